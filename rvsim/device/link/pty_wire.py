"""A pseudo-terminal as a wire, under a name that stays: Linux and macOS. Imports nothing that Windows lacks."""

from __future__ import annotations

import os
import struct
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

from rvsim.errors import DeviceError
from rvsim.language import tr, tr_later

_DATA = 0  # the first byte of each packet that carries data; other values are flags
_TERMINALS = ("/dev/pts/", "/dev/tty")


def usual_link() -> Path:
    """Where the link is when nobody says another place: the same for each start, another one for each user."""
    import getpass

    return Path(tempfile.gettempdir()) / f"al5b-{getpass.getuser()}"


class PtyWire:
    """A pseudo-terminal, and a symbolic link to it that has the same name at each start.

    Args:
        link: the link; one that a former server has left is replaced, anything else is not touched.
        baud: the rate that it is set to until a client sets another [bit/s].
    """

    def __init__(self, link: Path, baud: int) -> None:
        self.link = Path(os.path.abspath(link))
        self._baud = baud
        self._master = self._slave = -1
        self._flushed = False

    @property
    def address(self) -> str:
        """The link."""
        return str(self.link)

    def open(self) -> None:
        """Make the terminal and the link.

        Raises:
            DeviceError: the system has no pseudo-terminals, or the link's place is taken.
        """
        try:
            import tty
        except ImportError:
            raise DeviceError(
                self.address, tr("this system has no pseudo-terminals"), tr("Serve on TCP instead.")
            ) from None
        self._check_place()
        # Held open by us as well, the terminal outlives its clients and keeps their settings.
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self._set_speed()
        self._report_flushes()
        try:
            self._point(os.ttyname(self._slave))
        except OSError as problem:
            self.close()
            raise DeviceError(
                self.address, tr("the link cannot be made ({problem})", problem=problem.strerror), tr(_ELSEWHERE)
            ) from problem

    def close(self) -> None:
        """Take the link away, where it is still ours, and hang up."""
        if self._master < 0:
            return
        if self._points_to(os.ttyname(self._slave)):
            with suppress(OSError):
                self.link.unlink()
        for end in (self._slave, self._master):
            os.close(end)
        self._master = self._slave = -1

    def sockets(self) -> tuple[int, ...]:
        """Our end."""
        return () if self._master < 0 else (self._master,)

    def read(self, size: int) -> bytes:
        """What the client has sent."""
        try:
            packet = os.read(self._master, size + 1)
        except (BlockingIOError, InterruptedError):
            return b""
        if not packet:
            return b""
        if packet[0] == _DATA:
            return packet[1:]
        self._flushed |= bool(packet[0] & _termios().TIOCPKT_FLUSHWRITE)
        return b""

    def write(self, data: bytes) -> None:
        """To the client; what it does not read is lost when its buffer is full, as on a wire."""
        with suppress(BlockingIOError, InterruptedError):
            os.write(self._master, data)

    def flushed(self) -> bool:
        """Whether the client has flushed its output."""
        flushed, self._flushed = self._flushed, False
        return flushed

    def client_baud(self) -> int | None:
        """The rate that the client has set; None for one that has no name."""
        termios = _termios()
        speed = termios.tcgetattr(self._slave)[5]
        return next((rate for rate in _RATES if getattr(termios, f"B{rate}", None) == speed), None)

    def _set_speed(self) -> None:
        termios = _termios()
        attributes = termios.tcgetattr(self._slave)
        attributes[4] = attributes[5] = getattr(termios, f"B{self._baud}", termios.B9600)
        termios.tcsetattr(self._slave, termios.TCSANOW, attributes)

    def _report_flushes(self) -> None:
        """Packet mode: that a client calls its output back is told to us, who have read a part of it already."""
        import fcntl

        fcntl.ioctl(self._master, _termios().TIOCPKT, struct.pack("i", 1))

    # --- the link ----------------------------------------------------------------------------------------------------

    def _check_place(self) -> None:
        if self.link.is_symlink():
            target = os.readlink(self.link)
            if self.link.exists() and not target.startswith(_TERMINALS):
                raise DeviceError(
                    self.address, tr("a link to {target} is there already", target=target), tr(_ELSEWHERE)
                )
        elif self.link.exists():
            raise DeviceError(self.address, tr("something else is there already"), tr(_ELSEWHERE))
        elif not self.link.parent.is_dir():
            raise DeviceError(self.address, tr("there is no folder {folder}", folder=self.link.parent), tr(_ELSEWHERE))

    def _point(self, terminal: str) -> None:
        new = self.link.with_name(f".{self.link.name}.{os.getpid()}")
        with suppress(FileNotFoundError):
            new.unlink()
        new.symlink_to(terminal)
        new.replace(self.link)

    def _points_to(self, terminal: str) -> bool:
        return self.link.is_symlink() and os.readlink(self.link) == terminal


_ELSEWHERE = tr_later("Choose another place for the link.")
_RATES = (1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, 921600, 1000000)


def _termios() -> Any:
    import termios

    return termios
