"""What a student reads after tracking."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot, robot_names
from rvsim.experiment import random_pose
from rvsim.kinematics import Failure
from rvsim.lab import named_path
from rvsim.lab.sentences import (
    Units,
    advice_sentence,
    deviation_sentence,
    failure_sentence,
    joint_amount,
    length_error,
    short_sentence,
    tracking_sentence,
)
from rvsim.motion import Tracking, track
from rvsim.robot import Robot
from rvsim.spatial import rotation_from_rpy


def line_of_source_000(ignore_limits: bool = False) -> Tracking:
    robot = load_robot("rv-m1")
    path = named_path("line", robot, samples=11, start=(0.11, 0.0, 0.13), end=(0.23, 0.0, 0.333))
    return track(robot, path, ignore_limits=ignore_limits)


def test_the_line_of_source_000_in_words() -> None:
    assert tracking_sentence(line_of_source_000()) == (
        "4 of 11 points reached within the limits; 7 not: points 1–6: the elbow needs −156.7° … −116.9° and stops at "
        "−110°; point 11: the wrist pitch needs −94.7°, stops at −90°."
    )
    assert short_sentence(line_of_source_000()) == "4 of 11 points reached within the limits."
    assert advice_sentence(line_of_source_000()) == "Leave the pitch free, ignore the limits, or move the path."


def test_all_and_none() -> None:
    rv_m1, ur5e = load_robot("rv-m1"), load_robot("ur5e")
    every = line_of_source_000(ignore_limits=True)
    assert tracking_sentence(every) == "All 11 points reached without regard to the limits."
    assert advice_sentence(every) == ""
    none = track(rv_m1, named_path("letter-raw", rv_m1))
    assert tracking_sentence(none) == "None of 50 points reached within the limits: out of reach in any orientation."
    assert deviation_sentence(none) == "No point was reached: there is no deviation to tell."
    assert advice_sentence(none) == "Move the path nearer to where the arm can work."
    some = track(ur5e, named_path("ellipse", ur5e))
    assert tracking_sentence(some) == (
        "114 of 184 points reached within the limits; 70 not: points 77–146: in reach, but not in this orientation."
    )
    assert advice_sentence(some) == "Leave the orientation free, or move the path."


def test_deviations_are_never_rounded_to_nothing() -> None:
    sentence = deviation_sentence(line_of_source_000())
    assert sentence.startswith("RMS ")
    assert "e−1" in sentence
    assert " mm over the 4 points reached, largest " in sentence
    assert length_error(load_robot("rv-m1"), 0.0) == "0.0e+00 mm"


def test_amounts_have_the_units_of_the_screen() -> None:
    rv_m1, rrrp, scara = load_robot("rv-m1"), load_robot("rrrp"), load_robot("scara")
    assert joint_amount(rv_m1, "elbow", np.radians(-156.744)) == "−156.7°"
    assert joint_amount(rv_m1, "elbow", np.radians(-1e-9)) == "0°"
    assert joint_amount(scara, "d3", 0.0125) == "12.5 mm"
    assert joint_amount(rrrp, "l6", 4.25) == "4.25 units"


def test_radians_and_metres_where_they_are_preferred() -> None:
    rrrp, scara, units = load_robot("rrrp"), load_robot("scara"), Units("rad", "m")
    tracking = line_of_source_000()
    assert "the elbow needs −2.736 rad … −2.041 rad and stops at −1.92 rad" in tracking_sentence(tracking, units)
    assert "°" not in tracking_sentence(tracking, units)
    assert " m over the 4 points reached" in deviation_sentence(tracking, units)
    assert joint_amount(scara, "d3", 0.0125, units) == "0.0125 m"
    assert joint_amount(rrrp, "l6", 4.25, units) == "4.25 units"


def test_a_joint_with_a_symbol_for_a_name_gets_no_article() -> None:
    cartesian = load_robot("cartesian")
    path = named_path("line", cartesian, start=(0.3, 0.2, 0.15), end=(0.3, 0.5, 0.15), samples=4)
    assert "d2 needs 500 mm, stops at 400 mm" in tracking_sentence(track(cartesian, path))


def failures_of(robot: Robot) -> Iterator[Failure]:
    """Of places stretched away, of orientations at will, and of joints beyond their stops."""
    rng = np.random.default_rng(3)
    for seed in range(15):
        stretched, turned = (forward_kinematics(robot, random_pose(robot, seed)) for _ in range(2))
        stretched[:3, 3] *= rng.uniform(0.2, 4.0)
        turned[:3, :3] = rotation_from_rpy(rng.uniform(-3.0, 3.0, 3))
        beyond = robot.home + rng.uniform(-3.0, 3.0, robot.dof) * np.where(robot.is_revolute, 1.0, robot.size)
        for T in (stretched, turned, forward_kinematics(robot, beyond)):
            failure = inverse_kinematics(robot, T).failure
            if failure is not None:
                yield failure


_SI = {"°": np.pi / 180.0, " rad": 1.0, " mm": 1e-3, " m": 1.0, " units": 1.0}
_NUMBER = re.compile(r"(−?\d+\.\d+)(°| rad| mm| m| units)")


def amounts(sentence: str) -> list[float]:
    """Its numbers in radians and metres."""
    return [float(number.replace("−", "-")) * _SI[unit] for number, unit in _NUMBER.findall(sentence)]


@pytest.mark.parametrize("name", robot_names())
def test_a_failure_says_the_same_in_all_units_and_only_in_those(name: str) -> None:
    kinds = set()
    for failure in failures_of(load_robot(name)):
        kinds.add(failure.kind)
        usual, other = failure_sentence(failure), failure_sentence(failure, Units("rad", "m"))
        assert usual == failure.reason
        assert not re.search("°| mm", other)
        assert amounts(usual)
        np.testing.assert_allclose(amounts(other), amounts(usual), atol=1.5e-3)
        assert _NUMBER.sub("", usual) == _NUMBER.sub("", other)
    assert kinds


def test_a_stop_that_is_hardly_passed_is_told_from_what_is_needed() -> None:
    robot = load_robot("cartesian")
    T = forward_kinematics(robot, robot.limits[:, 1])
    T[:3, 3] *= 1.00001
    failure = inverse_kinematics(robot, T).failure
    assert failure is not None
    assert re.search(r"needs (\S+) mm, stops at (?!\1)\S+ mm", failure.reason)
