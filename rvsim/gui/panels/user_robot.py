"""The user's own arm: the copy that the first edit makes, and its way to and from a robot file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from rvsim.errors import RvsimError
from rvsim.files import load_robot, save_robot, user_robot_path
from rvsim.robot import Robot
from rvsim.robot.edits import OWN_PREFIX

_FILTER = "Robot files (*.toml)"


def is_own(robot: Robot) -> bool:
    """Whether this arm is the user's own already."""
    return robot.name.startswith(OWN_PREFIX)


def own_copy(robot: Robot) -> Robot:
    """The same arm as "my RV-M1", its source saying where it comes from; an own arm as it is."""
    if is_own(robot):
        return robot
    source = f"edited copy of {robot.title}" + (f"; {robot.source}" if robot.source else "")
    return replace(robot.renamed(f"{OWN_PREFIX}{robot.name}", f"my {short_title(robot)}"), source=source)


def short_title(robot: Robot) -> str:
    """The title without its maker: "RV-M1" of "Mitsubishi RV-M1"; else the title as it is within a sentence."""
    first, *rest = robot.title.split()
    if rest and rest[-1].lower() == robot.name.lower():
        return rest[-1]
    return " ".join([first.lower() if first.istitle() else first, *rest])


def ask_where_to_save(parent: QWidget, robot: Robot) -> Path | None:
    """The file that the user chooses, or None; offered is the user's own folder."""
    offered = user_robot_path(robot.title)
    folder = offered.parent
    # The folder is made when it can be: the dialog falls back to the home folder by itself.
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        offered = Path.home() / offered.name
    chosen, _ = QFileDialog.getSaveFileName(parent, "Save as robot file", str(offered), _FILTER)
    return Path(chosen) if chosen else None


def ask_what_to_open(parent: QWidget, robot: Robot) -> Path | None:
    """The robot file that the user chooses, or None."""
    folder = user_robot_path(robot.title).parent
    chosen, _ = QFileDialog.getOpenFileName(parent, "Open robot file", str(folder), _FILTER)
    return Path(chosen) if chosen else None


def saved(robot: Robot, path: Path) -> tuple[bool, str]:
    """Save an arm: whether it went well, and the sentence that says so."""
    path = path if path.suffix else path.with_suffix(".toml")
    try:
        save_robot(robot, path)
    except RvsimError as problem:
        return False, str(problem)
    except OSError as problem:
        return False, f"Not saved: {path} cannot be written ({problem.strerror or problem})."
    return True, f"Saved {robot.title} as {path}."


def opened(path: Path) -> tuple[Robot | None, str]:
    """Open a robot file: its arm, or None and the sentence that says why not."""
    try:
        robot = load_robot(path)
    except RvsimError as problem:
        return None, str(problem)
    return robot, f"Opened {robot.title} from {path}."
