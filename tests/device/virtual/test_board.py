"""The SSC-32 as bytes: what it answers, what it remembers, what its inputs say."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.device.virtual.board import Ssc32Board
from rvsim.device.virtual.faults import NO_FAULTS, Fault
from rvsim.device.virtual.inputs import potentiometer_pulse
from rvsim.robot.servos import pulses_of

ROBOT = load_robot("al5b")


def board(**options: object) -> Ssc32Board:
    return Ssc32Board(ROBOT.servos, lambda: ROBOT.home, **options)  # type: ignore[arg-type]


def said(of: Ssc32Board, line: bytes, dt: float = 0.0) -> bytes:
    of.write(line + b"\r")
    of.process(dt)
    return of.read()


def test_only_queries_are_answered() -> None:
    one = board()
    for line in (b"#0P1500", b"#0P1600T500", b"STOP0", b"#0PO10", b"#3H", b"#0:1", b"R4=960", b"SSCAT x;", b"?!", b""):
        assert said(one, line) == b""


def test_q_says_plus_until_the_pulses_have_come_to_their_end() -> None:
    one = board()
    assert said(one, b"Q") == b"."
    said(one, b"#0P1500", 0.02)
    assert said(one, b"Q") == b"."
    said(one, b"#0P1600T700")
    answers = [said(one, b"Q", 0.02) for _ in range(40)]
    assert answers == [b"+"] * 35 + [b"."] * 5


def test_q_stays_plus_after_stop_until_the_original_time_has_passed() -> None:
    one = board()
    said(one, b"#0P1500#1P1500", 0.02)
    said(one, b"#0P1600#1P1600T1000", 0.5)
    said(one, b"STOP0")
    said(one, b"STOP 1")
    before = one.pulses
    assert not one.busy
    assert said(one, b"Q") == b"+"
    one.process(0.48)
    assert said(one, b"Q", 0.02) == b"+"
    assert said(one, b"Q") == b"."
    np.testing.assert_array_equal(one.pulses, before)


def test_qp_answers_the_interpolated_pulse_in_tens_and_0_where_it_knows_none() -> None:
    one = board()
    assert said(one, b"QP0QP1") == b"\x00\x00"
    said(one, b"#0P1000", 0.02)
    said(one, b"#0P2000T1000", 0.5)
    assert said(one, b"QP0") == bytes([150])


def test_qp_leaves_the_offset_out_unless_the_firmware_is_old() -> None:
    one = board()
    said(one, b"#0PO50", 0.02)
    said(one, b"#0P1500", 0.02)
    assert one.pulses[0] == 1550
    assert said(one, b"QP0") == bytes([150])
    one.faults = NO_FAULTS.switched(Fault.QP_WITH_OFFSET)
    assert said(one, b"QP0") == bytes([155])


def test_registers_and_startup_text_act_when_the_power_comes() -> None:
    one = board()
    for line in (b"R0=13", b"R4=3840", b"R32=-50", b"R64=1400", b"SSCAT #1P1600;", b"SSCAT #2P1700;Q"):
        said(one, line)
    assert said(one, b"SS") == b'"#1P1600;#2P1700;Q"\r'
    assert said(one, b"SSDEL 1") == b""
    assert said(one, b"R32") == b"-50\r"
    one.process(1.0)
    assert not one.powered.any()
    assert one.baud == 9600
    one.power_cycle()
    one.process(0.02)
    assert one.pulses[:4].tolist()[:3] == [1350, 1600, 1700]
    assert np.isnan(one.pulses[3])
    assert one.baud == 38400


def test_a_disabled_startup_does_nothing() -> None:
    one = board()
    for line in (b"R0=32781", b"R64=1400", b"SSCAT #1P1600;"):
        said(one, line)
    one.power_cycle()
    one.process(0.1)
    assert not one.powered.any()


def test_a_startup_text_cannot_write_what_is_kept() -> None:
    one = board()
    for line in (b"R0=1", b"SSCAT R4=11520;SSDEL 99;#0P1500;"):
        said(one, line)
    one.power_cycle()
    assert said(one, b"R4") == b"960\r"
    assert said(one, b"SS") == b'"R4=11520;SSDEL 99;#0P1500;"\r'
    assert one.moving


def test_a_startup_text_holds_100_characters() -> None:
    one = board()
    for _ in range(3):
        said(one, b"SSCAT " + b"x" * 60)
    assert said(one, b"SS") == b'"' + b"x" * 100 + b'"\r'
    said(one, b"SSDEL 255")
    assert said(one, b"SS") == b'""\r'


def test_rdflt_answers_ok_after_more_than_a_second() -> None:
    one = board()
    said(one, b"R4=11520")
    assert said(one, b"RDFLT", 1.0) == b""
    assert one.busy
    one.process(0.5)
    assert one.read() == b"OK\r"
    assert said(one, b"R4") == b"960\r"


def test_the_version_can_be_another_boards() -> None:
    assert said(board(), b"ver") == b"SSC32-V2.04GP\r"
    assert said(board(version="SSC32-V2.50USB"), b"VER") == b"SSC32-V2.50USB\r"


def test_potentiometers_tell_where_the_joints_are_after_a_first_byte_that_means_nothing() -> None:
    one = board(potentiometers=True)
    first, then = said(one, b"VAVBVCVDVE"), said(one, b"VAVBVCVDVE")
    assert first != then
    pulses = [potentiometer_pulse(byte * 5.0 / 256.0) for byte in then]
    # Never more than a step of 5/256 V too low.
    assert np.all(np.abs(np.subtract(pulses_of(ROBOT.servos, ROBOT.home), pulses) - 3.9) < 4.0)


def test_an_input_without_a_sensor_is_at_0_volts() -> None:
    one = board()
    said(one, b"VAVH")
    assert said(one, b"VAVH") == b"\x00\x00"


def test_digital_inputs_are_debounced_and_latched() -> None:
    one = board()
    assert said(one, b"A BL C") == b"111"
    one.set_input(1, False)
    assert said(one, b"B", 0.010) == b"1"
    one.process(0.010)
    assert said(one, b"B") == b"0"
    one.set_input(1, True)
    one.process(0.020)
    assert said(one, b"B") == b"1"
    assert said(one, b"BL") == b"0"
    assert said(one, b"BL") == b"1"


def test_a_bounce_is_not_seen() -> None:
    one = board()
    one.set_input(0, False)
    one.process(0.010)
    one.set_input(0, True)
    assert said(one, b"AAL") == b"11"


def test_an_unfinished_line_is_forgotten_with_the_power() -> None:
    one = board()
    one.write(b"#0P15")
    one.power_cycle()
    said(one, b"#1P1500", 0.02)
    assert one.powered.tolist() == [False, True, *[False] * 30]


def test_switches_are_set_by_pin_and_by_eight() -> None:
    one = board()
    said(one, b"#3H#4L")
    assert one.levels == {3: True, 4: False}
    said(one, b"#1:5")
    assert [channel for channel, high in one.levels.items() if high] == [3, 8, 10]


@given(st.lists(st.integers(0, 60_000_000), max_size=12))
def test_however_time_is_cut_the_pulses_are_the_same(pieces: list[int]) -> None:
    whole, cut = board(), board()
    for one in (whole, cut):
        said(one, b"#0P1000#1P1200", 0.013)
        said(one, b"#0P1900S900#1P1500T333", 0.0)
    whole.process(sum(pieces) * 1e-9)
    for piece in pieces:
        cut.process(piece * 1e-9)
    np.testing.assert_array_equal(whole.pulses, cut.pulses)
    assert whole.channels == cut.channels
    assert said(whole, b"Q") == said(cut, b"Q")


@pytest.mark.parametrize("line", [b"#0P1500#1P1500T65535", b"#0P500T0#1P2500", b"#31P1500S1T1"])
def test_t_in_the_very_first_command_is_ignored(line: bytes) -> None:
    one = board()
    said(one, line, 0.02)
    assert not one.moving
    assert "moving" not in one.channels
