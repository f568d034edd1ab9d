"""Edits of the torque ratings change one drive of a copy, say who says so, and outlast a robot file."""

import math

import pytest

from rvsim.errors import RobotDefinitionError
from rvsim.files import load_robot, robot_names, save_robot
from rvsim.robot.rating_edits import (
    LARGEST_RATING,
    LEAST_RATING,
    rating_origin,
    with_guessed_ratings,
    with_max_torque,
)


@pytest.mark.parametrize("name", ["rv-m1", "rrrp"])
def test_one_rating_changes_and_is_the_users(name):
    robot = load_robot(name)
    edited = with_max_torque(robot, 1, 7.5)
    assert edited.joints[1].max_torque.value == 7.5
    assert rating_origin(edited.joints[1].max_torque) == "yours"
    assert edited.joints[0] is robot.joints[0]
    assert with_max_torque(edited, 1, None).joints[1].max_torque is None


@pytest.mark.parametrize("value", [0.0, -3.0, math.nan, math.inf, 1e9])
def test_what_no_drive_is_rated_for_is_refused(value):
    with pytest.raises(RobotDefinitionError, match=r"joint 'shoulder': .* above 0"):
        with_max_torque(load_robot("rv-m1"), 1, value)


@pytest.mark.parametrize("value", [LEAST_RATING, 12.5, LARGEST_RATING])
def test_a_rating_outlasts_a_robot_file(tmp_path, value):
    path = tmp_path / "own.toml"
    save_robot(with_max_torque(load_robot("rv-m1"), 1, value), path)
    read = load_robot(path).joints[1].max_torque
    assert read.value == pytest.approx(value)
    assert rating_origin(read) == "yours"


@pytest.mark.parametrize("name", robot_names())
def test_a_guess_rates_every_drive_and_counts_as_assumed(name):
    ratings = [joint.max_torque for joint in with_guessed_ratings(load_robot(name)).joints]
    assert {rating_origin(rating) for rating in ratings} == {"assumed"}


def test_the_origin_of_a_number_of_the_maker_is_its_source():
    robot = load_robot("ur5e")
    assert rating_origin(robot.joints[0].max_torque._replace(assumed=False)) == "source"
    assert rating_origin(robot.joints[0].max_torque) == "assumed"
