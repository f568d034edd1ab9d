"""The colours of a scene, light and dark. Joints bring their own (Okabe and Ito); these are all the others."""

from __future__ import annotations

from dataclasses import dataclass

from rvsim.scene.primitives import Color


@dataclass(frozen=True)
class ScenePalette:
    """One look. Texts and lines that carry meaning have a contrast of at least 4.5 : 1 to the background."""

    background: Color
    floor: Color  # the plate that the grid lies on
    floor_minor: Color
    floor_major: Color
    floor_axis: Color  # the two lines through the base
    shadow: Color
    text: Color
    muted_text: Color
    stick: Color  # base column, rails: what no joint moves
    body: Color  # the solid look's shells
    body_dark: Color  # the solid look's housings and base
    trail: Color
    desired: Color
    actual: Color
    unreached: Color
    gripper: Color
    ghost: Color
    limit: Color


def _hex(text: str, alpha: float = 1.0) -> Color:
    return Color.from_hex(text, alpha)


LIGHT = ScenePalette(
    background=_hex("#F6F8FB"),
    floor=_hex("#ECF0F5"),
    floor_minor=_hex("#DFE5ED"),
    floor_major=_hex("#C8D1DD"),
    floor_axis=_hex("#9AA7B8"),
    shadow=_hex("#22324A", 0.24),
    text=_hex("#1D2733"),
    muted_text=_hex("#566373"),
    stick=_hex("#4A5665"),
    body=_hex("#E6EAEF"),
    body_dark=_hex("#7A8695"),
    trail=_hex("#B5179E"),
    desired=_hex("#2F55D4"),
    actual=_hex("#B5179E"),
    unreached=_hex("#B54708"),
    gripper=_hex("#2CA02C"),
    ghost=_hex("#64748B"),
    limit=_hex("#C1272D"),
)

DARK = ScenePalette(
    background=_hex("#161B22"),
    floor=_hex("#1B222B"),
    floor_minor=_hex("#232C37"),
    floor_major=_hex("#364252"),
    floor_axis=_hex("#5A6A7F"),
    shadow=_hex("#000000", 0.5),
    text=_hex("#E8EDF3"),
    muted_text=_hex("#9AA8B8"),
    stick=_hex("#A9B5C3"),
    body=_hex("#C9D1DB"),
    body_dark=_hex("#5C6876"),
    trail=_hex("#FF7AD9"),
    desired=_hex("#86A8FF"),
    actual=_hex("#FF7AD9"),
    unreached=_hex("#FFA94D"),
    gripper=_hex("#4CC764"),
    ghost=_hex("#94A3B8"),
    limit=_hex("#FF7B72"),
)

_AXES_ON_LIGHT = (_hex("#D0312D"), _hex("#2B8A3E"), _hex("#1C5FD4"))
_AXES_ON_DARK = (_hex("#FF6B6B"), _hex("#62D97B"), _hex("#6EA8FF"))


def axis_colors(background: Color) -> tuple[Color, Color, Color]:
    """Red x, green y, blue z, each readable on this background."""
    return _AXES_ON_LIGHT if luminance(background) > 0.5 else _AXES_ON_DARK


def luminance(color: Color) -> float:
    """The relative luminance 0…1 of an opaque sRGB colour (WCAG 2.2)."""
    weights = (0.2126, 0.7152, 0.0722)
    return sum(weight * _linear(channel) for weight, channel in zip(weights, color[:3], strict=True))


def contrast(one: Color, other: Color) -> float:
    """The contrast 1…21 of two opaque colours (WCAG 2.2)."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def mixed(one: Color, other: Color, share: float) -> Color:
    """`share` of the other colour in the one; the alpha stays that of the one."""
    red, green, blue = (a + share * (b - a) for a, b in zip(one[:3], other[:3], strict=True))
    return Color(red, green, blue, one.alpha)


def _linear(channel: float) -> float:
    return channel / 12.92 if channel <= 0.04045 else float(((channel + 0.055) / 1.055) ** 2.4)
