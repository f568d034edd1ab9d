"""Programs: from where the arm is, without a jump, straight where they say so, and honest."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot
from rvsim.motion.moves import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.motion.program import TOLERANCE, Plan, plan_program
from rvsim.motion.shapes import arc_through
from rvsim.motion.trajectory import accelerations
from rvsim.spatial import rpy_from_rotation

ARMS = ["rv-m1", "ur5e", "al5b", "scara", "cylindrical", "planar"]


def reachable(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A pose with room about it, and two tool places near that of the pose."""
    robot = load_robot(name)
    rng = np.random.default_rng(4)
    lower, upper = np.maximum(robot.limits[:, 0], -1.5), np.minimum(robot.limits[:, 1], 1.5)
    q = 0.5 * (lower + upper) + 0.15 * (upper - lower) * rng.uniform(0.4, 1.0, robot.dof)
    near = [forward_kinematics(robot, q + 0.05 * (upper - lower) * rng.uniform(-1, 1, robot.dof)) for _ in range(2)]
    return q, near[0][:3, 3], near[1][:3, 3]


def planned(name: str, *moves: Move, **more: object) -> Plan:
    robot = load_robot(name)
    return plan_program(robot, robot.home, moves, **more)


def tour(name: str) -> Plan:
    """To a pose, along a line and an arc, a rest, the gripper, and home."""
    robot = load_robot(name)
    q, a, b = reachable(name)
    tool = "keep" if robot.dof in (4, 5) and name != "planar" else "free"
    start = forward_kinematics(robot, q)[:3, 3]
    middle = 0.5 * (a + b) + 0.05 * (start - b)
    moves = (
        JointMove(tuple(q)),
        LineMove(tuple(a), tool),
        ArcMove(tuple(middle), tuple(b), tool),
        Wait(0.3),
        Gripper(0.2),
        JointMove(tuple(robot.home)),
    )
    return planned(name, *moves)


@pytest.mark.parametrize("name", ARMS)
def test_a_tour_is_whole_continuous_within_limits_and_straight(name: str) -> None:
    plan = tour(name)
    robot, motion = plan.robot, plan.trajectory
    assert plan.complete, plan.problem
    assert motion is not None
    times = np.linspace(0.0, motion.duration, 2001)
    moments = motion.at(times)
    np.testing.assert_array_equal(moments.q[0], robot.home)
    np.testing.assert_allclose(moments.q[-1], robot.home)
    speeds = np.array([joint.max_speed.value if joint.max_speed else np.inf for joint in robot.joints])
    assert np.all(np.abs(moments.qd) <= 0.5 * speeds * 1.002)
    assert np.all(np.abs(moments.qdd) <= 0.25 * accelerations(robot) * 1.01)
    assert np.all(np.abs(np.diff(moments.q, axis=0)) <= np.diff(times)[:, None] * speeds * 0.51)
    assert np.all(moments.q >= robot.limits[:, 0] - 1e-9)
    assert np.all(moments.q <= robot.limits[:, 1] + 1e-9)
    start = forward_kinematics(robot, np.array(plan.moves[0].q))[:3, 3]
    end, via = np.array(plan.moves[1].to), np.array(plan.moves[2].via)
    line = forward_kinematics(robot, motion.q(np.linspace(*plan.starts[1:3], 301)))[:, :3, 3]
    arc = forward_kinematics(robot, motion.q(np.linspace(*plan.starts[2:4], 301)))[:, :3, 3]
    along = np.linspace(start, end, 4001)
    round_about = arc_through(end, via, np.array(plan.moves[2].to), 4001)
    for seen, wanted in ((line, along), (arc, round_about)):
        away = np.linalg.norm(seen[:, None] - wanted, axis=-1).min(axis=1)
        assert away.max() <= 1.5 * TOLERANCE * robot.size
        np.testing.assert_allclose(seen[-1], wanted[-1], atol=1e-6)


