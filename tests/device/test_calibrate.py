"""The calibration wizard: whatever servos an arm hides, two marks a joint find them; bad answers get a sentence."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim.device.calibrate import CalibrationWizard, Objection, Step, sag_of
from rvsim.device.calibration.marks import usual_range
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.calibration import hidden_servos
from rvsim.errors import RobotDefinitionError, ShapeError
from rvsim.files import load_robot
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import joints_of, pulses_of

ROBOT = load_robot("al5b")
HALF_A_DEGREE = math.radians(0.5)
DATE = "calibrated on 2026-03-01"
SHOULDER = 1


def taken(answer: CalibrationWizard | Objection) -> CalibrationWizard:
    assert isinstance(answer, CalibrationWizard), answer
    return answer


def refused(answer: CalibrationWizard | Objection) -> str:
    assert isinstance(answer, Objection)
    return answer.sentence


def marked(wizard: CalibrationWizard, hidden: tuple[Servo, ...], errors: list[float]) -> CalibrationWizard:
    """A student who marks joints whose servos are `hidden`, and reads each angle with an error [rad]."""
    error = iter(errors)
    while wizard.step and wizard.step.value is not None and wizard.step.joint is not None:
        servo = hidden[wizard.step.joint]
        pulse = round(servo.zero_us + servo.gain * (wizard.step.value + next(error)))
        within = servo.min_us <= pulse <= servo.max_us
        wizard = taken(wizard.mark(pulse) if within else wizard.cannot_reach())
    return wizard


def worst_error(robot: Robot, joint: int, hidden: Servo, found: Servo) -> float:
    """[rad] of all poses of a joint within the limits."""
    lower, upper = usual_range(robot, joint)
    q = np.linspace(max(lower, hidden.limits[0]), min(upper, hidden.limits[1]), 200)[:, None]
    return float(np.abs(joints_of([found], pulses_of([hidden], q)) - q).max())


# Errors count linearly: the worst ones are the largest, with all signs.
READING = st.lists(st.sampled_from((-HALF_A_DEGREE, HALF_A_DEGREE)), min_size=80, max_size=80)


@given(st.integers(0, 10_000), READING)
@settings(max_examples=60)
def test_the_hidden_calibration_is_found_within_one_degree(seed: int, errors: list[float]) -> None:
    hidden, _ = hidden_servos(ROBOT, seed)
    wizard = CalibrationWizard.begin(ROBOT, range(5), weight=False, ends=False)
    found = marked(wizard, hidden, errors).calibration(DATE).servos
    for joint in range(ROBOT.dof):
        assert worst_error(ROBOT, joint, hidden[joint], found[joint]) < math.radians(1.0)
        assert found[joint].sign == hidden[joint].sign


@st.composite
def servos(draw: st.DrawFn) -> Servo:
    """Any servo of 5 to 20 µs/° that reaches 60° and more, some of which lies in the middle of the shoulder's range."""
    gain = draw(st.floats(5.0, 20.0)) * 180.0 / math.pi
    middle = draw(st.floats(1200.0, 1800.0))
    sign = draw(st.sampled_from((-1, 1)))
    half = draw(st.floats(math.radians(35.0) * gain, 700.0)) if gain * math.radians(35.0) < 700.0 else 699.0
    centre = draw(st.floats(math.radians(80.0), math.radians(100.0)))
    return Servo(1, sign, middle - sign * gain * centre, gain, max(middle - half, 500.0), min(middle + half, 2500.0))


@given(servos(), READING)
@settings(max_examples=60)
def test_any_servo_is_found_within_one_degree_where_it_can_go(hidden: Servo, errors: list[float]) -> None:
    wizard = CalibrationWizard.begin(ROBOT, [SHOULDER], weight=False, ends=False)
    found = marked(wizard, (hidden,) * 5, errors).calibration(DATE).servos[SHOULDER]
    assert worst_error(ROBOT, SHOULDER, hidden, found) < math.radians(1.0)


# --- a student and a virtual arm: lag, dead band and sag under weight -------------------------------------------------


class Student:
    """Nudges the servos of a virtual arm until it looks right, within a quarter of a degree."""

    def __init__(self, seed: int) -> None:
        self.arm = VirtualArm(ROBOT, seed=seed)
        self.pulses = dict.fromkeys(range(6), 1500)
        for channel in self.pulses:
            self.send(channel)

    def send(self, channel: int) -> None:
        self.arm.write(f"#{channel}P{self.pulses[channel]}T200\r".encode())
        self.arm.process(0.5)

    def nudge(self, joint: int, value: float, near: float) -> bool:
        """Whether the joint comes there before its servo is at its end."""
        channel, sign = self.arm.servos[joint].channel, self.arm.servos[joint].sign
        while abs(off := math.degrees(value - self.arm.true_q[joint])) > math.degrees(near):
            step = sign * math.copysign(min(max(abs(off) * 8.0, 2.0), 300.0), off)
            pulse = min(max(self.pulses[channel] + round(step), 500), 2500)
            if pulse == self.pulses[channel]:
                return False
            self.pulses[channel] = pulse
            self.send(channel)
        return True

    def answer(self, wizard: CalibrationWizard, step: Step) -> CalibrationWizard:
        if step.joint is None or step.value is None:
            return wizard.skip()
        for other in range(ROBOT.dof):
            if other != step.joint:
                self.nudge(other, step.posture[other], math.radians(4.0))
        if not self.nudge(step.joint, step.value, math.radians(0.25)):
            return taken(wizard.cannot_reach())
        return taken(wizard.mark(self.pulses[step.channel]))


