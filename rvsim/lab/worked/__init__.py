"""Inverse kinematics worked out by hand: the closed form of an arm, step by step, with one target's numbers."""

from rvsim.lab.worked.latex import worked_latex
from rvsim.lab.worked.solution import worked_solution
from rvsim.lab.worked.values import Equation, Step, WorkedBranch, WorkedSolution

__all__ = ["Equation", "Step", "WorkedBranch", "WorkedSolution", "worked_latex", "worked_solution"]
