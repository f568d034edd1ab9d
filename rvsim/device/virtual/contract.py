"""What the virtual arm asks of a controller board, whichever language it speaks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rvsim.device.virtual.faults import Faults
from rvsim.robot.arrays import FloatArray

Language = Literal["ssc32", "bridge"]
ChannelState = Literal["unknown", "limp", "holding", "moving"]
BoolArray: TypeAlias = NDArray[np.bool_]
Measure: TypeAlias = Callable[[], FloatArray]  # where the joints really are now, (n,) [rad]


class Board(Protocol):
    """A board: bytes in, pulses and bytes out. It has its own time, which only `process` advances.

    The arm calls `process` up to the present before it writes, and at every servo frame (20 ms) while it is `busy`.
    """

    faults: Faults  # the arm sets it; a board minds those that are its own (a stuck "moving", for instance)

    def write(self, data: bytes) -> None:
        """Bytes arrive at the board's present time."""
        ...

    def process(self, dt: float) -> None:
        """So much time passes [s]: process(a) and process(b) are process(a + b)."""
        ...

    def read(self) -> bytes:
        """What it has answered since the last call; how long the wire takes is the arm's business."""
        ...

    def power_cycle(self) -> None:
        """Off and on: positions are forgotten, what is kept without power takes effect."""
        ...

    @property
    def pulses(self) -> FloatArray:
        """(32,) the pulses on the servos' pins [µs]; NaN where there is none."""
        ...

    @property
    def powered(self) -> BoolArray:
        """(32,) where a servo gets pulses, and so holds."""
        ...

    @property
    def channels(self) -> tuple[ChannelState, ...]:
        """(32) what each channel is doing."""
        ...

    @property
    def moving(self) -> bool:
        """Whether a move is under way."""
        ...

    @property
    def busy(self) -> bool:
        """Whether anything changes by itself; where it is False nobody needs to call `process` until bytes arrive."""
        ...
