"""A virtual arm of the window that other programs drive, through a pseudo-terminal or TCP."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from tempfile import gettempdir
from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, QTimer, Signal

from rvsim.errors import RvsimError
from rvsim.gui.served_wire import ServedWire
from rvsim.gui.session import Session
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.device.link.serve import Server
    from rvsim.device.virtual.arm import VirtualArm
    from rvsim.device.wire_log import WireLog

Way = Literal["pty", "tcp"]
LINK_NAME = "rvsim-al5b"
_WATCH_MS = 100


def ways() -> dict[str, str]:
    """What this system can: Windows has no pseudo-terminals."""
    tcp = {"tcp": tr("TCP on this computer")}
    return tcp if sys.platform == "win32" else {"pty": tr("Pseudo-terminal (a serial port)"), **tcp}


class ServedArm(QObject):
    """At most one.

    Signals:
        changed(): it began or ended.
        watched(): some ten times a second while it is served: time to read its log and its counters.
    """

    changed = Signal()
    watched = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._server: Server | None = None
        self._arm: VirtualArm | None = None
        self._wire: ServedWire | None = None
        self._timer = QTimer(self, interval=_WATCH_MS)
        self._timer.timeout.connect(self._watch)

    @property
    def arm(self) -> VirtualArm | None:
        """The arm that is served, None when none is."""
        return self._arm

    @property
    def address(self) -> str:
        """What another program opens, "" when nothing is served."""
        return self._server.address if self._server else ""

    @property
    def log(self) -> WireLog | None:
        """Its bytes since serving began; that of the last arm stays."""
        return self._wire.log if self._wire else None

    @property
    def received_bytes(self) -> int:
        """How many have come from other programs since serving began."""
        return self._server.received_bytes if self._server else 0

    @property
    def sent_bytes(self) -> int:
        """How many have gone to them."""
        return self._server.sent_bytes if self._server else 0

    def begin(self, way: Way, baud: int, seed: int = 0) -> None:
        """Serve an arm like the one that is shown."""
        from rvsim.device.link.serve import serve_pty, serve_tcp
        from rvsim.device.virtual.arm import VirtualArm

        self.end()
        try:
            arm = VirtualArm(self._session.robot, seed=seed)
            began = time.monotonic()
            wire = ServedWire(lambda: time.monotonic() - began)
            link = Path(gettempdir()) / LINK_NAME
            self._server = (
                serve_pty(arm, link=link, baud=baud, log=wire.add)
                if way == "pty"
                else serve_tcp(arm, baud=baud, log=wire.add)
            )
        except (RvsimError, OSError) as problem:
            self._session.say(str(problem), "error")
            return
        self._arm, self._wire = arm, wire
        self._timer.start()
        self._session.say(
            tr("A virtual arm is waiting at {address}. What moves it is shown as a ghost.", address=self.address)
        )
        self.changed.emit()

    def end(self) -> None:
        """Send clients away."""
        server, self._server, self._arm = self._server, None, None
        self._timer.stop()
        if server is not None:
            server.close()
            self.changed.emit()

    def take_over(self, other: ServedArm) -> None:
        """Go on serving the arm of a window that this one takes the place of."""
        other._timer.stop()
        self._server, other._server = other._server, None
        self._arm, self._wire = other._arm, other._wire
        if self._server is not None:
            self._timer.start()
            self.changed.emit()

    def _watch(self) -> None:
        """It may end by itself, for instance when its link is taken away."""
        self.watched.emit()
        if self._server is not None and not self._server.running:
            problem = self._server.problem
            self.end()
            self._session.say(f"{tr('The virtual arm is not served any more.')} {problem}".strip(), "warning")
