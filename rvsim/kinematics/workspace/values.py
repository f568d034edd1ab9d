"""What is asked about a workspace, and what comes out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.workspace.grid import BoolArray, Grid
from rvsim.robot import Robot
from rvsim.robot.arrays import frozen_array
from rvsim.spatial.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class WorkspaceTask:
    """What is asked: an arm at q (n,), which tells the sections' place and the orientation that may be kept.

    Args:
        fixed: keep the tool's orientation as it is at q (a 5R arm: pitch and roll).
        branches: count the branches of every pose too, which takes longer.
        poses: how many are sampled where the tool is free; where it is fixed, the cells are asked one by one.
        ignore_limits: let every turning joint make a whole turn.
        seed: the same seed gives the same result.
    """

    robot: Robot
    q: FloatArray
    fixed: bool = False
    branches: bool = False
    poses: int = 1_000_000
    ignore_limits: bool = False
    seed: int = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "q", frozen_array("q", self.q, (self.robot.dof,)))

    @property
    def counts(self) -> bool:
        """Whether branches are counted: with a fixed orientation they come by themselves."""
        return self.fixed or self.branches


@dataclass(frozen=True, eq=False)
class SectionMap:
    """A flat map: the place of (u, v) is origin + u · axis_u + v · axis_v [m].

    Args:
        manipulability, branches: (columns, rows) the largest at each cell, NaN where the tool does not come; branches
            None where they were not counted.
        outline: (k, 2, 2) line pieces (u, v) where the workspace ends; `exact`: they are curves of the arm's geometry.
        projected: all poses seen from the side, not a section.
    """

    grid: Grid
    origin: FloatArray
    axis_u: FloatArray
    axis_v: FloatArray
    manipulability: FloatArray
    branches: FloatArray | None
    outline: FloatArray
    exact: bool
    projected: bool = False

    @property
    def reached(self) -> BoolArray:
        """(columns, rows) where the tool comes."""
        return ~np.isnan(self.manipulability)

    def place(self, points: ArrayLike) -> FloatArray:
        """(..., 3) in base axes of points (..., 2) of the map [m]."""
        uv = np.asarray(points, dtype=np.float64)
        return np.asarray(self.origin + uv[..., :1] * self.axis_u + uv[..., 1:] * self.axis_v)

    def flat(self, places: ArrayLike) -> FloatArray:
        """(..., 2) where places (..., 3) lie in the map, seen square to it [m]."""
        away = np.asarray(places, dtype=np.float64) - self.origin
        return np.stack([away @ self.axis_u, away @ self.axis_v], axis=-1)


@dataclass(frozen=True, eq=False)
class Workspace:
    """What came out: the side section, the top section, and a cloud (m, 3) with manipulability and branches (m,)."""

    task: WorkspaceTask
    side: SectionMap
    top: SectionMap
    cloud: FloatArray
    cloud_manipulability: FloatArray
    cloud_branches: FloatArray | None
