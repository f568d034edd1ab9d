"""The format of session files as tables: the same tables read a session, refuse a bad one and write a good one.

Everything is written, what is at its default too: a file says the same whatever a later rvsim takes for granted.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, get_args

import numpy as np

from rvsim.errors import did_you_mean
from rvsim.experiment import (
    SHAPE_KINDS,
    CameraView,
    DeviceSettings,
    Experiment,
    LineTask,
    Load,
    NamedPose,
    Notes,
    PathOrientation,
    Placement,
    SessionState,
    Shape,
    TrajectoryTask,
    View,
    WrenchAxes,
)
from rvsim.experiment.session_state import Language, Look, Tracked, TrackedFrom
from rvsim.experiment.shapes import FormulaStage, Join, TextShape
from rvsim.files.place import Place, shown
from rvsim.files.session.kinds import (
    Choice,
    Field,
    Flag,
    Kind,
    Many,
    Maybe,
    Paragraphs,
    Real,
    Reals,
    Record,
    Rows,
    Whole,
    Words,
)
from rvsim.files.session.parts import RobotKind, plain_program, read_program
from rvsim.language import tr, tr_later, trn
from rvsim.motion.trajectory import LAW_TITLES
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

FORMAT = "rvsim session"
LONGEST_NOTES = 1_000_000  # characters
_UNITS_NOTE = (
    "radians, metres, seconds, kilograms, newtons; moves and the arm's file in degrees, millimetres, percent, "
    "as in files of their own"
)
_MOST_POSES, _MOST_SAMPLES, _MOST_LEFT, _MOST_JOINTS = 2000, 20_001, 64, 1000
_NAME = Words(60, shortest=1)
_POINT = Reals(3, tr_later("a list of 3 numbers: x, y, z"))
_TURN = Reals(3, tr_later("a list of 3 numbers: roll, pitch, yaw"))
_ORIENTATION = Choice(get_args(PathOrientation))
_POSITIVE = Real(1e-12)
_REAL = Real()

# --- what is drawn -------------------------------------------------------------------------------------------------

_SAMPLES = Whole(2, _MOST_SAMPLES)
# The kind of each field of a shape, by its name; `points` has as many rows as the shape needs.
_SHAPE_FIELDS: dict[str, Kind] = {
    **dict.fromkeys(("radius", "a", "b", "height"), Real(0.0)),  # 0: what fits an arm that has no line yet
    **dict.fromkeys(("spacing", "unit"), _POSITIVE),
    **dict.fromkeys(("begin", "sweep", "lift"), _REAL),
    "samples": _SAMPLES,
    "corners": Whole(3, 1000),
    "text": Words(2000),
    "join": Choice(get_args(Join)),
    "points": Rows(3, 1, _MOST_SAMPLES),
    "stages": Many(
        "stage",
        Record(
            (
                Field("end", _REAL),
                Field("samples", _SAMPLES),
                *(Field(name, Words(2000)) for name in ("x", "y", "z")),
            ),
            FormulaStage,
        ),
        most=1000,
        fewest=1,
    ),
}


def _shape_record(kind: type[Shape]) -> Record:
    kinds = _SHAPE_FIELDS | ({"points": Rows(3, 3, 3)} if kind is SHAPE_KINDS["arc-through"] else {})
    return Record(tuple(Field(field.name, kinds[field.name]) for field in fields(kind)), kind)


_SHAPES = {name: _shape_record(kind) for name, kind in SHAPE_KINDS.items()}


@dataclass(frozen=True)
class _ShapeKind:
    """A table whose key `kind` says which others it has."""

    def read(self, value: Any, place: Place) -> Shape:
        """The shape."""
        kind = value.get("kind") if isinstance(value, dict) else None
        if not isinstance(kind, str) or kind not in _SHAPES:
            guess = did_you_mean(kind[:100], tuple(_SHAPES)) if isinstance(kind, str) else ""
            place.at("kind").refuse(shown(kind), tr("a kind of shape"), guess)
        rest = {key: part for key, part in value.items() if key != "kind"}
        shape: Shape = _SHAPES[kind].read(rest, place)
        return shape

    def plain(self, value: Shape) -> dict[str, Any]:
        """Its kind first."""
        kind = next(name for name, made in SHAPE_KINDS.items() if isinstance(value, made))
        return {"kind": kind, **_SHAPES[kind].plain(value)}


_PLACEMENT = Record(
    (Field("center", _POINT), Field("rpy", _TURN), Field("scale", Real(1e-9, 1e9))),
    lambda **parts: Placement(**parts),
)
_LINE = Record(
    (
        Field("start", _POINT),
        Field("end", _POINT),
        Field("resolution", Real(1.0 / _MOST_SAMPLES, 1.0)),
        Field("orientation", _ORIENTATION),
    ),
    lambda **parts: LineTask(**parts),
)


@dataclass(frozen=True)
class _PathName:
    """The name of a path: a plain word, never that of a file."""

    def read(self, value: Any, place: Place) -> str:
        """The name."""
        name = _NAME.read(value, place)
        if not name.replace("-", "").isalnum():
            place.refuse(shown(value), tr("the name of a path: letters, digits and hyphens"))
        return name

    def plain(self, value: Any) -> str:
        """As it is."""
        return str(value)


_TRAJECTORY = Record(
    (
        Field("name", _PathName()),
        Field("orientation", _ORIENTATION),
        Field("height", _REAL),
        Field("shape", Maybe(_ShapeKind())),
        Field("placement", Maybe(_PLACEMENT)),
        Field("turn_from", Maybe(_TURN)),
        Field("turn_to", Maybe(_TURN)),
        Field("pitch", _REAL),
    ),
    lambda **parts: TrajectoryTask(**parts),
)

# --- the experiment ------------------------------------------------------------------------------------------------

_LOAD = Record(
    (
        Field("wrench", Reals(6, tr_later("a list of 6 numbers: fx, fy, fz, mx, my, mz"))),
        Field("axes", Choice(get_args(WrenchAxes))),
        Field("payload", Real(0.0)),
        Field("own_weight", Flag()),
    ),
    lambda **parts: Load(**parts),
)
_RIGID = 1e-6


@dataclass(frozen=True)
class _PoseKind:
    """A 4 × 4 matrix of a rotation and a place."""

    def read(self, value: Any, place: Place) -> FloatArray:
        """T (4, 4)."""
        T: FloatArray = Rows(4, 4, 4).read(value, place)
        R = T[:3, :3]
        if np.abs(R).max() > 2.0 or not _is_rotation(R) or T[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
            place.refuse(tr("a matrix that turns nothing rigidly"), tr("a rotation, a place, and the row 0, 0, 0, 1"))
        return T

    def plain(self, value: Any) -> list[list[float]]:
        """Row by row."""
        return Rows(4, 4, 4).plain(value)


def _is_rotation(R: FloatArray) -> bool:
    return bool(np.abs(R @ R.T - np.eye(3)).max() < _RIGID and np.linalg.det(R) > 0.0)


@dataclass(frozen=True)
class _ProgramKind:
    """The moves of an arm."""

    robot: Robot

    def read(self, value: Any, place: Place) -> Any:
        """The program."""
        return read_program(value, self.robot, place)

    def plain(self, value: Any) -> list[Any]:
        """As in a program file."""
        return plain_program(value, self.robot)


def _experiment_fields(robot: Robot) -> tuple[Field, ...]:
    expected = trn(
        "a list of {n} number, one for each joint of the {robot}",
        "a list of {n} numbers, one for each joint of the {robot}",
        robot.dof,
        robot=tr(robot.title),
    )
    q = Reals(robot.dof, expected)
    pose = Record((Field("name", Words(40_000, shortest=1)), Field("q", q)), _named_pose, NamedPose._asdict)
    return (
        Field("q", q),
        Field("typed", Maybe(q), None),
        Field("target", Maybe(_PoseKind()), None),
        Field("ignore_limits", Flag(), False),
        Field("poses", Many("pose", pose, _MOST_POSES), ()),
        Field("line", _LINE),
        Field("trajectory", _TRAJECTORY, TrajectoryTask()),
        Field("law", Choice(tuple(LAW_TITLES)), "quintic"),
        Field("path_seconds", Maybe(Real(0.0, 1e6)), None),
        Field("ease", Flag(), False),
        Field("load", _LOAD, Load()),
        Field("program", _ProgramKind(robot), ()),
    )


def _named_pose(name: str, q: tuple[float, ...]) -> NamedPose:
    return NamedPose(name, frozen_array("q", q, (len(q),)))


@dataclass(frozen=True)
class ExperimentKind:
    """An arm first, then what has as many numbers as it has joints."""

    def read(self, value: Any, place: Place) -> Experiment:
        """The experiment, without its notes."""
        robot_kind = RobotKind()
        if not isinstance(value, dict) or "robot" not in value:
            place.refuse(
                shown(value) if not isinstance(value, dict) else tr("no arm"), tr('a table with the key "robot"')
            )
        robot = robot_kind.read(value["robot"], place.at("robot"))
        rest = {key: part for key, part in value.items() if key != "robot"}
        experiment: Experiment = Record(_experiment_fields(robot), _with(Experiment, robot=robot)).read(rest, place)
        _check_pose_names(experiment, place)
        _check_shape(experiment.trajectory, place.at("trajectory"))
        return experiment

    def plain(self, value: Experiment) -> dict[str, Any]:
        """The arm first."""
        record = Record(_experiment_fields(value.robot), Experiment)
        return {"robot": self.arm(value.robot), **record.plain(value)}

    @staticmethod
    def arm(robot: Robot) -> dict[str, Any]:
        """An arm as it stands in a file: `{"name": …}` for a built-in one as it came, else `{"file": …}`."""
        return RobotKind().plain(robot)


def _with(build: Callable[..., Any], **given: Any) -> Callable[..., Any]:
    return lambda **parts: build(**given, **parts)


def _check_pose_names(experiment: Experiment, place: Place) -> None:
    names = [pose.name for pose in experiment.poses]
    for number, name in enumerate(names, 1):
        if names.index(name) + 1 < number:
            place.at(f"pose {number}").refuse(tr("the name {name!r} again", name=name[:60]), tr("a name of its own"))


def _check_shape(task: TrajectoryTask, place: Place) -> None:
    if task.shape is not None and SHAPE_KINDS.get(task.name) is not type(task.shape):
        place.at("shape").refuse(
            tr("the shape of another path than {name!r}", name=task.name), tr("a shape of this name, or null")
        )
    if isinstance(task.shape, TextShape) and not task.shape.text:
        place.at("shape").refuse(tr("an empty text"), tr("a letter or more"))


# --- what is beside it ---------------------------------------------------------------------------------------------

_NOTES = Record((Field("student", Words(2000), ""), Field("text", Paragraphs(LONGEST_NOTES), "")), Notes)
_DEVICE = Record(
    (
        Field("url", Words(2000), ""),
        Field("baud", Whole(1, 100_000_000), 9600),
        Field("language", Choice(get_args(Language)), "ssc32"),
    ),
    DeviceSettings,
)
_CAMERA = Record(
    (
        Field("azimuth", Real(-1e6, 1e6)),
        Field("elevation", Real(-10.0, 10.0)),
        Field("field_of_view", Real(1e-3, math.pi - 1e-3)),
        Field("orthographic", Flag(), False),
        Field("target", Maybe(_POINT), None),
        Field("distance", Maybe(_POSITIVE), None),
    ),
    lambda **parts: CameraView(**parts),
)
_POSE = Many("joint", Real(), _MOST_JOINTS, fewest=1)
_TRACKED_FROM = Record(
    (
        Field("near", _POSE),
        Field("start", _POSE),
        Field("lifts", Many("point", Whole(1, 2 * _MOST_SAMPLES), _MOST_SAMPLES), (), sparse=True),
    ),
    lambda **parts: TrackedFrom(**parts),
)
_VIEW = Record(
    (
        Field("camera", Maybe(_CAMERA), None),
        Field("look", Choice(get_args(Look)), "solid"),
        Field("panel", Words(60), ""),
        Field("speed", Real(1e-3, 1e3), 1.0),
        Field("loop", Flag(), False),
        Field("tracked", Choice(get_args(Tracked)), "", sparse=True),
        Field("tracked_from", Maybe(_TRACKED_FROM), None, sparse=True),
    ),
    View,
)


def _state(notes: Notes, left: tuple[Experiment, ...], **parts: Any) -> SessionState:
    experiment = replace(parts.pop("experiment"), notes=notes)
    return SessionState(experiment, tuple(replace(one, notes=notes) for one in left), **parts)


def _parts(state: SessionState) -> dict[str, Any]:
    return {"notes": state.experiment.notes, **vars(state)}


SESSION = Record(
    (
        Field("notes", _NOTES, Notes()),
        Field("experiment", ExperimentKind()),
        Field("left", Many("experiment", ExperimentKind(), _MOST_LEFT), ()),
        Field("device", _DEVICE, DeviceSettings()),
        Field("view", _VIEW, View()),
    ),
    _state,
    _parts,
)
HEAD = ("format", "version", "units")


def head(version: int) -> dict[str, Any]:
    """What every file begins with."""
    return {"format": FORMAT, "version": version, "units": _UNITS_NOTE}
