"""Other programs drive a served arm as they would a real one, and may come and go. Real ports: waits are for data."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import serial

from rvsim import load_robot
from rvsim.device.link.serve import Server, serve_pty, serve_tcp
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.errors import DeviceError

WAIT = 20.0  # [s] for data that must come
with_pty = pytest.mark.skipif(os.name != "posix", reason="this system has no pseudo-terminals")
Serve = Callable[..., Server]


@pytest.fixture
def arm() -> VirtualArm:
    return VirtualArm(load_robot("al5b"))


@pytest.fixture
def pty(arm: VirtualArm, tmp_path: Path) -> Iterator[Serve]:
    servers = []

    def start(baud: int | None = None, name: str = "arm") -> Server:
        servers.append(serve_pty(arm, link=tmp_path / name, baud=baud))
        return servers[-1]

    yield start
    for server in servers:
        server.close()


@pytest.fixture
def tcp(arm: VirtualArm) -> Iterator[Server]:
    server = serve_tcp(arm, baud=115200)
    yield server
    server.close()


def client(server: Server, baud: int = 9600, wait: float = WAIT) -> Any:
    return serial.serial_for_url(server.address, baudrate=baud, timeout=wait)


def until(server: Server, happened: Callable[[], bool]) -> None:
    """Let the server work until it has."""
    for _ in range(2000):
        if happened():
            return
        server.wait(0.01)
    raise AssertionError("it does not happen")


def pulse(port: Any, channel: int = 0) -> int:
    return 10 * ask_byte(port, f"QP{channel}\r".encode())


def drive_to(server: Server, port: Any, pulse_us: int) -> None:
    port.write(b"#0P%d\r" % pulse_us)
    until(server, lambda: pulse(port) == pulse_us)


def ask_byte(port: Any, query: bytes) -> int:
    port.write(query)
    return int(port.read(1)[0])


@with_pty
@pytest.mark.parametrize("baud", [9600, 115200])
def test_the_link_and_the_arm_outlive_their_clients(pty: Serve, baud: int) -> None:
    server = pty()
    link, terminal = Path(server.address), os.readlink(server.address)
    for pulse_us in (1600, 1400):
        with client(server, baud) as port:
            drive_to(server, port, pulse_us)
    with client(server, baud) as port:
        assert pulse(port) == 1400
        assert (os.readlink(link), server.baud, server.matches) == (terminal, baud, True)
    server.close()
    assert not link.is_symlink()
    assert not server.running
    server.close()


@with_pty
def test_a_stale_link_is_replaced_and_anything_else_left_alone(pty: Serve, tmp_path: Path) -> None:
    (tmp_path / "stale").symlink_to("/dev/pts/99999")
    assert Path(pty(name="stale").address).exists()
    (tmp_path / "notes").write_text("mine")
    (tmp_path / "to-notes").symlink_to(tmp_path / "notes")
    for name in ("notes", "to-notes", "no-such-folder/arm"):
        with pytest.raises(DeviceError, match="Choose another place for the link"):
            pty(name=name)
    assert (tmp_path / "to-notes").read_text() == "mine"


@with_pty
def test_a_link_that_a_newer_server_has_taken_is_left_to_it(pty: Serve) -> None:
    older, newer = pty(), pty()
    older.close()
    with client(newer) as port:
        port.write(b"VER\r")
        assert port.read(5) == b"SSC32"


@with_pty
def test_at_another_rate_than_the_boards_a_client_is_not_understood(pty: Serve, arm: VirtualArm) -> None:
    heard: list[bytes] = []
    arm.write = heard.append  # type: ignore[method-assign]
    server = pty(115200)
    with client(server, 9600) as port:
        until(server, lambda: not server.matches)
        port.write(b"#4P1500\r")
        until(server, lambda: len(heard) > 4)
        assert not set(b"".join(heard)) & set(b"#4P1500\r")
        port.baudrate = 115200
        until(server, lambda: server.matches)
        port.write(b"VER\r")
        until(server, lambda: b"".join(heard).endswith(b"VER\r"))


@with_pty
def test_output_that_a_client_calls_back_does_not_arrive(pty: Serve, arm: VirtualArm) -> None:
    server = pty()
    with client(server) as port:
        port.write(b"#1P2000\r" * 400)  # 3.3 s of the wire
        port.write(b"#2P1700\r")
        until(server, lambda: server.out_waiting > 3000)
        port.reset_output_buffer()
        port.write(b"\r#3P1500\r")
        until(server, lambda: pulse(port, 3) == 1500)
        assert arm.channels[2] == "unknown"


@with_pty
def test_a_pulled_plug_ends_the_client_and_the_name_comes_back(pty: Serve, arm: VirtualArm) -> None:
    server = pty()
    link = Path(server.address)
    with client(server) as port:
        arm.faults = Faults().switched(Fault.PORT_VANISHES)
        with pytest.raises(serial.SerialException):
            port.read(1)
    until(server, lambda: not link.is_symlink())
    arm.faults = Faults()
    until(server, link.is_symlink)
    with client(server) as port:
        assert ask_byte(port, b"Q\r") == ord(".")


@with_pty
def test_an_arm_that_breaks_ends_its_server_which_says_why(pty: Serve, arm: VirtualArm) -> None:
    def fail(dt: float) -> None:
        raise ZeroDivisionError("a gear without teeth")

    server = pty()
    arm.process = fail  # type: ignore[method-assign]
    assert server.wait(WAIT)
    assert server.problem == "ZeroDivisionError: a gear without teeth"
    assert not Path(server.address).is_symlink()


def test_tcp_clients_come_and_go_one_at_a_time(tcp: Server) -> None:
    for pulse_us in (1600, 1400):
        with client(tcp) as port:
            drive_to(tcp, port, pulse_us)
            with socket.create_connection(("127.0.0.1", int(tcp.address.rsplit(":", 1)[1])), WAIT) as second:
                assert second.recv(1) == b""
            assert pulse(port) == pulse_us


def test_a_tcp_port_is_named_and_taken_once(tcp: Server, arm: VirtualArm) -> None:
    number = int(tcp.address.rsplit(":", 1)[1])
    with pytest.raises(DeviceError, match="choose another port"):
        serve_tcp(arm, port=number)
    tcp.close()
    again = serve_tcp(arm, port=number)
    again.close()


def test_a_client_that_never_reads_holds_nobody_up(tcp: Server, arm: VirtualArm) -> None:
    with client(tcp) as port:
        for _ in range(20):
            port.write(b"Q\r" * 200)
        port.write(b"#5P1500\r")
        until(tcp, lambda: arm.channels[5] != "unknown")
