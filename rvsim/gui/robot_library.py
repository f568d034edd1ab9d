"""The arms on offer: the built-in ones, the user's files, and those made in this session."""

from __future__ import annotations

from pathlib import Path

from rvsim.files import example_names, load_robot, open_robot, robot_names, user_robots
from rvsim.robot import Robot


class RobotLibrary:
    """Arms by name: the built-in ones, the examples and those of the user's folder, each under a name of its own."""

    def __init__(self) -> None:
        self._robots: dict[str, Robot] = {name: load_robot(name) for name in (*robot_names(), *example_names())}
        own = user_robots()
        self.problems = own.problems
        for robot in own.by_file.values():
            self.remember(robot)

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
            UnknownRobotError: no such file.
            RobotFileError: the file makes no arm.
        """
        robot = open_robot(path)
        self.remember(robot)
        return robot
