"""Numbers as the screen shows them: unit, factor and decimals of each kind of quantity, the typographic minus."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Literal, NamedTuple

from rvsim.gui.preferences import Preferences
from rvsim.lab.sentences import Units
from rvsim.robot import Robot

Kind = Literal[
    "angle", "length", "unit_length", "number",
    "angle_speed", "length_speed", "unit_speed", "angle_acceleration", "length_acceleration", "unit_acceleration",
    "force", "torque", "unit_torque", "mass", "inertia", "energy", "gravity", "time", "percent",
]  # fmt: skip


class Display(NamedTuple):
    """How a kind of quantity is shown: factor · SI value, with a suffix, decimals and the step of one arrow key."""

    factor: float
    suffix: str
    decimals: int
    step: float


_DISPLAYS: dict[tuple[str, str], Display] = {
    ("angle", "deg"): Display(180.0 / math.pi, "°", 1, 1.0),
    ("angle", "rad"): Display(1.0, " rad", 3, 0.01),
    ("length", "mm"): Display(1e3, " mm", 1, 1.0),
    ("length", "m"): Display(1.0, " m", 4, 0.001),
    ("unit_length", ""): Display(1.0, " unit", 3, 0.01),
    ("number", ""): Display(1.0, "", 4, 0.01),
    ("angle_speed", "deg"): Display(180.0 / math.pi, " °/s", 1, 5.0),
    ("angle_speed", "rad"): Display(1.0, " rad/s", 3, 0.1),
    ("length_speed", "mm"): Display(1e3, " mm/s", 1, 10.0),
    ("length_speed", "m"): Display(1.0, " m/s", 4, 0.01),
    ("unit_speed", ""): Display(1.0, " unit/s", 3, 0.1),
    ("angle_acceleration", "deg"): Display(180.0 / math.pi, " °/s²", 1, 10.0),
    ("angle_acceleration", "rad"): Display(1.0, " rad/s²", 3, 0.1),
    ("length_acceleration", "mm"): Display(1e3, " mm/s²", 1, 10.0),
    ("length_acceleration", "m"): Display(1.0, " m/s²", 4, 0.01),
    ("unit_acceleration", ""): Display(1.0, " unit/s²", 3, 0.1),
    ("force", ""): Display(1.0, " N", 1, 1.0),
    ("torque", ""): Display(1.0, " N m", 2, 0.1),
    ("unit_torque", ""): Display(1.0, " N unit", 2, 0.1),
    ("mass", ""): Display(1.0, " kg", 3, 0.1),
    ("inertia", ""): Display(1.0, " kg m²", 5, 0.001),
    ("energy", ""): Display(1.0, " J", 2, 1.0),
    ("gravity", ""): Display(1.0, " m/s²", 3, 0.1),
    ("time", ""): Display(1.0, " s", 2, 0.1),
    ("percent", ""): Display(100.0, " %", 0, 1.0),
}


def display(kind: Kind, preferences: Preferences) -> Display:
    """How that kind is shown under the present preferences."""
    units = {"angle": preferences["angle_unit"], "length": preferences["length_unit"]}
    return _display(kind, units.get(kind.partition("_")[0], ""), preferences["extra_decimals"])


@lru_cache(maxsize=256)
def _display(kind: Kind, unit: str, extra_decimals: int) -> Display:
    shown = _DISPLAYS[kind, unit]
    return shown._replace(decimals=shown.decimals + extra_decimals)


def shown_units(preferences: Preferences) -> Units:
    """What sentences say angles and lengths in under the present preferences."""
    return Units(preferences["angle_unit"], preferences["length_unit"])


def length_kind(robot: Robot) -> Kind:
    """Lengths of an arm whose source gives none a unit are shown in "unit"."""
    return "length" if robot.length_unit == "millimetre" else "unit_length"


def joint_kind(robot: Robot, joint: int) -> Kind:
    """Whether that joint's value is an angle or a length."""
    return "angle" if robot.joints[joint].revolute else length_kind(robot)


def speed_kind(robot: Robot, joint: int) -> Kind:
    """What that joint's velocity is shown as."""
    return _SPEEDS[joint_kind(robot, joint)]


def acceleration_kind(robot: Robot, joint: int) -> Kind:
    """What that joint's acceleration is shown as."""
    return _ACCELERATIONS[joint_kind(robot, joint)]


def torque_kind(robot: Robot, joint: int) -> Kind:
    """A turning joint takes a torque, a sliding one a force."""
    return moment_kind(robot) if robot.joints[joint].revolute else "force"


def moment_kind(robot: Robot) -> Kind:
    """A force times a length of this arm."""
    return "torque" if robot.length_unit == "millimetre" else "unit_torque"


_SPEEDS: dict[Kind, Kind] = {"angle": "angle_speed", "length": "length_speed", "unit_length": "unit_speed"}
_ACCELERATIONS: dict[Kind, Kind] = {
    "angle": "angle_acceleration", "length": "length_acceleration", "unit_length": "unit_acceleration",
}  # fmt: skip


def format_number(value: float, decimals: int) -> str:
    """Fixed decimals, U+2212 for minus, and never −0.0."""
    text = f"{value:.{decimals}f}"
    if float(text) == 0.0:
        text = text.lstrip("-")
    return text.replace("-", "\u2212")


def half_turn_up(angle: float, shown: Display) -> float:
    """A direction [rad] that would be shown as −180° as +180°: the two are the same, and rounding chooses either."""
    lowest = format_number(-math.pi * shown.factor, shown.decimals)
    return angle + math.tau if format_number(angle * shown.factor, shown.decimals) == lowest else angle


def format_quantity(value: float, kind: Kind, preferences: Preferences) -> str:
    """An SI value with its unit, as the screen shows it."""
    shown = display(kind, preferences)
    return format_number(value * shown.factor, shown.decimals) + shown.suffix


def format_scientific(value: float, digits: int = 1) -> str:
    """Errors and residuals: always scientific, never rounded to 0."""
    return f"{value:.{digits}e}".replace("-", "\u2212")


def without_unit(text: str, suffix: str) -> str:
    """A typed text without the unit behind it: "250 mm" as "250" where mm is shown, but as it is where m is shown."""
    bare, unit = text.strip(), suffix.strip()
    if not unit or not bare.endswith(unit):
        return bare
    shorter = bare.removesuffix(unit)
    return bare if unit[0].isalpha() and shorter[-1:].isalpha() else shorter.strip()
