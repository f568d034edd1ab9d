"""The quintic: rest to rest, and its derivatives are derivatives."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from rvsim.motion.time_law import (
    QUINTIC_PEAK_ACCELERATION,
    QUINTIC_PEAK_SPEED,
    quintic,
    quintic_acceleration,
    quintic_speed,
)

TAU = np.linspace(0.0, 1.0, 2001)


def test_it_agrees_with_the_oracle_of_source_004() -> None:
    oracle = json.loads((Path(__file__).parents[1] / "oracles" / "oracle.json").read_text())
    t, q, qd, qdd = np.array(oracle["trajectories"]["al5b_quintic"]["samples"]).T
    assert np.allclose(40.0 * quintic(t / 2.0), q, atol=1e-12)
    assert np.allclose(20.0 * quintic_speed(t / 2.0), qd, atol=1e-12)
    assert np.allclose(10.0 * quintic_acceleration(t / 2.0), qdd, atol=1e-12)


def test_it_rests_at_both_ends_and_beyond() -> None:
    assert quintic([-1.0, 0.0, 1.0, 7.0]).tolist() == [0.0, 0.0, 1.0, 1.0]
    for rate in (quintic_speed, quintic_acceleration):
        assert rate([-1.0, 0.0, 1.0, 7.0]).tolist() == [0.0, 0.0, 0.0, 0.0]


def test_speed_and_acceleration_are_its_derivatives_and_have_the_stated_peaks() -> None:
    inner = TAU[1:-1]
    assert np.allclose((quintic(inner + 1e-6) - quintic(inner - 1e-6)) / 2e-6, quintic_speed(inner), atol=1e-8)
    slope = (quintic_speed(inner + 1e-6) - quintic_speed(inner - 1e-6)) / 2e-6
    assert np.allclose(slope, quintic_acceleration(inner), atol=1e-7)
    assert np.isclose(quintic_speed(TAU).max(), QUINTIC_PEAK_SPEED)
    assert np.isclose(quintic_acceleration(TAU).max(), QUINTIC_PEAK_ACCELERATION, rtol=1e-5)
