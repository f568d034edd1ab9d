"""The user's own arm: the copy that the first edit makes, and its way to and from a robot file."""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from rvsim.errors import RvsimError
from rvsim.files import named_after, open_robot, robot_names, save_robot, user_robot_files, user_robot_path, user_robots
from rvsim.gui.session import Session
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.edits import OWN_PREFIX, copied_source, original_name

_FILTER = tr_later("Robot files (*.toml)")


def is_own(robot: Robot) -> bool:
    """Whether this arm is the user's own already."""
    return original_name(robot) != robot.name


def own_copy(robot: Robot) -> Robot:
    """The same arm as "my RV-M1", its source saying where it comes from; an own arm as it is.

    Where one of that name has been saved it is "my RV-M1 (2)": a new copy hides none.
    """
    if is_own(robot):
        return robot
    taken = {file.stem for file in user_robot_files()} | {arm.name for arm in user_robots().by_file.values()}
    name, title = f"{OWN_PREFIX}{robot.name}", f"my {short_title(robot)}"
    number = next(number for number in count(1) if _numbered(name, "-{}", number) not in taken)
    copy = robot.renamed(_numbered(name, "-{}", number), _numbered(title, " ({})", number))
    return replace(copy, source=f"edited {copied_source(robot)}")


def _numbered(text: str, ending: str, number: int) -> str:
    return text if number == 1 else text + ending.format(number)


def short_title(robot: Robot) -> str:
    """The title without its maker: "RV-M1" of "Mitsubishi RV-M1"; else the title as it is within a sentence."""
    first, *rest = robot.title.split()
    if rest and rest[-1].lower() == robot.name.lower():
        return rest[-1]
    return " ".join([first.lower() if first.istitle() else first, *rest])


def ask_where_to_save(parent: QWidget, robot: Robot) -> Path | None:
    """The file that the user chooses, or None; offered is the user's own folder."""
    offered = _offered(robot)
    folder = offered.parent
    # The folder is made when it can be: the dialog falls back to the home folder by itself.
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        offered = Path.home() / offered.name
    chosen, _ = QFileDialog.getSaveFileName(parent, tr("Save as robot file"), str(offered), tr(_FILTER))
    return Path(chosen) if chosen else None


def ask_what_to_open(parent: QWidget, robot: Robot) -> Path | None:
    """The robot file that the user chooses, or None."""
    folder = user_robot_path(robot.title).parent
    chosen, _ = QFileDialog.getOpenFileName(parent, tr("Open robot file"), str(folder), tr(_FILTER))
    return Path(chosen) if chosen else None


def _offered(robot: Robot) -> Path:
    return user_robot_path(robot.title if robot.name in robot_names() else robot.name)


def saved(session: Session, path: Path) -> tuple[bool, str]:
    """Save the session's arm: whether it went well, and the sentence that says so.

    In a file of another name the arm is named after the file, and the session goes on with that arm.
    """
    path = path if path.suffix else path.with_suffix(".toml")
    robot = named_after(session.at_rest.robot, path)
    try:
        save_robot(robot, path)
    except RvsimError as problem:
        return False, str(problem)
    except OSError as problem:
        return False, tr(
            "Not saved: {path} cannot be written ({reason}).", path=path, reason=problem.strerror or problem
        )
    shown = named_after(session.robot, path)  # its limits are narrower while an arm is connected
    if shown is not session.robot:
        session.edit(tr("Save as {name}", name=path.name), session.experiment.with_robot(shown))
    return True, tr("Saved {robot} as {path}.", robot=tr(robot.title), path=path)


def opened(path: Path) -> tuple[Robot | None, str]:
    """Open a robot file: its arm, or None and the sentence that says why not."""
    try:
        robot = open_robot(path)
    except RvsimError as problem:
        return None, str(problem)
    return robot, tr("Opened {robot} from {path}.", robot=tr(robot.title), path=path)
