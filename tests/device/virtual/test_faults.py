"""Every fault does what its sentence says, from the moment it is switched on until it is switched off."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.bounds import settling_bound
from rvsim.device.virtual.faults import FAULT_WORDS, NO_FAULTS, Fault, Faults
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import joints_of, pulses_of

ROBOT = load_robot("al5b")
USED = [0, 1, 2, 3, 5]


def awake_arm(fault: Fault | None = None, potentiometers: bool = False) -> VirtualArm:
    """It holds its home pose; then the fault is switched on."""
    arm = VirtualArm(ROBOT, potentiometers=potentiometers)
    pulses = pulses_of(arm.servos, ROBOT.home)
    move(arm, pulses)
    arm.process(3.0)
    if fault is not None:
        arm.faults = arm.faults.switched(fault)
    return arm


def move(arm: VirtualArm, pulses: FloatArray) -> None:
    line = "".join(f"#{channel}P{pulse:.0f}" for channel, pulse in zip(USED, pulses, strict=True))
    arm.write(f"{line}\r".encode())


def answer(arm: VirtualArm, line: bytes, seconds: float = 0.1) -> bytes:
    arm.write(line + b"\r")
    arm.process(seconds)
    return arm.read()


def test_every_fault_has_one_sentence() -> None:
    assert set(FAULT_WORDS) == set(Fault)
    for words in FAULT_WORDS.values():
        assert words.endswith(".")
        assert ". " not in words


def test_no_reply_is_silent_but_obeys() -> None:
    arm = awake_arm(Fault.NO_REPLY)
    assert answer(arm, b"Q") == b""
    answer(arm, b"#0P1600")
    assert arm.commanded_pulses[0] == 1600
    arm.faults = NO_FAULTS
    assert answer(arm, b"Q") == b"."


def test_a_late_reply_comes_600_ms_late() -> None:
    arm = awake_arm(Fault.LATE_REPLY)
    assert answer(arm, b"VER", 0.6) == b""
    arm.process(0.001)
    assert arm.read() == b"SSC32-V2.04GP\r"


def test_a_split_reply_comes_byte_by_byte() -> None:
    arm = awake_arm(Fault.SPLIT_REPLY)
    arm.write(b"VER\r")
    come = []
    for _ in range(250):
        arm.process(0.001)
        come.append(arm.read())
    times = [index for index, data in enumerate(come) if data]
    assert b"".join(come) == b"SSC32-V2.04GP\r"
    assert {later - earlier for earlier, later in pairwise(times)} == {15}


def test_a_duplicated_reply_comes_twice() -> None:
    assert answer(awake_arm(Fault.DUPLICATED_REPLY), b"VER") == b"SSC32-V2.04GP\r" * 2


def test_one_byte_in_four_is_corrupted_by_one_bit_the_same_for_the_same_seed() -> None:
    arm = awake_arm(Fault.CORRUPTED_REPLY)
    sound, spoilt = b"SSC32-V2.04GP\r" * 50, b"".join(answer(arm, b"VER") for _ in range(50))
    wrong = [a ^ b for a, b in zip(sound, spoilt, strict=True) if a != b]
    assert 0.2 < len(wrong) / len(sound) < 0.3
    assert all(bits.bit_count() == 1 for bits in wrong)
    again = awake_arm(Fault.CORRUPTED_REPLY)
    assert b"".join(answer(again, b"VER") for _ in range(50)) == spoilt
    other = awake_arm()
    other.faults = Faults(frozenset([Fault.CORRUPTED_REPLY]), seed=1)
    assert b"".join(answer(other, b"VER") for _ in range(50)) != spoilt


def test_at_a_wrong_baud_nothing_is_acted_upon_and_nothing_understood() -> None:
    arm = awake_arm(Fault.WRONG_BAUD)
    before = arm.commanded_pulses
    for _ in range(50):
        assert b"." not in answer(arm, b"#0P1600#1P1600T100\rQ")
    np.testing.assert_array_equal(arm.commanded_pulses, before)


def test_stuck_moving_says_plus_for_ever() -> None:
    arm = awake_arm(Fault.STUCK_MOVING)
    arm.process(3600.0)
    assert answer(arm, b"Q") == b"+"
    arm.faults = NO_FAULTS
    assert answer(arm, b"Q") == b"."


def test_a_brown_out_forgets_all_positions_at_once_and_the_arm_sinks() -> None:
    arm = awake_arm()
    before = arm.true_q
    answer(arm, b"#0PO10")
    arm.write(b"VER\r")
    arm.faults = arm.faults.switched(Fault.BROWN_OUT)
    assert np.isnan(arm.commanded_pulses).all()
    assert set(arm.channels) == {"unknown"}
    assert answer(arm, b"Q#0P1500", 0.39) == b""
    arm.process(0.05)
    assert answer(arm, b"QP0") == b"\x00"
    assert np.isnan(arm.commanded_pulses).all()
    arm.process(5.0)
    assert arm.true_q[2] < before[2] - 0.1
    # It is over; another one needs another switching on.
    answer(arm, b"#0P1500")
    arm.process(10.0)
    assert arm.commanded_pulses[0] == 1500


def test_a_brown_out_in_mid_move_comes_with_every_move_of_more_than_200_ms() -> None:
    arm = awake_arm(Fault.BROWN_OUT_IN_MOVE)
    answer(arm, b"#0P1600T150", 1.0)
    assert arm.commanded_pulses[0] == 1600
    answer(arm, b"#0P1900T2000", 0.15)
    assert arm.channels[0] == "moving"
    arm.process(0.15)
    assert np.isnan(arm.commanded_pulses).all()
    answer(arm, b"Q", 1.0)
    assert set(arm.channels) == {"unknown"}
    answer(arm, b"#0P1500#1P1500", 1.0)
    answer(arm, b"#0P1800T2000", 0.3)
    assert np.isnan(arm.commanded_pulses).all()


def test_a_stalled_servo_stays_whatever_its_pulse() -> None:
    arm = awake_arm(Fault.STALLED_SERVO)
    before = arm.true_q
    move(arm, pulses_of(arm.servos, ROBOT.home) + 100.0)
    arm.process(3.0)
    assert arm.true_q[1] == before[1]
    assert np.all(np.abs(arm.true_q - before)[[0, 2, 3, 4]] > 0.1)
    assert np.isinf(settling_bound(ROBOT, arm.faults)[1])
    arm.faults = NO_FAULTS
    arm.process(3.0)
    assert abs(arm.true_q - before)[1] > 0.1


def test_a_sagging_servo_hangs_lower_within_its_larger_bound() -> None:
    arm = awake_arm()
    arm.faults = Faults(frozenset([Fault.SAGGING_SERVO]), sagging=(2,))
    before = arm.true_q
    arm.process(3.0)
    error = np.abs(arm.true_q - joints_of(arm.servos, arm.commanded_pulses[USED]))
    assert before[2] - arm.true_q[2] > np.radians(5.0)
    assert np.all(error <= settling_bound(ROBOT, arm.faults))


def test_a_saturated_buffer_loses_what_comes_too_fast() -> None:
    arm = awake_arm(Fault.SATURATED_BUFFER)
    for pulse in range(1500, 1600):
        arm.write(f"#0P{pulse}\r".encode())
        arm.process(0.001)
    arm.process(1.0)
    assert 1500 < arm.commanded_pulses[0] < 1599
    answer(arm, b"\r#0P1700", 1.0)
    assert arm.commanded_pulses[0] == 1700


def test_a_vanished_port_hears_and_says_nothing_and_the_board_holds() -> None:
    arm = awake_arm()
    before = arm.commanded_pulses
    arm.write(b"VER\r")
    arm.faults = arm.faults.switched(Fault.PORT_VANISHES)
    assert arm.vanished
    assert answer(arm, b"#0P1800\rQ") == b""
    np.testing.assert_array_equal(arm.commanded_pulses, before)
    arm.faults = NO_FAULTS
    assert answer(arm, b"Q") == b"."


def test_old_firmware_adds_the_offset_to_qp() -> None:
    arm = awake_arm()
    answer(arm, b"#0P1500")
    answer(arm, b"#0PO60")
    assert answer(arm, b"QP0") == bytes([150])
    arm.faults = arm.faults.switched(Fault.QP_WITH_OFFSET)
    assert answer(arm, b"QP0") == bytes([156])


def test_the_first_analog_reading_is_invalid_once_and_with_the_fault_after_every_pause() -> None:
    arm = awake_arm(potentiometers=True)
    first, second = answer(arm, b"VAVB"), answer(arm, b"VAVB", 10.0)
    assert first != second
    assert answer(arm, b"VAVB", 10.0) == second
    arm.faults = arm.faults.switched(Fault.FIRST_ANALOG)
    assert answer(arm, b"VAVB") != second
    assert answer(arm, b"VAVB") == second


def test_faults_are_values() -> None:
    some = NO_FAULTS.switched(Fault.NO_REPLY).switched(Fault.LATE_REPLY)
    assert Fault.NO_REPLY in some
    assert some.switched(Fault.NO_REPLY, on=False).on == {Fault.LATE_REPLY}
    assert NO_FAULTS.on == frozenset()


@pytest.mark.parametrize("servo", [-1, 6, 99])
def test_a_servo_that_is_not_there_cannot_be_jammed(servo: int) -> None:
    arm = awake_arm()
    arm.faults = Faults(frozenset([Fault.STALLED_SERVO]), stalled=(servo,))
    answer(arm, b"#0P1700", 2.0)
    assert arm.true_q[0] > 0.2
