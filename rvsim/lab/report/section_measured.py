"""What came back from an arm on the wire: desired, commanded and measured, with their differences."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

import numpy as np

from rvsim.lab.report.chart import Chart, Curve
from rvsim.lab.report.figures import DASH, Measure, Measures, number
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Column, Figure, Paragraph, Section, Table, Words
from rvsim.language import tr, tr_later, trn
from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

COLORS = {"desired": "#0072B2", "commanded": "#009E73", "measured": "#D55E00", "true": "#CC79A7"}
_DASHES = {"desired": 0, "commanded": 1, "measured": 2, "true": 3}
_HIGHEST, _TOGETHER = 92.0, 460.0  # [pt] of a chart, and of those of all joints: they fit on one page
_TRUE_WORDS = tr_later(
    "“Really” is where the joints of the virtual arm truly were, which nobody can see of a real one."
)
_SOURCES = {
    "desired": tr_later("desired"),
    "commanded": tr_later("commanded"),
    "measured": tr_later("measured"),
    "reported": tr_later("reported"),
    "true": tr_later("really"),
}
_LAGS = tr_later("Sent: the set-points commanded. The measured tool lags behind in time as well as in place.")
_REPORTED = tr_later(
    "Sent: the set-points commanded. Reported: the pulses that the controller says it sends, later than the set-points "
    "and in steps of 10 µs, about 1°; where the arm was is not known from them."
)


def measured_section(study: Study, measures: Measures) -> Section:
    """Deviations in numbers, then over time."""
    recording = study.recording
    assert recording is not None, "asked for only where something ran"
    part = recording.on_trajectory()
    head = Paragraph(" ".join(filter(None, _words(study, recording, part))))
    measured, reported = tr("On the arm: desired, commanded, measured"), tr("On the arm: desired, commanded, reported")
    title = measured if recording.is_measured else reported
    if part.empty:
        return Section(title, (head,))
    return Section(title, (head, _table(study.robot, part, measures), *_figures(study.robot, part, measures)))


def _words(study: Study, recording: Recording, part: Recording) -> Iterator[str]:
    if recording.stopped_at is None:
        yield tr("The motion ran on an arm for {seconds} s.", seconds=number(part.duration, 2))
    else:
        yield (
            tr(
                "The motion was stopped at {seconds} of {planned} s; what follows is of the part that ran.",
                seconds=number(recording.stopped_at, 1),
                planned=number(recording.planned, 1),
            )
        )
    yield study.run
    yield _moments(len(part.t), len(part.measured_rows), measured=recording.is_measured)
    yield study.measured
    if recording.true is not None:
        yield tr(_TRUE_WORDS)


def _moments(moments: int, known: int, *, measured: bool) -> str:
    """How much of a motion was recorded, and how much of that came back."""
    if measured and known:
        return trn(
            "{n} moment of it was recorded, {known} of them with a measurement.",
            "{n} moments of it were recorded, {known} of them with a measurement.",
            moments,
            known=known,
        )
    if measured:
        return trn(
            "{n} moment of it was recorded, none of them with a measurement.",
            "{n} moments of it were recorded, none of them with a measurement.",
            moments,
        )
    if known:
        return trn(
            "{n} moment of it was recorded, {known} of them with a report of the controller.",
            "{n} moments of it were recorded, {known} of them with a report of the controller.",
            moments,
            known=known,
        )
    return trn(
        "{n} moment of it was recorded, none of them with a report of the controller.",
        "{n} moments of it were recorded, none of them with a report of the controller.",
        moments,
    )


def source_word(recording: Recording, name: str) -> str:
    """What a source is called in the report."""
    return tr(_SOURCES[recording.back_word if name == "measured" else name])


def _table(robot: Robot, recording: Recording, measures: Measures) -> Table:
    shown = [name for name in recording.sources if name != "desired"]
    heads = [tr("sent") if name == "commanded" else source_word(recording, name) for name in shown]
    errors = ((tr("{source} RMS", source=head), tr("{source} max", source=head)) for head in heads)
    columns = (Column("", "left"), Column(tr("unit"), "center"), *map(Column, chain.from_iterable(errors)))
    joints = [recording.joint_errors(name) for name in shown]
    rows = [
        _row(f"J{i + 1} {tr(robot.joint_names[i])}", measures.joint(i),
             tuple(values[i] for errors in joints for values in (errors.rms, errors.max)))
        for i in range(robot.dof)
    ]  # fmt: skip
    tool = [recording.tool_errors(robot, name) for name in shown]
    rows.append(_row(tr("Tool, place"), measures.length, tuple(x for errors in tool for x in (errors.rms, errors.max))))
    note = tr(_LAGS) if recording.is_measured else tr(_REPORTED)
    caption = tr("Deviations from what was desired, at the same moments of the motion.")
    return Table(caption, columns, tuple(rows), note, totals=1)


def _row(name: str, measure: Measure, values: tuple[float | FloatArray, ...]) -> tuple[Words, ...]:
    texts = (DASH if np.isnan(value) else number(float(value) * measure.factor, 3) for value in values)
    return (name, measure.unit, *texts)


def _figures(robot: Robot, recording: Recording, measures: Measures) -> Iterator[Block]:
    charts = [_joint(robot, recording, measures, index) for index in range(robot.dof)]
    charts[-1] = replace(charts[-1], named=True)  # they all have the same curves
    measured = tr("Each joint: desired, commanded (dashed) and measured (dotted).")
    reported = tr("Each joint: desired, commanded (dashed) and reported (dotted).")
    yield Figure(measured if recording.is_measured else reported, tuple(charts))
    distances = {name: recording.tool_distances(robot, name) for name in recording.sources if name != "desired"}
    lines = tuple(
        Curve(
            source_word(recording, name),
            COLORS[name],
            *_known(recording.t, values * measures.length.factor),
            _DASHES[name],
        )
        for name, values in distances.items()
        if np.isfinite(values).any()
    )
    if lines:
        chart = Chart(
            tr("Distance of the tool from where it was desired"), tr("time [s]"), f"[{measures.length.unit}]", lines
        )
        yield Figure(tr("How far the tool was from where it was to be at that moment."), (chart,))


def _joint(robot: Robot, recording: Recording, measures: Measures, index: int) -> Chart:
    measure = measures.joint(index)
    lines = tuple(
        Curve(
            source_word(recording, name),
            COLORS[name],
            *_known(recording.t, getattr(recording, name)[:, index] * measure.factor),
            _DASHES[name],
        )
        for name in recording.sources
        if np.isfinite(getattr(recording, name)[:, index]).any()
    )
    title = f"J{index + 1} {tr(robot.joint_names[index])}"
    return Chart(
        title, tr("time [s]"), f"[{measure.unit}]", lines, height=min(_HIGHEST, _TOGETHER / robot.dof), named=False
    )


def _known(t: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Without the moments at which nothing is known: set-points and measurements come in turn."""
    there = np.isfinite(values)
    return t[there], values[there]
