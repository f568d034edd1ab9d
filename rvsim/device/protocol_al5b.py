"""The virtual arm as a serial port: `serial.serial_for_url("al5b://")` once `rvsim.device` has been imported.

Options, all of them optional: `al5b://?robot=al5b&seed=3&language=bridge&board=desk&potentiometers=1&board_baud=9600`;
`rvsim.device.link.options.ArmOptions` says what they mean. Each opening makes a new arm, unless its board has a name.
Bytes take ten bits each at the port's baud rate, and the arm lives in real time.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, ClassVar

from serial.serialutil import PortNotOpenError, SerialBase, SerialException, SerialTimeoutException, to_bytes

from rvsim.device.link.kept import leave_board, take_board
from rvsim.device.link.options import ArmOptions, options_of
from rvsim.device.link.pacing import PacedArm
from rvsim.device.link.real_time import RealTime, WallClock
from rvsim.errors import RvsimError
from rvsim.language import left_to_right, tr

if TYPE_CHECKING:
    from rvsim.device.virtual.arm import VirtualArm

_OUTPUT_BUFFER = 4096  # bytes, as a serial driver of an operating system has
_LOOK_AGAIN = 0.001  # [s], while somebody waits


class Serial(SerialBase):  # type: ignore[misc]
    """A serial port with a virtual arm at its other end; every method may be called from any thread."""

    clock: ClassVar[WallClock] = WallClock()

    def __init__(self, *arguments: Any, **settings: Any) -> None:
        self._changed = threading.Condition()
        self._options = ArmOptions()
        self._wire: PacedArm | None = None
        self._arm: VirtualArm | None = None
        self._time: RealTime | None = None
        self._read_cancelled = self._write_cancelled = False
        super().__init__(*arguments, **settings)

    @property
    def arm(self) -> VirtualArm | None:
        """The arm at the other end, the last one after closing; None before the first opening."""
        return self._arm

    # --- opening and closing -----------------------------------------------------------------------------------------

    def open(self) -> None:
        """Connect.

        Raises:
            SerialException: it is open already, the address cannot be used, or the port has gone.
        """
        with self._changed:
            if self.is_open:
                raise self._exception(tr("this port is open already."))
            self._check_settings()
            try:
                self._connect(options_of(self.port or ""))
            except RvsimError as problem:
                raise SerialException(str(problem)) from problem

    def _connect(self, options: ArmOptions) -> None:
        self._arm, since = take_board(self.port, options, self.clock.now())
        self._options = options
        self._wire = PacedArm(self._arm, self.baudrate, board_baud=options.board_baud)
        self._time = RealTime(self._wire, since)
        self.is_open = True
        try:
            self._present()
        except SerialException:
            self.close()
            raise
        self._wire.discard_input()

    def close(self) -> None:
        """Disconnect; who waits in `read` gets what has come, who waits in `write` an exception."""
        with self._changed:
            if not self.is_open:
                return
            if self._time is not None:
                self._time.tell(self.clock.now())  # what has arrived by now has arrived
            self.is_open, self._wire = False, None
            leave_board(self._options, self.clock.now())
            self._changed.notify_all()

    def _reconfigure_port(self) -> None:
        self._check_settings()
        with self._changed:
            self._present().baud = self.baudrate

    def _check_settings(self) -> None:
        if self.bytesize != 8 or self.parity != "N":
            rule = "bytesize=8, parity='N'"
            raise self._exception(tr("the board talks with 8 bits and no parity: {rule}.", rule=rule))
        if self.baudrate < 1:
            raise self._exception(tr("{rate} is no baud rate.", rate=self.baudrate))

    def _exception(self, sentence: str) -> SerialException:
        return SerialException(f"{left_to_right(self.port)}: {sentence}")

    # --- time --------------------------------------------------------------------------------------------------------

    def _present(self) -> PacedArm:
        """The wire after all time that has passed since the last look at it."""
        if self._wire is None or self._time is None or self._arm is None:
            raise PortNotOpenError
        self._time.tell(self.clock.now())
        if self._arm.vanished:
            raise self._exception(tr("the port has gone, as when its plug is pulled."))
        return self._wire

    def _deadline(self, timeout: float | None) -> float:
        return float("inf") if timeout is None else self.clock.now() + timeout

    def _wait(self, deadline: float) -> bool:
        """Whether there is time left, after a moment in which others could work."""
        left = deadline - self.clock.now()
        if left > 0.0:
            self.clock.wait(self._changed, min(left, _LOOK_AGAIN))
        return left > 0.0

    # --- reading -----------------------------------------------------------------------------------------------------

    @property
    def in_waiting(self) -> int:
        """How many bytes have come."""
        with self._changed:
            return self._present().in_waiting

    def read(self, size: int = 1) -> bytes:
        """As many bytes, or those that came before the timeout; a `cancel_read` ends it, or the next one."""
        taken = b""
        with self._changed:
            deadline = self._deadline(self.timeout)
            taken = self._present().receive(size)
            while len(taken) < size and not self._read_cancelled and self._wait(deadline) and self.is_open:
                taken += self._present().receive(size - len(taken))
            self._read_cancelled = False
        return taken

    def cancel_read(self) -> None:
        """End a `read` that waits in another thread, or the next one."""
        with self._changed:
            self._read_cancelled = self.is_open
            self._changed.notify_all()

    def reset_input_buffer(self) -> None:
        """Forget the bytes that have come."""
        with self._changed:
            self._present().discard_input()

    # --- writing -----------------------------------------------------------------------------------------------------

    @property
    def out_waiting(self) -> int:
        """How many bytes have not arrived at the board."""
        with self._changed:
            return self._present().out_waiting

    def write(self, data: Any) -> int:
        """Hand bytes over and return how many; waits only where the buffer is full.

        Raises:
            SerialTimeoutException: the buffer stayed full for longer than the write timeout.
        """
        data = to_bytes(data)
        with self._changed:
            deadline = self._deadline(self.write_timeout)
            left = self._hand_over(data)
            while left and not self._write_cancelled and self._wait(deadline):
                left = self._hand_over(left)
            cancelled, self._write_cancelled = self._write_cancelled, False
        if left and not cancelled and self.write_timeout != 0:
            raise SerialTimeoutException("Write timeout")
        return len(data) - len(left)

    def _hand_over(self, data: bytes) -> bytes:
        wire = self._present()
        room = _OUTPUT_BUFFER - wire.out_waiting
        wire.send(data[:room])
        return data[room:]

    def flush(self) -> None:
        """Wait until all bytes have arrived at the board."""
        with self._changed:
            while self._present().out_waiting and not self._write_cancelled:
                self._wait(float("inf"))
            self._write_cancelled = False

    def cancel_write(self) -> None:
        """End a `write` that waits in another thread, or the next one."""
        with self._changed:
            self._write_cancelled = self.is_open
            self._changed.notify_all()

    def reset_output_buffer(self) -> None:
        """Forget the bytes that have not begun."""
        with self._changed:
            self._present().cancel_output()

    # --- lines that the board does not have --------------------------------------------------------------------------

    @property
    def cts(self) -> bool:
        """Clear to send: always."""
        return True

    @property
    def dsr(self) -> bool:
        """Data set ready: always."""
        return True

    @property
    def ri(self) -> bool:
        """Ring indicator: never."""
        return False

    @property
    def cd(self) -> bool:
        """Carrier detect: always."""
        return True

    def _update_rts_state(self) -> None:
        """The board has no such line."""

    def _update_dtr_state(self) -> None:
        """The board has no such line."""

    def _update_break_state(self) -> None:
        """The board takes no notice of a break."""
