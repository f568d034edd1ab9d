"""The virtual arm as a whole: its time, its wire, its laws under any schedule of lines and faults."""

from __future__ import annotations

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.device.bridge.messages import Clear, HostMessage, Identify, Period, SetPoints, Stop, Wake, encode
from rvsim.device.virtual import arm as arm_module
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.bounds import settling_bound, settling_time
from rvsim.device.virtual.contract import Language
from rvsim.device.virtual.faults import NO_FAULTS, Fault
from rvsim.errors import RobotDefinitionError, SettingError, ShapeError
from rvsim.robot.servos import joints_of

SOAK = runpy.run_path(str(Path(__file__).parents[2] / "soak" / "soak_device.py"))
ROBOT = load_robot("al5b")
HOME = b"#0P1500#1P1500#2P1500#3P1500#4P1500#5P1500\r"
SAID: tuple[HostMessage, ...] = (
    *(Wake(axis, None, 0) for axis in range(5)),
    SetPoints((500, 9000, -9000, 100, 0, None), 500),
)
FRAMES = tuple(encode(Identify(), 0) + encode(message, 1) for message in SAID)
MORE_FRAMES = (*FRAMES, encode(Stop(), 7), encode(Identify(), 0) + encode(Clear(), 1) + encode(Period(50), 2))
LINES = (
    HOME,
    b"#0P1800#1P1700T500\r",
    b"#1P1400S200\r",
    b"#2P0\r",
    b"STOP1\r",
    b"Q\r",
    b"QP0QP1\r",
    b"RDFLT\r",
    b"VER\r",
)
Script = list[tuple[bytes, frozenset[Fault], list[int]]]


def scripts(lines: tuple[bytes, ...]) -> st.SearchStrategy[Script]:
    """Lines, faults, and the pieces of time until the next line [ns]."""
    faults = st.frozensets(st.sampled_from(Fault), max_size=2)
    pieces = st.lists(st.integers(0, 90_000_000), max_size=5)
    return st.lists(st.tuples(st.sampled_from(lines), faults, pieces), max_size=6)


@given(scripts(LINES))
@settings(max_examples=60)
def test_however_time_is_cut_the_arm_is_the_same_bit_for_bit(script: Script) -> None:
    check_cuts("ssc32", script)


@given(scripts(MORE_FRAMES))
@settings(max_examples=40)
def test_the_same_holds_for_the_bridge_and_what_it_sends_by_itself(script: Script) -> None:
    check_cuts("bridge", [*((frame, frozenset[Fault](), [0]) for frame in FRAMES), *script])


def check_cuts(language: Language, script: Script) -> None:
    whole, cut = (VirtualArm(ROBOT, seed=1, language=language) for _ in range(2))
    for line, faults, pieces in script:
        for arm in (whole, cut):
            arm.faults = replace(NO_FAULTS, on=faults)
            arm.write(line)
        whole.process(sum(pieces) * 1e-9)
        for piece in pieces:
            cut.process(piece * 1e-9)
            _ = cut.true_q, cut.channels  # looking changes nothing
        assert whole.time == cut.time
        assert whole.true_q.tobytes() == cut.true_q.tobytes()
        assert whole.commanded_pulses.tobytes() == cut.commanded_pulses.tobytes()
        assert (whole.channels, whole.true_opening) == (cut.channels, cut.true_opening)
        assert whole.read() == cut.read()


@pytest.mark.parametrize("seed", range(6))
def test_under_any_schedule_nothing_raises_and_a_stopped_arm_stays_stopped(seed: int) -> None:
    done = SOAK["session"](seed, minutes=6.0, pause=2.0)
    assert done["stop"] > 0
    assert done["fault"] > 0


def test_nothing_moves_before_a_line_says_so() -> None:
    arm = VirtualArm(ROBOT)
    before = arm.true_q
    arm.process(100.0)
    assert arm.true_q.tobytes() == before.tobytes()
    assert np.isnan(arm.commanded_pulses).all()
    assert set(arm.channels) == {"unknown"}


def test_the_first_move_is_a_jump_at_full_speed_whatever_t_says() -> None:
    arm = VirtualArm(ROBOT)
    before = arm.true_q[0]
    arm.write(b"#0P2000T10000\r")
    arm.process(0.36)
    assert arm.true_q[0] - before > 0.85  # the wanted 0.9 rad at 210 °/s, 0.25 s, after some 60 ms
    arm.write(b"Q\r")
    arm.process(0.01)
    assert arm.read() == b"."


def test_the_true_pose_follows_late_differs_and_comes_within_the_bound() -> None:
    arm = VirtualArm(ROBOT)
    arm.write(HOME)
    arm.process(3.0)
    arm.write(b"#0P2000T1000\r")
    arm.process(0.5)
    commanded = joints_of(arm.servos[:1], arm.commanded_pulses[:1])
    assert 0.02 < (commanded - arm.true_q[:1]).item() < 0.1
    arm.process(3.0)
    error = np.abs(arm.true_q - joints_of(arm.servos, arm.commanded_pulses[[0, 1, 2, 3, 5]]))
    assert np.all(error > 0.0)
    assert np.all(error <= settling_bound(ROBOT))
    assert np.degrees(error).max() > 1.0  # it sags


