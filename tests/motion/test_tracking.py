"""Tracking: the sources' paths with the numbers of shared reference work, and the laws of any tracking."""

from __future__ import annotations

import json
from pathlib import Path as FilePath

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim import forward_kinematics, load_robot
from rvsim.experiment import limit_violations, random_pose
from rvsim.lab import drawings, named_path
from rvsim.motion import TOOL_DOWN, Tracking, line_path, through_points, track
from rvsim.motion import tracking as tracking_module
from rvsim.motion.tracking import find_jumps
from rvsim.robot import Robot

ORACLE = json.loads((FilePath(__file__).parents[1] / "oracles" / "oracle.json").read_text())["trajectories"]
EXACT = 1e-15


@pytest.fixture(scope="module")
def rv_m1() -> Robot:
    return load_robot("rv-m1")


@pytest.fixture(scope="module")
def ur5e() -> Robot:
    return load_robot("ur5e")


def line_of_source_000() -> tuple[np.ndarray, np.ndarray]:
    return np.array([0.11, 0.0, 0.13]), np.array([0.23, 0.0, 0.333])


def reached_indices(tracking: Tracking) -> list[int]:
    return np.flatnonzero(tracking.reached).tolist()


class TestLineOfSource000:
    def test_within_its_own_limits_the_arm_reaches_4_of_11_points_and_the_elbow_and_the_wrist_are_why(
        self, rv_m1: Robot
    ) -> None:
        tracking = track(rv_m1, line_path(*line_of_source_000(), 11))
        assert reached_indices(tracking) == [6, 7, 8, 9]
        assert {point.kind for point in tracking.unreached} == {"limits"}
        first, last = tracking.unreached[0], tracking.unreached[-1]
        assert (first.index, first.joint) == (0, "elbow")
        assert np.degrees([first.value, first.limit]) == pytest.approx([-156.744, -110.0], abs=1e-3)
        assert (last.index, last.joint) == (10, "wrist pitch")
        assert np.degrees([last.value, last.limit]) == pytest.approx([-94.717, -90.0], abs=1e-3)
        assert tracking.rms is not None
        assert tracking.rms < EXACT

    def test_without_limits_it_reaches_all_along_one_branch_of_the_oracle(self, rv_m1: Robot) -> None:
        tracking = track(rv_m1, line_path(*line_of_source_000(), 11), ignore_limits=True)
        assert tracking.complete
        assert not tracking.jumps
        assert tracking.max_deviation is not None
        assert tracking.max_deviation < EXACT
        labels = set()
        for q, point in zip(tracking.q, ORACLE["rvm1_line"]["points"], strict=True):
            errors = {b["label"]: np.abs(np.sin((q - b["q"]) / 2)).max() for b in point["branches"]}
            labels.add(min(errors, key=lambda label: errors[label]))
            assert min(errors.values()) < 1e-9
        assert len(labels) == 1

    def test_with_a_free_pitch_it_reaches_6_of_11(self, rv_m1: Robot) -> None:
        tracking = track(rv_m1, line_path(*line_of_source_000(), 11, None))
        assert reached_indices(tracking) == [5, 6, 7, 8, 9, 10]
        assert not tracking.jumps


class TestLetter:
    def test_as_printed_it_is_out_of_reach(self, rv_m1: Robot) -> None:
        tracking = track(rv_m1, named_path("letter-raw", rv_m1))
        assert [point.kind for point in tracking.unreached] == ["reach"] * 50
        assert tracking.rms is tracking.max_deviation is None

    @pytest.mark.parametrize(("height", "count"), [(0.0, 0), (0.25, 5), (0.30, 21), (0.35, 0)])
    def test_divided_by_40_it_depends_on_the_height(self, rv_m1: Robot, height: float, count: int) -> None:
        assert track(rv_m1, named_path("letter-scaled", rv_m1, height=height)).reached_count == count

    def test_on_the_table_the_only_branch_within_limits_is_the_oracles(self, rv_m1: Robot) -> None:
        tracking = track(rv_m1, named_path("letter-flat", rv_m1))
        assert tracking.complete
        assert not tracking.jumps
        assert np.allclose(tracking.q, ORACLE["rvm1_D_horizontal"]["q"], atol=1e-9)

    def test_on_the_board_all_of_it_is_drawn_with_8_degrees_to_spare(self, rv_m1: Robot) -> None:
        tracking = track(rv_m1, named_path("letter-board", rv_m1))
        assert tracking.complete
        assert not tracking.jumps
        margin = np.minimum(tracking.q - rv_m1.limits[:, 0], rv_m1.limits[:, 1] - tracking.q).min()
        assert np.degrees(margin) == pytest.approx(8.3, abs=0.05)


