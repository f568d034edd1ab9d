"""One cell of the DH table: what stands in it, what it is called, and what a typed text means there."""

from __future__ import annotations

import math
from typing import NamedTuple

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate_in
from rvsim.gui.panels.matrices import subscript
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import (
    Display,
    Kind,
    display,
    format_number,
    format_quantity,
    joint_kind,
    length_kind,
    without_unit,
)
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.edits import DHKey

_LIMITS = {"lower": -math.inf, "upper": math.inf}
_NONE = frozenset({"none", "no", "inf", "-inf", "\u2212inf", "+inf", "∞", "-∞", "\u2212∞", "+∞"})
_TITLES = {
    "lower": tr_later("The lower limit of “{joint}”"),
    "upper": tr_later("The upper limit of “{joint}”"),
    "home": tr_later("The home of “{joint}”"),
}
_EDITS = {
    "lower": tr_later("Edit the lower limit of “{joint}” of {robot}"),
    "upper": tr_later("Edit the upper limit of “{joint}” of {robot}"),
    "home": tr_later("Edit the home of “{joint}” of {robot}"),
}
_NO_LIMIT = tr_later("none")
_LETTERS = {"theta": "θ", "d": "d", "a": "a", "alpha": "α"}
_LARGEST = 1e4  # [rad, m]: beyond this a number is a slip of the keyboard


class Typed(NamedTuple):
    """What a typed text means: an SI value, or a sentence that says why it cannot be taken."""

    value: float = 0.0
    problem: str = ""


def cell_kind(robot: Robot, joint: int, key: DHKey) -> Kind:
    """Whether the cell holds an angle or a length."""
    if key in ("theta", "alpha"):
        return "angle"
    return length_kind(robot) if key in ("d", "a") else joint_kind(robot, joint)


def cell_value(robot: Robot, joint: int, key: DHKey) -> float:
    """The SI value in a cell."""
    return float(getattr(robot.joints[joint], key))


def cell_title(robot: Robot, joint: int, key: DHKey) -> str:
    """What a sentence calls the cell: "a₂ of “shoulder”", "The upper limit of “elbow”"."""
    name = tr(robot.joint_names[joint])
    if key in _TITLES:
        return tr(_TITLES[key], joint=name)
    return tr("{letter} of “{joint}”", letter=_letter(robot, joint, key), joint=name)


def edit_title(robot: Robot, joint: int, key: DHKey) -> str:
    """What an edit of the cell is called: "Edit a₂ of “shoulder” of RV-M1"."""
    name = tr(robot.joint_names[joint])
    if key in _EDITS:
        return tr(_EDITS[key], joint=name, robot=tr(robot.title))
    letter = _letter(robot, joint, key)
    return tr("Edit {letter} of “{joint}” of {robot}", letter=letter, joint=name, robot=tr(robot.title))


def _letter(robot: Robot, joint: int, key: DHKey) -> str:
    """The letter of a DH value with its index."""
    shifted = robot.convention == "modified" and key in ("a", "alpha")
    return _LETTERS[key] + subscript(joint if shifted else joint + 1)


def cell_text(robot: Robot, joint: int, key: DHKey, preferences: Preferences) -> str:
    """The text in a cell; where q is added to the value it says so: "q₁ + 90.0°"."""
    value = cell_value(robot, joint, key)
    if math.isinf(value):
        return tr(_NO_LIMIT)
    kind = cell_kind(robot, joint, key)
    shown = display(kind, preferences)
    lengths_have_their_unit_above = key in ("d", "a")
    text = format_quantity(value, kind, preferences)
    if lengths_have_their_unit_above:
        text = format_number(value * shown.factor, shown.decimals)
    return _with_q(joint, value, text) if key == _moving_key(robot, joint) else text


def edit_text(robot: Robot, joint: int, key: DHKey, preferences: Preferences) -> str:
    """The bare number that an edit begins with, in full precision."""
    value = cell_value(robot, joint, key)
    shown = display(cell_kind(robot, joint, key), preferences)
    return tr(_NO_LIMIT) if math.isinf(value) else f"{value * shown.factor:.12g}"


def typed(robot: Robot, joint: int, key: DHKey, text: str, preferences: Preferences) -> Typed:
    """The SI value of a typed text in this cell, or why not."""
    title = cell_title(robot, joint, key)
    shown = display(cell_kind(robot, joint, key), preferences)
    bare = without_unit(text, shown.suffix)
    if bare.lower() in _NONE or bare == tr(_NO_LIMIT):
        return _no_limit(title, key)
    try:
        value = evaluate_in(shown.suffix.strip(), bare) / shown.factor
    except ExpressionError as problem:
        return Typed(problem=tr("{title} stays as it was: {problem}", title=title, problem=problem))
    if text.strip() == edit_text(robot, joint, key, preferences):
        value = cell_value(robot, joint, key)  # an untouched text keeps every digit
    return Typed(value, _objection(robot, joint, key, value, shown))


def stepped(robot: Robot, joint: int, key: DHKey, steps: float, preferences: Preferences) -> float | None:
    """The SI value some arrow-key steps further, or None where there is no number to step from."""
    value = cell_value(robot, joint, key)
    shown = display(cell_kind(robot, joint, key), preferences)
    # Rounded in the shown unit: 0.1 mm more is 250.1, not 250.10000000000002.
    return None if math.isinf(value) else round(value * shown.factor + steps * shown.step, 12) / shown.factor


def _moving_key(robot: Robot, joint: int) -> DHKey:
    return "theta" if robot.joints[joint].revolute else "d"


def _with_q(joint: int, value: float, text: str) -> str:
    q = f"q{subscript(joint + 1)}"
    if value == 0.0:
        return q
    return f"{q} \u2212 {text[1:]}" if text.startswith("\u2212") else f"{q} + {text}"


def _no_limit(title: str, key: DHKey) -> Typed:
    if key in _LIMITS:
        return Typed(_LIMITS[key])
    return Typed(problem=tr("{title} must be a number: only a limit can be none.", title=title))


def _objection(robot: Robot, joint: int, key: DHKey, value: float, shown: Display) -> str:
    """Why a number cannot stand in this cell, or nothing."""
    row, title = robot.joints[joint], cell_title(robot, joint, key)

    def text(number: float) -> str:
        return (
            tr(_NO_LIMIT) if math.isinf(number) else format_number(number * shown.factor, shown.decimals) + shown.suffix
        )

    if abs(value) > _LARGEST:
        return tr(
            "{title} stays as it was: {number} is too large for an arm.",
            title=title,
            number=f"{value * shown.factor:g}{shown.suffix}",
        )
    if key == "lower" and value >= row.upper:
        return tr(
            "{title} must lie below the upper limit, {upper}; {number} does not.",
            title=title,
            upper=text(row.upper),
            number=text(value),
        )
    if key == "upper" and value <= row.lower:
        return tr(
            "{title} must lie above the lower limit, {lower}; {number} does not.",
            title=title,
            lower=text(row.lower),
            number=text(value),
        )
    if key == "home" and not row.lower <= value <= row.upper:
        return tr(
            "{title} must lie within the limits, {lower} … {upper}; {number} does not.",
            title=title,
            lower=text(row.lower),
            upper=text(row.upper),
            number=text(value),
        )
    return ""
