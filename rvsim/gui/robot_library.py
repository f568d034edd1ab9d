"""The arms on offer: the built-in ones, the user's files, and those made in this session."""

from __future__ import annotations

from pathlib import Path

from rvsim.errors import RobotFileError
from rvsim.files import load_robot, robot_names, user_robot_files
from rvsim.robot import Robot


class RobotLibrary:
    """Arms by name; a file is read when its arm is first asked for, and only then."""

    def __init__(self) -> None:
        self._robots: dict[str, Robot] = {name: load_robot(name) for name in robot_names()}
        self.problems: list[str] = []
        for file in user_robot_files():
            try:
                self.remember(load_robot(file))
            except RobotFileError as problem:
                self.problems.append(str(problem))

    def __getitem__(self, name: str) -> Robot:
        return self._robots[name]

    def __contains__(self, name: object) -> bool:
        return name in self._robots

    @property
    def titles(self) -> dict[str, str]:
        """name → title, the built-in arms first."""
        return {name: robot.title for name, robot in self._robots.items()}

    def remember(self, robot: Robot) -> None:
        """Offer this arm from now on; a younger one of the same name takes its place."""
        self._robots[robot.name] = robot

    def open(self, path: Path) -> Robot:
        """Read a robot file and offer its arm.

        Raises:
            RobotFileError: the file makes no arm.
        """
        robot = load_robot(path)
        self.remember(robot)
        return robot
