"""The solid look of an arm: capsules and boxes fixed to its links. To draw it and to keep it clear of the table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray, frozen_array


@dataclass(frozen=True, eq=False)
class CapsuleShape:
    """A cylinder with round ends, fixed to a link.

    Args:
        frame: the link it moves with: 0 the base, i the link behind joint i (its DH frame i), dof + 1 the tool frame.
        start, end: (3,) ends of its axis in that frame [m].
        radius: [m].
        color: "#rrggbb", or "" for the colour of the joint that moves it.
        finger: whether it is part of a finger and moves with the arm's `Gripper`.
    """

    frame: int
    start: FloatArray
    end: FloatArray
    radius: float
    color: str = ""
    finger: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", frozen_array("capsule start", self.start, (3,)))
        object.__setattr__(self, "end", frozen_array("capsule end", self.end, (3,)))


@dataclass(frozen=True, eq=False)
class BoxShape:
    """A box fixed to a link, its edges along the link's axes.

    Args:
        frame: the link it moves with, as in `CapsuleShape`.
        center: (3,) [m].
        size: (3,) full edge lengths [m].
        color, finger: as in `CapsuleShape`.
    """

    frame: int
    center: FloatArray
    size: FloatArray
    color: str = ""
    finger: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", frozen_array("box center", self.center, (3,)))
        object.__setattr__(self, "size", frozen_array("box size", self.size, (3,)))
        if not np.all(self.size > 0.0):
            raise RobotDefinitionError("box", tr("every edge of a box must be longer than 0."))


Shape = CapsuleShape | BoxShape
