"""Frames of the encoder bridge: start byte, length, sequence number, type, payload, CRC; cut out of a stream of bytes.

Inside a frame the start byte and the escape byte never stand as they are: each is sent as the escape byte and itself
XOR 0x20, as in HDLC (RFC 1662, section 4.2). So a start byte always begins a frame, whatever was unfinished before it,
and no wrong length can swallow the stop that follows. resources/help/encoder-bridge.md is the specification.
"""

from __future__ import annotations

from binascii import crc_hqx
from enum import IntEnum
from typing import NamedTuple, TypeAlias

START, ESCAPE, FLIP = 0x7E, 0x7D, 0x20
LONGEST_PAYLOAD = 64  # bytes
_HEAD, _CRC = 3, 2  # length, sequence, type; CRC
_CRC_START = 0xFFFF
_LONGEST = 1 + 2 * (_HEAD + LONGEST_PAYLOAD + _CRC)  # bytes of a frame on the wire, each of them escaped


class Problem(IntEnum):
    """Why a frame is not acted upon; the numbers are those of the wire."""

    NOISE = 1  # bytes outside of a frame
    CUT = 2  # a start byte before the frame was whole
    ESCAPE = 3  # the escape byte before a byte that needs none
    LENGTH = 4  # a payload longer than any, or not as long as its type's is
    CRC = 5
    SEQUENCE = 6  # repeated or old
    TYPE = 7  # unknown
    VALUE = 8  # outside its range, or an axis that there is not
    ASLEEP = 9  # a set-point for an axis that has not been woken
    STOPPED = 10  # a stop has latched


class Frame(NamedTuple):
    """A whole frame with a right CRC; numbers are bytes, 0…255."""

    sequence: int
    type: int
    payload: bytes


class BadFrame(NamedTuple):
    """Bytes that are no frame; `sequence` is the number in them as far as one was there, else 0."""

    problem: Problem
    sequence: int = 0


Found: TypeAlias = Frame | BadFrame


def crc16(data: bytes) -> int:
    """CRC-16/IBM-3740 ("CCITT-FALSE"): polynomial 0x1021, start 0xFFFF, nothing reflected; "123456789" gives 0x29B1."""
    return crc_hqx(data, _CRC_START)


def frame_bytes(frame: Frame) -> bytes:
    """The frame as it goes over the wire."""
    inside = bytes((len(frame.payload), frame.sequence, frame.type)) + frame.payload
    return bytes((START,)) + _escaped(inside + crc16(inside).to_bytes(_CRC, "little"))


def next_frame(buffer: bytes) -> tuple[int, Found | None]:
    """Bytes to consume off the buffer's front, and what they were.

    (0, None) means: feed me more. A positive count with None: a start byte before another one, which says nothing.
    """
    if not buffer:
        return 0, None
    if buffer[0] != START:
        start = buffer.find(START)
        return (start if start > 0 else len(buffer)), BadFrame(Problem.NOISE)
    return _at_start(buffer)


def _at_start(buffer: bytes) -> tuple[int, Found | None]:
    """The frame that begins with the buffer's first byte."""
    inside = bytearray()
    position = 1
    while position < len(buffer):
        if buffer[position] == ESCAPE and position + 1 == len(buffer):
            return 0, None
        taken, byte = _unescaped(buffer, position)
        if isinstance(byte, Problem):
            return position + taken, BadFrame(byte, _sequence(inside)) if position > 1 or taken else None
        inside.append(byte)
        position += taken
        if inside[0] > LONGEST_PAYLOAD:
            return position, BadFrame(Problem.LENGTH)
        if len(inside) == _HEAD + inside[0] + _CRC:
            return position, _checked(bytes(inside))
    return 0, None


def _unescaped(buffer: bytes, position: int) -> tuple[int, int | Problem]:
    """How many bytes stand for the one at a position, and that byte; a start byte is left where it is."""
    byte = buffer[position]
    if byte == START:
        return 0, Problem.CUT
    if byte != ESCAPE:
        return 1, byte
    flipped = buffer[position + 1]
    if flipped == START:
        return 1, Problem.CUT
    byte = flipped ^ FLIP
    return (2, byte) if byte in (START, ESCAPE) else (2, Problem.ESCAPE)


def _checked(inside: bytes) -> Found:
    if crc16(inside[:-_CRC]) != int.from_bytes(inside[-_CRC:], "little"):
        return BadFrame(Problem.CRC, inside[1])
    return Frame(inside[1], inside[2], inside[_HEAD:-_CRC])


def _sequence(inside: bytearray) -> int:
    return inside[1] if len(inside) > 1 else 0


def _escaped(data: bytes) -> bytes:
    escaped = bytearray()
    for byte in data:
        escaped += bytes((ESCAPE, byte ^ FLIP)) if byte in (START, ESCAPE) else bytes((byte,))
    return bytes(escaped)


class FrameDecoder:
    """Frames of bytes as they come, however they are cut up; remembers less than one frame."""

    def __init__(self) -> None:
        self._buffer = b""
        self._lost = False

    @property
    def unfinished(self) -> bool:
        """Whether a frame has begun and is not whole yet."""
        return bool(self._buffer)

    def feed(self, data: bytes) -> tuple[Found, ...]:
        """What the bytes complete. Noise is told of once, and not at all after a bad frame: it is the rest of it."""
        buffer, position = self._buffer + data, 0
        found: list[Found] = []
        while True:
            consumed, item = next_frame(buffer[position : position + _LONGEST])
            position += consumed
            if not consumed:
                self._buffer = buffer[position:]
                return tuple(found)
            if item is not None:
                self._note(item, found)

    def _note(self, item: Found, found: list[Found]) -> None:
        if not (self._lost and item == BadFrame(Problem.NOISE)):
            found.append(item)
        self._lost = isinstance(item, BadFrame)
