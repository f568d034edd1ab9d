"""A workspace is made of poses: every place in it is reached, and its edges are where geometry says."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import NoClosedFormError
from rvsim.files import load_robot
from rvsim.kinematics import branch_labels, forward_kinematics, inverse_kinematics, jacobian, limit_copies
from rvsim.kinematics.singularity import task_rows
from rvsim.kinematics.workspace import (
    SectionMap,
    Workspace,
    WorkspaceTask,
    has_branches,
    holds_orientation,
    workspace,
    workspace_parts,
)
from rvsim.kinematics.workspace.branches import branch_counts, within_limits
from rvsim.kinematics.workspace.outline import border_pieces, cell_outline
from rvsim.kinematics.workspace.place import determinant, places_and_manipulability, turntable
from rvsim.kinematics.workspace.sampling import PoseSampler, joint_ranges

ARMS = (
    "rv-m1",
    "rv-1a",
    "ur5e",
    "rrrp",
    "al5b",
    "planar",
    "articulated",
    "spherical",
    "scara",
    "cylindrical",
    "cartesian",
)
POSES = 60_000


def surveyed(name: str, **options: object) -> Workspace:
    robot = load_robot(name)
    return workspace(WorkspaceTask(robot, robot.home, **{"poses": POSES, **options}))


def reached_at(section: SectionMap, points: np.ndarray) -> np.ndarray:
    """Whether the cells of points (m, 2) are reached; outside the map nothing is."""
    inside = np.append(section.reached.reshape(-1), False)
    return inside[section.grid.cells(*np.asarray(points, dtype=float).T)]


@pytest.mark.parametrize("name", ARMS)
def test_places_are_those_of_the_whole_arm_and_the_manipulability_is_that_of_its_task(name: str) -> None:
    robot = load_robot(name)
    q = np.random.default_rng(1).uniform(-2.0, 2.0, (200, robot.dof))
    places, measure = places_and_manipulability(robot, q)
    table = turntable(robot)
    if table is not None:
        places = table.placed(places, q[:, 0])
    assert places == pytest.approx(forward_kinematics(robot, q)[:, :3, 3], abs=1e-12)
    singular_values = np.linalg.svd(jacobian(robot, q)[:, task_rows(robot)], compute_uv=False)
    # det(Jᵀ J) loses half of the digits where it is nearly 0.
    assert measure == pytest.approx(singular_values.prod(axis=1), rel=1e-6, abs=1e-7)


@given(st.integers(0, 5), st.integers(0, 1000))
def test_the_determinant_is_that_of_the_matrix(size: int, seed: int) -> None:
    matrix = np.random.default_rng(seed).normal(size=(size, size))
    assert determinant(matrix.tolist()) == pytest.approx(np.linalg.det(matrix), abs=1e-9)


def test_an_arm_on_a_turned_base_still_has_its_turntable() -> None:
    robot = load_robot("rrrp")  # its base stands at (4, 4, 1)
    table = turntable(robot)
    assert table is not None
    assert table.point == pytest.approx((4.0, 4.0))
    assert turntable(load_robot("cartesian")) is None


@pytest.mark.parametrize("name", ARMS)
def test_samples_keep_to_the_limits_and_come_again_for_the_same_seed(name: str) -> None:
    robot = load_robot(name)
    ranges = joint_ranges(robot)
    first, second = (PoseSampler(robot, ranges, seed=3).block(5000, 2000) for _ in range(2))
    assert np.array_equal(first, second)
    assert not np.array_equal(first, PoseSampler(robot, ranges, seed=4).block(5000, 2000))
    assert (first >= robot.limits[:, 0] - 1e-9).all()
    assert (first <= robot.limits[:, 1] + 1e-9).all()
    # Every joint is sent to both of its ends.
    assert np.isclose(first, ranges[:, 0]).any(axis=0).all()
    assert np.isclose(first, ranges[:, 1]).any(axis=0).all()


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "cylindrical"])
def test_the_same_seed_gives_the_same_workspace(name: str) -> None:
    one, other = surveyed(name, seed=2), surveyed(name, seed=2)
    assert np.array_equal(one.cloud, other.cloud)
    assert np.array_equal(one.side.manipulability, other.side.manipulability, equal_nan=True)
    assert np.array_equal(one.top.manipulability, other.top.manipulability, equal_nan=True)


@pytest.mark.parametrize("name", ARMS)
def test_every_place_of_the_cloud_can_be_reached(name: str) -> None:
    result = surveyed(name, poses=4000)
    robot = result.task.robot
    assert len(result.cloud) == len(result.cloud_manipulability) == 4000
    base = robot.T_base_0[:3, 3]
    assert np.linalg.norm(result.cloud - base, axis=1).max() <= robot.size * math.sqrt(3.0) + 1e-9
    for place in result.cloud[:: 4000 // 12]:
        task = "position" if name in ("rv-m1", "al5b", "rrrp") else None
        if robot.dof <= 5 and name != "scara":
            T = forward_kinematics(robot, robot.home).copy()
            T[:3, 3] = place
            failure = inverse_kinematics(robot, T, task=task).failure
            assert failure is None or name == "rrrp"  # whose roll is kept by that task


def test_the_cloud_is_thinned_and_the_share_grows() -> None:
    robot = load_robot("planar")
    *shares, result = workspace_parts(WorkspaceTask(robot, robot.home, poses=100_000))
    assert len(result.cloud) == 20_000
    assert shares == sorted(shares)
    assert 0.0 < shares[0] < shares[-1] <= 1.0


def test_it_can_be_given_up_after_any_part() -> None:
    robot = load_robot("ur5e")
    parts = workspace_parts(WorkspaceTask(robot, robot.home, poses=10**12))
    begun = list(itertools.islice(parts, 2))
    parts.close()
    assert max(begun) < 1e-6


# --- the edges ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["rv-m1", "articulated", "spherical", "cylindrical", "scara"])
def test_an_exact_rim_closes_and_nothing_of_it_lies_within(name: str) -> None:
    side = surveyed(name, poses=400_000).side
    assert side.exact
    assert border_pieces(side.grid, side.reached, side.outline).all()
    # Whoever stands at the border of the cells has the rim beside him.
    border = cell_outline(side.grid, side.reached).mean(axis=1)
    rim = side.outline.mean(axis=1)
    away = np.linalg.norm(border[:, None] - rim, axis=-1).min(axis=1)
    assert away.max() < 4.0 * side.grid.cell


def test_the_rv_m1_reaches_as_far_from_its_shoulder_as_its_links_are_long() -> None:
    side = surveyed("rv-m1").side
    shoulder = np.array([0.0, 0.152])
    angles = np.radians(np.arange(-29.0, 99.0, 2.0))
    rim = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    cell = side.grid.cell
    assert reached_at(side, shoulder + (0.482 - 1.5 * cell) * rim).all()
    assert not reached_at(side, shoulder + (0.482 + 1.5 * cell) * rim).any()
    assert side.exact
    far = np.linalg.norm(side.outline - shoulder, axis=-1)
    assert far.max() == pytest.approx(0.482, abs=1e-9)


def ring(section: SectionMap, center: tuple[float, float], radius: float, degrees: np.ndarray) -> np.ndarray:
    angles = np.radians(degrees)
    return reached_at(section, np.array(center) + radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1))


def test_a_planar_arm_reaches_a_ring() -> None:
    top = surveyed("planar").top
    cell, all_around = top.grid.cell, np.arange(0.0, 360.0, 3.0)
    inner = math.sqrt(0.3**2 + 0.25**2 + 2.0 * 0.3 * 0.25 * math.cos(math.radians(150.0)))
    assert ring(top, (0.0, 0.0), 0.55 - 2.0 * cell, all_around).all()
    assert not ring(top, (0.0, 0.0), 0.55 + 2.0 * cell, all_around).any()
    assert ring(top, (0.0, 0.0), inner + 2.0 * cell, all_around).all()
    assert not ring(top, (0.0, 0.0), inner - 2.0 * cell, all_around).any()


def test_an_articulated_arm_reaches_a_ball_with_a_hole() -> None:
    side = surveyed("articulated").side
    inner = math.sqrt(0.3**2 + 0.28**2 + 2.0 * 0.3 * 0.28 * math.cos(math.radians(150.0)))
    far = np.linalg.norm(side.outline - (0.0, 0.35), axis=-1)
    assert far.max() == pytest.approx(0.58, abs=1e-9)
    assert far.min() == pytest.approx(inner, abs=1e-6)


def test_a_spherical_arm_reaches_a_shell() -> None:
    side = surveyed("spherical").side
    beyond = np.hypot(np.sqrt(np.maximum(side.outline[..., 0] ** 2 - 0.12**2, 0.0)), side.outline[..., 1] - 0.4)
    assert beyond.max() == pytest.approx(0.55, abs=1e-9)
    assert beyond.min() == pytest.approx(0.2, abs=1e-9)


def test_a_cylindrical_arm_reaches_a_hollow_cylinder() -> None:
    result = surveyed("cylindrical")
    cell = result.side.grid.cell
    for inside, corner in ((True, -1.5), (False, 1.5)):
        rho, z = (
            np.array([0.2, 0.5]) - (corner * cell, -corner * cell),
            np.array([0.2, 0.6]) - (corner * cell, -corner * cell),
        )
        corners = np.array(list(itertools.product(rho, z)))
        assert (reached_at(result.side, corners) == inside).all()
    assert np.abs(result.side.outline[..., 0]).min() == pytest.approx(0.2)
    assert result.side.outline.reshape(-1, 2).max(axis=0) == pytest.approx((0.5, 0.6))
    # It turns within ±170° about 90°, where it points at q1 = 0.
    assert ring(result.top, (0.0, 0.0), 0.35, np.array([-78.0, 90.0, 258.0])).all()
    assert not ring(result.top, (0.0, 0.0), 0.35, np.array([270.0])).any()


def test_a_scara_reaches_a_disc_as_high_as_its_stroke() -> None:
    side = surveyed("scara").side
    assert side.outline[..., 1].min() == pytest.approx(0.15, abs=1e-9)
    assert side.outline[..., 1].max() == pytest.approx(0.32, abs=1e-9)
    assert side.outline[..., 0].max() == pytest.approx(0.45, abs=1e-9)


@pytest.mark.parametrize("options", [{}, {"branches": True}])
def test_a_cartesian_arm_reaches_a_box(options: dict[str, bool]) -> None:
    result = surveyed("cartesian", **options)
    for section, size in ((result.side, (0.6, 0.25)), (result.top, (0.6, 0.4))):
        low, high = section.outline.reshape(-1, 2).min(axis=0), section.outline.reshape(-1, 2).max(axis=0)
        assert low == pytest.approx((0.0, 0.0), abs=1.01 * section.grid.cell)
        assert high == pytest.approx(size, abs=1.01 * section.grid.cell)
        centers = section.grid.centers()
        inside = ((centers > 0.01) & (centers < np.array(size) - 0.01)).all(axis=1)
        assert section.reached.reshape(-1)[inside].mean() > 0.95


def test_without_limits_a_workspace_grows() -> None:
    with_limits, without = surveyed("articulated"), surveyed("articulated", ignore_limits=True)
    assert without.side.reached.mean() > with_limits.side.reached.mean()


def test_the_outline_goes_round_the_cells() -> None:
    grid = surveyed("planar", poses=100).top.grid
    disc = np.hypot(*grid.centers().T).reshape(grid.shape) < 0.3
    radii = np.linalg.norm(cell_outline(grid, disc), axis=-1)
    assert radii == pytest.approx(np.full_like(radii, 0.3), abs=grid.cell)
    assert np.linalg.norm(np.diff(cell_outline(grid, disc), axis=1), axis=-1).sum() == pytest.approx(
        0.6 * math.pi, rel=0.02
    )


def test_a_place_of_a_map_lies_where_the_map_says() -> None:
    result = surveyed("rrrp", poses=1000)
    points = np.random.default_rng(0).uniform(-1.0, 1.0, (5, 2))
    for section in (result.side, result.top):
        assert section.flat(section.place(points)) == pytest.approx(points)
    tool = forward_kinematics(result.task.robot, result.task.q)[:3, 3]
    for section in (result.side, result.top):
        assert section.place(section.flat(tool)) == pytest.approx(tool)  # both sections go through the tool


# --- branches -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ARMS)
def test_limits_are_asked_as_limit_copies_does(name: str) -> None:
    robot = load_robot(name)
    q = np.random.default_rng(6).uniform(-np.pi, np.pi, (500, robot.dof))
    q[::7, 0] = np.nan
    assert np.array_equal(within_limits(robot, q), limit_copies(robot, q).within & ~np.isnan(q).any(axis=1))


@pytest.mark.parametrize(
    ("name", "task"),
    [
        ("rv-m1", "position+pitch+roll"),
        ("al5b", "position+pitch+roll"),
        ("rv-1a", None),
        ("ur5e", None),
        ("scara", None),
    ],
)
def test_with_the_orientation_held_every_cell_counts_the_branches_of_its_pose(name: str, task: str | None) -> None:
    result = surveyed(name, fixed=True)
    robot = result.task.robot
    T = forward_kinematics(robot, robot.home).copy()
    generator = np.random.default_rng(9)
    for section in (result.side, result.top):
        centers, counts = section.grid.centers(), section.branches
        assert counts is not None
        for cell in generator.integers(0, section.grid.size, 25):
            T[:3, 3] = section.place(centers[cell])
            branches = inverse_kinematics(robot, T, task=task).branches
            assert np.nan_to_num(counts.reshape(-1)[cell]) == sum(branch.within_limits for branch in branches)


@pytest.mark.parametrize("name", ARMS)
def test_a_pose_has_as_many_branches_as_its_inverse_finds(name: str) -> None:
    robot = load_robot(name)
    ranges = joint_ranges(robot)
    q = np.random.default_rng(9).uniform(ranges[:, 0], ranges[:, 1], (20, robot.dof))
    for pose, within, all_ in zip(q, branch_counts(robot, q), branch_counts(robot, q, ignore_limits=True), strict=True):
        branches = inverse_kinematics(robot, forward_kinematics(robot, pose)).branches
        assert within == sum(branch.within_limits for branch in branches)
        assert all_ == len(branches)


def test_a_straight_elbow_is_not_two_branches() -> None:
    robot = load_robot("rv-m1")  # whose elbow bends one way alone
    q = np.radians([[10.0, 20.0, 0.0, 30.0, 40.0], [10.0, 20.0, -50.0, 30.0, 40.0]])
    assert branch_counts(robot, q).tolist() == [1, 1]


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "articulated", "cartesian"])
def test_the_free_tool_has_branches_wherever_it_comes(name: str) -> None:
    result = surveyed(name, branches=True)
    robot = result.task.robot
    most = len(branch_labels(robot))
    assert result.cloud_branches is not None
    assert result.cloud_branches.min() >= 1
    assert result.cloud_branches.max() <= most
    counts, reached = result.side.branches, result.side.reached
    assert np.nanmin(counts) >= 1
    assert np.nanmax(counts) <= most
    assert np.array_equal(~np.isnan(counts), reached)
    assert (~np.isnan(result.top.branches) & result.top.reached).sum() > 0.9 * result.top.reached.sum()


def test_an_arm_that_cannot_hold_an_orientation_says_so() -> None:
    assert [name for name in ARMS if holds_orientation(load_robot(name))] == ["rv-m1", "rv-1a", "ur5e", "al5b", "scara"]
    assert all(has_branches(load_robot(name)) for name in ARMS)
    with pytest.raises(NoClosedFormError, match="cannot hold an orientation"):
        surveyed("articulated", fixed=True)
