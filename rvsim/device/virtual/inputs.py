"""The inputs of an SSC-32: pins with a pull-up, debounced and latched, or voltages in 256 steps of 5 V.

Potentiometer taps: the voltage of a servo's own potentiometer grows with the pulse at which the servo would stand
there, 0 V at 500 µs and 5 V at 2500 µs. So whoever knows the servos' calibration knows the joints.
"""

from __future__ import annotations

import random
from collections.abc import Sequence

from rvsim.device.virtual.clock import NANO
from rvsim.device.virtual.faults import ANALOG_PAUSE
from rvsim.robot.servo import LONGEST_US, SHORTEST_US

DIGITAL, ANALOG = 6, 8
DEBOUNCE = 15_000_000  # [ns]
FULL_VOLTS = 5.0


def potentiometer_volts(pulse_us: float) -> float:
    """The tap's voltage where a servo stands that this pulse [µs] would hold."""
    return FULL_VOLTS * (pulse_us - SHORTEST_US) / (LONGEST_US - SHORTEST_US)


def potentiometer_pulse(volts: float) -> float:
    """The pulse [µs] that would hold the servo whose tap has this voltage."""
    return SHORTEST_US + volts / FULL_VOLTS * (LONGEST_US - SHORTEST_US)


class DigitalInputs:
    """Six pins, high unless something pulls them down."""

    def __init__(self) -> None:
        self._levels = [True] * DIGITAL
        self._accepted = [True] * DIGITAL
        self._since = [0] * DIGITAL
        self._latched = [False] * DIGITAL

    def set(self, pin: int, high: bool, now: int) -> None:
        """From now [ns] on; what is shorter than 15 ms is never seen."""
        if high != self._levels[pin]:
            self._accepted[pin] = self._seen(pin, now)
            self._latched[pin] |= not self._accepted[pin]
            self._levels[pin], self._since[pin] = high, now

    def read(self, pin: int, latched: bool, now: int) -> bool:
        """The level; latched: False also if it was low at any time since this was asked last."""
        high = self._seen(pin, now)
        if not latched:
            return high
        was_low, self._latched[pin] = self._latched[pin], False
        return high and not was_low

    def _seen(self, pin: int, now: int) -> bool:
        return self._levels[pin] if now - self._since[pin] >= DEBOUNCE else self._accepted[pin]


class AnalogInputs:
    """Eight pins; one that becomes analog, at its first reading, answers nothing valid."""

    def __init__(self, dice: random.Random) -> None:
        self._dice = dice
        self._read_at: dict[int, int] = {}

    def read(self, pin: int, volts: Sequence[float], now: int, forgetful: bool) -> float:
        """The voltage; `forgetful`: a pin that was not read for a while answers nothing valid either."""
        before = self._read_at.get(pin)
        self._read_at[pin] = now
        if before is None or (forgetful and now - before > ANALOG_PAUSE * NANO):
            return self._dice.uniform(0.0, FULL_VOLTS)
        return volts[pin] if pin < len(volts) else 0.0
