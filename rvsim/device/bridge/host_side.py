"""The host's end of the encoder bridge: numbered frames out, messages in."""

from __future__ import annotations

from typing import TypeAlias, get_args

from rvsim.device.bridge.frames import BadFrame, Found, FrameDecoder, Problem
from rvsim.device.bridge.messages import BoardMessage, HostMessage, decode, encode

Heard: TypeAlias = BoardMessage | BadFrame


class BridgeEncoder:
    """Numbers what is sent: 0, 1, … 255, 0, … as the board wants it."""

    def __init__(self) -> None:
        self._next = 0

    def encode(self, message: HostMessage) -> bytes:
        """The message's frame, with the next number."""
        data = encode(message, self._next)
        self._next = (self._next + 1) % 256
        return data


class BridgeDecoder:
    """Messages of bytes as they come, however they are cut up."""

    def __init__(self) -> None:
        self._frames = FrameDecoder()

    def feed(self, data: bytes) -> tuple[Heard, ...]:
        """What the bytes complete. A frame that says nothing a board can say is a bad one."""
        return tuple(map(_heard, self._frames.feed(data)))


def _heard(found: Found) -> Heard:
    if isinstance(found, BadFrame):
        return found
    message = decode(found)
    if isinstance(message, Problem):
        return BadFrame(message, found.sequence)
    return message if isinstance(message, get_args(BoardMessage)) else BadFrame(Problem.TYPE, found.sequence)
