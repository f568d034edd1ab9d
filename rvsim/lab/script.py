"""A Python script that needs only NumPy and works a motion out once more: the numbers of a report, to be checked."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.lab.texts import matrix_numpy
from rvsim.motion import Tracking, Trajectory
from rvsim.motion.point_times import point_times
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

_HEAD = '''\
"""{title}: where the tool is for each pose of a motion, from the Denavit-Hartenberg table alone.

Run it with Python and NumPy. Angles are radians, lengths {unit}.
"""

import numpy as np

# theta, d, a, alpha of each joint at q = 0: {names}.
DH = {dh}

# Which joints turn; the others slide.
REVOLUTE = np.array({revolute})

# From the base to the first frame, and from the last frame to the tool.
T_BASE_0 = {base}

T_FLANGE_TOOL = {tool}

# {clock}, and where the joints are then: one row a pose.
{counted} = {times}

Q = {q}

# Where the tool should be, or None.
WANTED = {wanted}
'''
_MOVES = {
    "standard": ("Denavit and Hartenberg", "turn(z, theta) @ shift(z, d) @ shift(x, a) @ turn(x, alpha)"),
    "modified": ("Craig", "turn(x, alpha) @ shift(x, a) @ shift(z, d) @ turn(z, theta)"),
}
_BODY = '''

def turn(axis, angle):
    """Rotation about x (0) or z (2)."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (1, 2) if axis == 0 else (0, 1)
    T = np.eye(4)
    T[i, i], T[i, j], T[j, i], T[j, j] = c, -s, s, c
    return T


def shift(axis, length):
    """Translation along x (0) or z (2)."""
    T = np.eye(4)
    T[axis, 3] = length
    return T


def link(row, q, revolute):
    """One row of the table as a transform, after {author}."""
    x, z = 0, 2
    theta, d, a, alpha = row
    theta, d = (theta + q, d) if revolute else (theta, d + q)
    return {moves}


def forward_kinematics(q):
    """The pose of the tool (4, 4) in base axes."""
    T = T_BASE_0
    for row, value, revolute in zip(DH, q, REVOLUTE):
        T = T @ link(row, value, revolute)
    return T @ T_FLANGE_TOOL


def main():
    points = np.array([forward_kinematics(q)[:3, 3] for q in Q])
    columns = [{counted}[:, None], points]
    names = ["{column}", "x [{short}]", "y [{short}]", "z [{short}]"]
    if WANTED is not None:
        deviation = np.linalg.norm(points - WANTED, axis=1)
        columns.append(deviation[:, None])
        names.append("deviation [{short}]")
    print(",".join(names))
    for row in np.hstack(columns):
        print(",".join(repr(float(value)) for value in row))
    print("way [{short}],", float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()), sep="")
    if WANTED is not None:
        print("rms [{short}],", float(np.sqrt(np.mean(deviation**2))), sep="")
        print("max [{short}],", float(deviation.max()), sep="")
        print("mean [{short}],", float(deviation.mean()), sep="")


if __name__ == "__main__":
    main()
'''


class _Clock(NamedTuple):
    """What stands in the first column of the numbers: what it is, its name in the script, and in the output."""

    clock: str
    counted: str
    column: str


_SECONDS, _POINTS = _Clock("When [s]", "TIMES", "t [s]"), _Clock("Which point of the path", "POINTS", "point")


def motion_script(
    robot: Robot, times: ArrayLike, q: ArrayLike, wanted: ArrayLike | None = None, *, numbered: bool = False
) -> str:
    """The script that prints t, x, y, z (and the deviation) of each pose, the length of the way, RMS, max and mean.

    Args:
        times: (m,) [s], or where `numbered` the numbers of points.
        q: (m, n) the poses [rad, m], at least one.
        wanted: (m, 3) where the tool should be [m].

    Raises:
        ShapeError: they do not fit together.
    """
    poses = frozen_array("q", q, (-1, robot.dof))
    if not len(poses):
        raise ShapeError("q", f"(at least 1, {robot.dof})", poses.shape)
    places = None if wanted is None else frozen_array("wanted", wanted, (len(poses), 3))
    author, moves = _MOVES[robot.convention]
    in_metres = robot.length_unit == "millimetre"
    clock = (_POINTS if numbered else _SECONDS)._asdict()
    head = _HEAD.format(
        title=_plain(robot.title),
        unit="metres" if in_metres else "the arm's own unit",
        names=", ".join(map(_plain, robot.joint_names)),
        dh=matrix_numpy(robot.dh),
        revolute=robot.is_revolute.tolist(),
        base=matrix_numpy(robot.T_base_0),
        tool=matrix_numpy(robot.T_flange_tool),
        times=matrix_numpy(frozen_array("times", times, (len(poses),))),
        q=matrix_numpy(poses),
        wanted=None if places is None else matrix_numpy(places),
        **clock,
    )
    body = _BODY
    for name, text in {**clock, "author": author, "moves": moves, "short": "m" if in_metres else "unit"}.items():
        body = body.replace(f"{{{name}}}", text)
    return head + body


def tracking_script(tracking: Tracking, trajectory: Trajectory | None = None) -> str | None:
    """The script of the reached points of a tracked path; None when there is none.

    Args:
        trajectory: the motion, which says when they are passed; without one, or with that of another path, they are
            numbered.
    """
    reached: FloatArray = tracking.q[tracking.reached]
    if not len(reached):
        return None
    times = None if trajectory is None else point_times(trajectory, tracking)
    counted = np.flatnonzero(tracking.reached) if times is None else times
    wanted = tracking.path.points[tracking.reached]
    return motion_script(tracking.robot, counted, reached, wanted, numbered=times is None)


def _plain(name: str) -> str:
    """Without what would end a comment or a docstring."""
    return " ".join(name.replace("\\", "/").replace('"', "'").split())
