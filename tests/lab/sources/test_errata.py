"""What the sources print is wrong by the numbers that are known, and ours is what the library and the oracle say."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from rvsim import forward_kinematics, jacobian, load_robot
from rvsim.errors import UnknownNameError
from rvsim.lab.sources import TOPICS, Comparison, errata, erratum_of, topics
from rvsim.robot.edits import original_name

ALL = errata()
WITH_NUMBERS = [entry for entry in ALL if entry.printed is not None]
ARMS = ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b")


def at_text_pose(key: str) -> Comparison:
    entry = erratum_of(key)
    comparison = entry.compare(load_robot(entry.robot), entry.pose)
    assert comparison is not None
    return comparison


def degrees(value: np.ndarray) -> np.ndarray:
    return np.degrees(value)


@pytest.mark.parametrize(
    ("key", "printed", "right"),
    [
        ("000-10", 60.0, 30.0),
        ("000-15", 60.0, -50.0),
        ("000-17", 20.0, 110.0),
        ("003-t1", 36.87, -90.0),
        ("003-t3", -178.43, -90.0),
        ("004-3.22", 38.96, 36.03),
        ("004-3.23", 18.88, -70.0),
        ("004-5.22", -133.33, 0.0),
    ],
)
def test_angles_that_come_out_wrong(key: str, printed: float, right: float) -> None:
    comparison = at_text_pose(key)
    assert degrees(comparison.printed) == pytest.approx(printed, abs=5e-3)
    assert degrees(comparison.right) == pytest.approx(right, abs=5e-3)


def test_the_tool_by_source_000s_modified_link_matrix() -> None:
    comparison = at_text_pose("000-3")
    assert comparison.printed[:3, 3] == pytest.approx([0.2959, -0.1520, 0.2077], abs=5e-5)
    assert comparison.right[:3, 3] == pytest.approx([0.3637, 0.2100, 0.2974], abs=5e-5)


def test_the_inverse_of_source_000_differs_in_four_entries_and_its_matrix_is_no_rotation() -> None:
    assert at_text_pose("000-2").differs.sum() == 4
    assert np.linalg.det(at_text_pose("000-4").printed) == pytest.approx(0.361, abs=5e-4)
    assert np.linalg.det(at_text_pose("000-4").right) == pytest.approx(1.0)


def test_the_hand_counted_twice_puts_the_tip_72_millimetres_too_far() -> None:
    gap = at_text_pose("000-8").difference[:3, 3]
    assert np.linalg.norm(gap) == pytest.approx(0.072)


def test_source_000s_long_form_is_the_table_with_the_waist_reversed() -> None:
    entry, robot = erratum_of("000-9"), load_robot("rv-m1")
    assert entry.printed is not None
    for q in np.random.default_rng(1).uniform(-2.0, 2.0, (20, 5)):
        reversed_waist = q * [-1.0, 1.0, 1.0, 1.0, 1.0]
        assert np.asarray(entry.printed(robot, q))[:3, 3] == pytest.approx(
            forward_kinematics(robot, reversed_waist)[:3, 3], abs=1e-12
        )


def test_the_error_that_source_000_calls_0_is_1_018_decimetres() -> None:
    comparison = at_text_pose("000-P6")
    assert comparison.printed == pytest.approx(0.1018, abs=5e-5)
    assert comparison.right == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("azimuth", "off"), [(0.0, 0.0), (30.0, 0.0373), (90.0, 0.1018)])
def test_programs_8_and_9_are_right_only_tool_down_at_azimuth_0(azimuth: float, off: float) -> None:
    entry = erratum_of("000-P8")
    comparison = entry.compare(load_robot("rv-m1"), [np.radians(azimuth), *entry.pose[1:]])
    assert comparison is not None
    assert np.linalg.norm(comparison.difference) == pytest.approx(off, abs=5e-5)


def test_source_000s_shoulder() -> None:
    assert at_text_pose("000-14g").printed == pytest.approx(-0.2052, abs=5e-5)
    assert at_text_pose("000-14g").right == pytest.approx(0.3528, abs=5e-5)


def test_source_000s_shoulder_formula_is_never_right() -> None:
    entry, robot = erratum_of("000-14"), load_robot("rv-m1")
    low, high = robot.limits.T
    poses = np.random.default_rng(2).uniform(low, high, (500, 5))
    found = [entry.compare(robot, q) for q in poses]
    assert not any(comparison is not None and comparison.agree for comparison in found)


def test_the_printed_jacobian_of_source_000_has_rank_4_and_its_lever_is_349_millimetres_off() -> None:
    assert np.linalg.matrix_rank(at_text_pose("000-22").printed) == 4
    assert np.linalg.matrix_rank(at_text_pose("000-22").right) == 5
    lever = at_text_pose("000-21")
    assert np.abs(lever.difference).max() == pytest.approx(0.349, abs=5e-4)
    assert not lever.differs[3:].any()


def test_the_pseudo_inverse_of_source_000_fails_where_it_is_praised_and_is_right_elsewhere() -> None:
    entry = erratum_of("000-24")
    assert np.isnan(at_text_pose("000-24").printed).all()
    assert np.isfinite(at_text_pose("000-24").right).all()
    regular = entry.compare(load_robot("rv-m1"), erratum_of("000-22").pose)
    assert regular is not None
    assert np.abs(regular.difference).max() < 1e-9


def test_source_000_misses_one_singularity_and_invents_another() -> None:
    robot, missed, invented = load_robot("rv-m1"), erratum_of("000-29"), erratum_of("000-31")
    sigma = np.linalg.svd(jacobian(robot, missed.pose)[:3, :4], compute_uv=False)
    assert (float(at_text_pose("000-29").printed), sigma[-1] < 1e-9) == (3.0, True)
    sigma = np.linalg.svd(jacobian(robot, invented.pose)[:3, :4], compute_uv=False)
    assert sigma == pytest.approx([0.47, 0.217, 0.112], abs=5e-4)
    assert (float(at_text_pose("000-31").printed), float(at_text_pose("000-31").right)) == (2.0, 3.0)


def test_the_wrist_of_source_001_is_179_millimetres_from_the_flange() -> None:
    assert np.linalg.norm(at_text_pose("001-5").difference) == pytest.approx(0.179)
    entry, robot = erratum_of("001-3"), load_robot("rv-1a")
    assert entry.compare(robot, entry.pose) is not None
    assert at_text_pose("001-3").differs.any()


def test_the_place_and_the_sums_of_source_002() -> None:
    assert at_text_pose("002-pos").right == pytest.approx([-0.501349, -0.377327, 0.301583], abs=5e-7)
    assert at_text_pose("002-target").printed == pytest.approx(4.4e-5, rel=1e-3)
    assert at_text_pose("002-spacing").right == pytest.approx([0.858e-3, 1.2016e-3], abs=5e-7)
    assert at_text_pose("002-rms").printed == pytest.approx(0.431, abs=5e-4)
    assert degrees(at_text_pose("002-ik").right) == pytest.approx([70.2, 75.7], abs=0.05)
    assert np.argwhere(at_text_pose("002-R").differs).tolist() == [[0, 1], [1, 1]]
    assert not at_text_pose("002-J").differs[:, 5].any()


def test_source_003s_extension_has_no_value_where_the_tool_is_level_and_is_right_elsewhere() -> None:
    assert np.isnan(at_text_pose("003-l6").printed)
    elsewhere = erratum_of("003-l6").compare(load_robot("rrrp"), [0.3, 0.5, 0.1, 1.2])
    assert elsewhere is not None
    assert elsewhere.agree


def test_the_frames_of_source_004_are_no_rotations() -> None:
    assert np.linalg.det(at_text_pose("004-3.8").printed) == pytest.approx(0.0)
    assert np.linalg.det(at_text_pose("004-3.12").printed) == pytest.approx(-1.0)
    assert np.linalg.det(at_text_pose("004-3.15").printed) == pytest.approx(-1.0)
    assert at_text_pose("004-3.13").right == pytest.approx(np.eye(4))


def test_the_columns_of_source_004_come_one_joint_too_early() -> None:
    comparison = at_text_pose("004-4.7")
    assert comparison.printed[:, 0] == pytest.approx(comparison.printed[:, 1])
    assert comparison.printed[:, 1:] == pytest.approx(comparison.right[:, :4])
    assert at_text_pose("004-4.15").printed == pytest.approx(comparison.right[:, 3])


@pytest.mark.parametrize("entry", WITH_NUMBERS, ids=lambda entry: entry.key)
def test_every_erratum_shows_at_its_own_pose_which_the_arm_can_take(entry) -> None:
    robot = load_robot(entry.robot)
    comparison = entry.compare(robot, entry.pose)
    assert not comparison.agree
    assert np.isfinite(comparison.right).all()
    assert comparison.printed.shape == comparison.right.shape == comparison.kinds.shape
    assert comparison.right.shape[: bool(entry.rows)] in ((), (len(entry.rows),))
    assert (np.asarray(entry.pose) >= robot.limits[:, 0] - 1e-9).all()
    assert (np.asarray(entry.pose) <= robot.limits[:, 1] + 1e-9).all()


@pytest.mark.parametrize("entry", WITH_NUMBERS, ids=lambda entry: entry.key)
def test_every_erratum_has_a_value_or_says_so_at_any_pose(entry) -> None:
    robot = load_robot(entry.robot)
    low, high = np.clip(robot.limits, -3.0, 4.0).T
    for q in [np.zeros(robot.dof), *np.random.default_rng(3).uniform(low, high, (5, robot.dof))]:
        comparison = entry.compare(robot, q)
        assert np.isfinite(comparison.right).all()
        assert not np.isinf(comparison.printed).any()
        T = entry.printed_tool(robot, q)
        assert T is None or T.shape == (4, 4)


def test_what_is_right_is_the_library_at_any_pose() -> None:
    for entry in WITH_NUMBERS:
        robot = load_robot(entry.robot)
        q = np.radians([20.0, 35.0, -40.0, 25.0, 15.0, 10.0])[: robot.dof]
        right = entry.compare(robot, q).right
        if entry.tool is not None and entry.quantity == "transform":
            assert right == pytest.approx(forward_kinematics(robot, q), abs=1e-12)
        if entry.quantity == "jacobian" and right.ndim == 2:
            assert right == pytest.approx(jacobian(robot, q), abs=1e-12)


def test_a_held_tool_changes_nothing_the_sources_know_of_none() -> None:
    robot = load_robot("rv-m1")
    for entry in errata(robot):
        bare, held = (entry.compare(arm, entry.pose) for arm in (robot, robot.with_tool("standard hand")))
        if bare is not None and held is not None:
            assert np.array_equal(bare.printed, held.printed, equal_nan=True)
            assert np.array_equal(bare.right, held.right)


def test_errata_are_asked_for_by_arm_and_topic() -> None:
    assert {entry.key for entry in ALL} == {
        entry.key for name, topic in itertools.product(ARMS, TOPICS) for entry in errata(name, topic)
    }
    assert len({entry.key for entry in ALL}) == len(ALL)
    assert topics("al5b") == ("frames", "inverse", "jacobian", "singularity", "dynamics", "time law")
    assert errata("planar") == () == topics("planar")
    assert all(original_name(load_robot(entry.robot)) == entry.robot for entry in ALL)
    with pytest.raises(UnknownNameError, match="000-22"):
        erratum_of("000-2x2")
