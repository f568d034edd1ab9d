"""Where a solution is written down: steps, dead ends and solved ends, in order."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from rvsim.lab.sentences import Units
from rvsim.lab.worked.errata import source_note
from rvsim.lab.worked.figures import Figures, Quantity, wrapped
from rvsim.lab.worked.rows import Rows
from rvsim.lab.worked.values import Equation, Path, Step, WorkedBranch
from rvsim.spatial.arrays import FloatArray

Equations = tuple[Equation, ...]


class Notebook:
    """Collects one solution.

    Args:
        rows: the DH rows it is written with.
        known: the branches by label, (n,) each: where a joint is free, the solution takes the value they have.
        near: (n,) what a free joint is where no branch tells.
        units: what angles and lengths are written in.
    """

    def __init__(self, rows: Rows, known: Mapping[str, FloatArray], near: FloatArray, units: Units) -> None:
        self.rows, self.figures = rows, Figures(rows.robot, units)
        self._known, self._near = known, near
        self.steps: list[Step] = []
        self.ends: list[WorkedBranch] = []

    def step(
        self,
        path: Path,
        title: str,
        text: str,
        *equations: Equation,
        choices: tuple[str, ...] = (),
        failure: str = "",
        erratum: tuple[str, Mapping[str, float]] | None = None,
    ) -> None:
        """Write a step; `choices` are the paths it opens, a `failure` ends this one."""
        note = source_note(self.rows.robot.name, self.figures, *erratum) if erratum else ""
        leads_to = tuple((*path, choice) for choice in choices) if not failure else ()
        self.steps.append(Step(title, text, tuple(equations), path, leads_to, failure, note))
        if failure:
            self.ends.append(WorkedBranch(path, None, failure))

    def solved(self, path: Path, *values: float) -> None:
        """This path ends with these angles (lengths) of the rows."""
        joints = [self.rows.joint(i, value) for i, value in enumerate(values)]
        revolute = self.rows.robot.is_revolute
        q = np.array([wrapped(v) if turns else v for v, turns in zip(joints, revolute.tolist(), strict=True)])
        self.ends.append(WorkedBranch(path, q))

    def taken(self, path: Path, i: int) -> float:
        """The angle of row i (from 0) where it is free: that of the first known branch on this path."""
        label = ", ".join(path)
        for name, q in self._known.items():
            if name.startswith(label) and math.isfinite(q[i]):
                return self.rows.inner(i, float(q[i]))
        return self.rows.inner(i, float(self._near[i]))

    # --- quantities ------------------------------------------------------------------------------------------------

    def d(self, i: int) -> Quantity:
        """Length d of row i (from 0)."""
        return Quantity(self.rows.d_symbol(i), float(self.rows.d[i]))

    def a(self, i: int) -> Quantity:
        """Length a of row i (from 0)."""
        return Quantity(self.rows.a_symbol(i), float(self.rows.a[i]))

    def angle(self, i: int, value: float) -> Quantity:
        """The angle of row i (from 0)."""
        return Quantity(self.rows.symbol(i), value, "angle")

    def shorthand(self, i: int, value: float) -> tuple[Quantity, Quantity]:
        """The cosine and the sine of that angle as c and s with its number."""
        return Quantity(f"c_{i + 1}", math.cos(value), "number"), Quantity(f"s_{i + 1}", math.sin(value), "number")

    # --- equations -------------------------------------------------------------------------------------------------

    def joint(self, i: int, value: float, template: str, *quantities: Quantity, **named: Quantity) -> Equations:
        """An angle (length) of row i (from 0), and if that is not the joint variable itself, the joint variable."""
        inner = Quantity(self.rows.symbol(i), value, "angle" if self.rows.robot.joints[i].revolute else "length")
        found = self.figures.equation(inner, template, *quantities, **named)
        if self.rows.plain(i):
            return (found,)
        inner = inner._replace(value=found.value)
        offset = float(self.rows.offset[i])
        shift = Quantity(self.figures.constant(abs(offset), inner.kind), abs(offset), inner.kind)
        q = Quantity(f"q_{i + 1}", self.rows.joint(i, found.value), inner.kind)
        template = _CONVERSIONS[self.rows.sign[i] > 0.0, int(math.copysign(1.0, offset)) if offset else 0]
        return found, self.figures.equation(q, template, inner=inner, shift=shift)


_CONVERSIONS = {
    (True, 1): "<inner>-<shift>",
    (True, -1): "<inner>+<shift>",
    (True, 0): "<inner>",
    (False, 1): "<shift>-<inner>",
    (False, -1): "-<shift>-<inner>",
    (False, 0): "-<inner>",
}
