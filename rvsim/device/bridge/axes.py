"""From q to the whole numbers of the encoder bridge and back. Axes are the joints, then a gripper with a servo."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.bridge.messages import LARGEST, MOST_AXES, Place
from rvsim.errors import RobotDefinitionError, ShapeError
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_PER_RADIAN, _PER_METRE, _PER_OPENING = 18000.0 / np.pi, 1e5, 1e4


def axis_names(robot: Robot) -> tuple[str, ...]:
    """(m,) the joints' names, and "gripper"."""
    return robot.joint_names + (() if robot.gripper_servo is None else ("gripper",))


def places_of(robot: Robot, values: ArrayLike) -> tuple[Place, ...]:
    """(m,) whole numbers for values (m,): q [rad, m], then the opening 0…1; NaN becomes None.

    Raises:
        ShapeError: not one value an axis.
        RobotDefinitionError: more axes than the protocol can tell apart.
    """
    scales = axis_scales(robot)
    array = np.asarray(values, dtype=np.float64)
    if array.shape != scales.shape:
        raise ShapeError("values", str(scales.shape), array.shape)
    return tuple(None if np.isnan(place) else _place(place) for place in array * scales)


def values_of(robot: Robot, places: Sequence[Place]) -> FloatArray:
    """(m,) values of places (m,): q [rad, m], then the opening; None becomes NaN.

    Raises:
        ShapeError: not one place an axis.
        RobotDefinitionError: more axes than the protocol can tell apart.
    """
    scales = axis_scales(robot)
    if len(places) != len(scales):
        raise ShapeError("places", str(scales.shape), (len(places),))
    return np.array([np.nan if place is None else place for place in places]) / scales


def axis_scales(robot: Robot) -> FloatArray:
    """(m,) how many hundredths of a degree, a millimetre, a percent are one rad, one metre, the whole opening.

    Raises:
        RobotDefinitionError: more axes than the protocol can tell apart.
    """
    scales = [_PER_RADIAN if joint.revolute else _PER_METRE for joint in robot.joints]
    scales += [] if robot.gripper_servo is None else [_PER_OPENING]
    if len(scales) > MOST_AXES:
        raise RobotDefinitionError(
            robot.name,
            tr("{count} axes; the encoder bridge knows {most} at most.", count=len(scales), most=MOST_AXES),
        )
    return np.array(scales)


def _place(place: float) -> int:
    return round(min(max(place, -LARGEST), LARGEST))
