"""Colours can be told from their background."""

from __future__ import annotations

import pytest

from rvsim.scene import Color
from rvsim.scene.palette import DARK, LIGHT, ScenePalette, axis_colors, contrast, mixed

MEANING = ("text", "muted_text", "trail", "desired", "actual", "unreached", "limit")


def test_contrast_is_that_of_the_standard() -> None:
    black, white, grey = Color(0, 0, 0), Color(1, 1, 1), Color.from_hex("#767676")
    assert contrast(black, white) == pytest.approx(21.0)
    assert contrast(grey, white) == pytest.approx(4.54, abs=0.005)  # the grey that WCAG itself gives as just enough


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_what_carries_meaning_has_a_contrast_of_four_and_a_half(palette: ScenePalette) -> None:
    faint = [name for name in MEANING if contrast(getattr(palette, name), palette.background) < 4.5]
    assert faint == []
    assert min(contrast(color, palette.background) for color in axis_colors(palette.background)) >= 4.0


def test_a_mixture_lies_between() -> None:
    assert mixed(Color(0, 0, 0, 0.5), Color(1, 1, 1), 0.25) == Color(0.25, 0.25, 0.25, 0.5)