def test_a_pulse_is_out_at_the_next_frame_and_acts_a_frame_later() -> None:
    arm = VirtualArm(ROBOT)
    before = arm.true_q[0]
    arm.write(b"#0P2000\r")
    arm.process(0.019)
    assert np.isnan(arm.commanded_pulses[0])
    arm.process(0.021)
    assert (arm.commanded_pulses[0], arm.true_q[0]) == (2000, before)
    arm.process(0.001)
    assert arm.true_q[0] > before


def test_between_frames_joints_run_on_smoothly() -> None:
    arm = VirtualArm(ROBOT)
    arm.write(HOME)
    places = []
    for _ in range(2000):
        arm.process(0.001)
        places.append(arm.true_q)
    speeds = np.abs(np.diff(places, axis=0)) / 0.001
    top = [joint.max_speed.value for joint in ROBOT.joints if joint.max_speed]
    assert np.all(speeds <= np.add(top, 1e-9))
    assert np.count_nonzero(speeds[:, 2]) > 100


def test_t700_takes_700_ms_on_the_wire() -> None:
    arm = VirtualArm(ROBOT)
    arm.write(HOME)
    arm.process(1.0)
    arm.write(b"#0P1600#1P1700T700\r")
    answers = []
    for _ in range(800):
        arm.write(b"Q\r")
        arm.process(0.001)
        answers.append(arm.read())
    assert set(answers) == {b"+", b"."}
    assert 700 <= answers.index(b".") <= 720


def test_the_gripper_opens_and_closes_within_its_ends() -> None:
    arm = VirtualArm(ROBOT)
    assert arm.gripper_servo is not None
    for opening in (1.0, 0.0, 0.4):
        arm.write(f"#4P{arm.gripper_servo.pulse(opening):.0f}\r".encode())
        arm.process(2.0)
        assert arm.true_opening == pytest.approx(opening, abs=0.01)
    arm.write(b"#4P500\r")
    arm.process(2.0)
    assert arm.true_opening == 1.0


def test_a_hand_moves_limp_joints_only() -> None:
    arm = VirtualArm(ROBOT)
    arm.write(b"#0P1500\r")
    arm.process(2.0)
    base = arm.true_q[0]
    arm.put([0.5, 2.1, -0.9, 0.3, -0.2])
    np.testing.assert_array_equal(arm.true_q, [base, 2.1, -0.9, 0.3, -0.2])
    arm.put([0.0, 99.0, 99.0, 99.0, 99.0])
    assert np.all(arm.true_q[1:] == [servo.limits[1] for servo in arm.servos[1:]])
    with pytest.raises(ShapeError):
        arm.put([0.0])


def test_a_power_cycle_forgets_positions_and_what_was_being_said() -> None:
    arm = VirtualArm(ROBOT)
    arm.write(HOME)
    arm.process(1.0)
    arm.write(b"VER\r#0P15")
    arm.power_cycle()
    arm.write(b"#1P1600T5000\r")
    arm.process(0.1)
    assert arm.read() == b""
    assert [channel for channel in range(32) if arm.channels[channel] != "unknown"] == [1]
    assert arm.commanded_pulses[1] == 1600


def test_an_arm_at_rest_is_not_calculated(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = VirtualArm(ROBOT)
    arm.write(HOME)
    arm.process(settling_time(ROBOT))
    assert arm.resting
    calls = []
    monkeypatch.setattr(arm_module, "drive_of", lambda *_: calls.append(1))
    arm.process(1e6)
    assert calls == []
    assert arm.time == pytest.approx(1e6 + settling_time(ROBOT))


def test_a_brown_out_in_mid_move_survives_with_a_startup_text() -> None:
    arm = VirtualArm(ROBOT)
    for line in (b"R0=1\r", b"SSCAT #0P1700;\r", HOME):
        arm.write(line)
    arm.process(1.0)
    arm.faults = NO_FAULTS.switched(Fault.BROWN_OUT)
    arm.process(0.3)
    assert np.isnan(arm.commanded_pulses).all()
    arm.process(0.3)
    assert arm.commanded_pulses[0] == 1700
    assert np.isnan(arm.commanded_pulses[1:]).all()


@pytest.mark.parametrize("dt", [-1.0, float("nan"), float("inf")])
def test_time_goes_forward(dt: float) -> None:
    with pytest.raises(SettingError):
        VirtualArm(ROBOT).process(dt)


def test_time_is_not_lost_in_small_pieces() -> None:
    arm = VirtualArm(ROBOT)
    for _ in range(3000):
        arm.process(1.0 / 3e9)
    assert arm.time == pytest.approx(1e-6, abs=1e-9)


def test_another_size_of_the_arm_needs_only_its_file() -> None:
    longer = ROBOT.with_joint(2, a=0.14605).with_joint(3, a=0.187325)
    arm = VirtualArm(longer, seed=5)
    pulses = [(500 * (servo.min_us + servo.max_us) // 1000, servo.channel) for servo in arm.servos]
    arm.write("".join(f"#{channel}P{pulse:.0f}" for pulse, channel in pulses).encode() + b"\r")
    arm.process(5.0)
    wanted = joints_of(arm.servos, arm.commanded_pulses[[0, 1, 2, 3, 5]])
    assert np.all(np.abs(arm.true_q - wanted) <= settling_bound(longer))
    with pytest.raises(RobotDefinitionError):
        VirtualArm(load_robot("rv-m1"))


def test_answers_that_nobody_reads_do_not_pile_up() -> None:
    arm = VirtualArm(ROBOT)
    for _ in range(5000):
        arm.write(b"VER\r")
    arm.process(1.0)
    assert arm.read() == b"SSC32-V2.04GP\r" * 4096