class TestEllipseOfSource002:
    def test_as_printed_the_orientation_is_impossible_near_the_base_axis(self, ur5e: Robot) -> None:
        tracking = track(ur5e, named_path("ellipse", ur5e))
        assert reached_indices(tracking) == [*range(76), *range(146, 184)]
        assert {point.kind for point in tracking.unreached} == {"orientation"}
        assert not tracking.jumps

    def test_with_the_orientation_left_free_all_of_it_is_reached(self, ur5e: Robot) -> None:
        tracking = track(ur5e, named_path("ellipse", ur5e, orientation="free"))
        assert tracking.complete
        assert not tracking.jumps

    def test_moved_it_is_drawn_whole_and_ends_where_it_began(self, ur5e: Robot) -> None:
        tracking = track(ur5e, named_path("ellipse-moved", ur5e))
        assert tracking.complete
        assert not tracking.jumps
        assert np.allclose(tracking.q[0], tracking.q[-1], atol=1e-9)
        assert tracking.rms is not None
        assert tracking.rms < EXACT


def test_the_spiral_of_source_003_turns_the_waist_on_and_on() -> None:
    robot = load_robot("rrrp")
    tracking = track(robot, named_path("spiral", robot))
    assert tracking.complete
    assert not tracking.jumps
    assert np.degrees(tracking.q[[0, -1], 0]) == pytest.approx([-90.0, -990.0])
    # The exactness of a double at 990°.
    assert tracking.max_deviation is not None
    assert tracking.max_deviation < 4e-15


@settings(max_examples=40)
@given(
    st.sampled_from(
        ["rv-m1", "al5b", "rv-1a", "ur5e", "scara", "articulated", "spherical", "cylindrical", "cartesian"]
    ),
    st.integers(0, 10_000),
    st.floats(-0.2, 0.2),
    st.floats(-0.2, 0.2),
)
def test_what_is_reached_is_reached_within_the_limits_and_without_leaps(
    name: str, seed: int, along_y: float, along_z: float
) -> None:
    robot = load_robot(name)
    T = forward_kinematics(robot, random_pose(robot, seed))
    rotation = T[:3, :3] if robot.dof != 5 else None
    path = line_path(T[:3, 3], T[:3, 3] + robot.size * np.array([0.0, along_y, along_z]), 21, rotation)
    tracking = track(robot, path)
    assert rotation is None or tracking.reached[0]
    for index in np.flatnonzero(tracking.reached):
        assert not limit_violations(robot, tracking.q[index], 2e-9)
    assert tracking.max_deviation is None or tracking.max_deviation < 1e-9 * robot.size
    assert [point.index for point in tracking.unreached] == np.flatnonzero(~tracking.reached).tolist()
    steps = np.abs(np.diff(tracking.q, axis=0))[:, robot.is_revolute]
    smooth = np.delete(steps, np.array(tracking.jumps, dtype=int) - 1, axis=0)
    assert not np.any(smooth > np.pi)


def test_reaching_more_with_the_limits_ignored(rv_m1: Robot) -> None:
    path = named_path("letter-scaled", rv_m1)
    bound, unbound = track(rv_m1, path), track(rv_m1, path, ignore_limits=True)
    assert not (bound.reached & ~unbound.reached).any()
    assert unbound.reached_count > bound.reached_count


def test_the_sequence_starts_with_the_branch_nearest_to_where_the_arm_is(ur5e: Robot) -> None:
    path = named_path("ellipse-moved", ur5e)
    oracle = json.loads((FilePath(__file__).parents[1] / "oracles" / "oracle.json").read_text())
    tracks = oracle["trajectories"]["ur5e_ellipse"]
    assert tracks["points"]
    for seed in range(4):
        first = track(ur5e, path, near=random_pose(ur5e, seed)).q[0]
        again = track(ur5e, path, near=first).q
        assert np.allclose(again[0], first, atol=1e-9)


