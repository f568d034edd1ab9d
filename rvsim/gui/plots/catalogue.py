"""What can be plotted of a motion: each entry makes its curves, its unit and its limits from `Curves`."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, joint_kind, length_kind
from rvsim.language import tr, tr_later
from rvsim.playback.curves import Curves
from rvsim.robot.arrays import FloatArray

_AXIS_COLORS = ("#D55E00", "#009E73", "#0072B2")
_TOOL_COLOR, _OFF_COLOR = "#0072B2", "#B5179E"
NEAR_SINGULAR = 0.02  # σ below it is marked
_TORQUE, _DEVIATION = tr_later("Torque"), tr_later("Deviation")


class Line(NamedTuple):
    """One curve in shown units: its name, "#rrggbb", values (m,), whether it is dashed, and its name in short."""

    name: str
    color: str
    values: FloatArray
    dashed: bool = False
    sign: str = ""


class Band(NamedTuple):
    """What a curve of this colour must stay within, in shown units; infinite where there is no limit."""

    color: str
    low: float
    high: float


@dataclass(frozen=True, eq=False)
class Drawing:
    """One plot: title, said when it is shown, unit, curves, and limits; `empty` says why there are none."""

    title: str
    unit: str
    lines: tuple[Line, ...] = ()
    bands: tuple[Band, ...] = ()
    empty: str = ""


class PlotKind(NamedTuple):
    """An entry of the catalogue: its name, its sign on the button, what it shows, and what draws it."""

    name: str
    sign: str
    tip: str
    draw: Callable[[Curves, Preferences], Drawing]


def _joint_lines(curves: Curves, values: FloatArray, factors: list[float]) -> tuple[Line, ...]:
    return tuple(
        Line(f"J{i + 1} {tr(joint.name)}", joint.color, values[:, i] * factors[i], sign=f"J{i + 1}")
        for i, joint in enumerate(curves.robot.joints)
    )


def _per_joint(curves: Curves, preferences: Preferences) -> tuple[list[float], str]:
    """The factor of each joint, and the unit of the axis: both, where the arm turns and slides."""
    shown = [display(joint_kind(curves.robot, i), preferences) for i in range(curves.robot.dof)]
    return [each.factor for each in shown], ", ".join(dict.fromkeys(each.suffix.strip() for each in shown))


def _over(unit: str, below: str) -> str:
    return ", ".join(f"{part}{below}" for part in unit.split(", "))


def _joints(curves: Curves, preferences: Preferences) -> Drawing:
    factors, unit = _per_joint(curves, preferences)
    bands = tuple(
        Band(joint.color, joint.lower * factor, joint.upper * factor)
        for joint, factor in zip(curves.robot.joints, factors, strict=True)
    )
    return Drawing(tr_later("Joints q"), unit, _joint_lines(curves, curves.q, factors), bands)


def _rates(title: str, order: str, below: str, limit: str = "") -> Callable[[Curves, Preferences], Drawing]:
    def draw(curves: Curves, preferences: Preferences) -> Drawing:
        factors, unit = _per_joint(curves, preferences)
        bands = []
        for joint, factor in zip(curves.robot.joints, factors, strict=True):
            known = getattr(joint, limit) if limit else None
            most = math.inf if known is None else known.value * factor
            bands.append(Band(joint.color, -most, most))
        return Drawing(title, _over(unit, below), _joint_lines(curves, getattr(curves, order), factors), tuple(bands))

    return draw


def _place(curves: Curves, preferences: Preferences) -> Drawing:
    shown = display(length_kind(curves.robot), preferences)
    found = [
        Line(axis, color, curves.place[:, i] * shown.factor)
        for i, (axis, color) in enumerate(zip("xyz", _AXIS_COLORS, strict=True))
    ]
    if curves.desired is not None:
        found += [
            Line(tr("{axis} wanted", axis=axis), color, curves.desired[:, i] * shown.factor, dashed=True)
            for i, (axis, color) in enumerate(zip("xyz", _AXIS_COLORS, strict=True))
        ]
    return Drawing(tr_later("Tool position"), shown.suffix.strip(), tuple(found))


def _speed(curves: Curves, preferences: Preferences) -> Drawing:
    shown = display(length_kind(curves.robot), preferences)
    return Drawing(
        tr_later("Tool speed"),
        f"{shown.suffix.strip()}/s",
        (Line(tr("speed"), _TOOL_COLOR, curves.speed * shown.factor),),
    )


def _torque(curves: Curves, _preferences: Preferences) -> Drawing:
    if curves.torque is None:
        why = tr("No mass data for the {arm}: enter it under Inspect › Dynamics.", arm=tr(curves.robot.title))
        return Drawing(_TORQUE, "N m", empty=why)
    unit = "N m" if curves.robot.is_revolute.all() else "N m, N"
    bands = []
    for joint in curves.robot.joints:
        most = math.inf if joint.max_torque is None else joint.max_torque.value
        bands.append(Band(joint.color, -most, most))
    return Drawing(_TORQUE, unit, _joint_lines(curves, curves.torque, [1.0] * curves.robot.dof), tuple(bands))


def _sigma(curves: Curves, _preferences: Preferences) -> Drawing:
    line = Line("σ min", _TOOL_COLOR, curves.sigma_min, sign="σ")
    return Drawing(tr_later("Smallest σ of J"), "", (line,), (Band("#D55E00", NEAR_SINGULAR, math.inf),))


def _deviation(curves: Curves, preferences: Preferences) -> Drawing:
    offset, deviation = curves.offset, curves.deviation
    if offset is None or deviation is None:
        return Drawing(_DEVIATION, "", empty=tr("No path: track a line or a trajectory first."))
    kind: Kind = length_kind(curves.robot)
    shown = display(kind, preferences)
    unit, factor = shown.suffix.strip(), shown.factor
    largest = float(np.nanmax(deviation)) if np.isfinite(deviation).any() else 0.0
    if kind == "length" and largest * shown.factor < 0.01:
        unit, factor = "µm", 1e6
    axes = (Line(f"Δ{axis}", _AXIS_COLORS[i], offset[:, i] * factor) for i, axis in enumerate("xyz"))
    return Drawing(_DEVIATION, unit, (Line(tr("deviation"), _OFF_COLOR, deviation * factor), *axes))


PLOTS: tuple[PlotKind, ...] = (
    PlotKind("q", "q", tr_later("Joints over time, between their limits"), _joints),
    PlotKind("qd", "q′", tr_later("Speeds of the joints"), _rates(tr_later("Joint speeds"), "qd", "/s", "max_speed")),
    PlotKind(
        "qdd",
        "q″",
        tr_later("Accelerations"),
        _rates(tr_later("Joint accelerations"), "qdd", "/s²", "max_acceleration"),
    ),
    PlotKind("jerk", "q‴", tr_later("Jerks of the joints"), _rates(tr_later("Joint jerks"), "jerk", "/s³")),
    PlotKind("tool", tr_later("Tool"), tr_later("Where the tool is, and where the path wants it"), _place),
    PlotKind("speed", tr_later("Speed"), tr_later("How fast the tool goes"), _speed),
    PlotKind("torque", "τ", tr_later("Torques: what the joints must give"), _torque),
    PlotKind("sigma", "σ", tr_later("Smallest singular value: how near to a singularity"), _sigma),
    PlotKind("deviation", tr_later("Off path"), tr_later("Deviation: how far the tool is from the path"), _deviation),
)
