"""What one iteration of any solver gives."""

from __future__ import annotations

from typing import NamedTuple

from rvsim.kinematics.numeric.problem import Evaluation
from rvsim.spatial.arrays import FloatArray


class Step(NamedTuple):
    """Where it led, the motion (n,) of the joints [rad, m], and the damping λ of the system (0 where there is none)."""

    there: Evaluation
    motion: FloatArray
    damping: float