@pytest.mark.parametrize("seed", [0, 3])
def test_the_virtual_arm_is_calibrated_within_one_degree_though_it_sags(seed: int) -> None:
    student, wizard = Student(seed), CalibrationWizard.begin(ROBOT)
    while wizard.step:
        wizard = student.answer(wizard, wizard.step)
    for joint, servo in enumerate(wizard.calibration(DATE).servos):
        assert worst_error(ROBOT, joint, student.arm.servos[joint], servo) < math.radians(1.0)


# --- the state -------------------------------------------------------------------------------------------------------


def test_the_steps_go_from_the_hand_to_the_base_and_say_what_to_do() -> None:
    wizard = CalibrationWizard.begin(ROBOT, ends=False)
    titles = []
    while wizard.step:
        titles.append(wizard.step.title)
        assert wizard.step.number == len(titles)
        assert wizard.progress == (len(titles) - 1) / wizard.count
        assert wizard.step.instruction.startswith("Nudge the ")
        wizard = taken(wizard.mark(wizard.step.expected_us or 1500.0))
    assert wizard.done
    assert wizard.progress == 1.0
    parts = ("Wrist rotate", "Wrist", "Elbow", "Shoulder", "Base")
    assert titles == [f"{part}: {pose} pose" for part in parts for pose in ("first", "second")] + [
        "Gripper: open",
        "Gripper: closed",
    ]


def at_shoulder(*pulses: float, ends: bool = True) -> CalibrationWizard:
    wizard = CalibrationWizard.begin(ROBOT, [SHOULDER], weight=False, ends=ends)
    for pulse in pulses:
        wizard = taken(wizard.mark(pulse))
    return wizard


def test_results_say_what_was_what_is_and_how_much_that_changes() -> None:
    wizard = at_shoulder(2000, 1000, 2350, 800)
    (result,) = wizard.results
    found = {change.what: (change.new, change.difference) for change in result.changes}
    assert found["direction"] == (-1, 0)
    assert found["pulse at zero"] == (pytest.approx(2250.0), pytest.approx(2250.0 - 2436.9))
    assert found["pulse per degree"] == (pytest.approx(1000.0 / 120.0), pytest.approx(1000.0 / 120.0 - 10.41))
    assert found["longest pulse"] == (2350.0, pytest.approx(2350.0 - 2437.0))
    assert found["shortest pulse"] == (800.0, pytest.approx(800.0 - 688.0))
    assert not result.remarks
    servos, gripper = wizard.calibration(DATE)
    assert servos[SHOULDER].source == DATE
    assert not servos[SHOULDER].assumed
    assert servos[:1] + servos[2:] == ROBOT.servos[:1] + ROBOT.servos[2:]
    assert gripper == ROBOT.gripper_servo


def test_without_ends_a_joint_may_go_as_far_as_before() -> None:
    wizard = at_shoulder(1000, 2000, ends=False)
    servo = wizard.calibration(DATE).servos[SHOULDER]
    assert servo.sign == 1
    assert servo.limits == pytest.approx(ROBOT.servos[SHOULDER].limits)
    assert wizard.robot_so_far.servos[SHOULDER].zero_us == servo.zero_us


def test_the_gripper_may_open_the_other_way_round() -> None:
    wizard = CalibrationWizard.begin(ROBOT, [None])
    wizard = taken(taken(wizard.mark(2100)).mark(900))
    assert wizard.calibration(DATE).gripper_servo == GripperServo(4, 2100.0, 900.0, source=DATE)
    assert wizard.results[0].remarks == ("The gripper opens the other way round than before.",)


def test_undo_takes_the_last_answer_back() -> None:
    wizard = at_shoulder(2000, 1000)
    before = wizard.step
    again = taken(wizard.mark(2350)).undo()
    assert again.step is not None
    assert before is not None
    assert again.step.title == before.title
    assert wizard.undo().undo().undo().marks == ()


def test_skipping_a_pose_leaves_the_joint_as_it_was() -> None:
    wizard = CalibrationWizard.begin(ROBOT, [SHOULDER, None])
    wizard = taken(wizard.mark(2000)).skip()
    assert wizard.step is not None
    assert wizard.step.title == "Gripper: open"
    assert wizard.skip().done
    assert wizard.skip().calibration(DATE).servos == ROBOT.servos
    assert not wizard.results