def test_a_kept_tool_keeps_its_orientation_and_a_turned_one_ends_as_it_should() -> None:
    robot = load_robot("ur5e")
    q = np.radians([20, -80, 90, -100, -90, 10.0])
    T = forward_kinematics(robot, q)
    to = tuple(T[:3, 3] + (0.05, 0.1, -0.05))
    plan = plan_program(robot, q, [LineMove(to), LineMove(tuple(T[:3, 3]), "turn", (3.0, 0.2, 0.1))])
    assert plan.complete
    middle = forward_kinematics(robot, plan.trajectory.q(np.linspace(0.0, plan.starts[1], 50)))
    np.testing.assert_allclose(middle[:, :3, :3], np.broadcast_to(T[:3, :3], (50, 3, 3)), atol=1e-4)
    end = forward_kinematics(robot, plan.trajectory.q(plan.trajectory.duration))
    np.testing.assert_allclose(rpy_from_rotation(end[:3, :3]), (3.0, 0.2, 0.1), atol=1e-9)


@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_the_tool_of_a_5r_arm_turns_to_any_orientation_that_it_can_have(name: str) -> None:
    robot, (q, _, _) = load_robot(name), reachable(name)
    other = q + (robot.limits[:, 1] - robot.limits[:, 0]).clip(max=6.0) * (-0.06, 0.03, 0.02, 0.08, -0.1)
    T = forward_kinematics(robot, other)
    plan = plan_program(robot, q, [LineMove(tuple(T[:3, 3]), "turn", tuple(rpy_from_rotation(T[:3, :3])))])
    assert plan.complete, plan.problem
    end = forward_kinematics(robot, plan.trajectory.q(plan.trajectory.duration))
    np.testing.assert_allclose(end, T, atol=1e-6)


def test_half_the_speed_takes_twice_the_time() -> None:
    goal = tuple(np.add(load_robot("rv-m1").home, (0.3, 0.0, -0.2, 0.0, 0.0)))
    quick, slow = (planned("rv-m1", JointMove(goal, speed=speed)).trajectory for speed in (0.8, 0.4))
    assert slow.duration == pytest.approx(2.0 * quick.duration)


def test_what_comes_before_a_move_that_cannot_be_done_is_kept() -> None:
    robot = load_robot("rv-m1")
    plan = planned(
        "rv-m1",
        JointMove(tuple(np.add(robot.home, (0.1, 0.1, -0.1, 0.0, 0.0)))),
        Wait(1.0),
        LineMove((5.0, 0.0, 0.0)),
        Wait(2.0),
    )
    assert len(plan.steps) == 2
    assert plan.problem.kind == "path"
    assert plan.problem.tracking.unreached[-1].kind == "reach"
    assert plan.trajectory.duration == pytest.approx(plan.starts[-1])
    assert [plan.move_at(t) for t in (0.0, plan.starts[1] + 0.5, 99.0)] == [0, 1, 1]


@pytest.mark.parametrize(
    ("move", "kind"),
    [
        (JointMove(pose="nowhere"), "pose"),
        (JointMove((0.0, 0.0)), "joints"),
        (JointMove((9.0, 0.0, 0.0, 0.0, 0.0)), "limits"),
    ],
)
def test_a_joint_move_that_cannot_be_done_says_why(move: Move, kind: str) -> None:
    plan = planned("rv-m1", move)
    assert (plan.problem.kind, plan.trajectory) == (kind, None)


def test_a_named_pose_is_taken_as_it_is_now_and_limits_may_be_ignored() -> None:
    robot = load_robot("rv-m1")
    there = np.array([9.0, 0.0, 0.0, 0.0, 0.0])
    plan = planned("rv-m1", JointMove(pose="there"), poses={"there": there}, ignore_limits=True)
    np.testing.assert_array_equal(plan.trajectory.q(99.0), there)
    assert robot.dof == 5


def test_the_gripper_moves_only_in_its_own_moves() -> None:
    plan = planned("rv-m1", Wait(1.0), Gripper(0.0, 1.0), Wait(1.0), Gripper(0.6, 2.0))
    openings = [plan.opening_at(t) for t in (0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0)]
    assert openings == pytest.approx([1.0, 1.0, 0.5, 0.0, 0.0, 0.3, 0.6])


def test_a_move_to_where_the_arm_is_already_takes_next_to_no_time() -> None:
    robot = load_robot("rv-m1")
    here = tuple(forward_kinematics(robot, robot.home)[:3, 3])
    plan = planned("rv-m1", LineMove(here), JointMove(tuple(robot.home)))
    assert plan.complete
    assert plan.trajectory.duration < 0.1
