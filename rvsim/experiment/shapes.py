"""The shapes a student can draw, as values: what each is made of in metres and radians, and where it is put."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from rvsim.robot.arrays import FloatArray, frozen_array

Join = Literal["lines", "natural", "not-a-knot", "closed", "none"]


@dataclass(frozen=True)
class CircleShape:
    """Once around."""

    radius: float
    samples: int = 73


@dataclass(frozen=True)
class ArcShape:
    """Part of a circle, from the angle `begin` on by `sweep` [rad]."""

    radius: float
    begin: float = 0.0
    sweep: float = np.pi
    samples: int = 51


@dataclass(frozen=True, eq=False)
class ArcThroughShape:
    """The arc from the first over the second to the third of points (3, 3) [m], base axes."""

    points: FloatArray
    samples: int = 51

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_array("arc points", self.points, (3, 3)))


@dataclass(frozen=True)
class EllipseShape:
    """With semi-axes a and b [m]."""

    a: float
    b: float
    samples: int = 101


@dataclass(frozen=True)
class PolygonShape:
    """Regular, its corners on a circle of that radius [m]."""

    radius: float
    corners: int = 6
    samples: int = 121


@dataclass(frozen=True)
class StarShape:
    """Five-pointed, in one stroke, its tips on a circle of that radius [m]."""

    radius: float
    samples: int = 101


@dataclass(frozen=True)
class TextShape:
    """Single-stroke letters: capitals `height` high, points at most `spacing` apart, the pen lifted by `lift` [m]."""

    height: float
    text: str = "RV"
    lift: float = 0.02
    spacing: float = 0.005


@dataclass(frozen=True)
class FormulaStage:
    """From where the stage before ended until `end` [s] in `samples` points: x, y and z as formulas of t."""

    end: float
    samples: int
    x: str
    y: str
    z: str


@dataclass(frozen=True)
class FormulaShape:
    """Formulas in stages from `begin` [s] on; their numbers are `unit` metres each."""

    stages: tuple[FormulaStage, ...]
    begin: float = 0.0
    unit: float = 1e-3


@dataclass(frozen=True, eq=False)
class PointsShape:
    """A table of points (k, 3) [m], base axes, and how they are joined; "none" is the points alone."""

    points: FloatArray
    join: Join = "lines"
    samples: int = 101

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_array("points", self.points, (-1, 3)))


Shape = (
    CircleShape
    | ArcShape
    | ArcThroughShape
    | EllipseShape
    | PolygonShape
    | StarShape
    | TextShape
    | FormulaShape
    | PointsShape
)

# What each kind is called in an experiment and on the command line.
SHAPE_KINDS: dict[str, type[Shape]] = {
    "circle": CircleShape,
    "arc": ArcShape,
    "arc-through": ArcThroughShape,
    "ellipse-shape": EllipseShape,
    "polygon": PolygonShape,
    "star": StarShape,
    "text": TextShape,
    "formulas": FormulaShape,
    "points": PointsShape,
}


@dataclass(frozen=True, eq=False)
class Placement:
    """Where a path's middle lies (3,) [m], how it is turned (roll, pitch, yaw) [rad], and how many times as large."""

    center: FloatArray
    rpy: FloatArray
    scale: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", frozen_array("placement center", self.center, (3,)))
        object.__setattr__(self, "rpy", frozen_array("placement rpy", self.rpy, (3,)))
