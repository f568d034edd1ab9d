"""What came of a numeric solution: the joints, the verdict in words, and the way there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from rvsim.language import tr, tr_later, trn
from rvsim.spatial.arrays import FloatArray

Kind = Literal["solved", "iterations", "time", "gradient", "step", "change", "progress"]

_WORDS: dict[Kind, str] = {
    "solved": tr_later("The target is reached within every tolerance."),
    "iterations": tr_later("All iterations are used up."),
    "time": tr_later("The time is used up."),
    "gradient": tr_later(
        "No small motion lowers the error any more: this is a local minimum, or as near as the arm can come."
    ),
    "step": tr_later(
        "The steps have become too small to move anything: the arm leans on its limits, or can come no nearer."
    ),
    "change": tr_later("The error no longer changes from one iteration to the next."),
    "progress": tr_later("The error has stopped falling: the iterates creep or go in circles."),
}
# These end the whole search, the others one try.
ENDING: tuple[Kind, ...] = ("solved", "iterations", "time")


class History(NamedTuple):
    """The try that gave the result, start first: q (k, n), errors (k,) [m], [rad], damping (k,) of the step to there.

    The last entry is the result: if the try failed and its best iterate was an earlier one, that one again.
    """

    q: FloatArray
    position_error: FloatArray
    rotation_error: FloatArray
    damping: FloatArray


@dataclass(frozen=True, eq=False)
class NumericResult:
    """The outcome of `solve_numeric`.

    Args:
        q: (n,) the solution [rad, m]; if there is none, the best iterate of all tries.
        converged: whether every tolerance of the task is kept, and the limits if enforced.
        kind: the rule that ended the search, "solved" if converged.
        reason: the same in words.
        iterations: of all tries together.
        restarts: how many tries began at a random start.
        position_error, rotation_error: of q [m], [rad], whatever the task.
        elapsed: seconds of the clock given.
        history: the iterates of the try that gave q.
    """

    q: FloatArray
    converged: bool
    kind: Kind
    reason: str
    iterations: int
    restarts: int
    position_error: float
    rotation_error: float
    elapsed: float
    history: History


def reason_in_words(kind: Kind, best: Kind, restarts: int) -> str:
    """The sentence for a search that ended by one rule, whose best try ended by another."""
    if kind == "solved" or not restarts:
        return tr(_WORDS[kind])
    parts = [
        tr(_WORDS[kind]),
        trn("{n} random restart found no solution.", "{n} random restarts found no solution.", restarts),
    ]
    if best != kind:
        parts.append(tr("The best try ended so: {reason}", reason=tr(_WORDS[best])))
    return " ".join(parts)
