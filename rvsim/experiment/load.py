"""The value `Load`: what the arm is asked to hold, for every page that shows forces."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray, frozen_array

WrenchAxes = Literal["base", "tool"]


@dataclass(frozen=True, eq=False)
class Load:
    """A wrench (6,) [N, N m] that the tool exerts at its origin, and a payload [kg] that hangs there.

    Args:
        wrench: force, then moment, in `axes`.
        axes: of the base, or of the tool: then the wrench turns with it.
        payload: its mass.
        own_weight: whether the arm's own weight is counted with them.

    Raises:
        ShapeError: the wrench has not 6 numbers.
        SettingError: a number is not finite, the payload is negative.
    """

    wrench: FloatArray = field(default_factory=lambda: np.zeros(6))
    axes: WrenchAxes = "base"
    payload: float = 0.0
    own_weight: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "wrench", frozen_array("wrench", self.wrench, (6,)))
        if not np.isfinite(self.wrench).all():
            raise SettingError("wrench", self.wrench.tolist(), tr("finite"))
        if not 0.0 <= self.payload < math.inf:
            raise SettingError("payload", self.payload, tr("finite and 0 or more"))

    def with_wrench(self, first: int, values: FloatArray) -> Load:
        """With other numbers from `first` on: 0 the force, 3 the moment."""
        wrench = np.array(self.wrench)
        wrench[first : first + len(values)] = values
        return replace(self, wrench=wrench)

    def in_base(self, R_base_tool: FloatArray) -> FloatArray:
        """(6,) the wrench in base axes."""
        return self.wrench if self.axes == "base" else _turned(R_base_tool, self.wrench)

    def in_axes(self, axes: WrenchAxes, R_base_tool: FloatArray) -> Load:
        """The same wrench, written in these axes."""
        if axes == self.axes:
            return self
        return replace(self, axes=axes, wrench=_turned(R_base_tool.T if axes == "tool" else R_base_tool, self.wrench))


def _turned(R: FloatArray, wrench: FloatArray) -> FloatArray:
    return np.concatenate([R @ wrench[:3], R @ wrench[3:]])


NO_LOAD = Load()