class TestJumps:
    def test_a_change_of_branch_on_the_way_is_found(self, rv_m1: Robot) -> None:
        path = named_path("letter-flat", rv_m1)
        q = np.array(track(rv_m1, path).q)
        other = track(rv_m1, path, near=[0.0, 0.0, 1.5, 0.0, 0.0], ignore_limits=True).q
        assert np.abs(other - q).max() > 1.0
        q[20:] = other[20:]
        assert find_jumps(rv_m1, q, with_rotation=True) == (20,)

    def test_a_fast_motion_past_a_singularity_is_none(self, rv_m1: Robot) -> None:
        # Past the base axis, tool down: the waist turns by almost half a turn between two samples.
        tracking = track(rv_m1, line_path((-0.1, 0.004, 0.3), (0.1, 0.004, 0.3), 12), ignore_limits=True)
        assert tracking.complete
        assert np.degrees(np.abs(np.diff(tracking.q[:, 0])).max()) > 60.0
        assert not tracking.jumps

    def test_a_path_that_only_one_elbow_can_begin_and_only_the_other_can_end_jumps_once(self) -> None:
        planar = load_robot("planar").with_joint(1, lower=-2.6, upper=2.6)
        narrow = planar.with_joint(0, lower=-0.9, upper=0.9, home=0.0)
        bow = np.linspace(-0.9, 0.9, 41)
        path = through_points(np.column_stack([0.42 * np.cos(bow), 0.42 * np.sin(bow), np.full(41, 0.12)]))
        tracking = track(narrow, path, near=narrow.home)
        assert tracking.complete
        assert len(tracking.jumps) == 1


def test_a_path_of_one_point_and_one_that_stands_still(rv_m1: Robot) -> None:
    still = np.tile([0.3, 0.0, 0.2], (3, 1))
    for points in (still[:1], still):
        tracking = track(rv_m1, through_points(points, TOOL_DOWN))
        assert tracking.complete
        assert not tracking.jumps
        assert np.ptp(tracking.q, axis=0).max() < 1e-12


def test_a_wrong_near_is_told(rv_m1: Robot) -> None:
    with pytest.raises(ValueError, match="near must have the shape"):
        track(rv_m1, through_points(drawings.letter_flat()), near=[0.0, 0.0])


def test_a_planar_arm_does_not_pretend_to_leave_its_plane() -> None:
    tracking = track(load_robot("planar"), line_path((0.3, 0.0, 0.10), (0.3, 0.0, 0.14), 5, None))
    assert reached_indices(tracking) == [2]
    assert {point.kind for point in tracking.unreached} == {"reach"}


def test_a_free_pitch_glides_along_a_finely_sampled_path_longer_than_a_block(rv_m1: Robot) -> None:
    tracking = track(rv_m1, named_path("letter-flat", rv_m1, samples=300, orientation="free"))
    assert tracking.complete
    assert not tracking.jumps
    pitch = np.degrees(tracking.q[:, 1:4].sum(axis=1))
    assert np.abs(np.diff(pitch)).max() < 10.0


@pytest.mark.parametrize(
    ("arm", "name"),
    [("ur5e", "ellipse-moved"), ("ur5e", "letter-board"), ("rv-1a", "star"), ("rv-m1", "star"), ("al5b", "star")],
)
def test_a_long_free_path_is_as_good_from_a_few_of_its_points_as_the_long_way(
    arm: str, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = load_robot(arm)
    coarse = named_path(name, robot).points
    known, wanted = np.arange(len(coarse)), np.linspace(0.0, len(coarse) - 1.0, 600)
    path = through_points(np.stack([np.interp(wanted, known, coarse[:, axis]) for axis in range(3)], axis=1))
    quick = track(robot, path)
    monkeypatch.setattr(tracking_module, "_LONG", path.samples)
    long = track(robot, path)
    assert quick.complete
    assert quick.max_deviation is not None
    assert quick.max_deviation < 1e-12 * robot.size
    assert not any(limit_violations(robot, q) for q in quick.q)
    assert quick.jumps == find_jumps(robot, quick.q, with_rotation=False) == ()
    assert way_from_home(quick) <= 1.001 * way_from_home(long)
    # Where the long way keeps its orientation, so does the quick one: nothing swings between the few points.
    bends = [np.abs(np.diff(found.q, 2, axis=0)).max() for found in (quick, long)]
    assert bends[0] <= 1.5 * bends[1]


def way_from_home(tracking: Tracking) -> float:
    q = np.concatenate([[tracking.robot.home], tracking.q])
    return float(np.linalg.norm(np.diff(q, axis=0), axis=1).sum())


def test_a_long_free_path_that_leaves_the_reach_is_solved_the_long_way(ur5e: Robot) -> None:
    path = line_path((0.4, 0.1, 0.3), (1.5, 0.1, 0.3), 400, rotation=None)
    tracking = track(ur5e, path)
    assert 0 < tracking.reached_count < path.samples
    assert {missed.kind for missed in tracking.unreached} == {"reach"}
    assert tracking.reached[: tracking.reached_count].all()
