"""Source 000's Programs 2 and 3 as printed, in decimetres there and in metres here."""

from __future__ import annotations

import numpy as np

from rvsim.robot.arrays import FloatArray

_DECIMETRE = 0.1
_FINGERS = np.array([[-0.35, 0.0, 0.0], [-0.35, 0.0, -0.6], [0.0, 0.0, -0.6], [0.35, 0.0, -0.6], [0.35, 0.0, 0.0]])
BOXES = 11  # edit1 to edit11 of Program 15
LINE_PAUSE, LETTER_PAUSE = 0.51, 0.7  # [s] GraphingTimeDelay of Programs 10 and 11


def compute_dh_matrix(a: float, alpha: float, d: float, theta: float) -> FloatArray:
    """Program 2: A (4, 4)."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0.0, sa, ca, d], [0.0, 0.0, 0.0, 1.0]])


def dhparams(q: FloatArray) -> tuple[tuple[float, float, float, float], ...]:
    """Programs 1 and 3: a, alpha, d, theta of the five rows [dm, rad]."""
    right = np.pi / 2
    return (
        (0.0, right, 1.52, float(q[0])),
        (2.5, 0.0, 0.0, float(q[1])),
        (1.6, 0.0, 0.0, float(q[2])),
        (0.0, right, 0.0, float(q[3] + right)),
        (0.0, 0.0, 0.72, float(q[4] - right)),
    )


def rvm1_fk(q: FloatArray) -> FloatArray:
    """Program 3: pos (11, 3) [m], the base, the origins of frames 1 to 5, and five points of the gripper."""
    T, origins = np.eye(4), [np.zeros(3)]
    for row in dhparams(q):
        T = T @ compute_dh_matrix(*row)
        origins.append(T[:3, 3])
    fingers = _FINGERS @ T[:3, :3].T + T[:3, 3]
    return np.asarray(_DECIMETRE * np.vstack([*origins, fingers]))
