"""Programs on disk: a TOML file of [[move]] tables in degrees, millimetres and percent, for the hand too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rvsim.errors import ProgramFileError, RobotFileError, did_you_mean
from rvsim.experiment.program import MOVE_KINDS, Move, Program, kind_of
from rvsim.files.atomic import write_atomically
from rvsim.files.kinds import Choice, Items, Key, Number, Numbers, Table, Text, number_text
from rvsim.files.place import Place, Unit, Units, either, shown
from rvsim.files.toml_source import read_bytes, tables_of, text_of
from rvsim.language import tr, tr_later, trn
from rvsim.motion.moves import DEFAULT_SPEED, JointMove
from rvsim.robot import Robot

VERSION = 1
_A_FILE = tr_later("a program file (.toml)")
_MOST_MOVES = 2000
_PREAMBLE = """\
# A program of rvsim: the moves one after the other. Joints are degrees (millimetres where they slide), places x, y, z
# are {length}s in base axes, rpy is roll, pitch, yaw in degrees, speed is percent of what the joints may do.
"""
_POINT = Numbers(("x", "y", "z"), Number("length", -1e6, 1e6))
# As joints are, in degrees: 1.5708 may stand here, for a program may have been written by rvsim itself.
_ANGLES = Numbers(("roll", "pitch", "yaw"), Number("joint", -36_000.0, 36_000.0))
_NO_TURN = (0.0, 0.0, 0.0)

_PERCENT = Unit("percent", lambda percent: percent / 100.0, lambda share: 100.0 * share)


@dataclass(frozen=True)
class _Share:
    """A share 0…1, in percent."""

    least: float = 0.0

    def read(self, value: Any, place: Place) -> float:
        """The share."""
        return float(Number("plain", self.least, 100.0).read(value, place)) / 100.0

    def write(self, value: float, units: Units) -> str:
        """The percentage."""
        del units
        return number_text(value, _PERCENT)


@dataclass(frozen=True)
class _Joints:
    """One number a joint, each in its unit."""

    robot: Robot

    def read(self, value: Any, place: Place) -> tuple[float, ...]:
        """q (n,) [rad, m]."""
        names = self.robot.joint_names
        if not isinstance(value, list) or len(value) != len(names):
            found = trn("{n} number", "{n} numbers", len(value)) if isinstance(value, list) else shown(value)
            expected = trn(
                "{n} number, one for each joint of the {robot}",
                "{n} numbers, one for each joint of the {robot}",
                len(names),
                robot=tr(self.robot.title),
            )
            place.refuse(found, expected)
        return tuple(
            Number("joint", -1e6, 1e6).read(item, place.at(joint.name).with_units(place.units.for_joint(joint.type)))
            for joint, item in zip(self.robot.joints, value, strict=True)
        )

    def write(self, value: Sequence[float], units: Units) -> str:
        """The list in brackets."""
        pairs = zip(self.robot.joints, value, strict=True)
        texts = (Number("joint").write(number, units.for_joint(joint.type)) for joint, number in pairs)
        return f"[{', '.join(texts)}]"


_SPEED = Key("speed", _Share(1.0), DEFAULT_SPEED)
_TOOL = Key(
    "tool", Choice(("keep", "turn", "free")), "keep", tr_later("how it is turned: kept, turned to rpy, or free")
)
_RPY = Key("rpy", _ANGLES, _NO_TURN)
_SECONDS = Number("plain", 0.0, 86_400.0)


def _keys(robot: Robot) -> dict[str, tuple[Key, ...]]:
    """The keys of each kind of move."""
    return {
        "joint": (
            Key("joints", _Joints(robot), ()),
            Key("pose", Text(0, 60), "", tr_later("a remembered pose")),
            _SPEED,
        ),
        "line": (Key("to", _POINT), _TOOL, _RPY, _SPEED),
        "arc": (Key("via", _POINT), Key("to", _POINT), _TOOL, _RPY, _SPEED),
        "wait": (Key("seconds", _SECONDS),),
        "gripper": (Key("open", _Share()), Key("seconds", _SECONDS, 0.5)),
    }


_FIELDS = {"joints": "q", "open": "opening"}  # where a key of the file is called otherwise than the field


def _table(kind: str, keys: tuple[Key, ...]) -> Table:
    def build(values: dict[str, Any], place: Place) -> Move:
        arguments = {_FIELDS.get(name, name): value for name, value in values.items() if name != "kind"}
        move = MOVE_KINDS[kind](**arguments)
        if isinstance(move, JointMove) and not (move.q or move.pose):
            place.refuse(tr("neither joints nor a pose"), tr('joints = […] or pose = "…"'))
        return move

    def parts(move: Move) -> dict[str, Any]:
        return {key.name: getattr(move, _FIELDS.get(key.name, key.name)) for key in keys} | {"kind": kind}

    return Table((Key("kind", Text()), *keys), build, parts)


@dataclass(frozen=True)
class _AnyMove:
    """A table whose key `kind` says which others it may have."""

    robot: Robot

    def read(self, value: Any, place: Place) -> Move:
        """The move."""
        names = tuple(MOVE_KINDS)
        kind = value.get("kind") if isinstance(value, dict) else None
        if not isinstance(kind, str) or kind not in names:
            found = tr("nothing") if kind is None else shown(kind)
            guess = did_you_mean(kind, names) if isinstance(kind, str) else ""
            place.at("key 'kind'").refuse(found, either(names), guess)
        move: Move = self.table(kind).read(value, place)
        return move

    def write(self, value: Move, units: Units) -> str:
        """An inline table."""
        return self.table(kind_of(value)).write(value, units)

    def table(self, kind: str) -> Table:
        """The table of a kind of move."""
        return _table(kind, _keys(self.robot)[kind])


def program_text(program: Program, robot: Robot) -> str:
    """The file of a program for an arm."""
    units, any_move = Units().for_robot(robot.length_unit), _AnyMove(robot)
    lines = [f"version = {VERSION}", f"robot = {Text().write(robot.name, units)}"]
    for move in program:
        present = any_move.table(kind_of(move)).present(move, units)
        lines += ["", "[[move]]", *(f"{key.name} = {key.kind.write(part, inner)}" for key, part, inner in present)]
    return _PREAMBLE.format(length=robot.length_unit) + "\n".join(lines) + "\n"


def moves_kind(robot: Robot) -> Items:
    """The list of an arm's moves, as it stands under "move" in a file."""
    return Items("move", _AnyMove(robot), 0, _MOST_MOVES)


