"""A Python script that needs only NumPy and works a motion out once more: the numbers of a report, to be checked."""

from __future__ import annotations

from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.lab.texts import matrix_numpy
from rvsim.motion import Tracking
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

# When [s], and where the joints are then: one row a pose.
TIMES = {times}

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
    columns = [TIMES[:, None], points]
    names = ["t", "x", "y", "z"]
    if WANTED is not None:
        deviation = np.linalg.norm(points - WANTED, axis=1)
        columns.append(deviation[:, None])
        names.append("deviation")
    print(",".join(names))
    for row in np.hstack(columns):
        print(",".join(repr(float(value)) for value in row))
    print("way,", float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()), sep="")
    if WANTED is not None:
        print("rms,", float(np.sqrt(np.mean(deviation**2))), sep="")
        print("max,", float(deviation.max()), sep="")
        print("mean,", float(deviation.mean()), sep="")


if __name__ == "__main__":
    main()
'''


def motion_script(robot: Robot, times: ArrayLike, q: ArrayLike, wanted: ArrayLike | None = None) -> str:
    """The script that prints t, x, y, z (and the deviation) of each pose, the length of the way, RMS, max and mean.

    Args:
        times: (m,) [s].
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
    head = _HEAD.format(
        title=_plain(robot.title),
        unit="metres" if robot.length_unit == "millimetre" else "the arm's own unit",
        names=", ".join(map(_plain, robot.joint_names)),
        dh=matrix_numpy(robot.dh),
        revolute=robot.is_revolute.tolist(),
        base=matrix_numpy(robot.T_base_0),
        tool=matrix_numpy(robot.T_flange_tool),
        times=matrix_numpy(frozen_array("times", times, (len(poses),))),
        q=matrix_numpy(poses),
        wanted=None if places is None else matrix_numpy(places),
    )
    return head + _BODY.replace("{author}", author).replace("{moves}", moves)


def tracking_script(tracking: Tracking) -> str | None:
    """The script of the reached points of a tracked path, t being their index; None when there is none."""
    reached: FloatArray = tracking.q[tracking.reached]
    if not len(reached):
        return None
    return motion_script(tracking.robot, tracking.reached.nonzero()[0], reached, tracking.path.points[tracking.reached])


def _plain(name: str) -> str:
    """Without what would end a comment or a docstring."""
    return " ".join(name.replace("\\", "/").replace('"', "'").split())
