"""The driver's thread at a real (virtual) port: it outlives whatever happens there."""

from __future__ import annotations

import logging
import threading

import pytest

from rvsim import load_robot
from rvsim.device.driver import ArmDriver, available_ports
from rvsim.device.driver.actions import StopAll
from rvsim.device.virtual.faults import Fault, Faults

SOON = 10.0  # [s]; what happens at once needs milliseconds


@pytest.fixture
def driver(quick_time):
    with ArmDriver(load_robot("al5b"), "al5b://", baud=115200) as driver:
        yield driver


def set_off(driver: ArmDriver) -> None:
    """Connected, the base awake and on a long way."""
    assert driver.connect() is None
    assert driver.wait(lambda state: state.phase == "asleep", SOON)
    assert driver.wake(0, 0.0) is None
    assert driver.wait(lambda state: state.phase == "ready", SOON)
    assert driver.jog_pulse(0, 2000.0, 20.0) is None
    assert driver.wait(lambda state: state.commanded_q[0] > 0.02, SOON)


def test_a_pulled_plug_is_a_sentence_and_the_next_connection_needs_no_restart(driver) -> None:
    set_off(driver)
    driver.virtual.faults = Faults(frozenset({Fault.PORT_VANISHES}))
    assert driver.wait(lambda state: state.phase == "lost", SOON)
    assert "the port has gone" in driver.state.reason
    assert driver.connect() is None
    assert driver.wait(lambda state: state.phase == "asleep", SOON)
    assert not any(driver.state.awake)


def test_a_stop_reaches_the_board_and_a_reset_leads_out(driver) -> None:
    set_off(driver)
    assert driver.stop("the cat") is None
    assert driver.state.phase == "stopped"
    assert driver.wait(lambda _: driver.reset() is None, SOON)
    assert driver.state.phase == "ready"
    assert any(b"STOP0" in entry.data for entry in driver.log.since(0)[1])


@pytest.mark.parametrize("url", ["al5b://?colour=red", "nothing://", "socket://127.0.0.1:1", "/no/such/port"])
def test_a_port_that_cannot_be_opened_is_a_sentence(url) -> None:
    with ArmDriver(load_robot("al5b"), url) as driver:
        assert driver.connect() is None
        assert driver.wait(lambda state: state.phase == "lost", SOON)
        assert url in driver.state.reason


def test_a_mistake_inside_the_thread_stops_the_arm_and_not_the_thread(driver, monkeypatch, caplog) -> None:
    set_off(driver)
    with caplog.at_level(logging.CRITICAL), monkeypatch.context() as patch:
        patch.setattr(driver._core, "process", lambda *_: 1 / 0)
        assert driver.wait(lambda state: state.phase == "lost", SOON)
    assert "ZeroDivisionError" in driver.state.reason
    assert driver.virtual.channels[0] == "holding"
    assert driver.connect() is None
    assert driver.wait(lambda state: state.phase == "asleep", SOON)


class WrittenDown:
    """A port, and what is written to it."""

    def __init__(self, port) -> None:
        self._port, self.written = port, []

    def __getattr__(self, name):
        return getattr(self._port, name)

    def write(self, data: bytes) -> int:
        self.written.append(bytes(data))
        return self._port.write(data)

    def reset_output_buffer(self) -> None:
        raise ValueError("this port cannot call bytes back")


def test_what_was_about_to_be_written_goes_down_with_the_stop(driver, monkeypatch) -> None:
    assert driver.connect() is None
    assert driver.wait(lambda state: state.phase == "asleep", SOON)
    port = driver._port = WrittenDown(driver._port)
    process = driver._core.process

    def interrupted(now: float, received: bytes) -> bytes:
        out = process(now, received)
        if b"#0P" in out:  # another thread stops as soon as the lock is free
            driver._core.do(StopAll())
        return out

    monkeypatch.setattr(driver._core, "process", interrupted)
    assert driver.wake(0, 0.0) is None
    assert driver.wait(lambda state: state.phase == "stopped", SOON)
    assert driver.wait(lambda _: driver.reset() is None, SOON)
    assert any(b"STOP0" in data for data in port.written)
    assert not any(b"#0P" in data for data in port.written)


def test_closing_at_once_after_a_stop_lets_the_stop_arrive() -> None:
    with ArmDriver(load_robot("al5b"), "al5b://", baud=9600) as driver:
        set_off(driver)
        assert driver.stop() is None
    assert driver.virtual.channels[0] == "holding"


def test_a_stop_for_a_port_that_never_opened_does_not_bar_the_next_connection(monkeypatch) -> None:
    opening, gate = threading.Event(), threading.Event()

    def never(*_: object, **__: object) -> None:
        opening.set()
        gate.wait(SOON)
        raise OSError("no such port")

    monkeypatch.setattr("serial.serial_for_url", never)
    with ArmDriver(load_robot("al5b"), "COM99") as driver:
        assert driver.connect() is None
        assert opening.wait(SOON)
        assert driver.stop() is None
        assert driver.disconnect() is None
        gate.set()
        assert driver.wait(lambda _: driver.connect() is None, SOON)


def test_who_waits_may_ask_for_something(driver) -> None:
    assert driver.connect() is None
    assert driver.wait(lambda _: len([driver.hold() for _ in range(2000)]) > 0, SOON)
    assert driver.wait(lambda state: state.phase == "asleep", SOON)


def test_closing_ends_the_thread(driver) -> None:
    set_off(driver)
    driver.close()
    assert not any(thread.name.startswith("arm at") for thread in threading.enumerate())
    assert driver.state.phase == "disconnected"
    assert "closed" in driver.connect().sentence
    driver.close()


def test_the_virtual_arm_is_the_first_of_the_ports() -> None:
    ports = available_ports()
    assert ports[0].url == "al5b://"
    assert all(port.title and port.detail for port in ports)
