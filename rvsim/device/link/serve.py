"""A virtual arm for other programs: on a pseudo-terminal or on TCP. The one thread of a server is here."""

from __future__ import annotations

import atexit
import select
import threading
from collections.abc import Callable
from pathlib import Path
from typing import ClassVar, Protocol, TypeAlias

from rvsim.device.link.pacing import PacedArm, WiredArm
from rvsim.device.link.pty_wire import PtyWire
from rvsim.device.link.real_time import RealTime, WallClock
from rvsim.device.link.wires import TcpWire, Wire
from rvsim.device.wire_log import Direction
from rvsim.errors import RvsimError

Log: TypeAlias = Callable[[Direction, bytes], None]
USUAL_BAUD = 9600
_OUTPUT_BUFFER = 4096  # bytes, as a serial driver has; what is with us a client can call back, the rest holds it up
_BUSY, _QUIET = 0.001, 0.01  # [s] between two looks at the arm while bytes are on their way, and otherwise


class ServedArm(WiredArm, Protocol):
    """An arm whose plug may be pulled."""

    @property
    def vanished(self) -> bool:
        """Whether its port has gone."""
        ...


def serve_pty(arm: ServedArm, *, link: Path, baud: int | None = None, log: Log | None = None) -> Server:
    """Serve the arm on a pseudo-terminal; the arm lives on while clients come and go.

    Args:
        arm: nobody else may move its time while it is served.
        link: the name under which clients find it. A former server's is replaced, foreign files never.
        baud: the board's rate [bit/s]: a client at another one hears garbage, as on a real wire. None: the client's.
        log: told of all bytes, by the server's thread.

    Raises:
        DeviceError: there are no pseudo-terminals here, or the place of the link is taken.
    """
    return Server(arm, PtyWire(link, baud or USUAL_BAUD), baud, log)


def serve_tcp(arm: ServedArm, *, port: int = 0, baud: int | None = None, log: Log | None = None) -> Server:
    """Serve the arm on a TCP port of this computer, 127.0.0.1 only.

    Args:
        arm: nobody else may move its time while it is served.
        port: its number; 0 takes a free one, `Server.address` says which.
        baud: at which bytes are paced [bit/s]; None: 9600.
        log: told of all bytes, by the server's thread.

    Raises:
        DeviceError: the port is taken.
    """
    return Server(arm, TcpWire(port), baud, log)


class Server:
    """Lets another program drive an arm, from its making until `close`.

    Args:
        arm: at the far end.
        wire: the near end, which clients hold.
        baud: the board's rate [bit/s], or None.
        log: told of bytes to the arm (→) and from it (←), by the server's thread.

    Attributes:
        received_bytes, sent_bytes: how many have come from clients, and gone to them.
    """

    clock: ClassVar[WallClock] = WallClock()

    def __init__(self, arm: ServedArm, wire: Wire, baud: int | None = None, log: Log | None = None) -> None:
        self.arm = arm
        self._log = log
        self.received_bytes = self.sent_bytes = 0
        self._wire = wire
        self._paced = PacedArm(arm, baud or USUAL_BAUD, board_baud=baud)
        self._time = RealTime(self._paced, self.clock.now())
        self._unplugged = False
        self._stop, self._stopped = threading.Event(), threading.Event()
        self.problem = ""
        wire.open()
        atexit.register(self.close)
        self._thread = threading.Thread(target=self._run, name=f"serving {wire.address}", daemon=True)
        self._thread.start()

    @property
    def address(self) -> str:
        """What a client gives to `serial.serial_for_url`."""
        return self._wire.address

    @property
    def running(self) -> bool:
        """Whether clients are served; where it has ended by itself `problem` says why."""
        return not self._stopped.is_set()

    @property
    def baud(self) -> int:
        """The rate at which the last client talks [bit/s]."""
        return self._paced.baud

    @property
    def board_baud(self) -> int:
        """The board's rate [bit/s]."""
        return self._paced.board_baud

    @property
    def matches(self) -> bool:
        """Whether the two are the same."""
        return self._paced.matches

    @property
    def out_waiting(self) -> int:
        """How many of the client's bytes have not arrived at the board."""
        return self._paced.out_waiting

    def wait(self, seconds: float) -> bool:
        """Wait until it has ended, at most so long [s]; whether it has."""
        return self._stopped.wait(seconds)

    def close(self) -> None:
        """Send clients away, take the link away, and end the thread."""
        self._stop.set()
        self._thread.join()
        atexit.unregister(self.close)

    def _run(self) -> None:
        try:
            while not self._stop.is_set():
                self._exchange()
                self._rest()
        except Exception as problem:  # whatever it is, the link must go and `running` must tell
            self.problem = str(problem) if isinstance(problem, RvsimError) else f"{type(problem).__name__}: {problem}"
        finally:
            self._wire.close()
            self._stopped.set()

    def _exchange(self) -> None:
        """One look at the wire and the arm."""
        self._time.tell(self.clock.now())
        self._mind_the_plug()
        if self._unplugged:
            self._paced.discard_input()
            return
        self._paced.baud = self._wire.client_baud() or self._paced.baud
        data = self._wire.read(self._room) if self._room else b""
        if self._wire.flushed():
            self._paced.cancel_output()
        self._paced.send(data)
        answer = self._paced.receive()
        if answer:
            self._wire.write(answer)
        self._tell(data, answer)

    def _tell(self, data: bytes, answer: bytes) -> None:
        self.received_bytes += len(data)
        self.sent_bytes += len(answer)
        if self._log is not None and data:
            self._log("→", data)
        if self._log is not None and answer:
            self._log("←", answer)

    def _mind_the_plug(self) -> None:
        """A port that vanishes takes its clients with it; back again, it is a new one of the same name."""
        if self.arm.vanished != self._unplugged:
            self._unplugged = self.arm.vanished
            if self._unplugged:
                self._wire.close()
            else:
                self._wire.open()

    @property
    def _room(self) -> int:
        return _OUTPUT_BUFFER - self._paced.out_waiting

    def _rest(self) -> None:
        seconds = _BUSY if self._paced.busy else _QUIET
        ends = self._wire.sockets() if self._room else ()
        if ends:
            select.select(ends, (), (), seconds)
        else:
            self._stop.wait(seconds)
