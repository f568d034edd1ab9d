"""What the driver needs of a language. Axes have values: q [rad, m] of a joint; the gripper's opening comes last.

"Raw" is what goes over the wire: pulses [µs] for the SSC-32, the values themselves for the encoder bridge. The driver
believes in raw numbers, so that another calibration changes what they mean and not where the arm is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from rvsim.device.driver.state import MeasuredKind
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


@dataclass(frozen=True)
class Named:
    """The board says what it is."""

    text: str


@dataclass(frozen=True, eq=False)
class Reported:
    """(m,) where the board says it sends each axis, raw; NaN where it sends nothing."""

    raw: FloatArray


@dataclass(frozen=True, eq=False)
class Measured:
    """(m,) where sensors say each axis is (values); NaN where there is no sensor."""

    values: FloatArray
    kind: MeasuredKind


@dataclass(frozen=True)
class Noticed:
    """The board tells of something that a person should know; a sentence, or "" when it is over."""

    sentence: str


@dataclass(frozen=True)
class Latched:
    """The board itself has latched a stop."""

    sentence: str


@dataclass(frozen=True)
class Unfit:
    """The board cannot drive this arm."""

    sentence: str


Event: TypeAlias = Named | Reported | Measured | Noticed | Latched | Unfit


class ArmLanguage(Protocol):
    """A codec with a memory of what it has asked. m axes: the joints, and the gripper where the board has one."""

    title: str
    named_answers: bool  # whether an answer tells what it answers; else the line must be silent before a question
    gentle: bool  # whether an axis that wakes begins where its sensor says it is; else it jumps

    @property
    def axes(self) -> int:
        """m."""
        ...

    @property
    def limits(self) -> FloatArray:
        """(m, 2) the least and the largest value of each axis."""
        ...

    @property
    def set_point_bytes(self) -> int:
        """How long a line for all joints is."""
        ...

    @property
    def question_bytes(self) -> int:
        """How long a question is."""
        ...

    @property
    def tolerance(self) -> FloatArray:
        """(m,) how far, raw, what the board reports may be from what it was told."""
        ...

    def raw(self, values: FloatArray) -> FloatArray:
        """(m,) raw numbers as the wire carries them (rounded, within limits); NaN stays."""
        ...

    def values(self, raw: FloatArray) -> FloatArray:
        """(m,) values of raw numbers."""
        ...

    def use(self, robot: Robot) -> bool:
        """Another calibration; whether the axes are still the same, on the same channels."""
        ...

    def jogged(self, channel: int, pulse_us: float, /) -> tuple[int, float] | str:
        """The axis of a channel and its raw number at a pulse, or why there is none."""
        ...

    def set_points(self, raw: FloatArray, seconds: float) -> bytes:
        """Axes to raw numbers (m,) together; those with NaN are left alone."""
        ...

    def wake(self, raw: FloatArray, seconds: float) -> bytes:
        """The first move of the axes that are not NaN."""
        ...

    def limp(self, axis: int) -> bytes:
        """Switch an axis off."""
        ...

    def stop(self, awake: Sequence[bool], /) -> tuple[bytes, ...]:
        """The emergency stop: what is most urgent first; the rest follows when the wire is free."""
        ...

    def clear(self) -> bytes:
        """Leave a stop that the board has latched; may be empty."""
        ...

    def hello(self) -> bytes:
        """Ask what the board is."""
        ...

    def poll(self) -> bytes:
        """Ask where the axes are."""
        ...

    def lines(self, data: bytes) -> tuple[bytes, ...]:
        """What was said, cut into what one would say at a time."""
        ...

    @property
    def pending(self) -> bool:
        """Whether an answer is owed."""
        ...

    def forget(self) -> None:
        """Wait no longer for answers."""
        ...

    def feed(self, data: bytes) -> tuple[Event, ...]:
        """What the board says."""
        ...
