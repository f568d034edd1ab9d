"""The arms of the user's folder, each under a name and a title of its own: no file hides another one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import NamedTuple

from rvsim.errors import RobotFileError
from rvsim.files.robot_file import load_robot, robot_names
from rvsim.files.user_folder import user_robot_files
from rvsim.robot import Robot
from rvsim.robot.edits import copied_source

_LONGEST_NAME, _LONGEST_TITLE, _LONGEST_SOURCE = 60, 80, 2000  # as the robot file has them


class UserRobots(NamedTuple):
    """The arm of each file, and a sentence for each file that makes none."""

    by_file: dict[Path, Robot]
    problems: tuple[str, ...]


def user_robots() -> UserRobots:
    """Read every robot file of the user's folder."""
    found: dict[Path, Robot] = {}
    problems = []
    for file in user_robot_files():
        try:
            found[file] = _distinct(load_robot(file), file, found.values())
        except RobotFileError as problem:
            problems.append(str(problem))
    return UserRobots(found, tuple(problems))


def open_robot(path: Path) -> Robot:
    """The arm of a robot file, wherever it is; if its name is that of another arm, it gets one from its file's name.

    Raises:
        UnknownRobotError: no such file.
        RobotFileError: the file cannot be read or makes no arm.
    """
    robot = load_robot(path)
    arms = user_robots().by_file
    known = next((arm for file, arm in arms.items() if path.exists() and file.samefile(path)), None)
    return known or (_distinct(robot, path, arms.values()) if path.exists() else robot)


def named_after(robot: Robot, path: Path) -> Robot:
    """The arm as it is saved in this file: under the file's name, "longarm", and as "longarm (my RV-M1)".

    In the file "my_rv-m1" it is just that: its title would say the same twice.
    A file that has its name already, or is the one offered for it, changes nothing.
    """
    stem = path.stem[:_LONGEST_NAME]
    builtin = robot.name in robot_names()
    if stem.lower() == robot.name.lower() and not builtin:
        return robot
    name = stem.lower() if stem.lower() not in robot_names() else f"my-{stem.lower()}"[:_LONGEST_NAME]
    title = robot.title.removesuffix(")").partition(" (")[2] if _is_named_after_a_file(robot) else robot.title
    renamed = robot.renamed(name, stem if _spelt_alike(stem, title) else _title(stem, title))
    return replace(renamed, source=copied_source(robot)[:_LONGEST_SOURCE]) if builtin else renamed


def _spelt_alike(one: str, other: str) -> bool:
    """Whether they differ by capitals, spaces and signs alone."""
    first, second = ("".join(filter(str.isalnum, text)).casefold() for text in (one, other))
    return first == second


def _is_named_after_a_file(robot: Robot) -> bool:
    return robot.title.lower().startswith(f"{robot.name.lower()} (") and robot.title.endswith(")")


def _distinct(robot: Robot, file: Path, others: Iterable[Robot]) -> Robot:
    """The arm under a name that neither a built-in arm nor one of the others has, and a title none of them has."""
    arms = tuple(others)
    names = {*robot_names(), *(arm.name.lower() for arm in arms)}
    name = next(name for name in _candidates(robot, file) if name.lower() not in names)
    if name == robot.name and robot.title not in {arm.title for arm in arms}:
        return robot
    return robot.renamed(name, _title(robot.title, file.name))


def _candidates(robot: Robot, file: Path) -> Iterator[str]:
    yield robot.name
    yield file.stem
    yield f"{robot.name}-{file.stem}"
    yield from (f"{file.stem}-{number}" for number in count(2))


def _title(text: str, addition: str) -> str:
    """ "text (addition)", as long as a title may be."""
    room = _LONGEST_TITLE - len(addition) - 3
    return f"{text[: max(room, 20)]} ({addition})"[:_LONGEST_TITLE]
