"""Why a target cannot be had: the kind, the joint, and where to look for the nearest pose that can."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse.batch import frame_entries
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.explain import broken_limit
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.nearest import nearest_configuration, place_in_reach
from rvsim.kinematics.inverse.projection import has_tip_on_roll_axis, nearest_orientation
from rvsim.kinematics.inverse.result import Branch, Failure, Nearest, in_order
from rvsim.kinematics.inverse.task import POSE_ENTRIES, Candidates, candidates
from rvsim.kinematics.inverse.verdict import branches_of
from rvsim.spatial import rotation_error_angle
from rvsim.spatial.arrays import FloatArray

Search = Callable[[], Nearest]


def limits_failure(form: ClosedForm, found: Candidates, branches: Sequence[Branch], here: FloatArray) -> Failure:
    """Branches exist, but each breaks a limit; the one that breaks them least tells which."""
    robot = form.chain.robot
    closest = max(branches, key=lambda branch: float(branch.limit_margin.min()))
    joint = int(np.argmin(closest.limit_margin))
    value = float(closest.q[joint])
    return Failure(
        "limits",
        robot,
        partial(_search, form, found, here, robot.limits, np.array([branch.q for branch in branches])),
        robot.joint_names[joint],
        value,
        broken_limit(robot.joints[joint], value),
        closest,
        len(branches),
    )


def reach_failure(form: ClosedForm, found: Candidates, here: FloatArray, order: Sequence[str]) -> Failure:
    """No branch exists: not at this place, or not in this orientation there. Limits are not asked."""
    robot = form.chain.robot
    anywhere = np.tile([-np.inf, np.inf], (robot.dof, 1))
    search = partial(_search, form, found, here, anywhere, here[None])
    if form.task == "pose" and found.entries == POSE_ENTRIES and _reaches(form, found.T_goal, here):
        return Failure("orientation", robot, partial(_nearest_turn, form, found, here, order, search))
    return Failure("reach", robot, search)


def _search(form: ClosedForm, found: Candidates, here: FloatArray, bounds: FloatArray, starts: FloatArray) -> Nearest:
    place_only, held = found.entries != POSE_ENTRIES, list(found.held)
    allowed = bounds.copy()
    allowed[held] = here[held, None]
    return nearest_configuration(form.chain.robot, found.T_goal, here, allowed, starts, place_only=place_only)


def _reaches(form: ClosedForm, T: FloatArray, here: FloatArray) -> bool:
    """Whether the place is in reach: the family knows, or a search finds it."""
    place = frame_entries(form.chain, T[None], flange=False)[:, 3, 0]
    known = form.reaches(place)
    return place_in_reach(form.chain.robot, T, here) if known is None else known


def _nearest_turn(
    form: ClosedForm, found: Candidates, here: FloatArray, order: Sequence[str], search: Search
) -> Nearest:
    """The closed projection of a 5R arm where the arm reaches it, else the search."""
    robot = form.chain.robot
    if isinstance(form, FiveAxis) and has_tip_on_roll_axis(form.chain):
        turned = nearest_orientation(form.chain, found.T_goal[None])[0]
        branches = in_order(branches_of(robot, candidates(form, None, turned, here), here), order)
        if branches:
            T = forward_kinematics(robot, branches[0].q)
            angle = float(rotation_error_angle(T[:3, :3], found.T_goal[:3, :3]))
            return Nearest(branches[0].q, T, float(np.linalg.norm(T[:3, 3] - found.T_goal[:3, 3])), angle)
    return search()
