"""`al5b://` is a serial port like any other, and its options are those of the arm. Time is virtual but for one test."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

import pytest
import serial

import rvsim.device
from rvsim.device import protocol_al5b
from rvsim.device.link.real_time import WallClock
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.resources import resource


class TestTime(WallClock):
    """Passes where somebody waits."""

    __test__ = False

    def __init__(self) -> None:
        self.time = 0.0

    def now(self) -> float:
        return self.time

    def wait(self, changed: threading.Condition | threading.Event, seconds: float) -> None:
        self.time += seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> TestTime:
    clock = TestTime()
    monkeypatch.setattr(protocol_al5b.Serial, "clock", clock)
    return clock


@pytest.fixture
def ports(clock: TestTime) -> Iterator[Any]:
    opened = []

    def open_port(options: str = "", **settings: Any) -> Any:
        opened.append(serial.serial_for_url(f"al5b://{options}", **{"timeout": 0.1, **settings}))
        return opened[-1]

    yield open_port
    for port in opened:
        port.close()


def ask(port: Any, line: bytes, size: int = 100) -> bytes:
    port.write(line)
    return bytes(port.read(size))


def test_importing_the_device_makes_pyserial_know_the_scheme() -> None:
    program = "import serial, rvsim.device; print(serial.serial_for_url('al5b://').baudrate)"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, check=True).stdout.split() == [b"9600"]
    assert serial.protocol_handler_packages.count(rvsim.device.__name__) == 1


def test_a_board_answers_and_is_a_fresh_one_at_each_opening(ports: Any, clock: TestTime) -> None:
    port = ports()
    assert ask(port, b"VER\r").startswith(b"SSC32-V")
    port.write(b"#0P1600\r")
    clock.time += 0.1
    assert ask(port, b"QP0\r", 1) == b"\xa0"
    port.close()
    port.open()
    assert port.arm.channels[0] == "unknown"


def test_a_move_of_700_ms_takes_700_ms_and_a_frame_at_most(ports: Any, clock: TestTime) -> None:
    port = ports("?seed=2", timeout=0.01)
    ask(port, b"#0P1500\r")
    began = clock.time
    port.write(b"#0P1700T700\r")
    while ask(port, b"Q\r", 1) != b".":
        assert clock.time < began + 1.0
    assert 0.700 <= clock.time - began <= 0.700 + 0.020 + 17 * 10 / 9600 + 0.010


def test_time_passes_while_nobody_calls(ports: Any, clock: TestTime) -> None:
    port = ports()
    port.write(b"#0P1500\r#0P1900T4000\r")
    clock.time += 4.2
    assert ask(port, b"Q\r", 1) == b"."


def test_the_options_are_the_arms(ports: Any) -> None:
    file = resource("robots", "al5b.toml")
    port = ports(f"?robot={quote(str(file))}&seed=3&language=bridge&potentiometers=1&board_baud=38400", baudrate=38400)
    assert (port.arm.robot.name, port.arm.language) == ("al5b", "bridge")
    assert port.arm.servos != ports().arm.servos


@pytest.mark.parametrize(
    ("options", "what"),
    [
        ("?speed=9", r"no option “speed”.*Known: robot, seed, language, board, potentiometers, board_baud"),
        ("?sead=9", "Did you mean 'seed'"),
        ("?seed=x", "the option seed is “x”. It must be a whole number"),
        ("?language=basic", "It must be ssc32 or bridge"),
        ("?potentiometers=maybe", "It must be 0 or 1"),
        ("?board_baud=0", "It must be a rate such as 9600"),
        ("?robot=al6b", "No robot 'al6b'"),
        ("?robot=ur5e", "servo"),
        ("desk", "no address of a virtual arm"),
    ],
)
def test_what_an_option_cannot_be_is_told(ports: Any, options: str, what: str) -> None:
    with pytest.raises(serial.SerialException, match=what):
        ports(options)


def test_a_board_with_a_name_is_kept_and_has_one_port(ports: Any, clock: TestTime) -> None:
    port = ports("?board=desk")
    port.write(b"#0P1500\r#0P1900T4000\r")
    port.flush()
    with pytest.raises(serial.SerialException, match="open already"):
        ports("?board=desk")
    port.close()
    clock.time += 4.2
    assert ask(ports("?board=desk"), b"QP0\r") == bytes((190,))
    with pytest.raises(serial.SerialException, match="“desk” is another arm"):
        ports("?board=desk&seed=1")


def test_a_read_ends_at_its_timeout_with_what_there_is(ports: Any, clock: TestTime) -> None:
    port = ports(timeout=0.25)
    assert port.read(10) == b""
    assert clock.time == pytest.approx(0.25)
    port.timeout = 0
    assert ask(port, b"Q\r", 1) == b""
    clock.time += 0.1
    assert (port.in_waiting, port.read(10)) == (1, b".")


def test_output_that_is_called_back_makes_room_for_a_stop(ports: Any, clock: TestTime) -> None:
    port = ports()
    port.write(b"#0P1500\r")
    clock.time += 0.1
    began = clock.time
    port.write(b"#0P2000T100\r" * 50)
    assert port.out_waiting == 600
    port.reset_output_buffer()
    port.write(b"\rSTOP0\r")
    port.flush()
    assert clock.time - began < 0.010
    assert port.arm.commanded_pulses[0] == 1500


def test_a_full_buffer_holds_a_writer_up_until_its_timeout(ports: Any, clock: TestTime) -> None:
    port = ports(write_timeout=0.5)
    assert port.write(b"\r" * 4096) == 4096
    with pytest.raises(serial.SerialTimeoutException):
        port.write(b"\r" * 1000)
    assert clock.time == pytest.approx(0.5)
    port.write_timeout = 0
    port.reset_output_buffer()
    assert port.write(b"\r" * 5000) == 4095
    port.cancel_write()
    port.write_timeout = None
    assert port.write(b"\r" * 5000) == 0


def test_a_port_that_vanishes_raises_and_can_be_opened_when_it_is_back(ports: Any) -> None:
    port = ports("?board=unplugged")
    port.arm.faults = Faults().switched(Fault.PORT_VANISHES)
    for use in (lambda: port.in_waiting, port.read, lambda: port.write(b"Q\r"), port.flush):
        with pytest.raises(serial.SerialException, match="the port has gone"):
            use()
    port.close()
    with pytest.raises(serial.SerialException, match="the port has gone"):
        port.open()
    port.arm.faults = Faults()
    port.open()
    assert ask(port, b"Q\r", 1) == b"."


def test_a_board_set_to_another_rate_hears_and_says_garbage(ports: Any) -> None:
    port = ports("?board_baud=9600", baudrate=115200)
    assert b"SSC32" not in ask(port, b"VER\r" * 5)
    port.baudrate = 9600
    assert b"SSC32" in ask(port, b"\x1bVER\r")


def test_settings_that_the_board_does_not_have_are_refused(ports: Any) -> None:
    with pytest.raises(serial.SerialException, match="8 bits and no parity"):
        ports(parity="E")
    port = ports()
    with pytest.raises(serial.SerialException, match="8 bits and no parity"):
        port.bytesize = 7
    with pytest.raises(serial.SerialException, match="no baud rate"):
        ports(baudrate=0)


def test_a_closed_port_says_so(ports: Any) -> None:
    port = ports()
    port.close()
    port.close()
    with pytest.raises(serial.PortNotOpenError):
        port.read()
    assert port.arm is not None


def test_a_read_without_end_is_ended_from_another_thread() -> None:
    with serial.serial_for_url("al5b://") as port:
        taken: list[bytes] = []
        reader = threading.Thread(target=lambda: taken.append(port.read(10)))
        reader.start()
        port.cancel_read()
        reader.join(timeout=20)
        assert taken == [b""]
        port.write(b"Q\r")
        assert port.read(1) == b"."
