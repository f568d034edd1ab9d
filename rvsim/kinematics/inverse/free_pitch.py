"""A 5R arm that only has to be at a place: all its branches for every pitch of the tool it may choose."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics.inverse.elbow import erase
from rvsim.kinematics.inverse.families import closed_form, five_axis
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats


def free_pitch_batch(robot: Robot, p: ArrayLike, pitches: ArrayLike, roll: float = 0.0) -> FloatArray:
    """q (m, k, branches, n) [rad] that bring the tool to p (m, 3) [m] with the tool axis at each of the pitches (k,).

    A pitch is the tool axis's angle above the horizontal [rad], outwards: −π/2 points straight down, 0 outwards, π
    back to the base. The roll joint stays at `roll`, the columns are those of `branch_labels`, NaN where no branch
    exists. A place on the base axis leaves joint 1 free: there it is at home.

    Raises:
        NoClosedFormError: the arm is no 5R arm with a waist, three parallel axes and a roll.
        ShapeError: p is not (m, 3) or the pitches are not (k,).
    """
    form, places, angles = (
        five_axis(closed_form(robot), tr("a pitch is free")),
        floats("p", p, 3),
        np.asarray(pitches, dtype=np.float64),
    )
    if places.ndim != 2 or angles.ndim != 1:
        raise ShapeError("p and pitches", "(m, 3) and (k,)", (*places.shape, *angles.shape))
    return free_pitches(form, places, angles, roll)


def free_pitches(form: FiveAxis, places: FloatArray, angles: FloatArray, roll: float) -> FloatArray:
    """The same of a known closed form."""
    chain = form.chain
    x, y, z = chain.T_0_base[:3, :3] @ places.T + chain.T_0_base[:3, 3:]
    rho = np.hypot(x, y)
    away = np.where(rho <= 1e-10 * chain.size, chain.inner(chain.robot.home)[0], np.arctan2(y, x))
    theta5 = chain.sign[4] * roll + chain.offset[4]
    q = np.empty((4, 5, len(places), len(angles)))
    with np.errstate(invalid="ignore"):
        _fill(form, q, rho[:, None], z[:, None], away[:, None], angles, theta5)
        joints = chain.to_joints(q.reshape(4, 5, -1))
    return np.ascontiguousarray(joints.reshape(q.shape).transpose(2, 3, 0, 1))


def _fill(
    form: FiveAxis, q: FloatArray, rho: FloatArray, z: FloatArray, away: FloatArray, pitch: FloatArray, theta5: float
) -> None:
    """Both sides; the tool's offset beside the roll axis, turned by the roll, has a part out of the plane: `aside`."""
    tip = form.chain.T_n_tool[:3, 3]
    along = form.a4 + math.cos(theta5) * tip[0] - math.sin(theta5) * tip[1]
    aside = math.sin(theta5) * tip[0] + math.cos(theta5) * tip[1]
    reach = form.d5 + tip[2]
    turn = np.arcsin(aside / rho) if aside else np.zeros_like(rho)
    r = np.sqrt(rho * rho - aside * aside)
    q[:, 4] = theta5
    for side, outward in enumerate((1.0, -1.0)):
        c, s = outward * np.cos(pitch), np.sin(pitch)
        u = outward * r - form.a1 - reach * c + along * s
        w = z - form.d1 - reach * s - along * c
        columns = q[2 * side : 2 * side + 2]
        columns[:, 0] = away + outward * turn + (0.0 if outward > 0.0 else math.pi)
        missing = form.fill_side(columns, u, w, np.arctan2(c, -s), outward * form.up)
        erase(columns, missing | np.isnan(turn))
