"""The ends of a wire that another program may hold: one at a time, who comes and goes as it likes."""

from __future__ import annotations

import os
import socket
from contextlib import suppress
from typing import Protocol

from rvsim.errors import DeviceError
from rvsim.language import tr


class Wire(Protocol):
    """A way in for another program; used by one thread. Nothing here waits, except `wait`."""

    @property
    def address(self) -> str:
        """What to give to `serial.serial_for_url`."""
        ...

    def open(self) -> None:
        """Let clients in.

        Raises:
            DeviceError: the address is not to be had.
        """
        ...

    def close(self) -> None:
        """Send clients away and leave nothing behind."""
        ...

    def sockets(self) -> tuple[int, ...]:
        """File numbers at which something may happen."""
        ...

    def read(self, size: int) -> bytes:
        """At most so many bytes from the client."""
        ...

    def write(self, data: bytes) -> None:
        """Bytes for the client; lost where there is none, or none that reads."""
        ...

    def flushed(self) -> bool:
        """Whether the client has called its output back since the last look."""
        ...

    def client_baud(self) -> int | None:
        """The client's rate, where the wire has one [bit/s]."""
        ...


class TcpWire:
    """A TCP port of this computer, not reachable from others.

    Args:
        port: its number; 0 takes a free one.
    """

    def __init__(self, port: int = 0) -> None:
        self._port = port
        self._door: socket.socket | None = None
        self._client: socket.socket | None = None

    @property
    def address(self) -> str:
        """`socket://127.0.0.1:54321`."""
        return f"socket://127.0.0.1:{self._port}"

    def open(self) -> None:
        """Listen.

        Raises:
            DeviceError: the port is taken.
        """
        door = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        if os.name == "posix":  # elsewhere it would let a second server take the same port
            door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            door.bind(("127.0.0.1", self._port))
            door.listen()
        except (OSError, OverflowError) as problem:
            door.close()
            remedy = tr("Another program may have it: choose another port, or 0 for a free one.")
            raise DeviceError(
                self.address, tr("this port cannot be opened ({problem})", problem=problem), remedy
            ) from problem
        door.setblocking(False)
        self._door, self._port = door, door.getsockname()[1]

    def close(self) -> None:
        """Hang up."""
        self._hang_up()
        if self._door is not None:
            self._door.close()
            self._door = None

    def sockets(self) -> tuple[int, ...]:
        """The door and the client."""
        return tuple(end.fileno() for end in (self._door, self._client) if end is not None)

    def read(self, size: int) -> bytes:
        """What the client has sent; a client that has gone makes room for the next one."""
        data = b"" if self._client is None else self._receive(self._client, size)
        self._let_in()
        return data

    def _receive(self, client: socket.socket, size: int) -> bytes:
        try:
            data = client.recv(size)
        except (BlockingIOError, InterruptedError):
            return b""
        except OSError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def _let_in(self) -> None:
        """A wire has one end: whoever comes second is sent away."""
        if self._door is None:
            return
        with suppress(BlockingIOError, InterruptedError, ConnectionError):
            client, _ = self._door.accept()
            if self._client is not None:
                client.close()
                return
            client.setblocking(False)
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._client = client

    def write(self, data: bytes) -> None:
        """To the client."""
        if self._client is None:
            return
        try:
            self._client.send(data)
        except (BlockingIOError, InterruptedError):
            return  # it does not read: lost, as on a wire
        except OSError:
            self._hang_up()

    def flushed(self) -> bool:
        """Never: TCP has no such thing."""
        return False

    def client_baud(self) -> int | None:
        """None: TCP has no rate."""
        return None

    def _hang_up(self) -> None:
        if self._client is not None:
            self._client.close()
            self._client = None
