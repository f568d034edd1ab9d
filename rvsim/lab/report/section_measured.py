"""What came back from an arm on the wire: desired, commanded and measured, with their differences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rvsim.lab.report.chart import Chart, Curve
from rvsim.lab.report.figures import DASH, Measure, Measures, number
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Column, Figure, Paragraph, Section, Table, Words
from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

COLORS = {"desired": "#0072B2", "commanded": "#009E73", "measured": "#D55E00"}
_DASHES = {"desired": 0, "commanded": 1, "measured": 2}


def measured_section(study: Study, measures: Measures) -> Section:
    """Errors in numbers, then over time."""
    recording = study.recording
    assert recording is not None, "asked for only where something ran"
    count = len(recording.measured_rows)
    words = (
        f"The motion ran on an arm for {number(recording.duration, 2)} s; {len(recording.t)} moments were recorded, "
        f"{count or 'none'} of them with a measurement. {study.measured}"
    )
    return Section(
        "On the arm: desired, commanded, measured",
        (
            Paragraph(words),
            _table(study.robot, recording, measures),
            *_figures(study.robot, recording, measures),
        ),
    )


def _table(robot: Robot, recording: Recording, measures: Measures) -> Table:
    columns = (
        Column("", "left"), Column("unit", "center"), Column("sent RMS"), Column("sent max"),
        Column("measured RMS"), Column("measured max"), Column("measured mean"),
    )  # fmt: skip
    sent, back = recording.joint_errors("commanded"), recording.joint_errors("measured")
    rows = [
        _row(f"J{i + 1} {robot.joint_names[i]}", measures.joint(i),
             (sent.rms[i], sent.max[i], back.rms[i], back.max[i], back.mean[i]))
        for i in range(robot.dof)
    ]  # fmt: skip
    tool_sent, tool_back = recording.tool_errors(robot, "commanded"), recording.tool_errors(robot, "measured")
    values = (tool_sent.rms, tool_sent.max, tool_back.rms, tool_back.max, tool_back.mean)
    rows.append(_row("Tool, place", measures.length, values))
    return Table(
        "Differences from what was desired, at the same moments.", columns, tuple(rows),
        "Sent: the set-points commanded. The measured tool lags behind in time as well as in place.", totals=1,
    )  # fmt: skip


def _row(name: str, measure: Measure, values: tuple[float | FloatArray, ...]) -> tuple[Words, ...]:
    texts = (DASH if np.isnan(value) else number(float(value) * measure.factor, 3) for value in values)
    return (name, measure.unit, *texts)


def _figures(robot: Robot, recording: Recording, measures: Measures) -> Iterator[Block]:
    charts = tuple(_joint(robot, recording, measures, index) for index in range(robot.dof))
    yield Figure("Each joint: desired, commanded (dashed) and measured (dotted).", charts)
    distances = {name: recording.tool_distances(robot, name) for name in ("commanded", "measured")}
    lines = tuple(
        Curve(name, COLORS[name], *_known(recording.t, values * measures.length.factor), _DASHES[name])
        for name, values in distances.items()
        if np.isfinite(values).any()
    )
    if lines:
        chart = Chart("Distance of the tool from where it was desired", "time [s]", f"[{measures.length.unit}]", lines)
        yield Figure("How far the tool was from where it was to be at that moment.", (chart,))


def _joint(robot: Robot, recording: Recording, measures: Measures, index: int) -> Chart:
    measure = measures.joint(index)
    lines = tuple(
        Curve(name, color, *_known(recording.t, getattr(recording, name)[:, index] * measure.factor), _DASHES[name])
        for name, color in COLORS.items()
        if np.isfinite(getattr(recording, name)[:, index]).any()
    )
    return Chart(f"J{index + 1} {robot.joint_names[index]}", "time [s]", f"[{measure.unit}]", lines, height=96.0)


def _known(t: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Without the moments at which nothing is known: set-points and measurements come in turn."""
    there = np.isfinite(values)
    return t[there], values[there]
