"""A place and a choice of pitches for a 5R arm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics_batch, link_transforms, load_robot
from rvsim.errors import NoClosedFormError, ShapeError
from rvsim.kinematics import free_pitch_batch
from rvsim.robot import Tool
from rvsim.spatial import translation


@pytest.mark.parametrize("tip", [(0.0, 0.0, 0.05), (0.02, 0.03, 0.05)])
@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_each_branch_is_at_the_place_with_its_pitch_and_the_roll_given(name, tip):
    robot = replace(load_robot(name), tools=(Tool("pen", "Pen", translation(tip)),), tool_name="pen")
    places, pitches = np.random.default_rng(0).uniform(-0.3, 0.3, (50, 3)), np.linspace(-np.pi, np.pi, 24)
    q = free_pitch_batch(robot, places, pitches, roll=0.3)
    assert q.shape == (50, 24, 4, 5)
    exists = ~np.isnan(q[..., 0])
    assert 0.1 < exists.mean() < 0.9
    wanted = np.broadcast_to(places[:, None, None], (*exists.shape, 3))[exists]
    np.testing.assert_allclose(forward_kinematics(robot, q[exists])[:, :3, 3], wanted, atol=1e-12)
    np.testing.assert_allclose(q[exists][:, 4], 0.3, atol=1e-15)
    axis = link_transforms(robot, q[exists])[:, -1, :3, 2]
    sines = np.broadcast_to(np.sin(pitches)[None, :, None], exists.shape)[exists]
    np.testing.assert_allclose(axis[:, 2], sines, atol=1e-12)


def test_a_known_pitch_gives_the_branches_of_that_pose(apart):
    robot, q = load_robot("rv-m1"), np.array([0.4, 0.5, -1.0, 0.2, 0.0])
    T = forward_kinematics(robot, q)
    ours = free_pitch_batch(robot, T[None, :3, 3], [q[1:4].sum()])[0, 0]
    theirs = inverse_kinematics_batch(robot, T[None])[0]
    assert apart(robot, ours[:2], theirs[:2]).max() < 1e-12


def test_other_arms_and_other_shapes_are_refused():
    with pytest.raises(NoClosedFormError, match="pitch is free only for a 5R arm"):
        free_pitch_batch(load_robot("ur5e"), np.zeros((1, 3)), [0.0])
    with pytest.raises(ShapeError):
        free_pitch_batch(load_robot("rv-m1"), np.zeros(3), [0.0])
