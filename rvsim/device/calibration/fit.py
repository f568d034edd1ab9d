"""The line of a servo through marks or samples: direction, pulse at zero, µs per degree."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr
from rvsim.robot import Servo
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import LONGEST_US, SHORTEST_US

LEAST_TRAVEL_US = 20.0  # between the shortest and the longest pulse of what is fitted
PLAUSIBLE_US_PER_DEGREE = (5.0, 20.0)
_CROOKED = math.radians(2.0)  # a sample so far off the line is told
SWEEP = 9  # samples


@dataclass(frozen=True)
class Objection:
    """Why something cannot be taken as it is, and what would help; a sentence or two."""

    sentence: str

    def __str__(self) -> str:
        return self.sentence


@dataclass(frozen=True)
class Fit:
    """A fitted servo, and how far q is off its line [rad, m]: root mean square, and at worst."""

    servo: Servo
    rms: float
    worst: float


def fit_from_samples(servo: Servo, pulses_us: Sequence[float], q: Sequence[float], source: str = "") -> Fit | Objection:
    """The servo whose line lies nearest to samples: at pulses (k,) [µs] the joint was measured at q (k,) [rad, m].

    Least squares in q, since pulses are exact and measurements are not. Where weight makes the arm sag, add
    `sag.sag_of` to q first. The channel is that of `servo`, and so are the angles that its pulses may reach.

    Args:
        source: what the new servo says of where its numbers come from.
    """
    pulses, angles = np.asarray(pulses_us, dtype=np.float64), np.asarray(q, dtype=np.float64)
    wrong = _wrong_samples(pulses, angles)
    if wrong:
        return Objection(wrong)
    per_us, at_zero_us = _line(pulses, angles)
    if per_us == 0.0:
        return Objection(tr("The joint stands at the same angle at all these pulses: it did not move. Is it powered?"))
    fitted = with_line(servo, -at_zero_us / per_us, 1.0 / per_us, source)
    if isinstance(fitted, Objection):
        return fitted
    off = np.abs(at_zero_us + per_us * pulses - angles)
    return Fit(fitted, float(np.sqrt(np.mean(off**2))), float(off.max()))


def sweep_pulses(servo: Servo, count: int = SWEEP) -> tuple[float, ...]:
    """Whole pulses [µs] to be visited one after the other, a tenth of the servo's range away from its ends."""
    margin = 0.1 * (servo.max_us - servo.min_us)
    return tuple(np.round(np.linspace(servo.min_us + margin, servo.max_us - margin, count)).tolist())


def with_line(servo: Servo, zero_us: float, gain: float, source: str) -> Servo | Objection:
    """A copy with another pulse at q = 0 [µs] and signed gain [µs/rad, µs/m], that may reach the same angles."""
    ends = sorted(min(max(zero_us + gain * q, SHORTEST_US), LONGEST_US) for q in servo.limits)
    sign = 1 if gain > 0.0 else -1
    try:
        return replace(
            servo,
            sign=sign,
            zero_us=zero_us,
            us_per_rad=abs(gain),
            min_us=ends[0],
            max_us=ends[1],
            assumed=False,
            source=source,
        )
    except RobotDefinitionError:
        return Objection(
            tr("No pulse of the controller would bring the joint between its limits. Mark its poses again.")
        )


def remarks_on(servo: Servo, name: str, revolute: bool, worst: float = 0.0) -> tuple[str, ...]:
    """What is odd about a fitted servo, sentences.

    Args:
        worst: how far a sample is off its line [rad, m].
    """
    remarks = []
    per_degree = math.radians(servo.us_per_rad)
    least, most = PLAUSIBLE_US_PER_DEGREE
    if revolute and not least <= per_degree <= most:
        remarks.append(
            tr(
                "The {joint} would have {per_degree:.1f} µs/°; hobby servos have {least:g} to {most:g}. "
                "Mark its poses again.",
                joint=tr(name),
                per_degree=per_degree,
                least=least,
                most=most,
            )
        )
    if revolute and worst > _CROOKED:
        remarks.append(
            tr(
                "The {joint}'s samples lie up to {worst:.1f}° off a line. Was it held up, or at its end?",
                joint=tr(name),
                worst=math.degrees(worst),
            )
        )
    return tuple(remarks)


def _line(pulses: FloatArray, q: FloatArray) -> tuple[float, float]:
    """Slope and value at 0 µs of the line of least squares."""
    middle, height = pulses.mean(), q.mean()
    slope = float(np.dot(pulses - middle, q - height) / np.dot(pulses - middle, pulses - middle))
    return slope, float(height - slope * middle)


def _wrong_samples(pulses: FloatArray, q: FloatArray) -> str:
    if pulses.ndim != 1 or pulses.shape != q.shape or len(pulses) < 2:
        return tr("A line needs two samples at least, each with its pulse and its angle.")
    if not (np.isfinite(pulses).all() and np.isfinite(q).all()):
        return tr("Some sample is no number: nothing was measured there.")
    if pulses.min() < SHORTEST_US or pulses.max() > LONGEST_US:
        return tr("Pulses go from {shortest:g} to {longest:g} µs.", shortest=SHORTEST_US, longest=LONGEST_US)
    if pulses.max() - pulses.min() < LEAST_TRAVEL_US:
        return tr(
            "The pulses are nearly the same ({least:g} and {most:g} µs): the joint must move between its marks.",
            least=pulses.min(),
            most=pulses.max(),
        )
    return ""
