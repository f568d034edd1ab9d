"""The value `Experiment`: all that a student has set up for one arm. Edits are functions from one state to the next."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.experiment.load import NO_LOAD, Load
from rvsim.experiment.notes import NO_NOTES, Notes
from rvsim.experiment.program import Program
from rvsim.experiment.shapes import Placement, Shape
from rvsim.motion.trajectory import Law
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

PathOrientation = Literal["down", "free", "keep", "source", "turn", "normal", "pitch"]


class NamedPose(NamedTuple):
    """A joint pose worth remembering: q (n,) [rad, m]."""

    name: str
    q: FloatArray


class LimitViolation(NamedTuple):
    """One joint outside its limits: the joint's index, its value and the limit it passes [rad, m]."""

    joint: int
    value: float
    limit: float


@dataclass(frozen=True, eq=False)
class LineTask:
    """The line to track: `start` and `end` (3,) [m], the step as a fraction of the line (source 000's "resolution")."""

    start: FloatArray
    end: FloatArray
    resolution: float = 0.1
    orientation: PathOrientation = "down"

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", frozen_array("line start", self.start, (3,)))
        object.__setattr__(self, "end", frozen_array("line end", self.end, (3,)))

    @property
    def samples(self) -> int:
        """The number of points: as in source 000's Program 7, `0 : resolution : 1`."""
        return int(np.floor(1.0 / self.resolution + 1e-9)) + 1


@dataclass(frozen=True, eq=False)
class TrajectoryTask:
    """The path to track: a named one, for instance "letter-board", or a shape, and the tool's orientation along it.

    Args:
        name: of a path that has one, or a kind of `SHAPE_KINDS`.
        height: [m], for the paths whose source gives no height.
        shape: what is drawn, None for what fits the arm.
        placement: where, None for where its source or the shape has it.
        turn_from, turn_to: (3,) roll, pitch, yaw [rad] at the path's ends where the tool turns evenly along it; None
            for the tool's present orientation.
        pitch: of the tool axis above the horizontal [rad], where that is held.
    """

    name: str = "letter-board"
    orientation: PathOrientation = "source"
    height: float = 0.3
    shape: Shape | None = None
    placement: Placement | None = None
    turn_from: tuple[float, float, float] | None = None
    turn_to: tuple[float, float, float] | None = None
    pitch: float = -np.pi / 2


@dataclass(frozen=True, eq=False)
class Experiment:
    """One arm, its present pose q (n,) [rad, m], and what is to be done with it.

    `target` (4, 4) is the tool pose that was wanted where the arm could not follow; None is the tool's own. `law` and
    `path_seconds` say how paths are travelled: None is a calm pace, 0 as quick as the joints may; `ease` slows a path
    down only where a joint needs it, not as a whole. `load` is what the tool pulls at and carries. `typed` (n,) are
    joint values that were typed but not drawn yet, None where there are none. `notes` are about all of it.
    """

    robot: Robot
    q: FloatArray
    line: LineTask
    trajectory: TrajectoryTask = field(default_factory=TrajectoryTask)
    ignore_limits: bool = False
    poses: tuple[NamedPose, ...] = ()
    target: FloatArray | None = None
    law: Law = "quintic"
    path_seconds: float | None = None
    program: Program = ()
    load: Load = NO_LOAD
    ease: bool = False
    typed: FloatArray | None = None
    notes: Notes = NO_NOTES

    def __post_init__(self) -> None:
        object.__setattr__(self, "q", frozen_array("q", self.q, (self.robot.dof,)))
        if self.typed is not None:
            object.__setattr__(self, "typed", frozen_array("typed", self.typed, (self.robot.dof,)))
        if self.target is not None:
            object.__setattr__(self, "target", frozen_array("target", self.target, (4, 4)))

    def at(self, q: ArrayLike) -> Experiment:
        """In another pose. The pose is taken as it is: ask `limit_violations` first."""
        return replace(self, q=np.asarray(q, dtype=np.float64), typed=None)

    def with_typed(self, typed: ArrayLike | None) -> Experiment:
        """With joint values that are to be drawn later."""
        return replace(self, typed=None if typed is None else np.asarray(typed, dtype=np.float64))

    def with_notes(self, notes: Notes) -> Experiment:
        """With something else written beside it."""
        return replace(self, notes=notes)

    def with_robot(self, robot: Robot) -> Experiment:
        """With an edited arm of the same joints; the pose stays."""
        return replace(self, robot=robot)

    def with_load(self, load: Load) -> Experiment:
        """With something else to hold."""
        return replace(self, load=load)

    def with_pose(self, name: str) -> Experiment:
        """The present pose remembered under a name; an older pose of that name is replaced."""
        others = tuple(pose for pose in self.poses if pose.name != name)
        return replace(self, poses=(*others, NamedPose(name, self.q)))

    def without_pose(self, name: str) -> Experiment:
        """That name forgotten."""
        return replace(self, poses=tuple(pose for pose in self.poses if pose.name != name))


def limit_violations(robot: Robot, q: ArrayLike, tolerance: float = 1e-9) -> tuple[LimitViolation, ...]:
    """The joints of q (n,) that lie outside their limits, first joint first."""
    values: NDArray[np.float64] = np.asarray(q, dtype=np.float64)
    found = []
    for index, (value, (lower, upper)) in enumerate(zip(values, robot.limits, strict=True)):
        if value < lower - tolerance:
            found.append(LimitViolation(index, float(value), float(lower)))
        elif value > upper + tolerance:
            found.append(LimitViolation(index, float(value), float(upper)))
    return tuple(found)


def random_pose(robot: Robot, seed: int) -> FloatArray:
    """A pose (n,) drawn evenly from the limits.

    A joint without limits turns within ±π or slides within the arm's size.
    """
    generator = np.random.default_rng(seed)
    spans = np.where(robot.is_revolute, np.pi, robot.size)
    lower = np.where(np.isfinite(robot.limits[:, 0]), robot.limits[:, 0], -spans)
    upper = np.where(np.isfinite(robot.limits[:, 1]), robot.limits[:, 1], spans)
    return np.asarray(generator.uniform(lower, upper))
