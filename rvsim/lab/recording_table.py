"""A motion of a real or virtual arm as a table: times, wanted, sent and measured joints."""

from __future__ import annotations

import math

from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.units import degrees_from_radians, millimetres_from_metres

_SOURCES = (("wanted", "desired"), ("sent", "commanded"), ("measured", "measured"))


def recording_csv(robot: Robot, recording: Recording) -> str:
    """CSV with a head that names units; degrees and millimetres; empty cells where nothing is known."""
    heads = ["time [s]"]
    columns = [recording.t]
    for word, name in _SOURCES:
        values = getattr(recording, name)
        for index, joint in enumerate(robot.joints):
            unit = "deg" if joint.revolute else "mm"
            heads.append(f"{word} {joint.name} [{unit}]")
            convert = degrees_from_radians if joint.revolute else millimetres_from_metres
            columns.append(convert(values[:, index]))
    rows = [",".join(heads)]
    rows += [",".join(_cell(value) for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([f"# measured: {recording.kind}", *rows, ""])


def _cell(value: float) -> str:
    return f"{value:.6f}" if math.isfinite(value) else ""
