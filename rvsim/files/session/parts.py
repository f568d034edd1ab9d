"""The arm and the program inside a session file: the tables of robot and program files, as JSON.

A built-in arm as it came stands there by its name, with the tool in use; any other one whole. Angles there are
degrees, lengths millimetres, as in a file of their own.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from rvsim.errors import UnknownNameError, did_you_mean
from rvsim.experiment.program import Program
from rvsim.files.place import Place, Units, shown
from rvsim.files.program_file import moves_kind, program_text
from rvsim.files.robot_file import example_names, load_robot, robot_names
from rvsim.files.robot_format import ROBOT
from rvsim.files.robot_writer import robot_text
from rvsim.files.session.place import SessionPlace
from rvsim.language import tr
from rvsim.robot import Robot

_SETTLING = 8  # times that rounding to the shortest decimals may find still shorter ones


@dataclass(frozen=True)
class RobotKind:
    """An arm: `{"name": …, "tool": …}` or `{"file": …}`."""

    def read(self, value: Any, place: Place) -> Robot:
        """The arm, one object for all that are the same built-in one."""
        if not isinstance(value, dict) or ("name" in value) == ("file" in value):
            place.refuse(
                shown(value), tr('the name of a built-in arm, {"name": "rv-m1"}, or its robot file, {"file": …}')
            )
        if "file" in value:
            return _embedded(value["file"], place.at("file"))
        return _built_in(value["name"], value.get("tool"), place)

    def plain(self, value: Robot) -> dict[str, Any]:
        """By its name where that says it all."""
        return dict(_plain_robot(value))


def _embedded(tables: Any, place: Place) -> Robot:
    robot: Robot = ROBOT.read(tables, place)
    if not robot.name:
        place.at("name").refuse(tr("nothing"), tr("the arm's short name"))
    return robot


def _built_in(name: Any, tool: Any, place: Place) -> Robot:
    known = (*robot_names(), *example_names())
    if not isinstance(name, str) or name not in known:  # a path would be taken for a file
        place.at("name").refuse(shown(name), tr("a built-in arm"), did_you_mean(str(name)[:100], known))
    if not isinstance(tool, str | None):
        place.at("tool").refuse(shown(tool), tr("the name of a tool"))
    try:
        return shipped(name, tool or "")
    except UnknownNameError as problem:
        place.at("tool").refuse(shown(tool), tr("a tool of this arm"), str(problem))


@lru_cache(maxsize=64)
def shipped(name: str, tool: str = "") -> Robot:
    """A built-in arm with one of its tools, "" for its first; the same object each time."""
    if not tool:
        return load_robot(name)
    robot = shipped(name)
    return robot if robot.tool_name == tool else robot.with_tool(tool)


@lru_cache(maxsize=32)
def _plain_robot(robot: Robot) -> dict[str, Any]:
    if robot.name in (*robot_names(), *example_names()):
        built_in = shipped(robot.name)
        if robot.tool_name == built_in.tool_name and robot_text(robot) == robot_text(built_in):
            return {"name": robot.name}
        held = {tool.name for tool in built_in.tools}
        if robot.tool_name in held and robot_text(robot.with_tool(built_in.tool_name)) == robot_text(built_in):
            return {"name": robot.name, "tool": robot.tool_name}
    return {"file": _settled(tomllib.loads(robot_text(robot)), _rewritten_robot)}


def _rewritten_robot(tables: dict[str, Any]) -> dict[str, Any]:
    return tomllib.loads(robot_text(ROBOT.read(tables, _here("robot", "file"))))


def _here(*steps: str) -> SessionPlace:
    return SessionPlace(tr("this experiment"), steps)


def _settled(tables: Any, rewritten: Callable[[Any], Any]) -> Any:
    """What does not change any more when it is read and written: the shortest decimals of the shortest decimals."""
    for _ in range(_SETTLING):
        before, tables = tables, rewritten(tables)
        if tables == before:
            break
    return tables


def plain_program(program: Program, robot: Robot) -> list[Any]:
    """The moves as they stand in a program file."""
    if not program:
        return []

    def rewritten(moves: list[Any]) -> list[Any]:
        return _moves(read_program(moves, robot, _here("program")), robot)

    settled: list[Any] = _settled(_moves(program, robot), rewritten)
    return settled


def _moves(program: Program, robot: Robot) -> list[Any]:
    moves: list[Any] = tomllib.loads(program_text(program, robot)).get("move", [])
    return moves


def read_program(value: Any, robot: Robot, place: Place) -> Program:
    """The program of an arm."""
    program: Program = moves_kind(robot).read(value, place.at("move").with_units(Units().for_robot(robot.length_unit)))
    return program
