"""What sentences about an arm on a wire have in common: names of its axes, and a capital at the beginning."""

from __future__ import annotations

from collections.abc import Iterable

from rvsim.language import tr
from rvsim.robot import Robot

ISOLATES = "\u2066\u2067\u2068"  # in front of a value in a text that is written from right to left


def axis_name(robot: Robot, axis: int) -> str:
    """The name of a joint (from 0), or of the gripper, which comes after them."""
    return tr(robot.joint_names[axis] if axis < robot.dof else "gripper")


def axis_names(robot: Robot) -> tuple[str, ...]:
    """(n + 1,) the joints' names, and the gripper's."""
    return tuple(axis_name(robot, axis) for axis in range(robot.dof + 1))


def in_a_row(texts: Iterable[str]) -> str:
    """Texts with commas between them."""
    return tr(", ").join(texts)


def one_after_another(texts: Iterable[str]) -> str:
    """Texts with semicolons between them."""
    return tr("; ").join(texts)


def with_capital(text: str) -> str:
    """A text that begins a sentence, with a capital; languages without capitals know none."""
    start = len(text) - len(text.lstrip(ISOLATES))
    return f"{text[:start]}{text[start : start + 1].upper()}{text[start + 1 :]}"
