"""Where one is in a robot file, and in which units its numbers are: so that a refusal can name the culprit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, NoReturn

from rvsim.errors import RobotFileError
from rvsim.files.toml_source import line_of
from rvsim.language import tr
from rvsim.units import (
    degrees_from_radians,
    metres_from_millimetres,
    millimetres_from_metres,
    radians_from_degrees,
)

Quantity = Literal["plain", "length", "angle", "joint"]
_LONGEST_SHOWN = 60


class Unit(NamedTuple):
    """A unit of the file: its name, and the way from the file's number to SI and back."""

    name: str
    to_si: Callable[[float], float]
    from_si: Callable[[float], float]


PLAIN = Unit("", float, float)
DEGREE = Unit("degrees", radians_from_degrees, degrees_from_radians)
MILLIMETRE = Unit("millimetres", metres_from_millimetres, millimetres_from_metres)
ABSTRACT = Unit("units", float, float)
LENGTH_UNITS = {"millimetre": MILLIMETRE, "unit": ABSTRACT}


class Units(NamedTuple):
    """The unit of each quantity here; `joint` is that of the joint at hand: degrees, or the unit of length."""

    length: Unit = MILLIMETRE
    joint: Unit = DEGREE
    angle: Unit = DEGREE
    plain: Unit = PLAIN

    def of(self, quantity: Quantity) -> Unit:
        """The unit of a quantity."""
        unit: Unit = getattr(self, quantity)
        return unit

    def for_robot(self, length_unit: object) -> Units:
        """The units of an arm whose file says this `length_unit`; an unknown one is refused elsewhere."""
        return self._replace(length=LENGTH_UNITS.get(str(length_unit), MILLIMETRE))

    def for_joint(self, joint_type: object) -> Units:
        """The units of a joint of this type."""
        return self._replace(joint=self.length if joint_type == "prismatic" else self.angle)


_FILE_UNITS = Units()


@dataclass(frozen=True)
class Place:
    """A place in a file: the steps from its top, the units that hold there, a hint for who errs there, and the text.

    `newer`: a younger rvsim wrote it, and keys that are unknown here are passed over.
    """

    path: str
    steps: tuple[str, ...] = ()
    units: Units = _FILE_UNITS
    hint: str = ""
    text: str = ""
    newer: bool = False

    def at(self, step: str, hint: str = "") -> Place:
        """One step deeper."""
        return replace(self, steps=(*self.steps, step), hint=hint)

    def item(self, step: str) -> Place:
        """An item of the list that is here: "joint 3" instead of "joint"."""
        return replace(self, steps=(*self.steps[:-1], step))

    def with_units(self, units: Units) -> Place:
        """The same place, its numbers in other units."""
        return replace(self, units=units)

    def refuse(self, found: str, expected: str, suggestion: str = "") -> NoReturn:
        """Raise the `RobotFileError` of this place."""
        line = line_of(self.text, self.steps)
        where = ", ".join((tr("line {line}", line=line), *self.steps) if line else self.steps) or tr("the file")
        raise RobotFileError(self.path, where, found, expected, suggestion or self.hint)


def shown(value: object) -> str:
    """A value of a file in a few words."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return _shortened(_number_text(value))
    if isinstance(value, str):
        return tr("the text {shortened}", shortened=_shortened(repr(value)))
    if isinstance(value, list):
        return tr("a list of {count}", count=len(value))
    return "a table" if isinstance(value, dict) else tr("a date or time")


def _number_text(value: float) -> str:
    try:
        return repr(value)
    except ValueError:  # Python refuses to print an integer of thousands of digits
        return tr("an integer of thousands of digits")


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 1] + "…"
