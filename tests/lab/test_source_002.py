"""The algorithm as source 002 prints it believes in itself, and misses; corrected, it arrives."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.lab.source_002 import (
    Comparison,
    compare_source_002,
    corrected_recipe,
    iterate,
    printed_jacobian,
    printed_position,
)


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    return compare_source_002(load_robot("ur5e"))


def test_as_printed_the_real_arm_is_431_millimetres_away_from_the_ellipse(comparison: Comparison) -> None:
    assert len(comparison.printed.targets) == 184
    assert comparison.printed.rms == pytest.approx(431.0, abs=0.5)


def test_as_printed_it_believes_to_be_within_a_millimetre_on_each_axis(comparison: Comparison) -> None:
    printed = comparison.printed
    assert np.abs(printed.believed - printed.targets).max() <= 1.0
    assert max(printed.iterations) < 300


def test_corrected_it_misses_by_rounding_only(comparison: Comparison) -> None:
    assert comparison.corrected.rms < 1e-12
    assert max(comparison.corrected.iterations) < 300


def test_the_printed_place_differs_from_the_true_one_as_the_errata_say() -> None:
    q = np.radians([20.0, -70.0, 100.0, -50.0, 60.0, 35.0])
    true = corrected_recipe(load_robot("ur5e")).formulas.position(q)
    assert true == pytest.approx([-501.349, -377.327, 301.583], abs=1e-3)
    with_sine = printed_position(q) - [99.6 * np.cos(q[0]) * np.cos(q[1:4].sum()) * (np.sin(q[4]) - 1.0), 0.0, 0.0]
    with_term = with_sine - [0.0, 99.6 * np.sin(q[0]) * np.cos(q[1:4].sum()) * np.sin(q[4]), 0.0]
    with_signs = with_term - 2.0 * (425.0 * _in_plane(q[0], q[1]) + 392.2 * _in_plane(q[0], q[1] + q[2]))
    assert with_signs == pytest.approx(true, abs=1e-9)


def _in_plane(azimuth: float, elevation: float) -> np.ndarray:
    level = np.cos(elevation)
    return np.array([np.cos(azimuth) * level, np.sin(azimuth) * level, np.sin(elevation)])


def test_the_printed_jacobian_is_not_the_derivative_of_the_printed_place() -> None:
    q, step = np.radians([20.0, -70.0, 100.0, -50.0, 60.0, 35.0]), 1e-6
    columns = [(printed_position(q + e) - printed_position(q - e)) / (2.0 * step) for e in step * np.eye(6)]
    wrong = np.abs(np.array(columns).T - printed_jacobian(q)) > 1e-3
    assert wrong.any()
    assert not wrong[:, 5].any()


def test_the_iterates_of_one_point_begin_at_the_guess_and_end_at_the_point() -> None:
    recipe, guess = corrected_recipe(load_robot("ur5e")), np.full(6, 0.3)
    path = iterate(recipe, np.array([135.0, 100.0, 0.0]), guess)
    assert np.array_equal(path[0], guess)
    assert recipe.formulas.position(path[-1]) == pytest.approx([135.0, 100.0, 0.0], abs=1e-9)
