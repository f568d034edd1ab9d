"""The wrist kept as it is relative to the arm, the place alone wanted: the second closed form that source 004 names.

With θ4 and θ5 held, all beyond the elbow is one rigid link to the tip: two links in a vertical plane remain.
"""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics.inverse.elbow import empty_rows, erase, solve_elbow
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.waist import solve_waist
from rvsim.spatial.arrays import FloatArray


def kept_wrist(form: FiveAxis, place: FloatArray, near: FloatArray) -> FloatArray:
    """(4, 5) joints of each branch that bring the tip to a place (3,) in frame 0; NaN rows where there is none.

    `near` (5,) gives the two wrist joints, and joint 1 where the place leaves it free. The tip lies on the roll axis.
    """
    chain, (free, _, _, wrist, roll) = form.chain, form.chain.inner(near).tolist()
    out, aside = form.d5 + float(chain.T_n_tool[2, 3]), form.a4
    # The tip in the frame of link 3: its length and its angle are those of the one link that is left.
    x = form.a3 + aside * math.cos(wrist) + out * math.sin(wrist)
    y = aside * math.sin(wrist) - out * math.cos(wrist)
    length, angle = math.hypot(x, y), math.atan2(y, x)
    q = empty_rows(4, 5, 1)
    q[:, 3], q[:, 4] = wrist, roll
    waist = solve_waist(place[:1], place[1:2], 0.0, chain.size, free)
    for k, side in enumerate(waist.sides):
        branches = q[2 * k : 2 * k + 2]
        elbow = solve_elbow(side.out - form.a1, place[2:] - form.d1, form.a2, length)
        up = (form.up if k == 0 else -form.up) * math.copysign(1.0, form.a3)
        for branch, sign in zip(branches, (up, -up), strict=True):
            branch[0], branch[1] = side.theta1, elbow.direction - sign * elbow.lean
            branch[2] = sign * elbow.bend - angle
        erase(branches, elbow.missing)
    return np.asarray(chain.to_joints(q)[:, :, 0])
