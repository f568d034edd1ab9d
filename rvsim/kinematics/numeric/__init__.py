"""Numeric inverse kinematics: joints found by iteration, for every arm, and the reason where none are found."""

from rvsim.kinematics.numeric.batch import BatchResult, solve_numeric_batch

__all__ = ["BatchResult", "solve_numeric_batch"]
