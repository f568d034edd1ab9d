"""What every family of closed forms offers, and how its conditions are asked of an arm."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import ClassVar

from rvsim.kinematics.inverse.chain import TOLERANCE, Chain
from rvsim.language import tr
from rvsim.spatial.arrays import FloatArray

Condition = tuple[bool, str]


class ClosedForm(ABC):
    """The closed form of one arm. A subclass is a family.

    `solve` works on structures of arrays: S (3, 4, m) holds, entry by entry, the poses of the last frame in frame 0,
    or those of the tool where only its place counts (`place_only`). `labels` names each branch in the field's words.
    """

    title: ClassVar[str]
    joints: ClassVar[str]
    task: ClassVar[str] = "pose"
    place_only: ClassVar[bool] = False
    labels: tuple[str, ...]

    def __init__(self, chain: Chain) -> None:
        self.chain = chain

    @classmethod
    @abstractmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """What must hold, each with the sentence that says so; asked only of arms with the family's joint types."""

    @abstractmethod
    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """Variables of the normal form (branches, n, m), NaN where a branch does not exist.

        Where a joint is free (a continuum of solutions) it takes its value in `free` (n,).
        """

    def reaches(self, place: FloatArray) -> bool | None:  # noqa: ARG002 (a family may not know)
        """Whether the tool can be at a place (3,) of frame 0 somehow, limits aside; None: not known here."""
        return None

    @classmethod
    def failure(cls, chain: Chain) -> str:
        """The first condition the arm breaks, or ""."""
        return next((sentence for holds, sentence in cls.conditions(chain) if not holds), "")


def is_zero(value: float) -> bool:
    """Whether a length or an angle of a DH table counts as zero."""
    return abs(value) <= TOLERANCE


def right_angle(chain: Chain, i: int) -> Condition:
    """Axes i and i + 1 (from 0) at a right angle."""
    return chain.square(i), tr("axes {first} and {second} must be at a right angle.", first=i + 1, second=i + 2)


def parallel(chain: Chain, i: int) -> Condition:
    """Axes i and i + 1 (from 0) parallel."""
    return chain.parallel(i), tr("axes {first} and {second} must be parallel.", first=i + 1, second=i + 2)


def intersecting(chain: Chain, i: int) -> Condition:
    """No distance a between axes i and i + 1 (from 0)."""
    return is_zero(chain.a[i]), tr(
        "axes {first} and {second} must meet: no length a between them.", first=i + 1, second=i + 2
    )


def long_enough(chain: Chain, i: int) -> Condition:
    """A link i (from 0) of some length."""
    return not is_zero(chain.a[i]), tr(
        "the link between axes {first} and {second} must have a length a.", first=i + 1, second=i + 2
    )
