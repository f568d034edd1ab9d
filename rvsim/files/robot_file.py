"""Robot files: the built-in arms and the user's own, read and written. resources/help/robot-file.md explains them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from rvsim.errors import RobotDefinitionError, RobotFileError, UnknownRobotError
from rvsim.files.atomic import write_atomically
from rvsim.files.place import Place
from rvsim.files.robot_format import ROBOT
from rvsim.files.robot_writer import robot_text
from rvsim.files.toml_source import read_bytes, tables_of, text_of
from rvsim.files.user_folder import user_robot_path
from rvsim.language import tr
from rvsim.resources import resource
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SOURCES = ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b")
_EXAMPLES = ("al5a", "al5d")
_TEXTBOOK = ("planar", "articulated", "spherical", "scara", "cylindrical", "cartesian")


def robot_names() -> tuple[str, ...]:
    """The names of the built-in arms: those of the sources first, then the textbook arms."""
    return _SOURCES + _TEXTBOOK


def example_names() -> tuple[str, ...]:
    """Arms that come as examples of robot files; `load_robot` knows their names too."""
    return _EXAMPLES


def load_robot(name_or_path: str | Path) -> Robot:
    """A built-in arm by its name, in capitals or not, the arm of a robot file by its path, or a saved one by its name.

    The files of the user's folder are looked at only when it is neither of the former.

    Raises:
        UnknownRobotError: neither a name nor a file that exists.
        RobotFileError: the file cannot be read or makes no arm.
    """
    name = name_or_path.strip().lower() if isinstance(name_or_path, str) else ""
    for folder, names in (("robots", robot_names()), ("examples", _EXAMPLES)):
        if name in names:
            path = resource(folder, f"{name}.toml")
            return _built_in(read_bytes(path), path)
    path = Path(name_or_path)
    return robot_from_bytes(read_bytes(path), path) if _exists(path) else _own_by_name(str(name_or_path))


@cache  # all of an arm is frozen; each window has all of them, and to understand them took a quarter of its start
def _built_in(data: bytes, path: Path) -> Robot:
    return robot_from_bytes(data, path)


def _own_by_name(name: str) -> Robot:
    from rvsim.files.user_arms import user_robots  # it reads its files with this module

    arms = {robot.name.lower(): robot for robot in user_robots().by_file.values()}
    robot = arms.get(name.strip().lower())
    if robot is None:
        raise UnknownRobotError(name, (*robot_names(), *_EXAMPLES, *(arm.name for arm in arms.values())))
    return robot


def robot_from_bytes(data: bytes, path: str | Path) -> Robot:
    """The arm that the bytes of a robot file mean; `path` is for messages, and names an arm that has no name.

    Raises:
        RobotFileError: they make no arm.
    """
    text = text_of(data, path)
    robot: Robot = ROBOT.read(tables_of(text, path), Place(str(path), text=text))
    return robot if robot.name else replace(robot, name=Path(path).stem)


def save_robot(robot: Robot, path: str | Path) -> None:
    """Write a robot file that reads back as the same arm, whole or not at all; of all folders only the user's is made.

    Raises:
        RobotDefinitionError: the arm has values that no robot file may hold.
        OSError: the folder cannot be written.
    """
    data = robot_text(robot).encode()
    try:
        reread = robot_from_bytes(data, path)
    except RobotFileError as problem:
        what = tr(
            "cannot be saved: {where}: found {found}, expected {expected}.",
            where=problem.where,
            found=problem.found,
            expected=problem.expected,
        )
        raise RobotDefinitionError(robot.name, what) from None
    _check_same(robot, reread)
    _make_if_the_users(Path(path).parent)
    write_atomically(Path(path), data)


def _make_if_the_users(folder: Path) -> None:
    if not folder.exists() and folder == user_robot_path("").parent:
        folder.mkdir(parents=True)


def _check_same(robot: Robot, reread: Robot) -> None:
    # A file says rotations as three angles and inertias as six numbers: a skewed matrix would come back as another.
    for before, after in zip(_matrices(robot), _matrices(reread), strict=True):
        if not np.allclose(before, after, rtol=0.0, atol=1e-9):
            raise RobotDefinitionError(
                robot.name, tr("cannot be saved: a matrix of its base, tools or masses is skewed.")
            )


def _matrices(robot: Robot) -> list[FloatArray]:
    return [robot.T_base_0, *(tool.T_flange_tool for tool in robot.tools), *(link.inertia for link in robot.masses)]


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name too long, or with a zero byte
        return False
