"""The laws of servos: pulses and joints are each other's inverse, and limits are those that both allow."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import RobotDefinitionError
from rvsim.files import load_robot
from rvsim.robot import GripperServo, Servo
from rvsim.robot.servos import clamped_pulses, joints_of, pulses_of, servo_limits, with_servo, within_servos

AL5B = load_robot("al5b")
servos = st.builds(
    Servo,
    st.integers(0, 31),
    st.sampled_from([-1, 1]),
    st.floats(-3000, 6000),
    st.floats(200, 1000),
    st.floats(500, 1400),
    st.floats(1500, 2500),
)


@given(servos, st.floats(-4, 4))
def test_a_pulse_and_its_joint_are_each_others_inverse(servo: Servo, q: float) -> None:
    assert joints_of([servo], pulses_of([servo], [q])) == pytest.approx([q], abs=1e-9)


@given(servos)
def test_the_limits_are_where_the_pulses_end(servo: Servo) -> None:
    ends = pulses_of([servo, servo], servo_limits([servo])[0])
    assert sorted(ends) == pytest.approx([servo.min_us, servo.max_us])
    assert clamped_pulses([servo], [1e9]) == servo.max_us
    assert clamped_pulses([servo], [-1e9]) == servo.min_us


def test_the_al5b_has_the_vendors_ranges() -> None:
    """HARDWARE §2: shoulder 0..168°, elbow −161..−45°, wrist rotate −76..83°."""
    expected = [(-90, 90), (0, 168), (-161, -45), (-90, 90), (-76, 83)]
    np.testing.assert_allclose(np.degrees(within_servos(AL5B).limits), expected, atol=0.06)


@pytest.mark.parametrize("joint", range(5))
def test_narrowed_limits_lie_within_those_of_both(joint: int) -> None:
    narrowed = within_servos(AL5B)
    lower, upper = narrowed.limits[joint]
    for outer in (AL5B.limits[joint], servo_limits(AL5B.servos)[joint]):
        assert outer[0] <= lower < upper <= outer[1]
    assert lower <= narrowed.home[joint] <= upper


def test_a_servo_that_turns_elsewhere_is_refused_by_name() -> None:
    elsewhere = Servo(1, 1, 1500.0 + math.radians(400) * 600, 600.0)
    with pytest.raises(RobotDefinitionError, match=r"'shoulder'.*Calibrate it again"):
        within_servos(with_servo(AL5B, 1, elsewhere))


@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"channel": 32}, "0 to 31"),
        ({"sign": 0}, "1 or -1"),
        ({"us_per_rad": 0.0}, "above 0"),
        ({"zero_us": math.nan}, "finite"),
        ({"min_us": 400.0}, "500 to 2500"),
        ({"min_us": 2000.0, "max_us": 1000.0}, "below its longest"),
    ],
)
def test_values_that_make_no_servo_are_refused(wrong: dict[str, float], what: str) -> None:
    values = {"channel": 0, "sign": 1, "zero_us": 1500.0, "us_per_rad": 600.0} | wrong
    with pytest.raises(RobotDefinitionError, match=what):
        Servo(**values)  # type: ignore[arg-type]


def test_two_servos_cannot_share_a_channel() -> None:
    with pytest.raises(RobotDefinitionError, match="channel 1"):
        with_servo(AL5B, 0, AL5B.servos[1])


@given(st.floats(0, 1), st.sampled_from([(750.0, 2208.0), (2208.0, 750.0)]))
def test_a_gripper_opens_either_way(opening: float, ends: tuple[float, float]) -> None:
    servo = GripperServo(4, *ends)
    assert servo.opening(servo.pulse(opening)) == pytest.approx(opening, abs=1e-9)
    assert servo.pulse(2.0) == servo.open_us
    assert servo.pulse(-1.0) == servo.closed_us
