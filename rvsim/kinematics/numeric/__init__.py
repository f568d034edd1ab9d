"""Numeric inverse kinematics: joints found by iteration, for every arm, and the reason where none are found."""

from rvsim.kinematics.numeric.batch import BatchResult, solve_numeric_batch
from rvsim.kinematics.numeric.options import SOLVERS, TASKS, Solver, SolverOptions, Task
from rvsim.kinematics.numeric.presets import AS_IN_SOURCE_000, AS_IN_SOURCE_002, Preset
from rvsim.kinematics.numeric.result import History, NumericResult
from rvsim.kinematics.numeric.solve import solve_numeric

__all__ = [
    "AS_IN_SOURCE_000",
    "AS_IN_SOURCE_002",
    "SOLVERS",
    "TASKS",
    "BatchResult",
    "History",
    "NumericResult",
    "Preset",
    "Solver",
    "SolverOptions",
    "Task",
    "solve_numeric",
    "solve_numeric_batch",
]
