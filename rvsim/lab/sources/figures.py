"""Values of the errata as numbers with units: degrees and millimetres, or an arm's own unit of length."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from rvsim.lab.tables import joint_units, length_unit, shown_joints
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

Numbers = float | tuple[float, ...]
MINUS = "\u2212"
_DEGREE, _MILLIMETRE = degrees_from_radians(1.0), millimetres_from_metres(1.0)
_UNITS = {
    "number": ("", 1.0),
    "angle": ("deg", _DEGREE),
    "rate": ("deg/s", _DEGREE),
    "acceleration": ("deg/s²", _DEGREE),
    "length": ("mm", _MILLIMETRE),
    "lever": ("mm/rad", _MILLIMETRE),
    "torque": ("N m", 1.0),
}
_ZERO = 1e-9  # what is smaller is rounding, in the units that are printed


def unit_of(robot: Robot, kind: str) -> tuple[str, float]:
    """The unit of a kind of entry and the factor from SI to it."""
    unit, factor = _UNITS[kind]
    return ("unit", 1.0) if unit == "mm" and length_unit(robot) == "unit" else (unit, factor)


def pose_text(robot: Robot, q: ArrayLike) -> str:
    """A pose as it is typed: (30, 40, −50, 20, 60)°, a length with its unit."""
    values = [number(value, 4) for value in shown_joints(robot, q)]
    units = joint_units(robot)
    if set(units) == {"deg"}:
        return f"({', '.join(values)})°"
    return f"({', '.join(f'{value}°' if unit == 'deg' else value for value, unit in zip(values, units, strict=True))})"


def as_numbers(values: ArrayLike) -> Numbers:
    """A number, or several; NaN stays, and what is only rounding is 0."""
    array: FloatArray = np.asarray(values, dtype=np.float64)
    clean = np.where(np.abs(array) < _ZERO, 0.0, array)
    return float(clean) if clean.ndim == 0 else tuple(float(value) for value in clean.ravel())


def shown_value(value: Numbers, digits: int = 6) -> str:
    """For people: so many digits at most."""
    if isinstance(value, float):
        return number(value, digits)
    return f"({', '.join(number(each, digits) for each in value)})"


def number(value: float, digits: int) -> str:
    """With so many significant digits and a typographic minus; a dash for what is no number."""
    return "–" if math.isnan(value) else f"{value:.{digits}g}".replace("-", MINUS).replace("e+0", "e")
