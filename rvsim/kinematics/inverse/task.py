"""What is asked of the tool: a pose, or less. Each task of each family gives its candidates."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rvsim.errors import UnknownNameError
from rvsim.kinematics.inverse.batch import frame_entries, solve_block
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.copies import limit_copies
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.free_orientation import place_branches
from rvsim.kinematics.inverse.free_pitch import free_pitches
from rvsim.kinematics.inverse.kept_wrist import kept_wrist
from rvsim.kinematics.inverse.projection import require_tip_on_roll_axis, turned_about_vertical
from rvsim.kinematics.inverse.rrrp import RollAndExtend
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.kinematics.inverse.textbook import Planar, Scara, yaw_of
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.spatial import rot_z
from rvsim.spatial.arrays import FloatArray

POSE_ENTRIES, PLACE_ENTRIES = 6, 3  # how many numbers of a pose a task asks for


class Candidates(NamedTuple):
    """Joints (b, n), NaN rows where a branch does not exist, their labels, and what they are to be checked against.

    T_goal (4, 4) is the target as the arm can understand it; `entries` is 6 if all of it counts, 3 if only the place;
    joints that are `held` stay as they are; of a `continuum` each row is but one representative.
    """

    q: FloatArray
    labels: tuple[str, ...]
    T_goal: FloatArray
    entries: int
    held: tuple[int, ...] = ()
    continuum: bool = False


Solver = Callable[[ClosedForm, FloatArray, FloatArray], Candidates]


def tasks(form: ClosedForm) -> tuple[str, ...]:
    """The tasks an arm has closed forms for, its own first."""
    return (form.task, *(name for family, name in _OTHER_TASKS if isinstance(form, family)))


def candidates(form: ClosedForm, task: str | None, T: FloatArray, near: FloatArray) -> Candidates:
    """The candidates for T (4, 4) with the arm at `near` (n,).

    Raises:
        UnknownNameError: the arm has no closed form for this task.
    """
    if task is None or task == form.task:
        return _own(form, T, near)
    for (family, name), solver in _OTHER_TASKS.items():
        if task == name and isinstance(form, family):
            return solver(form, T, near)
    raise UnknownNameError("task", task, tasks(form))


def _own(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    q = solve_block(form, T[None], near)[:, :, 0]
    entries = POSE_ENTRIES if form.task in ("pose", "position+yaw") else PLACE_ENTRIES
    return Candidates(q, form.labels, _goal(form, T), entries)


def _goal(form: ClosedForm, T: FloatArray) -> FloatArray:
    """The target without what the arm is not asked for: the tilt of a SCARA's tool, the height of a planar arm's."""
    chain = form.chain
    T_0_tool = chain.T_0_base @ T
    if isinstance(form, Scara):
        turn = yaw_of(frame_entries(chain, T[None], flange=False), chain.T_n_tool[:3, :3])[0]
        T_0_tool[:3, :3] = rot_z(turn) @ chain.T_n_tool[:3, :3]
    elif isinstance(form, Planar):
        T_0_tool[2, 3] = chain.place(np.zeros(2).tolist())[2]
    else:
        return T
    return np.asarray(chain.T_base_0 @ T_0_tool)


def _pitch_and_roll(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    """Place, pitch and roll of a 5R arm: the target turned about the vertical as far as the arm must."""
    return _own(form, turned_about_vertical(form.chain, T[None])[0], near)


def _place_with_roll(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    """The place alone for an RRRP arm, its roll kept."""
    assert isinstance(form, RollAndExtend)
    chain, inner = form.chain, form.chain.inner(near)
    place = frame_entries(chain, T[None], flange=False)[:, 3]
    q = chain.to_joints(form.solve_place(place, inner))[:, :, 0]
    return Candidates(q, form.place_labels, T, PLACE_ENTRIES)


_PITCHES = np.radians(np.arange(-180.0, 180.0, 2.0))
_REFINEMENTS = 4  # each divides the step by 10


def _place_with_free_pitch(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    """The place alone for a 5R arm, its roll kept: on each branch the pitch within limits with the least motion."""
    assert isinstance(form, FiveAxis)
    pitch = float(form.chain.inner(near)[1:4].sum()) - 0.5 * math.pi
    samples = np.append(_PITCHES, (pitch, math.pi - pitch))
    best = [_best_pitch(form, T[:3, 3], samples, branch, near) for branch in range(len(form.labels))]
    return Candidates(np.array(best), form.labels, T, PLACE_ENTRIES)


def _best_pitch(form: FiveAxis, place: FloatArray, pitches: FloatArray, branch: int, near: FloatArray) -> FloatArray:
    """The joints (n,) of one branch at its best pitch, found among samples and again among ever finer ones."""
    step = float(_PITCHES[1] - _PITCHES[0])
    for refinement in range(_REFINEMENTS + 1):
        q = free_pitches(form, place[None], pitches, float(near[4]))[0, :, branch]
        copies = limit_copies(form.chain.robot, q, near)
        cost = np.abs(copies.q - near).max(axis=1) + np.where(copies.within, 0.0, 1e3)
        best = int(np.argmin(np.where(np.isnan(cost), np.inf, cost)))
        if refinement < _REFINEMENTS:
            pitches = np.append(pitches[best], pitches[best] + step * np.linspace(-1.0, 1.0, 21))
            step *= 0.1
    return np.asarray(q[best])


def _place_with_kept_wrist(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    """The place alone for a 5R arm, its two wrist joints kept."""
    assert isinstance(form, FiveAxis)
    require_tip_on_roll_axis(form.chain)
    place = frame_entries(form.chain, T[None], flange=False)[:, 3, 0]
    return Candidates(kept_wrist(form, place, near), form.labels, T, PLACE_ENTRIES, held=(3, 4))


def _place_with_free_orientation(form: ClosedForm, T: FloatArray, near: FloatArray) -> Candidates:
    """The place alone for a 6R arm: on each branch the orientation nearest to T's."""
    assert isinstance(form, SphericalWrist | ParallelAxes)
    return Candidates(place_branches(form, T, near), form.labels, T, PLACE_ENTRIES, continuum=True)


_OTHER_TASKS: dict[tuple[type[ClosedForm], str], Solver] = {
    (FiveAxis, "position+pitch+roll"): _pitch_and_roll,
    (FiveAxis, "position"): _place_with_free_pitch,
    (FiveAxis, "position, wrist kept"): _place_with_kept_wrist,
    (RollAndExtend, "position"): _place_with_roll,
    (ParallelAxes, "position"): _place_with_free_orientation,
    (SphericalWrist, "position"): _place_with_free_orientation,
}
