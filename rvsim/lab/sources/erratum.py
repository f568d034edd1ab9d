"""What an erratum is: a formula as a source prints it, the right one, and both worked out at a pose of the arm."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import NO_TOOL

Topic = Literal["frames", "inverse", "jacobian", "singularity", "path", "dynamics", "time law"]
TOPICS: tuple[Topic, ...] = get_args(Topic)
Kind = Literal["number", "angle", "length", "lever", "rate", "acceleration", "torque"]
Quantity = Literal[
    "number",
    "angle",
    "length",
    "lever",
    "rate",
    "acceleration",
    "torque",
    "transform",
    "jacobian",
    "position jacobian",
]
Evaluate = Callable[[Robot, FloatArray], ArrayLike]

# Entries that are nearer than this are the same [rad, m, 1].
_SAME = 1e-9
_TABLES = {
    "transform": np.array([["number"] * 3 + ["length"]] * 3 + [["number"] * 4]),
    "jacobian": np.array([["lever"]] * 3 + [["number"]] * 3),
    "position jacobian": np.array([["lever"]] * 3),
}


@dataclass(frozen=True, eq=False)
class Erratum:
    r"""One place where a source does not print what is right.

    Args:
        key: the stable id, for instance "000-22".
        source, where: "000" and for instance "(22)": an equation, a program, a figure of the source.
        robot: the name of the arm.
        topic: what it is about.
        title: what is wrong, in a few words.
        printed_latex, right_latex: the formulas, a line each, with their left sides.
        why: one sentence.
        pose: q (n,) [rad, m] where it shows: the text's own example, or one like it.
        quantity: what the values are; it gives every entry its unit.
        printed, right: (robot, q) to the value (scalar, vector or matrix) [rad, m, s, N]: the formula as printed, and
            ours by the library. NaN where the printed formula has no value. None for a remark without numbers.
        rows, columns: names of the entries.
        tool: (robot, q) to T (4, 4), where the source puts the tool; None where it does not say.
        undefined: what it means when the printed formula has no value.
    """

    key: str
    source: str
    where: str
    robot: str
    topic: Topic
    title: str
    printed_latex: tuple[str, ...]
    right_latex: tuple[str, ...]
    why: str
    pose: tuple[float, ...]
    quantity: Quantity = "number"
    printed: Evaluate | None = None
    right: Evaluate | None = None
    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    tool: Evaluate | None = None
    undefined: str = tr_later("The printed formula has no value here.")

    def compare(self, robot: Robot, q: ArrayLike) -> Comparison | None:
        """Both formulas at q (n,), the arm without a tool as in the sources; None for a remark without numbers."""
        if self.printed is None or self.right is None:
            return None
        bare, pose = as_in_source(robot), np.asarray(q, dtype=np.float64)
        printed, right = (np.asarray(form(bare, pose), dtype=np.float64) for form in (self.printed, self.right))
        return Comparison(printed, right, entry_kinds(self.quantity, right.shape))

    def printed_tool(self, robot: Robot, q: ArrayLike) -> FloatArray | None:
        """T (4, 4) where the printed formula puts the tool; None where it says nothing or has no value."""
        if self.tool is None:
            return None
        T = np.asarray(self.tool(as_in_source(robot), np.asarray(q, dtype=np.float64)), dtype=np.float64)
        return T if np.isfinite(T).all() else None


@dataclass(frozen=True, eq=False)
class Comparison:
    """What is printed and what is right at one pose: values of the same shape, (), (k,) or (m, k), and their kinds."""

    printed: FloatArray
    right: FloatArray
    kinds: NDArray[np.str_]

    @property
    def difference(self) -> FloatArray:
        """Printed − right; angles within ±π, NaN where the printed one has no value."""
        gap = np.asarray(self.printed - self.right)
        turns = np.asarray(np.remainder(gap + np.pi, 2.0 * np.pi) - np.pi)
        return np.asarray(np.where((self.kinds == "angle") & (np.abs(gap) > np.pi), turns, gap))

    @property
    def differs(self) -> NDArray[np.bool_]:
        """Which entries are not the same; one without a value is not."""
        return np.asarray(~(np.abs(self.difference) <= _SAME))

    @property
    def agree(self) -> bool:
        """Whether the printed formula happens to be right at this pose."""
        return not self.differs.any()


def entry_kinds(quantity: Quantity, shape: tuple[int, ...]) -> NDArray[np.str_]:
    """The kind of every entry of a value of that shape."""
    if quantity not in _TABLES:
        return np.full(shape, quantity)
    table = _TABLES[quantity]
    return np.broadcast_to(table if len(shape) == 2 else table[:, 0], shape)


@lru_cache(maxsize=16)
def as_in_source(robot: Robot) -> Robot:
    """The arm as the sources have it: nothing bolted to its flange; only source 003's arm stands beside the origin."""
    if robot.tool_name == NO_TOOL.name and np.array_equal(robot.T_flange_tool, np.eye(4)):
        return robot
    return replace(robot, tools=(NO_TOOL,), tool_name=NO_TOOL.name)
