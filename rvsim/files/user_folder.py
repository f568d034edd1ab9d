"""The user's own folder: robot files made from the DH table, logs. It is always there, if need be a temporary one."""

from __future__ import annotations

import os
import re
import tempfile
from functools import cache
from pathlib import Path
from typing import NamedTuple

from rvsim.language import tr

ENVIRONMENT_VARIABLE = "RVSIM_USER_FOLDER"


class UserFolder(NamedTuple):
    """A folder that can be written, and why it is not the usual one: a sentence, empty when it is."""

    path: Path
    problem: str = ""


def find_user_folder() -> UserFolder:
    """The folder named by RVSIM_USER_FOLDER, else the system's place for a program's data; made if it is missing.

    Where that cannot be written (a full disk, a locked-down computer) it is a temporary folder, the same one until
    the program ends, and `problem` says so: nothing raises, and the window can tell the user what will be lost.
    """
    wanted = _wanted()
    try:
        wanted.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=wanted):
            return UserFolder(wanted)
    except (OSError, ValueError) as problem:  # ValueError: a zero byte in the variable
        reason = getattr(problem, "strerror", None) or str(problem)
        sentence = tr(
            "{folder} cannot be written ({reason}): what you save is kept only until the computer restarts.",
            folder=wanted,
            reason=reason,
        )
        return UserFolder(_temporary_folder(), sentence)


def user_folder() -> Path:
    """The path of `find_user_folder`."""
    return find_user_folder().path


def user_robot_files() -> tuple[Path, ...]:
    """The user's robot files, by name; the arms in them have not been looked at."""
    return tuple(sorted(_robots().glob("*.toml")))


def user_robot_path(title: str) -> Path:
    """Where an arm of this title is saved: "my RV-M1" becomes robots/my-rv-m1.toml in the user's folder."""
    words = re.findall(r"[\w]+", title.lower())
    return _robots() / f"{'-'.join(words)[:80] or 'robot'}.toml"


def _robots() -> Path:
    return user_folder() / "robots"


def _wanted() -> Path:
    named = os.environ.get(ENVIRONMENT_VARIABLE)
    if named:
        return Path(named)
    import platformdirs  # imported when needed: `import rvsim` stays fast

    return platformdirs.user_data_path("rvsim", appauthor=False)


@cache
def _temporary_folder() -> Path:
    return Path(tempfile.mkdtemp(prefix="rvsim-"))
