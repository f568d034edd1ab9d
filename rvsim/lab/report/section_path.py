"""The path: what was asked for, what the arm reached and how exactly, and what its check found before it ran."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rvsim.lab.findings import SYMBOLS, WORDS, finding_sentence, summary_sentence
from rvsim.lab.report.chart import Chart, Curve
from rvsim.lab.report.figures import DASH, Measures, lined_up, number, scientific
from rvsim.lab.report.path_words import path_formulas, path_words
from rvsim.lab.report.pictures import path_picture
from rvsim.lab.report.section_motion import between
from rvsim.lab.report.section_robot import unit_columns
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import ASSUMED, Block, Column, Figure, Items, Paragraph, Run, Section, Table, Words
from rvsim.lab.sentences import advice_sentence, tracking_sentence
from rvsim.language import tr, tr_later, trn
from rvsim.motion import Tracking
from rvsim.motion.honesty import Peak, Report
from rvsim.robot.arrays import FloatArray

ASKED, REACHED, MISSED = "#0072B2", "#B5179E", "#B54708"
BoolArray = NDArray[np.bool_]
_LAWS = {
    "quintic": tr_later("quintic"),
    "cubic": tr_later("cubic"),
    "trapezoid": tr_later("trapezoidal"),
    "quickest": tr_later("quickest"),
}


def path_section(study: Study, measures: Measures) -> Section:
    """Facts, picture, findings, peaks."""
    tracking, report = study.tracking, study.check
    assert tracking is not None, "asked for only where a path was tracked"
    assert report is not None, "a tracked path is checked"
    formulas = path_formulas(study)
    return Section(
        tr("The path"),
        (
            Paragraph(" ".join(_about(study, tracking, measures))),
            *((Items(formulas),) if formulas else ()),
            *((Paragraph(advice_sentence(tracking)),) if not tracking.complete else ()),
            _facts(study, tracking, measures),
            Figure(
                tr(
                    "The path: blue what was asked for, purple what the tool draws, orange and dashed what is out of "
                    "reach."
                )
                if not tracking.complete
                else tr("The path that the tool draws."),
                (path_picture(study, tracking),),
            ),
            _flat(tracking, measures),
            *_findings(study, report),
            *_peaks(report, measures),
        ),
    )


def _about(study: Study, tracking: Tracking, measures: Measures) -> Iterator[str]:
    """What was asked for, and what came of it."""
    yield trn(
        "The path is “{title}”, {n} point.",
        "The path is “{title}”, {n} points.",
        tracking.samples,
        title=tr(tracking.path.title or tracking.path.name),
    )
    yield from path_words(study, tracking.path, measures)
    yield tracking_sentence(tracking, study.units)


def _facts(study: Study, tracking: Tracking, measures: Measures) -> Table:
    deviation = tracking.deviation[tracking.reached]
    share = 100.0 * tracking.reached_count / tracking.samples
    rows: list[tuple[Words, ...]] = [
        (
            tr("Points reached"),
            tr("{number} of {count}", number=tracking.reached_count, count=tracking.samples),
            f"{share:.0f} %",
        ),
        (tr("Length of the path"), measures.length.text(tracking.path.length), measures.length.unit),
        *_deviation(deviation, measures),
        (tr("Changes of branch on the way"), str(len(tracking.jumps)), ""),
        (tr("Solving, all points"), number(1e3 * tracking.solve_seconds, 1), "ms"),
        (tr("Solving, a point"), number(1e6 * tracking.seconds_per_point, 1), "µs"),
    ]
    if study.trajectory is not None:
        law = study.experiment.law
        rows.append((tr("Duration of the motion"), number(study.trajectory.duration, 2), "s"))
        rows.append((tr("Time law"), tr(_LAWS.get(law, law)), ""))
        rows += _between(study, measures)
    columns = (Column("", "left"), Column(tr("value")), Column("", "left"))
    return Table(tr("The path in numbers; deviations over the points that were reached."), columns, tuple(rows))


def _flat(tracking: Tracking, measures: Measures) -> Figure:
    """Along the two axes of the base in which the path is widest, both in the same scale."""
    points = tracking.path.points
    first, second = sorted(np.argsort(np.ptp(points, axis=0))[-2:].tolist())
    factor, unit = measures.length.factor, measures.length.unit
    lifted = np.zeros(len(points), dtype=bool) if tracking.path.pen_up is None else tracking.path.pen_up
    begins = np.flatnonzero(lifted)

    def curve(name: str, color: str, places: FloatArray, there: BoolArray, dash: int) -> Curve:
        """With a gap before each point to which the pen is lifted; where it comes down a stroke begins."""
        seen = np.insert(np.where(there[:, None], places * factor, np.nan), begins, np.nan, axis=0)
        return Curve(name, color, seen[:, first], seen[:, second], dash)

    everywhere = np.ones(len(points), dtype=bool)
    curves = [curve(tr("asked for"), ASKED, points, everywhere, 0)]
    curves.append(curve(tr("reached"), REACHED, tracking.actual, everywhere, 2))
    if not tracking.complete:
        curves.append(curve(tr("out of reach"), MISSED, points, ~tracking.reached, 1))
    across, up = (f"{'xyz'[axis]} [{unit}]" for axis in (first, second))
    chart = Chart(tr("The path, flat"), across, up, tuple(curves), height=190.0, equal=True)
    return Figure(
        tr(
            "The path along {first} and {second} of the base, both in the same scale.",
            first="xyz"[first],
            second="xyz"[second],
        ),
        (chart,),
    )


def _between(study: Study, measures: Measures) -> list[tuple[Words, ...]]:
    """A motion passes the points; between them it follows a spline of the joints."""
    deviation = None if study.curves is None else study.curves.deviation
    if deviation is None or not np.isfinite(deviation).any():
        return []
    return [(tr("Largest deviation of the motion"), *between(deviation, measures))]


def _deviation(
    deviation: np.ndarray[tuple[int, ...], np.dtype[np.float64]], measures: Measures
) -> Iterator[tuple[Words, ...]]:
    if not len(deviation):
        return
    values = (math.sqrt(float(np.mean(deviation**2))), float(deviation.max()), float(deviation.mean()))
    for name, value in zip((tr("RMS deviation"), tr("Largest deviation"), tr("Mean deviation")), values, strict=True):
        yield name, scientific(value * measures.length.factor), measures.length.unit


def _findings(study: Study, report: Report) -> Iterator[Block]:
    yield Paragraph((Run(tr("The check before the motion."), "bold"), Run(f" {summary_sentence(report)}")))
    marks = tuple(Run(SYMBOLS[finding.severity], finding.severity) for finding in report.findings)
    items = tuple(
        (Run(f"{tr(WORDS[finding.kind])}. ", "bold"), Run(finding_sentence(report, finding, study.units)))
        for finding in report.findings
    )
    yield Items(items, marks)


def _peaks(report: Report, measures: Measures) -> Iterator[Block]:
    if not report.speeds:
        return
    columns = (
        Column("i", "center"), Column(tr("Joint"), "left"), *unit_columns(measures),
        Column(measures.head("max |q̇|", "/s")), Column(tr("limit")), Column(tr("share")),
        Column(measures.head("max |q̈|", "/s²")), Column(tr("limit")), Column(tr("share")),
    )  # fmt: skip
    pairs = zip(report.speeds, report.accelerations, strict=True)
    rows = lined_up([_peak_row(index, speed, rate, report, measures) for index, (speed, rate) in enumerate(pairs)])
    assumed = any(peak.limit is not None and peak.limit.assumed for peak in (*report.speeds, *report.accelerations))
    yield Table(
        tr("The most that the joints do on the way."),
        columns,
        rows,
        tr("{assumed} assumed: no source gives it.", assumed=ASSUMED) if assumed else "",
    )


def _peak_row(index: int, speed: Peak, rate: Peak, report: Report, measures: Measures) -> tuple[Words, ...]:
    measure = measures.joint(index)
    cells: list[Words] = [str(index + 1), tr(report.robot.joint_names[index]), *measures.unit_cell(index)]
    for peak in (speed, rate):
        limit = DASH if peak.limit is None else f"{peak.limit.value * measure.factor:.4g}"
        mark = f" {ASSUMED}" if peak.limit is not None and peak.limit.assumed else ""
        share = DASH if math.isnan(peak.share) else f"{100.0 * peak.share:.0f} %"
        cells += [number(peak.value * measure.factor, measure.decimals - 1), limit + mark, share]
    return tuple(cells)