def test_a_pose_that_cannot_be_reached_is_replaced_by_a_nearer_one() -> None:
    wizard = CalibrationWizard.begin(ROBOT, [0], ends=False)
    wizard = taken(wizard.mark(600))
    values = [wizard.step.value] if wizard.step else []
    for _ in range(3):
        wizard = taken(wizard.cannot_reach())
        assert wizard.step is not None
        values.append(wizard.step.value)
    ends = [value for value in values if value is not None and value > 0.0]
    assert len(ends) >= 2
    assert ends == sorted(ends, reverse=True)
    for _ in range(200):
        answer = wizard.cannot_reach()
        if isinstance(answer, Objection):
            break
        wizard = answer
    assert "Skip this joint" in refused(answer)


def test_weight_is_allowed_for_in_the_pose_in_which_the_arm_is() -> None:
    light, heavy = (CalibrationWizard.begin(ROBOT, [SHOULDER], weight=weight) for weight in (False, True))
    step = heavy.step
    assert step is not None
    sag = float(sag_of(ROBOT, step.posture)[SHOULDER])
    assert sag > math.radians(1.0)
    assert taken(heavy.mark(2000)).marks[0].value - taken(light.mark(2000)).marks[0].value == pytest.approx(sag)
    folded = np.array([0.0, 0.0, math.radians(-160.0), 0.0, 0.0])
    assert taken(heavy.mark(2000, posture=folded)).marks[0].value < taken(heavy.mark(2000)).marks[0].value


def test_an_angle_that_was_measured_otherwise_counts() -> None:
    wizard = CalibrationWizard.begin(ROBOT, [SHOULDER], weight=False, ends=False)
    wizard = taken(taken(wizard.mark(1900, value=math.radians(40.0))).mark(900, value=math.radians(140.0)))
    servo = wizard.calibration(DATE).servos[SHOULDER]
    assert math.radians(servo.gain) == pytest.approx(-10.0)


# --- bad answers -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("wizard", "pulse", "sentence"),
    [
        (at_shoulder(), math.nan, "The servo has no pulse: wake it first, then nudge it."),
        (at_shoulder(), 300.0, "300 µs is no pulse of the controller: its go from 500 to 2500 µs."),
        (
            at_shoulder(1500),
            1510.0,
            "The pulses are nearly the same (1500 and 1510 µs): the joint must move between its marks.",
        ),
        (
            at_shoulder(2000, 1000),
            900.0,
            "900 µs is the wrong way: this end has longer pulses than the pose at 2000 µs. "
            "Nudge on from that pose, not back through it.",
        ),
        (
            at_shoulder(2000, 1000, 2300),
            1800.0,
            "1800 µs is the wrong way: this end has shorter pulses than the pose at 1000 µs. "
            "Nudge on from that pose, not back through it.",
        ),
        (at_shoulder(2000, 1000, 2300, 800), 1500.0, "All is marked. Undo leads back."),
    ],
    ids=["no number", "no pulse", "did not move", "wrong end", "ends reversed", "nothing left"],
)
def test_a_bad_answer_gets_a_sentence_and_changes_nothing(
    wizard: CalibrationWizard, pulse: float, sentence: str
) -> None:
    marks = wizard.marks
    assert refused(wizard.mark(pulse)) == sentence
    assert wizard.marks == marks


def test_marks_close_together_are_refused() -> None:
    wizard = taken(CalibrationWizard.begin(ROBOT, [0]).mark(1500, value=0.0))
    assert refused(wizard.mark(1600, value=math.radians(10.0))) == (
        "Both marks are only 10° apart: errors in reading would grow. Choose poses at least 20° apart."
    )


def test_a_gripper_that_did_not_move_is_refused() -> None:
    wizard = taken(CalibrationWizard.begin(ROBOT, [None]).mark(1500))
    assert "did the gripper move?" in refused(wizard.mark(1505))


@pytest.mark.parametrize(
    ("pulses", "remark"),
    [
        ((1600, 1400), "The shoulder would have 1.7 µs/°; hobby servos have 5 to 20. Mark its poses again."),
        ((1000, 2000), "The shoulder turns the other way round than before."),
    ],
)
def test_what_is_odd_is_remarked(pulses: tuple[float, float], remark: str) -> None:
    assert remark in at_shoulder(*pulses, ends=False).results[0].remarks


def test_ends_that_leave_little_are_remarked() -> None:
    (result,) = at_shoulder(2000, 1000, 2000, 1000).results
    assert not result.remarks
    (result,) = at_shoulder(1500, 1300, 1500, 1300).results
    assert any("µs/°" in remark for remark in result.remarks)


def test_an_arm_without_servos_has_nothing_to_calibrate() -> None:
    with pytest.raises(RobotDefinitionError, match="servo"):
        CalibrationWizard.begin(load_robot("rv-m1"))
    with pytest.raises(RobotDefinitionError, match="gripper_servo"):
        CalibrationWizard.begin(replace(ROBOT, gripper_servo=None), [None])


def test_a_posture_of_another_arm_is_a_mistake() -> None:
    posture: FloatArray = np.zeros(4)
    with pytest.raises(ShapeError):
        CalibrationWizard.begin(ROBOT).mark(1500, posture=posture)
