"""An arm at the end of a wire on which bytes take their time. Virtual time: no clock is read."""

from __future__ import annotations

from typing import Protocol

from rvsim.device.link.line import Line
from rvsim.device.virtual.clock import NANO, Clock
from rvsim.errors import SettingError
from rvsim.language import tr

# Answers are picked up once in a USB frame, as adapters do; after a silence once in a servo frame, which costs little.
_PICK_UP_NS, _IDLE_PICK_UP_NS = NANO // 1000, NANO // 50
_SILENCE_NS = 5 * NANO
_RECENT_NS = NANO // 20
_BUFFER = 4096  # bytes kept for who does not read; what comes on top is lost, as in an operating system


class WiredArm(Protocol):
    """What hangs on the wire: `VirtualArm`, whichever language it speaks."""

    def write(self, data: bytes) -> None:
        """Bytes arrive now."""
        ...

    def process(self, dt: float) -> None:
        """So much time passes [s]."""
        ...

    def read(self) -> bytes:
        """What it has answered since the last call."""
        ...


class PacedArm:
    """An arm and the wire to it, ten bits a byte both ways. process(a) and process(b) are process(a + b).

    Args:
        arm: at the other end.
        baud: our rate [bit/s].
        board_baud: the arm's rate; at another one than ours both sides hear garbage. None: it goes with ours.

    Raises:
        SettingError: a rate below 1.
    """

    def __init__(self, arm: WiredArm, baud: int, *, board_baud: int | None = None) -> None:
        self.arm = arm
        self._baud, self._board_baud = _checked(baud), _checked(board_baud or baud)
        self._follows = board_baud is None
        self._down, self._up = Line(baud, self.board_baud), Line(self.board_baud, baud)
        self._clock, self._arm_time, self._last_byte = Clock(), 0, -_SILENCE_NS
        self._pick_up_at = _IDLE_PICK_UP_NS
        self._received = bytearray()

    @property
    def baud(self) -> int:
        """Our rate [bit/s]; another one holds from the next byte on."""
        return self._baud

    @baud.setter
    def baud(self, baud: int) -> None:
        if baud == self._baud:
            return
        self._baud = _checked(baud)
        self._down.set_rates(baud, self.board_baud)
        self._up.set_rates(self.board_baud, baud)

    @property
    def board_baud(self) -> int:
        """The arm's rate [bit/s]."""
        return self._baud if self._follows else self._board_baud

    @property
    def matches(self) -> bool:
        """Whether both sides talk at the same rate."""
        return self._baud == self.board_baud

    @property
    def out_waiting(self) -> int:
        """How many of our bytes have not arrived."""
        return self._down.waiting

    @property
    def busy(self) -> bool:
        """Whether bytes are on their way, or were a moment ago."""
        recent = self._clock.now - self._last_byte < _RECENT_NS
        return recent or not (self._down.resting and self._up.resting)

    @property
    def in_waiting(self) -> int:
        """How many bytes `receive` would give."""
        return len(self._received)

    def send(self, data: bytes) -> None:
        """Put bytes on the wire, behind those that wait."""
        self._down.send(data, self._clock.now)

    def cancel_output(self) -> None:
        """Forget what waits; a byte under way arrives nevertheless."""
        self._down.cancel()

    def receive(self, size: int | None = None) -> bytes:
        """What has arrived from the arm, at most `size` bytes of it."""
        taken = bytes(self._received[:size])
        del self._received[:size]
        return taken

    def discard_input(self) -> None:
        """Forget what has arrived."""
        self._received.clear()

    def process(self, dt: float) -> None:
        """So much time passes [s], for the wire and for the arm."""
        until = self._clock.advance(dt)
        while (event := self._next_event()) <= until:
            self._run_arm(event)
            self._bytes_down(event)
            if event == self._pick_up_at:
                self._pick_up(event)
        self._run_arm(until)
        self._bytes_up(until)

    def _next_event(self) -> int:
        return self._pick_up_at if self._down.resting else min(self._pick_up_at, self._down.arrives)

    def _run_arm(self, now: int) -> None:
        if now > self._arm_time:
            self.arm.process((now - self._arm_time) / NANO)
            self._arm_time = now

    def _bytes_down(self, now: int) -> None:
        data = b"" if self._down.resting or self._down.arrives > now else self._down.arrive()
        data += self._down.misheard(now)
        if data:
            self.arm.write(data)
        if data or not self._down.resting:
            self._last_byte = now
            self._pick_up_at = min(self._pick_up_at, _after(now, _PICK_UP_NS))

    def _pick_up(self, now: int) -> None:
        self._bytes_up(now)
        answer = self.arm.read()
        if answer:
            self._up.send(answer[: _BUFFER - self._up.waiting], now)
            self._last_byte = now
        quiet = now - self._last_byte >= _SILENCE_NS and self._up.resting
        self._pick_up_at = _after(now, _IDLE_PICK_UP_NS if quiet else _PICK_UP_NS)

    def _bytes_up(self, now: int) -> None:
        while not self._up.resting and self._up.arrives <= now:
            self._received += self._up.arrive()
        self._received += self._up.misheard(now)
        del self._received[_BUFFER:]


def _after(now: int, step: int) -> int:
    return (now // step + 1) * step


def _checked(baud: int) -> int:
    if baud < 1:
        raise SettingError("baud", baud, tr("1 or more"))
    return baud
