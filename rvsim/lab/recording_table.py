"""A motion of a real or virtual arm as a table: times, and the joints and the tool as wanted, sent and measured."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

_WORDS = {"desired": "wanted", "commanded": "sent", "true": "really"}
_NO_MEASUREMENT = " (no measurement: the pulses that the controller says it sends)"


def recording_csv(robot: Robot, recording: Recording) -> str:
    """CSV with heads that name units; degrees and millimetres; empty cells where nothing is known.

    What came back is called measured or reported, as it is; "really" is the true pose of a virtual arm.
    """
    columns = {"time [s]": recording.t} | dict(_joint_columns(robot, recording)) | dict(_tool_columns(robot, recording))
    rows = [",".join(columns)]
    rows += [",".join(_cell(value) for value in row) for row in zip(*columns.values(), strict=True)]
    return "\n".join([*_remarks(recording), *rows, ""])


def _remarks(recording: Recording) -> Iterator[str]:
    note = "" if recording.is_measured else _NO_MEASUREMENT
    yield f"# {recording.back_word}: {recording.kind}{note}"
    yield "# time 0 is the start of the motion; below it the arm goes there"
    if recording.stopped_at is not None:
        yield f"# stopped at {recording.stopped_at:.1f} of {recording.planned:.1f} s"


def _joint_columns(robot: Robot, recording: Recording) -> Iterator[tuple[str, FloatArray]]:
    for name in recording.sources:
        values = getattr(recording, name)
        for index, joint in enumerate(robot.joints):
            unit = "deg" if joint.revolute else "mm"
            convert = degrees_from_radians if joint.revolute else millimetres_from_metres
            yield f"{_word(recording, name)} {joint.name} [{unit}]", convert(values[:, index])


def _tool_columns(robot: Robot, recording: Recording) -> Iterator[tuple[str, FloatArray]]:
    is_metric = robot.length_unit != "unit"
    for name in recording.sources:
        places = recording.tool_path(robot, name)
        shown = millimetres_from_metres(places) if is_metric else places
        for letter, column in zip("xyz", shown.T, strict=True):
            yield f"{_word(recording, name)} tool {letter} [{'mm' if is_metric else 'unit'}]", column


def _word(recording: Recording, name: str) -> str:
    return _WORDS.get(name, recording.back_word)


def _cell(value: float) -> str:
    return f"{value:.6f}" if math.isfinite(value) else ""