def program_of(text: str, robot: Robot, path: str | Path) -> Program:
    """The program that the text of a file means for an arm; `path` is for messages.

    Raises:
        ProgramFileError: it means none, with the line and the key.
    """
    program: Program = _refused(lambda: _read(tables_of(text, path), robot, Place(str(path), text=text)))
    return program


def save_program(program: Program, robot: Robot, path: str | Path) -> None:
    """Write a program that reads back as the same, whole or not at all.

    Raises:
        OSError: the folder or the file cannot be written.
    """
    write_atomically(Path(path), program_text(program, robot).encode())


def load_program(path: str | Path, robot: Robot) -> Program:
    """The program in a file, for an arm with as many joints as the one it was written for.

    Raises:
        ProgramFileError: the file cannot be read or makes no program.
    """
    text: str = _refused(lambda: text_of(read_bytes(Path(path), _A_FILE), path))
    return program_of(text, robot, path)


def is_program(path: str | Path) -> bool:
    """Whether a TOML file has moves: it may be a broken program still, but it is meant as one."""
    try:
        return "move" in tables_of(text_of(read_bytes(Path(path)), path), path)
    except RobotFileError:
        return False


def _read(tables: dict[str, Any], robot: Robot, place: Place) -> Program:
    whole = Table(
        keys=(
            Key("version", Number("plain", 1, 1e6)),
            Key("robot", Text(), ""),
            Key("move", moves_kind(robot), ()),
        ),
        build=_newer_refused,
        parts=lambda value: value,
        units=lambda _, units: units.for_robot(robot.length_unit),
    )
    program: Program = whole.read(tables, place)
    return program


def _newer_refused(values: dict[str, Any], place: Place) -> Program:
    if values["version"] != VERSION:
        there = place.at("key 'version'")
        there.refuse(f"{values['version']:g}", f"{VERSION}", tr("A newer rvsim may have written it."))
    program: Program = values["move"]
    return program


def _refused(read: Callable[[], Any]) -> Any:
    """Whatever is read; what the readers of robot files refuse is said of a program."""
    try:
        return read()
    except RobotFileError as problem:
        where, found, expected = problem.where, problem.found, problem.expected
        raise ProgramFileError(problem.path, where, found, expected, problem.suggestion) from None
