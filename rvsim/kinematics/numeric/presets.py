"""The settings of the sources."""

from __future__ import annotations

import math
from typing import NamedTuple

from rvsim.kinematics.numeric.options import Solver, SolverOptions, Task
from rvsim.language import tr_later


class Preset(NamedTuple):
    """Settings by name.

    Args:
        title: for the screen.
        citation: where they come from, and what is worth knowing.
        solver, task, options: as `solve_numeric` takes them.
        guess: (n,) where to start [rad], None for the arm's home.
        warm_start: whether each point of a path starts from the solution of the one before.
    """

    title: str
    citation: str
    solver: Solver
    task: Task
    options: SolverOptions
    guess: tuple[float, ...] | None
    warm_start: bool


AS_IN_SOURCE_000 = Preset(
    tr_later("As in source 000"),
    tr_later(
        "Source 000, Program 8: weights 0.1 0.1 0.1 1.2 1.2 1, the orientation first, and a solution tolerance of "
        "0.01. Its lengths are decimetres, so 0.01 allows up to 0.1 rad and 1 mm."
    ),
    "lm",
    "pose",
    SolverOptions(
        max_iterations=1500,
        solution_tolerance=0.01,
        weights=(0.1, 0.1, 0.1, 1.2, 1.2, 1.0),
        length=0.1,
        position_tolerance=1e-3,
        rotation_tolerance=0.1,
    ),
    None,
    True,
)

# The source turns degrees into radians by 0.0175.
_GUESS_002 = tuple(0.0175 * degrees for degrees in (15, 20, 25, 10, 15, 12))
AS_IN_SOURCE_002 = Preset(
    tr_later("As in source 002"),
    tr_later(
        "Source 002, code 2: the pseudoinverse, position only, 300 iterations, 1 mm, no limits and no restarts. The "
        "guess is 15 20 25 10 15 12 degrees, times 0.0175."
    ),
    "newton",
    "position",
    SolverOptions(
        max_iterations=300,
        solution_tolerance=1e-3,
        position_tolerance=1e-3,
        enforce_joint_limits=False,
        allow_random_restarts=False,
        step_limit=math.inf,
    ),
    _GUESS_002,
    True,
)
