"""A held key moves the tool straight and the joints smoothly, stops before limits and singularities, and says why."""

import math

import numpy as np
import pytest

from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.motion.jog import RAMP, Jog
from rvsim.motion.jog_course import JointMotion, ToolMotion

FRAME = 1.0 / 60.0
STILL = np.zeros(3)
X, Y, Z = np.eye(3)
POSES = {
    "rv-m1": np.radians([30.0, 40.0, -70.0, -30.0, 20.0]),
    "ur5e": np.radians([20.0, -70.0, 100.0, -120.0, -80.0, 10.0]),
    "rv-1a": np.radians([20.0, 80.0, 10.0, 30.0, 50.0, 10.0]),
    "articulated": np.radians([20.0, 40.0, -60.0]),
}


def along(direction, speed=0.1, axes="base"):
    return ToolMotion(speed * direction, STILL, axes, "moving along it")


def about(axis, speed=0.5, axes="base"):
    return ToolMotion(STILL, speed * axis, axes, "turning about it")


def ridden(robot, motion, q, *, dt=FRAME, held=1.0, limits=None, most=20.0):
    """The steps of a key that is held so long [s], up to rest."""
    jog, steps, time = Jog(robot, motion, limits), [], 0.0
    while not jog.resting and time < most:
        if time >= held - 1e-9:
            jog.release()
        steps.append(jog.advance(steps[-1].q if steps else q, dt))
        time += dt
    return steps


@pytest.mark.parametrize("name", POSES)
@pytest.mark.parametrize("direction", [X, -Y, (X + Z) / math.sqrt(2.0)])
def test_the_tool_moves_straight(name, direction):
    robot, q = load_robot(name), POSES[name]
    steps = ridden(robot, along(direction), q, held=5.0)
    ways = forward_kinematics(robot, np.array([q, *(step.q for step in steps)]))[:, :3, 3]
    ways = ways - ways[0]
    assert ways[-1] @ direction > 0.01
    assert np.abs(ways - np.outer(ways @ direction, direction)).max() < 1e-5 * (ways[-1] @ direction)


@pytest.mark.parametrize("name", ["ur5e", "rv-1a"])
def test_an_arm_of_six_joints_keeps_its_orientation_and_turns_about_a_fixed_point(name):
    robot, q = load_robot(name), POSES[name]
    T = forward_kinematics(robot, q)
    moved = forward_kinematics(robot, ridden(robot, along(Y), q)[-1].q)
    np.testing.assert_allclose(moved[:3, :3], T[:3, :3], atol=2e-3)
    turned = forward_kinematics(robot, ridden(robot, about(Z, axes="tool"), q)[-1].q)
    np.testing.assert_allclose(turned[:3, 3], T[:3, 3], atol=1e-7)
    np.testing.assert_allclose(turned[:3, 2], T[:3, 2], atol=2e-3)
    assert turned[:3, 0] @ T[:3, 1] > 0.1


@pytest.mark.parametrize("name", POSES)
@pytest.mark.parametrize("motion", [along(X), along(-Z), JointMotion(1, 0.7), JointMotion(0, -1.0)])
def test_it_never_leaves_the_limits_and_says_at_which_it_stands(name, motion):
    robot = load_robot(name)
    steps = ridden(robot, motion, POSES[name], held=60.0, most=60.0)
    q = np.array([step.q for step in steps])
    assert np.all(q >= robot.limits[:, 0])
    assert np.all(q <= robot.limits[:, 1])
    if "limit" in steps[-1].stopped_reason:
        margins = np.minimum(q[-1] - robot.limits[:, 0], robot.limits[:, 1] - q[-1])
        nearest = robot.joint_names[int(np.argmin(margins))]
        assert nearest in steps[-1].stopped_reason
        assert margins.min() < math.radians(0.1)


@pytest.mark.parametrize("name", POSES)
@pytest.mark.parametrize("motion", [along(X), along(-Z), JointMotion(1, 0.7)])
def test_the_speed_is_continuous_up_to_rest(name, motion):
    robot = load_robot(name)
    steps = ridden(robot, motion, POSES[name], held=4.0)
    full = 0.1 if isinstance(motion, ToolMotion) else 0.7 * np.linalg.norm(jacobian(robot, POSES[name])[:3, 1]) * 2.0
    speeds = np.array([0.0, *(np.linalg.norm(step.twist[:3]) for step in steps)])
    assert np.abs(np.diff(speeds)).max() <= 1.2 * full * FRAME / RAMP
    assert speeds[-1] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("motion", [along(X), about(Y, axes="tool"), JointMotion(2, 0.4)])
def test_what_is_done_does_not_depend_on_how_often_it_is_asked(motion):
    robot, q = load_robot("ur5e"), POSES["ur5e"]
    ends = [ridden(robot, motion, q, dt=dt)[-1].q for dt in (1 / 20, 1 / 60, 1 / 250)]
    np.testing.assert_allclose(ends[1:], [ends[0]] * 2, atol=2e-3)


def test_a_singularity_ahead_slows_it_down_and_stops_it():
    robot, q = load_robot("articulated"), POSES["articulated"]
    out = forward_kinematics(robot, q)[:3, 3] - forward_kinematics(robot, np.zeros(3))[:3, 3] * (0, 0, 1)
    steps = ridden(robot, along(out / np.linalg.norm(out), 0.2), q, held=20.0)
    assert "singularity" in steps[-1].stopped_reason
    assert any("top speed" in step.slowed_reason for step in steps)
    assert np.linalg.norm(steps[-1].twist) == 0.0


def test_what_the_arm_cannot_do_is_refused_at_once_in_words():
    step = Jog(load_robot("rv-m1"), about(X, axes="tool")._replace(name="turning about x")).advance(POSES["rv-m1"], 0.1)
    assert step.stopped_reason == (
        "This arm cannot do that here: turning about x is lost while its tool stays in place."
    )
    np.testing.assert_array_equal(step.q, POSES["rv-m1"])


def test_a_released_key_brings_it_to_rest_within_the_ramp():
    robot, q = load_robot("ur5e"), POSES["ur5e"]
    steps = ridden(robot, along(X), q, held=0.5)
    assert len(steps) * FRAME == pytest.approx(0.5 + RAMP, abs=3 * FRAME)
    way = forward_kinematics(robot, steps[-1].q)[:3, 3] - forward_kinematics(robot, q)[:3, 3]
    assert np.linalg.norm(way) == pytest.approx(0.1 * 0.5, abs=0.1 * 2 * FRAME)


def test_an_arm_that_somebody_else_moved_begins_anew_from_there():
    robot, jog = load_robot("ur5e"), Jog(load_robot("ur5e"), along(X))
    for _ in range(30):
        jog.advance(POSES["ur5e"], 0.0)
    elsewhere = POSES["ur5e"] + 0.2
    step = jog.advance(elsewhere, FRAME)
    assert jog.share == pytest.approx(FRAME / RAMP)
    assert np.abs(step.q - elsewhere).max() < 0.01
    assert robot.dof == 6


def test_a_joint_outside_its_limits_may_move_in_only():
    robot, q = load_robot("rv-m1"), np.array(POSES["rv-m1"])
    q[1] = robot.limits[1, 1] + 0.1
    out, back = (ridden(robot, JointMotion(1, rate), q)[-1] for rate in (0.5, -0.5))
    np.testing.assert_allclose(out.q, q, atol=2e-3)
    assert "upper limit" in out.stopped_reason
    assert back.q[1] < q[1] - 0.3
