"""One pose: every branch with its verdict, in order; or the reason why not, in words, and the nearest there is."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot
from rvsim.errors import NoClosedFormError, PoseError, SettingError, ShapeError, UnknownNameError
from rvsim.kinematics import free_pitch_batch, inverse_tasks, jacobian, solve_numeric
from rvsim.robot import Joint, Robot

DOWN = np.diag([1.0, -1.0, -1.0])
OUTWARD = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])


def pose(p, R=DOWN) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def inside(robot: Robot, q: np.ndarray) -> bool:
    return bool(np.all((q >= robot.limits[:, 0] - 1e-9) & (q <= robot.limits[:, 1] + 1e-9)))


def special_poses(robot: Robot, count: int) -> np.ndarray:
    """q (count, n): every joint at a stop, or at a multiple of 30° or 45° within its limits."""
    rng, angles = np.random.default_rng(0), np.radians([0.0, 30.0, 45.0, 90.0, 135.0, 180.0])
    columns = []
    for joint in robot.joints:
        chosen = [*angles, *-angles, joint.lower, joint.upper] if joint.revolute else [joint.lower, joint.upper]
        columns.append(rng.choice([v for v in chosen if joint.lower <= v <= joint.upper], count))
    return np.array(columns).T


class TestVerdicts:
    def test_each_branch_tells_what_it_is(self):
        robot, near = load_robot("rv-m1"), np.array([0.1, 0.3, -0.5, 0.2, 0.4])
        T = forward_kinematics(robot, near)
        for branch in inverse_kinematics(robot, T, near=near).branches:
            J = jacobian(robot, branch.q)
            assert branch.residual == pytest.approx(np.abs(forward_kinematics(robot, branch.q) - T).max(), abs=1e-15)
            assert branch.manipulability == pytest.approx(np.sqrt(np.linalg.det(J.T @ J)), rel=1e-6)
            assert branch.distance == np.abs(branch.q - near).max()
            assert branch.within_limits == inside(robot, branch.q) == (branch.limit_margin.min() >= -1e-9)
            margins = [min(q - lower, upper - q) for q, (lower, upper) in zip(branch.q, robot.limits, strict=True)]
            np.testing.assert_array_equal(branch.limit_margin, margins)

    def test_where_the_arm_is_comes_first(self, random_q):
        for name in ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b"):
            robot = load_robot(name)
            for q in random_q(robot, 20):
                best = inverse_kinematics(robot, forward_kinematics(robot, q), near=q).best
                assert best is not None
                assert best.distance < 1e-6

    def test_the_copy_by_whole_turns_is_the_one_nearest_to_where_the_arm_is(self):
        robot = load_robot("ur5e")
        q = np.array([6.0, -5.0, 1.5, 4.0, -6.0, 5.5])
        best = inverse_kinematics(robot, forward_kinematics(robot, q), near=q).best
        assert best is not None
        np.testing.assert_allclose(best.q, q, atol=1e-9)

    def test_the_rule_of_the_order_is_a_value(self):
        robot = load_robot("ur5e")
        T = forward_kinematics(robot, robot.home)
        values = [b.manipulability for b in inverse_kinematics(robot, T, order=["most manipulable"]).branches]
        assert (np.diff(values) < 1e-9).all()
        with pytest.raises(UnknownNameError, match="least motion"):
            inverse_kinematics(robot, T, order=["least moton"])

    def test_a_straight_elbow_is_one_branch_and_within_the_limits(self):
        robot = load_robot("rv-m1")
        result = inverse_kinematics(robot, forward_kinematics(robot, np.zeros(5)))
        assert result.failure is None
        assert [branch.within_limits for branch in result.branches] == [True, False]

    @pytest.mark.parametrize(
        ("name", "near"),
        [
            ("rv-1a", [0.2, 1.5, 0.3, 0.7, 0.0, -0.4]),
            ("cylindrical", [2.3, 0.2, 0.0]),
            ("spherical", [0.4, 0.7, 0.0]),
        ],
    )
    def test_an_axis_that_is_free_stays_where_it_is(self, name, near):
        robot = load_robot(name)
        branches = inverse_kinematics(robot, forward_kinematics(robot, near), near=near).branches
        stayed = min(branches, key=lambda branch: branch.distance)
        assert stayed.continuum
        np.testing.assert_allclose(stayed.q, near, atol=1e-9)

    @pytest.mark.parametrize("name", ["rv-m1", "al5b", "rv-1a", "ur5e", "articulated", "spherical", "planar"])
    def test_an_arm_within_its_limits_is_where_it_is_at_stops_and_singular_poses_too(self, name):
        robot = load_robot(name)
        for q in special_poses(robot, 150):
            T = forward_kinematics(robot, q)
            failure = inverse_kinematics(robot, T).failure  # at home a free waist may ask too much of the roll
            assert failure is None or failure.branch.continuum
            best = inverse_kinematics(robot, T, near=q).best
            assert best is not None
            assert best.distance < 1e-6
            assert inside(robot, best.q)

    def test_a_free_waist_is_marked_where_the_elbow_is_singular_as_well(self):
        robot, q = load_robot("rv-m1"), np.radians([135.0, 90.0, 180.0, 0.0, 135.0])
        branches = inverse_kinematics(robot, forward_kinematics(robot, q), near=q).branches
        assert branches
        assert all(branch.continuum for branch in branches)

    def test_a_free_wrist_turns_where_the_elbow_needs_it(self):
        # The flange is parallel to axis 4, so θ6 is free; but at θ6 = 0 the elbow would have to be longer than it is.
        robot = load_robot("ur5e")
        T = forward_kinematics(robot, [0.93, -0.5, -0.54, -0.68, 0.0, 2.19])
        free = [b for b in inverse_kinematics(robot, T, near=np.zeros(6)).branches if b.continuum]
        assert free
        assert all(abs(branch.q[5]) > 1.0 for branch in free)


class TestFailures:
    def test_limits_name_the_joint_and_both_angles(self):
        robot = load_robot("rv-m1")
        result = inverse_kinematics(robot, pose((0.110, 0.0, 0.130)))
        failure = result.failure
        assert failure is not None
        assert (failure.kind, failure.joint, len(result.branches)) == ("limits", "elbow", 4)
        assert result.best is None
        assert np.degrees([failure.value, failure.limit]) == pytest.approx([-156.7, -110.0], abs=0.05)
        assert "All 4 branches are outside the limits" in failure.reason
        assert "elbow needs −156.7°, stops at −110.0°" in failure.reason
        assert inside(robot, failure.nearest_q)
        np.testing.assert_allclose(forward_kinematics(robot, failure.nearest_q), failure.nearest_T, atol=1e-12)

    def test_a_place_out_of_reach_is_missed_by_what_the_arm_lacks(self):
        robot = load_robot("rv-m1")
        failure = inverse_kinematics(robot, pose((0.9, 0.0, 0.2))).failure
        assert failure is not None
        lacking = np.hypot(0.9, 0.048) - 0.482
        assert (failure.kind, failure.joint) == ("reach", None)
        assert failure.nearest.position_error == pytest.approx(lacking, abs=1e-6)
        assert f"{1e3 * lacking:.1f} mm away" in failure.reason

    def test_an_orientation_that_cannot_be_had_is_told_from_a_place(self):
        robot = load_robot("rv-m1")
        failure = inverse_kinematics(robot, pose((0.2, 0.28, 0.25), OUTWARD)).failure
        assert failure is not None
        assert failure.kind == "orientation"
        assert failure.nearest.position_error < 1e-12
        assert "turned by 54.5°" in failure.reason

    def test_the_ur5e_cannot_point_straight_down_beside_its_base(self):
        robot = load_robot("ur5e")
        failure = inverse_kinematics(robot, pose((0.1, 0.0, 0.2))).failure
        assert failure is not None
        assert failure.kind == "orientation"
        # The flange's centre must stand 133.3 mm off the base axis; 99.6 mm of wrist bring it there.
        tilt = np.arcsin((0.1333 - 0.1) / 0.0996)
        assert failure.nearest.position_error < 1e-7
        assert failure.nearest.rotation_error == pytest.approx(tilt, abs=1e-6)
        assert inverse_kinematics(robot, pose((2.0, 0.0, 0.2))).failure.kind == "reach"

    def test_a_place_inside_the_hollow_of_the_rrrp_arm_is_out_of_reach(self):
        failure = inverse_kinematics(load_robot("rrrp"), pose((4.2, 4.0, 1.1))).failure
        assert failure is not None
        assert failure.kind == "reach"
        assert failure.nearest.position_error == pytest.approx(1.0 - np.hypot(0.2, 0.9), abs=1e-6)
        assert "units" in failure.reason

    def test_a_prismatic_joint_out_of_its_stroke_is_told_in_millimetres(self):
        failure = inverse_kinematics(load_robot("cartesian"), pose((0.5, 0.5, 0.6))).failure
        assert failure is not None
        assert "d2 needs 500.0 mm, stops at 400.0 mm" in failure.reason


class TestTasks:
    def test_each_arm_names_its_tasks_its_own_first(self):
        asked = ("pose", "position+pitch+roll", "position", "position, wrist kept")
        assert inverse_tasks(load_robot("rv-m1")) == asked
        assert inverse_tasks(load_robot("rrrp")) == ("pose", "position")
        assert inverse_tasks(load_robot("scara")) == ("position+yaw",)
        assert inverse_tasks(load_robot("planar")) == ("x,y",)
        with pytest.raises(UnknownNameError, match="mean 'position'"):
            inverse_kinematics(load_robot("rrrp"), np.eye(4), task="positon")

    def test_pitch_and_roll_are_kept_where_the_yaw_cannot_be(self, random_q):
        robot, rng = load_robot("rv-m1"), np.random.default_rng(2)
        for T in forward_kinematics(robot, random_q(robot, 30)):
            turn = rng.uniform(-0.7, 0.7)
            c, s = np.cos(turn), np.sin(turn)
            turned = T.copy()
            turned[:3, :3] = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]) @ T[:3, :3]
            result = inverse_kinematics(robot, turned, task="position+pitch+roll")
            assert result.branches
            np.testing.assert_allclose(forward_kinematics(robot, result.branches[0].q), T, atol=1e-9)

    def test_a_place_alone_lets_a_5r_arm_choose_its_pitch(self):
        robot = load_robot("rv-m1")
        near = np.array([0.3, 0.4, -0.9, 0.2, 0.8])
        here = forward_kinematics(robot, near)
        assert inverse_kinematics(robot, here, task="position", near=near).branches[0].distance < 1e-12
        moved = pose(here[:3, 3] + (0.02, -0.01, 0.03))
        best = inverse_kinematics(robot, moved, task="position", near=near).best
        assert best is not None
        np.testing.assert_allclose(forward_kinematics(robot, best.q)[:3, 3], moved[:3, 3], atol=1e-12)
        assert best.q[4] == near[4]
        every = free_pitch_batch(robot, moved[None, :3, 3], np.linspace(-np.pi, np.pi, 20001), near[4])[0]
        assert best.distance < np.nanmin(np.abs(every - near).max(axis=2)) + 1e-4

    def test_the_scara_takes_the_nearest_yaw(self):
        robot = load_robot("scara")
        T = forward_kinematics(robot, robot.home)
        tilted = T.copy()
        tilted[:3, :3] = T[:3, :3] @ np.array([[1.0, 0.0, 0.0], [0.0, 0.96, -0.28], [0.0, 0.28, 0.96]])
        best = inverse_kinematics(robot, tilted).best
        assert best is not None
        np.testing.assert_allclose(best.q, robot.home, atol=1e-9)


class TestWhatIsNoTarget:
    def test_a_rotation_typed_with_four_digits_is_mended(self):
        robot = load_robot("ur5e")
        T = np.round(forward_kinematics(robot, robot.home), 4)
        assert len(inverse_kinematics(robot, T).branches) == 8

    @pytest.mark.parametrize(
        "T", [np.diag([1.0, 1.0, 2.0, 1.0]), np.diag([1.0, 1.0, -1.0, 1.0]), np.full((4, 4), np.nan), np.ones((4, 4))]
    )
    def test_a_matrix_that_is_no_pose_is_refused(self, T):
        with pytest.raises(PoseError, match="no pose"):
            inverse_kinematics(load_robot("ur5e"), T)

    def test_shapes_are_checked(self):
        with pytest.raises(ShapeError):
            inverse_kinematics(load_robot("ur5e"), np.eye(3))
        with pytest.raises(ShapeError):
            inverse_kinematics(load_robot("ur5e"), np.eye(4), near=np.zeros(5))

    @pytest.mark.parametrize("solve", [inverse_kinematics, solve_numeric])
    @pytest.mark.parametrize(
        ("near", "error", "rule"),
        [
            (np.zeros((2, 6)), ShapeError, r"shape \(6,\)"),
            (np.full(6, np.nan), SettingError, "finite"),
            (np.full(6, np.inf), SettingError, "finite"),
        ],
    )
    def test_where_the_arm_is_must_be_one_finite_pose(self, solve, near, error, rule):
        robot, name = load_robot("ur5e"), "near" if solve is inverse_kinematics else "q0"
        with pytest.raises(error, match=f"{name} must .*{rule}"):
            solve(robot, forward_kinematics(robot, robot.home), **{name: near})


def test_an_arm_of_no_family_is_told_which_condition_it_breaks():
    skew = load_robot("rv-m1").with_joint(2, alpha=0.1)
    with pytest.raises(NoClosedFormError, match="axes 3 and 4 must be parallel"):
        inverse_kinematics(skew, np.eye(4))
    with pytest.raises(NoClosedFormError, match="must cancel"):
        inverse_kinematics(load_robot("rv-m1").with_joint(1, d=0.01), np.eye(4))
    with pytest.raises(NoClosedFormError, match=r"three parallel axes.*spherical wrist"):
        inverse_kinematics(load_robot("ur5e").with_joint(4, a=0.01), np.eye(4))
    lonely = Robot("one", "One", "standard", (Joint("a", "revolute", 0.0, 0.1, 0.2, 0.0),))
    with pytest.raises(NoClosedFormError, match="its joints are R; known are"):
        inverse_kinematics(lonely, np.eye(4))
