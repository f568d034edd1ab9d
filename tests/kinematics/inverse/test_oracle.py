"""The branches are those of the oracle: all of them, none besides, as sets and up to whole turns."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_branches, inverse_kinematics, inverse_kinematics_batch, load_robot

SINGULAR, REGULAR = 1e-3, 1e-9  # near a singular pose a branch moves like the root of the rounding


def residual(robot, q, T):
    return np.abs(forward_kinematics(robot, q) - T).max(initial=0.0)


def test_every_sample_has_the_oracles_branches_and_no_others(oracle_arm, apart):
    name, reference = oracle_arm
    robot = load_robot(name)
    for sample in reference["samples"]:
        ours, theirs = inverse_branches(robot, sample["T"]), np.array([b["q"] for b in sample["branches"]])
        assert len(ours)
        assert residual(robot, ours, np.array(sample["T"])) < 1e-9
        if not sample["continuum"]:
            gaps = apart(robot, ours[:, None], theirs[None])
            allowed = SINGULAR if sample["families"] else REGULAR
            assert gaps.min(axis=0).max() < allowed, f"sample {sample['i']}: a branch is missing"
            assert gaps.min(axis=1).max() < allowed, f"sample {sample['i']}: a branch too many"


def test_doubles_are_merged_and_limits_judged_with_whole_turns_as_the_oracle_does(oracle_arm, apart):
    name, reference = oracle_arm
    robot = load_robot(name)
    for sample in reference["samples"]:
        result = inverse_kinematics(robot, sample["T"], near=sample["q"])
        if not sample["continuum"]:
            assert len(result.branches) == sample["n_branches"]
            ours, theirs = (
                sum(b.within_limits for b in result.branches),
                sum(b["in_limits"] for b in sample["branches"]),
            )
            # A double at a straight elbow counts as within the limits if one of the two is.
            assert ours == theirs or (ours > theirs and sample["families"])
        # In a continuum the free joint stays where it is, so the sample's own configuration is among the branches.
        assert apart(robot, [branch.q for branch in result.branches], sample["q"]).min() < SINGULAR


def test_a_continuum_is_said_to_be_one(oracle_arm):
    name, reference = oracle_arm
    for sample in reference["samples"]:
        result = inverse_kinematics(load_robot(name), sample["T"], near=sample["q"])
        assert any(branch.continuum for branch in result.branches) == sample["continuum"]


@pytest.mark.parametrize(("name", "key"), [("rv-m1", "rvm1"), ("al5b", "al5b")])
def test_an_orientation_is_projected_to_the_nearest_the_arm_can_have(name, key, oracle, apart):
    robot = load_robot(name)
    for case in oracle["projection"][key]:
        T, reference = np.array(case["T_target"]), np.array([b["q"] for b in case["branches"]])
        q = inverse_kinematics_batch(robot, T[None], project=True)[0]
        q = q[~np.isnan(q).any(axis=1)]
        assert len(q) == len(reference)
        assert residual(robot, q, np.array(case["T_projected"])) < 1e-12
        if len(q):
            assert apart(robot, q[:, None], reference[None]).min(axis=0).max() < REGULAR
            failure = inverse_kinematics(robot, T).failure
            assert failure is not None
            assert failure.kind == "orientation"
            assert failure.nearest.rotation_error == pytest.approx(case["angle"], abs=1e-9)
            np.testing.assert_allclose(failure.nearest_T, case["T_projected"], atol=1e-9)


def test_the_line_of_source_000_has_four_branches_and_four_points_within_its_limits(oracle, apart):
    robot, line = load_robot("rv-m1"), oracle["trajectories"]["rvm1_line"]
    within = []
    for point in line["points"]:
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = line["orientation"], point["p"]
        result = inverse_kinematics(robot, T)
        reference = np.array([b["q"] for b in point["branches"]])
        found = np.array([b.q for b in result.branches])
        assert len(found) == 4
        assert apart(robot, found[:, None], reference[None]).min(axis=0).max() < REGULAR
        within.append(result.failure is None)
    assert within == [any(b["in_limits"] for b in p["branches"]) for p in line["points"]]
    assert sum(within) == 4


def test_the_letter_laid_flat_has_one_branch_within_limits(oracle, apart):
    robot, letter = load_robot("rv-m1"), oracle["trajectories"]["rvm1_D_horizontal"]
    T = np.tile(np.eye(4), (len(letter["points"]), 1, 1))
    T[:, :3, :3], T[:, :3, 3] = letter["orientation"], letter["points"]
    for pose, reference in zip(T, letter["q"], strict=True):
        result = inverse_kinematics(robot, pose)
        assert [b.within_limits for b in result.branches] == [True, False, False, False]
        assert apart(robot, result.branches[0].q, np.array(reference)) < REGULAR


def test_the_ellipse_of_source_002_is_out_of_reach_in_its_own_orientation_at_seventy_points(oracle):
    robot, ellipse = load_robot("ur5e"), oracle["trajectories"]["ur5e_ellipse"]
    T = np.tile(np.eye(4), (len(ellipse["points"]), 1, 1))
    T[:, :3, :3], T[:, :3, 3] = ellipse["orientation"], [point["p"] for point in ellipse["points"]]
    counts = (~np.isnan(inverse_kinematics_batch(robot, T)).any(axis=2)).sum(axis=1)
    assert counts.tolist() == [len(point["branches"]) for point in ellipse["points"]]
    assert (counts > 0).sum() == 114


def test_the_path_of_source_003_has_one_branch_throughout(oracle, apart):
    robot, path = load_robot("rrrp"), oracle["trajectories"]["rrrp_path"]
    T = np.tile(np.eye(4), (len(path["points"]), 1, 1))
    T[:, :3, :3], T[:, :3, 3] = path["orientation"], path["points"]
    q = inverse_kinematics_batch(robot, T)
    assert q.shape == (len(T), 1, 4)
    assert apart(robot, q[:, 0], np.array(path["q_continuous"])).max() < REGULAR


def test_a_place_for_the_rrrp_arm_has_four_branches(oracle, apart):
    robot = load_robot("rrrp")
    for sample in oracle["robots"]["rrrp"]["samples"]:
        result = inverse_kinematics(robot, sample["T"], task="position", near=sample["q"])
        reference = np.array([b["q"] for b in sample["branches_position_only"]])
        found = np.array([b.q for b in result.branches])
        if "tip_on_axis_position_only" in sample["aux"]:  # joint 1 is free
            assert apart(robot, found, sample["q"]).min() < SINGULAR
            continue
        gaps = apart(robot, found[:, None], reference[None])
        allowed = SINGULAR if sample["aux"] else REGULAR
        assert max(gaps.min(axis=0).max(), gaps.min(axis=1).max()) < allowed
