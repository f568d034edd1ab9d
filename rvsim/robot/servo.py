"""How a joint hangs on a hobby servo: channel, direction, pulse at q = 0, µs per radian, and the pulses it may get."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr

SHORTEST_US, LONGEST_US = 500.0, 2500.0
CHANNELS = 32


@dataclass(frozen=True)
class Servo:
    """One joint's servo: pulse = zero_us + sign · us_per_rad · q, between min_us and max_us.

    Args:
        channel: of the controller, 0…31.
        sign: +1 where a longer pulse means a larger q, −1 where it means a smaller one.
        zero_us: the pulse at q = 0 [µs]; the servo need not reach it.
        us_per_rad: [µs/rad], positive.
        min_us, max_us: the pulses that the servo may get [µs].
        assumed, source: where the numbers come from; a calibrated servo says so here.

    Raises:
        RobotDefinitionError: the values make no servo.
    """

    channel: int
    sign: int
    zero_us: float
    us_per_rad: float
    min_us: float = SHORTEST_US
    max_us: float = LONGEST_US
    assumed: bool = False
    source: str = ""

    def __post_init__(self) -> None:
        _check_channel(self.channel)
        _check_pulses(self.channel, self.min_us, self.max_us)
        if self.min_us >= self.max_us:
            raise RobotDefinitionError(_where(self.channel), tr("its shortest pulse must lie below its longest one."))
        if self.sign not in (-1, 1):
            raise RobotDefinitionError(_where(self.channel), tr("the sign is {sign}; it is 1 or -1.", sign=self.sign))
        if not (math.isfinite(self.zero_us) and math.isfinite(self.us_per_rad) and self.us_per_rad > 0.0):
            raise RobotDefinitionError(_where(self.channel), tr("the pulse at zero must be finite and µs/° above 0."))

    @property
    def gain(self) -> float:
        """Signed µs/rad."""
        return self.sign * self.us_per_rad

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the largest q that its pulses allow [rad]."""
        ends = ((self.min_us - self.zero_us) / self.gain, (self.max_us - self.zero_us) / self.gain)
        return min(ends), max(ends)


@dataclass(frozen=True)
class GripperServo:
    """The gripper's servo: the pulses at which it is open and closed [µs]. Either may be the longer one.

    Raises:
        RobotDefinitionError: the values make no servo.
    """

    channel: int
    open_us: float
    closed_us: float
    assumed: bool = False
    source: str = ""

    def __post_init__(self) -> None:
        _check_channel(self.channel)
        _check_pulses(self.channel, self.open_us, self.closed_us)
        if self.open_us == self.closed_us:
            raise RobotDefinitionError(_where(self.channel), tr("open and closed need different pulses."))

    def pulse(self, opening: float) -> float:
        """The pulse [µs] for an opening, 0 closed … 1 open; clamped."""
        return self.closed_us + min(max(opening, 0.0), 1.0) * (self.open_us - self.closed_us)

    def opening(self, pulse_us: float) -> float:
        """The opening, 0 closed … 1 open, at a pulse [µs]; clamped."""
        return min(max((pulse_us - self.closed_us) / (self.open_us - self.closed_us), 0.0), 1.0)


def _where(channel: int) -> str:
    return tr("servo on channel {channel}", channel=channel)


def _check_channel(channel: int) -> None:
    if not 0 <= channel < CHANNELS:
        raise RobotDefinitionError(_where(channel), tr("the controller's channels are 0 to {last}.", last=CHANNELS - 1))


def _check_pulses(channel: int, *pulses_us: float) -> None:
    for pulse in pulses_us:
        if not SHORTEST_US <= pulse <= LONGEST_US:
            what = tr(
                "a pulse of {pulse:g} µs; the controller's go from {shortest:g} to {longest:g} µs.",
                pulse=pulse,
                shortest=SHORTEST_US,
                longest=LONGEST_US,
            )
            raise RobotDefinitionError(_where(channel), what)
