"""The hidden calibration: the same for the same seed, near the file's, and never told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.device.virtual.calibration import GAIN_SPREAD, ZERO_SPREAD_US, hidden_servos
from rvsim.errors import RobotDefinitionError
from rvsim.robot.servos import servo_limits

ROBOT = load_robot("al5b")


def test_a_seed_is_one_arm() -> None:
    assert hidden_servos(ROBOT, 3) == hidden_servos(ROBOT, 3)
    assert hidden_servos(ROBOT, 3) != hidden_servos(ROBOT, 4)


def test_seed_0_is_mounted_as_the_file_says_and_only_trimmed_otherwise() -> None:
    servos, gripper = hidden_servos(ROBOT, 0)
    assert gripper is not None
    assert ROBOT.gripper_servo is not None
    for real, told in zip(servos, ROBOT.servos, strict=True):
        assert (real.channel, real.sign) == (told.channel, told.sign)
        assert 0.0 < abs(real.zero_us - told.zero_us) <= ZERO_SPREAD_US
        assert 0.0 < abs(real.us_per_rad / told.us_per_rad - 1.0) <= GAIN_SPREAD
    assert (gripper.open_us < gripper.closed_us) == (ROBOT.gripper_servo.open_us < ROBOT.gripper_servo.closed_us)


def test_other_seeds_turn_some_servos_round_and_keep_all_channels() -> None:
    signs = np.array([[servo.sign for servo in hidden_servos(ROBOT, seed)[0]] for seed in range(1, 40)])
    told = [servo.sign for servo in ROBOT.servos]
    assert np.all((signs == told).any(axis=0) & (signs != told).any(axis=0))
    for seed in range(1, 40):
        servos, gripper = hidden_servos(ROBOT, seed)
        assert [servo.channel for servo in servos] == [servo.channel for servo in ROBOT.servos]
        assert gripper is not None
        assert gripper.channel == 4


def test_the_end_stops_lie_about_where_the_file_has_them() -> None:
    told = servo_limits(ROBOT.servos)
    for seed in range(40):
        real = servo_limits(hidden_servos(ROBOT, seed)[0])
        assert np.all(np.abs(np.degrees(real - told)) < 11.0)  # 40 µs of zero beyond what the controller can send
        assert np.all(np.ptp(real, axis=1) > 0.9 * np.ptp(told, axis=1))


def test_an_arm_without_servos_cannot_be_on_the_wire() -> None:
    with pytest.raises(RobotDefinitionError, match="servo"):
        hidden_servos(replace(ROBOT, servos=()), 0)
