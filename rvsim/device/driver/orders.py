"""Moves that one line tells: wake, go there, grip, jog, switch off. Each is timed when it is sent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rvsim.motion.trajectory import speeds
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

CALM = 0.5  # of the joints' speeds, where no time is asked for, and while streaming
LONGEST = 60.0  # [s]; the time of an SSC-32's move has 16 bits of ms
_SHORTEST_CALM = 0.4  # [s]
_SHORTEST = 0.02  # [s] one frame of a servo
_WAKING = 1.0  # [s] at least, where the board knows a position and so could be slow
_GRIPS = 2.0  # openings a second


@dataclass(frozen=True, eq=False)
class Order:
    """Axes to raw numbers (m,), NaN for those left alone; or one axis to be switched off.

    Args:
        seconds: as asked for; None: calmly.
        wake: this is a first move.
        limp: the axis that is switched off.
    """

    raw: FloatArray
    seconds: float | None = None
    wake: bool = False
    limp: int | None = None


class Paces:
    """How quick each of m axes may be.

    Args:
        robot: its joints' speeds count.
        axes: m; an axis beyond the joints is a gripper.
    """

    def __init__(self, robot: Robot, axes: int) -> None:
        self.fastest = np.append(speeds(robot), np.full(axes - robot.dof, _GRIPS))
        self.calm = CALM * self.fastest

    def seconds(self, ways: FloatArray, order: Order) -> float:
        """How long ways (m,) take, |Δ| in values: as asked for, never quicker than the axes may; NaN is no way."""
        shortest = float(np.max(np.nan_to_num(ways) / self.fastest))
        calm = max(_WAKING if order.wake else _SHORTEST_CALM, shortest / CALM)
        wanted = calm if order.seconds is None or order.wake else max(order.seconds, shortest, _SHORTEST)
        return min(wanted, LONGEST)
