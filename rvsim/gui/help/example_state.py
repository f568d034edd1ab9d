"""What an example of a help page sets up, read from the texts of its link: arithmetic only, no window."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from rvsim.errors import ExpressionError, UnknownNameError
from rvsim.experiment import SHAPE_KINDS, Experiment, TrajectoryTask, limit_violations
from rvsim.experiment.program import ArcMove, Gripper, JointMove, Program, Triple, Wait
from rvsim.expressions import evaluate
from rvsim.lab.lines import default_experiment, line_presets, preset_path
from rvsim.lab.named_paths import path_names
from rvsim.language import tr
from rvsim.motion import track
from rvsim.motion.trajectory import LAW_TITLES
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import NO_TOOL
from rvsim.spatial import rotation_from_rpy, transform
from rvsim.units import metres_from_millimetres, radians_from_degrees

_ORIENTATIONS = ("down", "free", "keep", "source", "turn", "normal", "pitch")
_LIFT = 0.25  # of the example program's arc, as a share of its length
_POSE_NUMBERS = 6


def one_of(kind: str, name: str, known: tuple[str, ...]) -> str:
    """The name, if it is one of those that are known.

    Raises:
        UnknownNameError: it is not.
    """
    if name not in known:
        raise UnknownNameError(kind, name, known)
    return name


def example_experiment(robot: Robot, wishes: Mapping[str, str]) -> Experiment:
    """The state that an example shows: all that it does not say is as at the start.

    Raises:
        RvsimError: a wish names something unknown, or a number that is none.
    """
    experiment = default_experiment(robot)
    for name, edit in EDITS.items():
        if name in wishes:
            experiment = edit(experiment, wishes[name])
    return experiment


def without_tool(robot: Robot) -> Robot:
    """The arm with nothing bolted to its flange, where its file allows that."""
    if robot.tool_name == NO_TOOL.name or all(tool.name != NO_TOOL.name for tool in robot.tools):
        return robot
    return replace(robot, tool_name=NO_TOOL.name)


def _numbers(text: str, count: int) -> FloatArray:
    parts = text.split(",")
    if len(parts) != count:
        raise ExpressionError(text, tr("{count} numbers are wanted, with commas between them", count=count))
    return np.array([evaluate(part) for part in parts])


def _lengths(robot: Robot, values: FloatArray) -> FloatArray:
    return values if robot.length_unit == "unit" else np.asarray(metres_from_millimetres(values))


def _at(experiment: Experiment, text: str) -> Experiment:
    robot = experiment.robot
    typed = _numbers(text, robot.dof)
    q = np.where(robot.is_revolute, radians_from_degrees(typed), _lengths(robot, typed))
    return replace(experiment.at(q), ignore_limits=experiment.ignore_limits or bool(limit_violations(robot, q)))


def _target(experiment: Experiment, text: str) -> Experiment:
    typed = _numbers(text, _POSE_NUMBERS)
    R = rotation_from_rpy(radians_from_degrees(typed[3:]))
    return replace(experiment, target=transform(R, _lengths(experiment.robot, typed[:3])))


def _line(experiment: Experiment, text: str) -> Experiment:
    presets = {preset.name: preset for preset in line_presets(experiment.robot)}
    return replace(experiment, line=presets[one_of("line", text, tuple(presets))].task())


def _path(experiment: Experiment, text: str) -> Experiment:
    known = (*path_names(experiment.robot), *SHAPE_KINDS)
    return replace(experiment, trajectory=TrajectoryTask(one_of("path", text, known)))


def _orientation(experiment: Experiment, text: str) -> Experiment:
    wanted: Any = one_of("orientation", text, _ORIENTATIONS)
    trajectory = replace(experiment.trajectory, orientation=wanted)
    return replace(experiment, line=replace(experiment.line, orientation=wanted), trajectory=trajectory)


def _limits(experiment: Experiment, text: str) -> Experiment:
    return replace(experiment, ignore_limits=one_of("limits", text, ("ignored", "kept")) == "ignored")


def _law(experiment: Experiment, text: str) -> Experiment:
    law: Any = one_of("law", text, tuple(LAW_TITLES))
    return replace(experiment, law=law)


def _seconds(experiment: Experiment, text: str) -> Experiment:
    return replace(experiment, path_seconds=float(_numbers(text, 1)[0]))


def _force(experiment: Experiment, text: str) -> Experiment:
    return experiment.with_load(experiment.load.with_wrench(0, _numbers(text, 3)))


def _payload(experiment: Experiment, text: str) -> Experiment:
    return experiment.with_load(replace(experiment.load, payload=float(_numbers(text, 1)[0])))


def _program(experiment: Experiment, text: str) -> Experiment:
    one_of("program", text, ("carry",))
    return replace(experiment, program=_carrying(experiment))


def _carrying(experiment: Experiment) -> Program:
    """Something is taken at the beginning of the arm's line, put down at its end; then home."""
    robot, preset = experiment.robot, line_presets(experiment.robot)[0]
    first = track(robot, preset_path(robot, preset), near=robot.home).q[0]
    over = 0.5 * (preset.start + preset.end) + (0.0, 0.0, _LIFT * float(np.linalg.norm(preset.end - preset.start)))
    carried = ArcMove(_triple(over), _triple(preset.end), "keep")
    taken = (JointMove(tuple(first.tolist())), Gripper(0.0))
    return (*taken, carried, Gripper(1.0), Wait(0.5), JointMove(tuple(robot.home.tolist())))


def _triple(point: FloatArray) -> Triple:
    x, y, z = point.tolist()
    return x, y, z


# In this order: the pose may need the limits to be ignored.
EDITS: dict[str, Callable[[Experiment, str], Experiment]] = {
    "limits": _limits,
    "q": _at,
    "target": _target,
    "line": _line,
    "path": _path,
    "orientation": _orientation,
    "law": _law,
    "seconds": _seconds,
    "force": _force,
    "payload": _payload,
    "program": _program,
}
