"""What came of an inverse problem: every branch with its verdict, or the reason why there is none that will do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from rvsim.errors import UnknownNameError
from rvsim.kinematics.inverse.explain import explain
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

FailureKind = Literal["reach", "orientation", "limits"]


@dataclass(frozen=True, eq=False)
class Branch:
    """One solution.

    Args:
        q: (n,) [rad, m]; if a copy q + 2πk is within the limits, the one nearest to where the arm is.
        label: its name in the field's words.
        within_limits: whether q is.
        limit_margin: (n,) how far each joint is from its nearer limit [rad, m], negative outside, inf without limits.
        residual: the largest entry of |FK − T|, of the entries the task asks for [1, m].
        manipulability: √det(JᵀJ), 0 at a singular pose.
        distance: the largest joint difference to where the arm is [rad, m].
        continuum: whether q is one of infinitely many: a joint may take any value here.
    """

    q: FloatArray
    label: str
    within_limits: bool
    limit_margin: FloatArray
    residual: float
    manipulability: float
    distance: float
    continuum: bool


class Nearest(NamedTuple):
    """The best the arm can do: joints (n,), the pose (4, 4) they give, and how far it is from the wanted one."""

    q: FloatArray
    T: FloatArray
    position_error: float
    rotation_error: float


@dataclass(frozen=True, eq=False)
class Failure:
    """Why there is no solution: data, of which `explain` makes a sentence. The nearest pose is looked for when asked.

    kind: "reach", the place cannot be reached; "orientation", the place can, but not in this orientation; "limits", the
    arm could, but a joint would leave its limits: then `joint` is its name, `value` what it needs and `limit` where it
    stops [rad, m], `branch` the one of `count` that breaks the limits least (else None and 0).
    """

    kind: FailureKind
    robot: Robot
    search: Callable[[], Nearest]
    joint: str | None = None
    value: float | None = None
    limit: float | None = None
    branch: Branch | None = None
    count: int = 0

    @cached_property
    def nearest(self) -> Nearest:
        """Least position error first, then least angle; within the limits if the kind is "limits"."""
        return self.search()

    @property
    def nearest_T(self) -> FloatArray:
        """(4, 4) the pose the arm can reach instead."""
        return self.nearest.T

    @property
    def nearest_q(self) -> FloatArray:
        """(n,) the joints for it [rad, m]."""
        return self.nearest.q

    @property
    def reason(self) -> str:
        """One sentence, with its numbers in degrees and millimetres."""
        return explain(self)


@dataclass(frozen=True, eq=False)
class InverseResult:
    """Every branch, best first; `failure` is None, or says why none of them will do."""

    branches: tuple[Branch, ...]
    failure: Failure | None

    @property
    def best(self) -> Branch | None:
        """The first branch, None if there is a failure."""
        return self.branches[0] if self.failure is None else None


# The rule that puts branches in order is a value: the criteria's names, the most important first.
DEFAULT_ORDER = ("within limits", "least motion", "largest margin")
_ROUNDING = 9  # decimals: differences below this are no reason to prefer a branch
ORDER_CRITERIA: dict[str, Callable[[Branch], float]] = {
    tr_later("within limits"): lambda branch: 0.0 if branch.within_limits else 1.0,
    tr_later("least motion"): lambda branch: round(branch.distance, _ROUNDING),
    tr_later("largest margin"): lambda branch: -round(float(branch.limit_margin.min()), _ROUNDING),
    tr_later("most manipulable"): lambda branch: -round(branch.manipulability, _ROUNDING),
}


def in_order(branches: Sequence[Branch], order: Sequence[str]) -> tuple[Branch, ...]:
    """The branches, best first by the criteria named.

    Raises:
        UnknownNameError: a name that is no criterion.
    """
    for name in order:
        if name not in ORDER_CRITERIA:
            raise UnknownNameError("order criterion", name, tuple(ORDER_CRITERIA))
    return tuple(sorted(branches, key=lambda branch: tuple(ORDER_CRITERIA[name](branch) for name in order)))
