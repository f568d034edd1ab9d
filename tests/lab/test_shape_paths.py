"""Every shape fits every arm at the first go; formulas are source 003's; the tool is turned as it is asked to be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim import load_robot, robot_names
from rvsim.errors import FormulaError, LetterError, TooLargeError, TooManyPointsError
from rvsim.experiment import Placement, Shape, TrajectoryTask
from rvsim.experiment.shapes import (
    SHAPE_KINDS,
    ArcThroughShape,
    EllipseShape,
    FormulaShape,
    FormulaStage,
    Join,
    PointsShape,
    StarShape,
    TextShape,
)
from rvsim.kinematics import forward_kinematics
from rvsim.lab import named_path
from rvsim.lab.orientations import normal_gap
from rvsim.lab.shape_paths import SPIRAL_STAGES, formula_points, placed_task, placement_of, plane_normal, task_path
from rvsim.motion import track, trajectory_of
from rvsim.spatial import rotation_error_angle, rotation_from_rpy


@pytest.mark.parametrize("arm", robot_names())
def test_the_first_try_of_every_shape_succeeds(arm: str) -> None:
    robot = load_robot(arm)
    for name in SHAPE_KINDS:
        if (arm, name) != ("rrrp", "formulas"):  # 2001 points, tried below
            tracking = track(robot, task_path(robot, TrajectoryTask(name)))
            assert tracking.complete, name
            assert not tracking.jumps, name


def test_formulas_in_stages_are_the_spiral_of_source_003() -> None:
    spiral = named_path("spiral", load_robot("rrrp")).points
    path = task_path(load_robot("rrrp"), TrajectoryTask("formulas"))
    np.testing.assert_allclose(path.points, spiral, rtol=0.0, atol=1e-12)
    assert path.corners.tolist() == [1000]


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        ("cso(t)", "no function “cso”"),
        ("4 + s", "no “s”"),
        ("1/(t - 15)", "not finite at t = 15"),
        ("", "empty"),
        ("t.shape", "cannot be read"),
        ("sin(t, t)", "cannot be read"),
        ("__import__('os')", "cannot be read|no function"),
    ],
)
def test_a_formula_that_does_not_work_is_named_with_its_stage_and_coordinate(formula: str, reason: str) -> None:
    shape = FormulaShape((SPIRAL_STAGES[0], replace(SPIRAL_STAGES[1], y=formula)))
    with pytest.raises(FormulaError, match=rf"Stage 2, y: .*({reason})"):
        formula_points(shape)


def test_too_many_points_are_refused_and_constants_will_do() -> None:
    with pytest.raises(FormulaError, match="20001"):
        formula_points(FormulaShape((FormulaStage(1.0, 20_002, "t", "t", "t"),)))
    points = formula_points(FormulaShape((FormulaStage(1.0, 3, "0,5", "max(t, 0.4)", "2^-1"),), unit=1.0))
    assert points.tolist() == [[0.5, 0.4, 0.5], [0.5, 0.5, 0.5], [0.5, 1.0, 0.5]]


@pytest.mark.parametrize(
    ("shape", "problem"),
    [
        (TextShape(0.1, "  "), "Type a letter"),
        (TextShape(0.1, "Жук"), "cannot write “Ж”"),
        (TextShape(1e3, "W" * 60, spacing=1e-4), "The text would have about"),
        (TextShape(0.1, "RV", lift=1e3, spacing=1e-4), "The text would have about"),
    ],
)
def test_a_text_that_cannot_be_written_says_why_in_a_sentence(shape: TextShape, problem: str) -> None:
    with pytest.raises((LetterError, TooManyPointsError), match=problem):
        task_path(load_robot("rv-m1"), TrajectoryTask("text", shape=shape))


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("star", StarShape(1e308)),
        ("ellipse-shape", EllipseShape(0.1, 1e200)),
        ("arc-through", ArcThroughShape(1e160 * np.eye(3))),
        ("points", PointsShape(np.array([[0, 0, 0], [1e308, -1e308, 0]]), "natural")),
        ("text", TextShape(1e200)),
        ("formulas", FormulaShape((FormulaStage(1.0, 3, "1e300*t", "0*t", "0*t"),))),
    ],
)
def test_what_is_too_large_to_be_worked_out_is_refused(name: str, shape: Shape) -> None:
    with pytest.raises(TooLargeError, match="too large for an arm: at most 1e"):
        task_path(load_robot("rv-m1"), TrajectoryTask(name, shape=shape))


@pytest.mark.parametrize("join", ["lines", "natural", "not-a-knot", "closed", "none"])
def test_points_that_are_all_the_same_are_just_these_points(join: Join) -> None:
    shape = PointsShape(np.tile([0.3, 0.0, 0.16], (3, 1)), join)
    path = task_path(load_robot("rv-m1"), TrajectoryTask("points", shape=shape))
    np.testing.assert_array_equal(path.points, shape.points)


@pytest.mark.parametrize("name", ["star", "ellipse-moved", "points", "text", "formulas"])
def test_a_placement_moves_turns_and_scales_about_the_middle(name: str) -> None:
    robot, task = load_robot("ur5e"), TrajectoryTask(name, "free")
    before, where = task_path(robot, task), placement_of(robot, task)
    turn = rotation_from_rpy((0.2, -0.4, 0.7))
    rpy = np.array([0.2, -0.4, 0.7])
    center = where.center + np.array([0.01, 0.02, -0.03])
    if name == "text":  # it stands turned already
        turn = turn @ rotation_from_rpy(where.rpy).T
    moved = task_path(robot, placed_task(robot, task, Placement(center, rpy, 1.5)))
    np.testing.assert_allclose(moved.points, center + 1.5 * (before.points - where.center) @ turn.T, atol=1e-9)
    assert moved.corners.tolist() == before.corners.tolist()


def test_points_that_were_typed_are_moved_themselves() -> None:
    robot = load_robot("rv-m1")
    task = TrajectoryTask("points", shape=PointsShape([[0.2, 0.0, 0.2], [0.3, 0.1, 0.2], [0.3, 0.0, 0.2]]))
    where = placement_of(robot, task)
    moved = placed_task(robot, task, replace(where, center=where.center + np.array([0.0, 0.0, 0.1])))
    assert moved.placement is None
    assert isinstance(moved.shape, PointsShape)
    np.testing.assert_allclose(moved.shape.points[:, 2], 0.3)


TILTED = Placement((0.45, 0.1, 0.35), (0.0, -0.6, 0.3))


def test_a_six_axis_arm_is_square_to_any_plane_and_a_5r_arm_as_near_as_it_can() -> None:
    for arm, exact in (("ur5e", True), ("rv-m1", False)):
        robot = load_robot(arm)
        task = TrajectoryTask("star", "normal", placement=TILTED)
        path, normal = task_path(robot, task), plane_normal(robot, task)
        assert normal is not None
        gap = normal_gap(path, normal)
        assert (gap < 1e-9) == exact
        assert path.rotations is not None
        if not exact:
            azimuth = np.arctan2(path.points[:, 1], path.points[:, 0])
            beside = np.column_stack([-np.sin(azimuth), np.cos(azimuth), np.zeros(len(azimuth))])
            np.testing.assert_allclose(np.sum(path.rotations[:, :, 2] * beside, axis=1), 0.0, atol=1e-12)
            np.testing.assert_allclose(gap, np.arcsin(np.abs(beside @ normal)).max(), atol=1e-9)


def test_the_tool_turns_evenly_from_now_to_what_is_wanted() -> None:
    robot, q = load_robot("ur5e"), load_robot("ur5e").home
    path = task_path(robot, TrajectoryTask("circle", "turn", turn_to=(3.0, 0.2, 1.0)), q)
    assert path.rotations is not None
    np.testing.assert_allclose(path.rotations[0], forward_kinematics(robot, q)[:3, :3], atol=1e-12)
    np.testing.assert_allclose(path.rotations[-1], rotation_from_rpy((3.0, 0.2, 1.0)), atol=1e-12)
    steps = rotation_error_angle(path.rotations[1:], path.rotations[:-1])
    np.testing.assert_allclose(steps, steps[0], rtol=1e-6)


def test_a_held_pitch_is_the_height_of_the_tool_axis() -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, task_path(robot, TrajectoryTask("star", "pitch", pitch=-1.2)))
    reached = tracking.q[tracking.reached]
    assert len(reached) > 50
    np.testing.assert_allclose(forward_kinematics(robot, reached)[:, 2, 2], np.sin(-1.2), atol=1e-9)


@pytest.mark.parametrize("arm", ["rv-m1", "ur5e", "al5b"])
def test_the_arm_rests_at_the_tips_of_a_star_and_where_the_pen_turns(arm: str) -> None:
    robot = load_robot(arm)
    for task in (TrajectoryTask("star"), TrajectoryTask("text", shape=TextShape(0.03, "RV", 0.01, 0.003))):
        tracking = track(robot, task_path(robot, task))
        assert tracking.complete
        trajectory = trajectory_of(tracking, robot.home)
        assert trajectory is not None
        ends = {stretch.progress[-1] for stretch in trajectory.stretches}
        assert set(tracking.path.corners.tolist()) <= ends
        speeds = trajectory.at(trajectory.starts).qd
        np.testing.assert_allclose(speeds, 0.0, atol=1e-9)
