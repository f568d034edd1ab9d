"""Lines through samples: exact without noise, nearest with it, and a sentence for what makes no line."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.calibration.fit import Fit, Objection, fit_from_samples, remarks_on, sweep_pulses
from rvsim.device.calibration.sag import sag_of
from rvsim.device.virtual.arm import VirtualArm
from rvsim.files import load_robot
from rvsim.robot import Servo

ROBOT = load_robot("al5b")
OLD = ROBOT.servos[0]


@given(st.sampled_from((-1, 1)), st.floats(5.0, 15.0), st.floats(1300.0, 1700.0), st.integers(2, 12))
def test_samples_on_a_line_give_the_line(sign: int, per_degree: float, zero_us: float, count: int) -> None:
    gain = sign * math.degrees(per_degree)
    pulses = np.linspace(800.0, 2200.0, count)
    fit = fit_from_samples(OLD, pulses.tolist(), ((pulses - zero_us) / gain).tolist(), "fitted")
    assert isinstance(fit, Fit)
    assert fit.servo.gain == pytest.approx(gain)
    assert fit.servo.zero_us == pytest.approx(zero_us, abs=1e-6)
    assert fit.worst < 1e-9
    assert (fit.servo.channel, fit.servo.source, fit.servo.assumed) == (OLD.channel, "fitted", False)


def test_noise_is_left_over_and_averages_out() -> None:
    noise = np.random.default_rng(5).normal(0.0, math.radians(0.5), 200)
    pulses = np.linspace(600.0, 2400.0, 200)
    q = (pulses - OLD.zero_us) / OLD.gain + noise
    fit = fit_from_samples(OLD, pulses.tolist(), q.tolist())
    assert isinstance(fit, Fit)
    assert fit.rms == pytest.approx(math.radians(0.5), rel=0.15)
    assert fit.worst == pytest.approx(np.abs(noise).max(), rel=0.1)
    assert fit.servo.us_per_rad == pytest.approx(OLD.us_per_rad, rel=2e-3)


@pytest.mark.parametrize(
    ("pulses", "q", "words"),
    [
        ([1500.0], [0.0], "two samples at least"),
        ([1500.0, 1600.0], [0.0], "two samples at least"),
        ([1500.0, 1600.0], [0.0, math.nan], "nothing was measured"),
        ([1500.0, 2600.0], [0.0, 1.0], "from 500 to 2500"),
        ([1500.0, 1505.0], [0.0, 0.1], "nearly the same"),
        ([1500.0, 1900.0], [0.3, 0.3], "did not move"),
        ([500.0, 600.0], [100.0, 101.0], "No pulse of the controller"),
    ],
)
def test_what_makes_no_line_gets_a_sentence(pulses: list[float], q: list[float], words: str) -> None:
    objection = fit_from_samples(OLD, pulses, q)
    assert isinstance(objection, Objection)
    assert words in str(objection)


def test_a_crooked_line_is_remarked() -> None:
    assert "off a line" in remarks_on(OLD, "base", True, worst=math.radians(4.0))[0]
    assert not remarks_on(OLD, "base", True, worst=math.radians(1.0))


def test_a_sweep_stays_away_from_the_ends() -> None:
    pulses = sweep_pulses(Servo(0, 1, 1500.0, 600.0, 1000.0, 2000.0), 5)
    assert pulses == (1100.0, 1300.0, 1500.0, 1700.0, 1900.0)


def test_an_arm_with_measured_angles_calibrates_itself_within_one_degree() -> None:
    arm, joint = VirtualArm(ROBOT, seed=4), 3
    channel = ROBOT.servos[joint].channel
    samples = []
    for pulse in sweep_pulses(ROBOT.servos[joint]):
        arm.write(f"#{channel}P{pulse:.0f}T500\r".encode())
        arm.process(1.5)
        samples.append((pulse, (arm.true_q + sag_of(ROBOT, arm.true_q))[joint]))
    pulses, q = zip(*samples, strict=True)
    fit = fit_from_samples(ROBOT.servos[joint], pulses, q)
    assert isinstance(fit, Fit)
    true = arm.servos[joint]
    ends = np.array(true.limits)
    found = (true.zero_us + true.gain * ends - fit.servo.zero_us) / fit.servo.gain
    assert np.abs(found - ends).max() < math.radians(1.0)
