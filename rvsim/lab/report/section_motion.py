"""The motion over time: joints with their speeds and accelerations, tool, deviation, nearness to a singularity."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rvsim.lab.report.chart import DASHES, Chart, Curve, Limit
from rvsim.lab.report.figures import Measure, Measures, number, scientific
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Figure, Paragraph, Section
from rvsim.language import left_to_right, tr, tr_later
from rvsim.playback.curves import Curves
from rvsim.robot.arrays import FloatArray
from rvsim.scene.palette import luminance
from rvsim.scene.primitives import Color

AXIS_COLORS = ("#D55E00", "#009E73", "#0072B2")  # Okabe and Ito
_TOOL_COLOR, _OFF_COLOR = "#0072B2", "#B5179E"
_OFF_WORDS = {
    True: tr_later(
        "How far the tool is from the straight pieces between the points of the path: at the points nothing but "
        "rounding, between them a little, for there the joints follow a spline."
    ),
    False: tr_later(
        "How far the tool is from the straight pieces between the points of the path: it passes by those that are "
        "out of reach."
    ),
}
_TIME = tr_later("time [s]")
_LIGHTEST = 0.4  # luminance of a curve on white
_LEAST_SHOWN = 0.01  # what is less needs powers of ten
# A level deviation of rounding is written in the unit that shows it.
_FINER = (("mm", 1e3), ("µm", 1e6), ("nm", 1e9), ("pm", 1e12), ("fm", 1e15))


def motion_section(study: Study, measures: Measures) -> Section:
    """The curves."""
    curves, trajectory = study.curves, study.trajectory
    assert curves is not None, "asked for only where a motion is loaded"
    assert trajectory is not None, "its curves are those of a trajectory"
    marks = (trajectory.path_start,) if 0.0 < trajectory.path_start < trajectory.duration else ()
    text = tr("The motion takes {seconds} s.", seconds=number(trajectory.duration, 2))
    if marks:
        begin = tr("The dashed line at {seconds} s is where the path begins.", seconds=number(marks[0], 2))
        text = f"{text} {begin}"
    return Section(tr("The motion over time"), (Paragraph(text), *_figures(curves, measures, marks)))


def _figures(curves: Curves, measures: Measures, marks: tuple[float, ...]) -> Iterator[Block]:
    captions = (
        tr("The joints over time; limits that are near are hatched."),
        tr("The speeds of the joints; limits that are near are hatched."),
        tr("The accelerations of the joints."),
    )
    for order, caption in enumerate(captions):
        yield Figure(caption, (_joint_chart(curves, measures, order, marks),))
    yield Figure(tr("Where the tool is, and where the path wants it (dashed)."), (_place(curves, measures, marks),))
    if curves.deviation is not None:
        yield Figure(
            tr(_OFF_WORDS[curves.tracking is None or curves.tracking.complete]),
            (_deviation(curves, measures, marks),),
        )
    yield Figure(
        tr("The smallest singular value of the Jacobian: at 0 the arm would be singular."), (_sigma(curves, marks),)
    )


def _joint_chart(curves: Curves, measures: Measures, order: int, marks: tuple[float, ...]) -> Chart:
    found = (curves.q, curves.qd, curves.qdd)[order]
    below = ("", "/s", "/s²")[order]
    shown = [measures.joint(index).per(below) for index in range(curves.robot.dof)]
    values = [found[:, i] * measure.factor for i, measure in enumerate(shown)]
    lines = tuple(
        Curve(f"J{i + 1} {tr(joint.name)}", paper_color(joint.color), curves.times, values[i], i % DASHES)
        for i, joint in enumerate(curves.robot.joints)
    )
    unit = ", ".join(dict.fromkeys(each.unit for each in shown))
    title = (tr("Joints q"), tr("Joint speeds q̇"), tr("Joint accelerations q̈"))[order]
    limits = _limits(curves, order, shown) if order < 2 else ()
    return Chart(title, tr(_TIME), f"[{unit}]", lines, limits, marks, 132.0)


def paper_color(color: str) -> str:
    """Darker where it would be too light on white, as the yellow of the palette is."""
    found = Color.from_hex(color)
    share = min(1.0, _LIGHTEST / max(luminance(found), 1e-6)) ** 0.5
    return "#" + "".join(f"{round(255 * share * channel):02X}" for channel in found[:3])


def _limits(curves: Curves, order: int, shown: list[Measure]) -> tuple[Limit, ...]:
    found = []
    for joint, measure in zip(curves.robot.joints, shown, strict=True):
        top = joint.max_speed.value if joint.max_speed else math.inf
        bounds = (joint.lower, joint.upper) if order == 0 else (-top, top)
        for side, bound in zip((-1, 1), bounds, strict=True):
            if math.isfinite(bound):
                found.append(Limit(bound * measure.factor, paper_color(joint.color), side))
    return tuple(found)


def _place(curves: Curves, measures: Measures, marks: tuple[float, ...]) -> Chart:
    length = measures.length
    lines = [_axis_curve(i, "xyz"[i], curves.times, curves.place[:, i] * length.factor) for i in range(3)]
    if curves.desired is not None:
        wanted = [tr("{axis} wanted", axis=axis) for axis in "xyz"]
        lines += [_axis_curve(i, wanted[i], curves.times, curves.desired[:, i] * length.factor, 2) for i in range(3)]
    return Chart(tr("Place of the tool"), tr(_TIME), f"[{length.unit}]", tuple(lines), (), marks, 150.0)


def _axis_curve(i: int, name: str, times: FloatArray, values: FloatArray, dash: int = 0) -> Curve:
    return Curve(name, AXIS_COLORS[i], times, values, dash)


def _deviation(curves: Curves, measures: Measures, marks: tuple[float, ...]) -> Chart:
    deviation = curves.deviation
    assert deviation is not None
    factor, unit = fine_unit(deviation, measures)
    line = Curve(tr("deviation"), _OFF_COLOR, curves.times, np.asarray(deviation) * factor)
    return Chart(tr("Deviation from the path"), tr(_TIME), f"[{unit}]", (line,), (), marks, 110.0)


def between_words(curves: Curves | None, measures: Measures) -> str:
    """How far a motion is from the path at most, with a unit; "" where that is not known.

    It passes the points; between them it follows a spline of the joints.
    """
    deviation = None if curves is None else curves.deviation
    if deviation is None or not np.isfinite(deviation).any():
        return ""
    value, unit = between(deviation, measures)
    return left_to_right(f"{value} {unit}")


def between(deviation: FloatArray, measures: Measures) -> tuple[str, str]:
    """The largest of the deviations [m] that are known, and its unit."""
    factor, unit = fine_unit(deviation, measures)
    largest = float(np.nanmax(deviation)) * factor
    return number(largest, 2) if largest >= _LEAST_SHOWN or largest == 0.0 else scientific(largest), unit


def fine_unit(values: FloatArray, measures: Measures) -> tuple[float, str]:
    """Factor and unit in which the largest of lengths [m] is a number one can read."""
    length = measures.length
    known = np.abs(values[np.isfinite(values)])
    largest = float(known.max(initial=0.0))
    if measures.robot.length_unit == "unit" or largest * length.factor >= _LEAST_SHOWN or largest == 0.0:
        return length.factor, length.unit
    unit, factor = next(((name, factor) for name, factor in _FINER if largest * factor >= 0.1), ("fm", 1e15))
    return factor, unit


def _sigma(curves: Curves, marks: tuple[float, ...]) -> Chart:
    line = Curve("σ min", _TOOL_COLOR, curves.times, curves.sigma_min)
    return Chart(tr("Smallest singular value σ of J (SI units)"), tr(_TIME), "", (line,), (), marks, 110.0)
