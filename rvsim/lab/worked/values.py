"""What a worked solution is: equations in steps, steps along paths of choices, paths that end in branches."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from rvsim.kinematics.inverse import Branch, branch_title
from rvsim.spatial.arrays import FloatArray

Path = tuple[str, ...]


class Equation(NamedTuple):
    """One line of arithmetic in LaTeX's mathematics: left side, formula, the formula with numbers, the result.

    A part that would only repeat another is empty. `value` is the result [rad, m, 1].
    """

    left: str
    formula: str
    substituted: str
    result: str
    value: float = 0.0


@dataclass(frozen=True)
class Step:
    """One step of the closed form.

    Args:
        title, text: what is done, and why, in plain words.
        equations: what is computed, line by line.
        path: the choices made before this step; a step with an empty path belongs to every branch.
        leads_to: the paths this step opens: two where a sign is free, one or none else.
        failure: why there is no solution from here on, "" where there is one.
        source_note: where a source prints this step wrongly: its value for these numbers, and ours.
    """

    title: str
    text: str
    equations: tuple[Equation, ...]
    path: Path = ()
    leads_to: tuple[Path, ...] = ()
    failure: str = ""
    source_note: str = ""

    @property
    def formula_latex(self) -> str:
        """The formulas, one line an equation."""
        return " \\\\ ".join(f"{e.left} = {e.formula}" for e in self.equations if e.formula)

    @property
    def substituted_latex(self) -> str:
        """The same with numbers."""
        return " \\\\ ".join(f"{e.left} = {e.substituted}" for e in self.equations if e.substituted)

    @property
    def values(self) -> tuple[float, ...]:
        """The results [rad, m, 1], one an equation."""
        return tuple(equation.value for equation in self.equations)


@dataclass(frozen=True, eq=False)
class WorkedBranch:
    """One end of the tree: a solution, or the reason why the path ends without one.

    Args:
        path: the choices that lead here.
        q: (n,) the joints [rad, m], angles within [−π, π]; None at a dead end.
        reason: why there is no solution, or which limit it breaks; "" if neither.
        branch: the same solution with its verdict: limits, and the copy by whole turns that is within them. None at a
            dead end.
    """

    path: Path
    q: FloatArray | None
    reason: str = ""
    branch: Branch | None = None

    @property
    def label(self) -> str:
        """Its name, for instance "front, elbow up"."""
        return ", ".join(self.path)

    @property
    def title(self) -> str:
        """The same as the screen says it."""
        return branch_title(self.label)

    @property
    def within_limits(self) -> bool:
        """Whether the arm can take this pose."""
        return self.branch is not None and self.branch.within_limits


@dataclass(frozen=True, eq=False)
class WorkedSolution:
    """The whole tree, in the order in which one would write it down."""

    title: str
    steps: tuple[Step, ...]
    branches: tuple[WorkedBranch, ...]

    def along(self, path: Path) -> tuple[Step, ...]:
        """The steps that lead to one end of the tree."""
        return tuple(step for step in self.steps if step.path == path[: len(step.path)])

    @property
    def solutions(self) -> tuple[WorkedBranch, ...]:
        """The ends that are solutions."""
        return tuple(branch for branch in self.branches if branch.q is not None)
