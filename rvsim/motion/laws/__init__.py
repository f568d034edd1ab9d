"""Time laws between joint poses: each gives a `PiecewisePolynomial`, joints over time with their derivatives."""

from rvsim.motion.laws.jerk_limited import Limits, jerk_limited
from rvsim.motion.laws.piecewise import Moments, PiecewisePolynomial, joined
from rvsim.motion.laws.polynomial import cubic, quintic_between
from rvsim.motion.laws.quickest import quickest_along
from rvsim.motion.laws.shortest import shortest_time
from rvsim.motion.laws.trapezoid import trapezoid
from rvsim.motion.laws.via_points import SplineEnds, spline_through

__all__ = [
    "Limits",
    "Moments",
    "PiecewisePolynomial",
    "SplineEnds",
    "cubic",
    "jerk_limited",
    "joined",
    "quickest_along",
    "quintic_between",
    "shortest_time",
    "spline_through",
    "trapezoid",
]
