"""Where one is in a robot file, and in which units its numbers are: so that a refusal can name the culprit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, NoReturn

from rvsim.errors import RobotFileError
from rvsim.files.toml_source import line_of
from rvsim.language import left_to_right, tr, tr_later
from rvsim.units import (
    degrees_from_radians,
    metres_from_millimetres,
    millimetres_from_metres,
    radians_from_degrees,
)

Quantity = Literal["plain", "length", "angle", "joint"]
_LONGEST_SHOWN = 60


class Unit(NamedTuple):
    """A unit of the file: its name in English, and the way from the file's number to SI and back."""

    name: str
    to_si: Callable[[float], float]
    from_si: Callable[[float], float]


PLAIN = Unit("", float, float)
DEGREE = Unit(tr_later("degrees"), radians_from_degrees, degrees_from_radians)
MILLIMETRE = Unit(tr_later("millimetres"), metres_from_millimetres, millimetres_from_metres)
ABSTRACT = Unit(tr_later("units"), float, float)
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

    Steps and hint are in English, as the file has them ("joint 3", "key 'alpha'"; "alpha: DH twist about x."): they are
    translated when somebody reads them. `newer`: a younger rvsim wrote it, and keys that are unknown here are passed
    over.
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
        steps = [*([tr("line {number}", number=line)] if line else []), *map(step_words, self.steps)]
        where = tr(", ").join(steps) or tr("the file")
        raise RobotFileError(self.path, where, found, expected, suggestion or hint_words(self.hint))


_STEPS = {
    "key": tr_later("key {which}"),
    "number": tr_later("number {which}"),
    "row": tr_later("row {which}"),
    "joint": tr_later("joint {which}"),
    "tool": tr_later("tool {which}"),
    "mass": tr_later("mass {which}"),
    "servo": tr_later("servo {which}"),
    "point": tr_later("point {which}"),
    "capsule": tr_later("capsule {which}"),
    "box": tr_later("box {which}"),
    "move": tr_later("move {which}"),
    "stage": tr_later("stage {which}"),
    "pose": tr_later("pose {which}"),
    "experiment": tr_later("experiment {which}"),
}


def step_words(step: str) -> str:
    """A step for people: "key 'alpha'", "joint 3"; one that is a word of the file alone stays that."""
    word, _, which = step.partition(" ")
    return tr(_STEPS[word], which=which) if which and word in _STEPS else step


def hint_words(hint: str) -> str:
    """A hint for people: the key that it begins with, and what that means."""
    key, colon, meaning = hint.partition(": ")
    return f"{left_to_right(key)}: {tr(meaning.removesuffix('.'))}." if colon else tr(hint)


def either(words: Sequence[str]) -> str:
    """Words of which one is right: "'a' or 'b'"."""
    return tr(" or ").join(map(repr, words))


# A list, and how many it may hold, by the name of one of them.
_LISTS = {
    "joint": (tr_later("a list of joints"), tr_later("{fewest} to {most} joints")),
    "tool": (tr_later("a list of tools"), tr_later("{fewest} to {most} tools")),
    "mass": (tr_later("a list of masses"), tr_later("{fewest} to {most} masses")),
    "servo": (tr_later("a list of servos"), tr_later("{fewest} to {most} servos")),
    "point": (tr_later("a list of points"), tr_later("{fewest} to {most} points")),
    "capsule": (tr_later("a list of capsules"), tr_later("{fewest} to {most} capsules")),
    "box": (tr_later("a list of boxes"), tr_later("{fewest} to {most} boxes")),
    "move": (tr_later("a list of moves"), tr_later("{fewest} to {most} moves")),
    "stage": (tr_later("a list of stages"), tr_later("{fewest} to {most} stages")),
    "pose": (tr_later("a list of poses"), tr_later("{fewest} to {most} poses")),
    "experiment": (tr_later("a list of experiments"), tr_later("{fewest} to {most} experiments")),
}


def list_of(one: str) -> str:
    """What is expected where a list stands whose items are called `one`."""
    return tr(_LISTS[one][0])


def count_of(one: str, fewest: int, most: int) -> str:
    """How many items such a list may have."""
    return tr(_LISTS[one][1], fewest=fewest, most=most)


def shown(value: object) -> str:
    """A value of a file in a few words."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return _shortened(_number_text(value))
    if isinstance(value, str):
        return tr("the text {text}", text=_shortened(repr(value)))
    if isinstance(value, list):
        return tr("a list of {count}", count=len(value))
    return tr("a table") if isinstance(value, dict) else tr("a date or time")


def _number_text(value: float) -> str:
    try:
        return repr(value)
    except ValueError:  # Python refuses to print an integer of thousands of digits
        return tr("an integer of thousands of digits")


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 1] + "…"
