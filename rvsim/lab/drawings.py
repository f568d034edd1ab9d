"""The curves of the sources as points in metres, base axes. The sources' own numbers, in their units, stand here."""

from __future__ import annotations

import math

import numpy as np

from rvsim.motion import spline_points
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import nearest_rotation

_DECIMETRE = 0.1
_MILLIMETRE = 1e-3

# Source 000, Programs 9 and 16: the letter's twelve points.
LETTER_X = (13, 14, 6, 2, 5, 20, 42, 49, 39, 25, 22, 30)
LETTER_Y = (48, 31, 7, 13, 19, 12, 16, 39, 61, 66, 40, 2)
LETTER_SAMPLES = 50
# Where all of it can be drawn tool-down within the RV-M1's limits.
_TABLE_PLACE = np.array([0.256, -0.087, 0.0])

# Source 002, code 1: semi-axes, centre twice shifted by 50, and the interval, all in mm.
_ELLIPSE_AXES_MM = (35.0, 25.0)
_ELLIPSE_CENTRE_MM = (100.0, 100.0)
_ELLIPSE_MOVE = np.array([0.3, 0.0, 0.3])
ELLIPSE_SAMPLES = math.ceil(2.0 * math.pi * 35.0 / 1.2)
# Source 002, code 2: the desired rotation as printed; it is not quite orthogonal (4.4e-5).
ELLIPSE_PRINTED_ROTATION = np.array([[-0.5, -0.866, 0.0], [0.866, -0.5, 0.0], [0.0, 0.0, 1.0]])

SPIRAL_SAMPLES = 2001


def letter(samples: int = LETTER_SAMPLES) -> FloatArray:
    """(m, 3) the spline through the letter's points: x, y and the parameter t = 1…12, in the source's own numbers."""
    t = np.linspace(1.0, 12.0, samples)
    xy = spline_points(range(1, 13), np.column_stack([LETTER_X, LETTER_Y]), t)
    return np.column_stack([xy, t])


def letter_raw(samples: int = LETTER_SAMPLES) -> FloatArray:
    """As Program 9 has it: x, y and t are decimetres."""
    return letter(samples) * _DECIMETRE


def letter_scaled(samples: int = LETTER_SAMPLES, height: float = 0.3) -> FloatArray:
    """As Program 16 plots it, divided by 40, at a height [m] that the source does not give."""
    points = letter(samples) / 40.0 * _DECIMETRE
    points[:, 2] = height
    return points


def letter_flat(samples: int = LETTER_SAMPLES) -> FloatArray:
    """Divided by 40 and laid before the arm, on a table of 150 mm."""
    return np.asarray(letter_scaled(samples, 0.15) + _TABLE_PLACE)


def letter_board(samples: int = LETTER_SAMPLES) -> FloatArray:
    """Divided by 40 and upright, on a board at x = 340 mm."""
    curve = letter(samples)
    across, up = (curve[:, 0] - 25.55) / 40.0, 1.8 + (curve[:, 1] - 34.75) / 40.0
    return np.column_stack([np.full(samples, 3.4), across, up]) * _DECIMETRE


def ellipse(samples: int = ELLIPSE_SAMPLES) -> FloatArray:
    """Source 002's ellipse on the mounting plane."""
    theta = np.linspace(0.0, 2.0 * math.pi, samples)
    x = _ELLIPSE_CENTRE_MM[0] + _ELLIPSE_AXES_MM[0] * np.cos(theta)
    y = _ELLIPSE_CENTRE_MM[1] + _ELLIPSE_AXES_MM[1] * np.sin(theta)
    return np.column_stack([x, y, np.zeros(samples)]) * _MILLIMETRE


def ellipse_moved(samples: int = ELLIPSE_SAMPLES) -> FloatArray:
    """The same ellipse moved by (+300, 0, +300) mm, where the arm reaches all of it."""
    return np.asarray(ellipse(samples) + _ELLIPSE_MOVE)


def ellipse_rotation() -> FloatArray:
    """(3, 3) the rotation nearest to the printed one: 120.00073° about z."""
    return nearest_rotation(ELLIPSE_PRINTED_ROTATION)


def spiral(samples: int = SPIRAL_SAMPLES) -> FloatArray:
    """Source 003's path: straight up for 10 s, then a spiral for 10 s; its unit of length is our metre."""
    t = np.linspace(0.0, 20.0, samples)
    turning = t > 10.0
    x = 4.0 + np.where(turning, np.sin(math.pi / 2.0 * t), 0.0)
    y = 4.0 + np.where(turning, np.cos(math.pi / 2.0 * t), -1.0)
    return np.column_stack([x, y, 0.1 * t + 4.0])


def star(center: FloatArray, radius: float, samples: int = 101) -> FloatArray:
    """A five-pointed star drawn in one stroke in a level plane: `samples` points spread evenly along it."""
    corners_at = math.pi / 2.0 + 0.8 * math.pi * np.arange(6)
    corners = center + radius * np.column_stack([np.cos(corners_at), np.sin(corners_at), np.zeros(6)])
    along = np.linspace(0.0, 5.0, samples)
    return np.column_stack([np.interp(along, np.arange(6), corners[:, axis]) for axis in range(3)])
