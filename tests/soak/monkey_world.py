"""The world around the monkey's window, which turns against it: files that cannot be, a full disk, a jumping clock."""

from __future__ import annotations

import os
import random
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import serial.tools.list_ports
from PySide6.QtCore import QCoreApplication, QMimeData, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog

from rvsim import load_robot, robot_names
from rvsim.files import save_robot

ENDINGS = (
    "",
    ".csv",
    ".png",
    ".toml",
    ".gif",
    ".webp",
    ".txt",
    ".py",
    ".jpg",
    ".exe",
    ".CSV",
    ".svg",
    ".pdf",
    ".rvsim",
)
_JUNK = (
    *("", "x,y,z\n1,2,3\n4,5,6\n", "q1;q2\n1,5;nan\n", "1e308,1e308,1e308\n-1e308,0,0\n", "\x00\x01", "{" * 3000),
    *("x\ty\tz\n" + "1\t2\t3\n" * 3000, '{"format": "rvsim session", "version": 99}', "٣,٤,٥\n١,٢,٣\n", "[[joint]]\n"),
)


class World:
    """Temporary folders with files good and bad, and switches for what goes wrong around the program.

    Entered as a context it replaces the file dialogs, the list of serial ports, the browser and `time.time`.
    """

    def __init__(self, folder: Path, hard: bool = True) -> None:
        self.folder, self._hard = folder, hard
        self.dice = random.Random(0)  # another one before each deed, so that a replay finds the same files
        self._saved: list[tuple[Any, str, Any]] = []
        self._jump, self._full = 0.0, False
        self._blocked = folder / "no-folder"
        self._make_files()
        self.use_folder("sound")

    def _make_files(self) -> None:
        (self.folder / "out").mkdir(parents=True, exist_ok=True)
        self._blocked.write_text("a file, where a folder is asked for", encoding="utf-8")
        inputs = self.folder / "in"
        inputs.mkdir(exist_ok=True)
        for number, text in enumerate(_JUNK):
            for ending in (".csv", ".toml", ".rvsim"):
                (inputs / f"junk-{number}{ending}").write_text(text, encoding="utf-8")
        for name in robot_names():
            save_robot(load_robot(name).renamed(f"own-{name}", f"Own {name} عربي"), inputs / f"own-{name}.toml")
        self._inputs = sorted(inputs.iterdir())

    # --- what goes wrong -------------------------------------------------------------------------------------------

    def use_folder(self, kind: str) -> None:
        """The user's folder from now on: "sound", or "blocked", where nothing can be made."""
        place = self.folder / "user" if kind == "sound" else self._blocked / "user"
        os.environ["RVSIM_USER_FOLDER"] = str(place)

    def fill_disk(self, full: bool) -> None:
        """No file can grow beyond a few bytes from now on; only where the system can do that."""
        if not self._hard or sys.platform == "win32":
            return
        import resource

        _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100 if full else hard, hard))
        self._full = full

    @contextmanager
    def room_on_disk(self) -> Iterator[None]:
        """For the soak's own writing."""
        full = self._full
        self.fill_disk(False)
        yield
        self.fill_disk(full)

    def jump_clock(self, seconds: float) -> None:
        """The time of day is another one from now on."""
        self._jump += seconds

    # --- what is asked ---------------------------------------------------------------------------------------------

    def path_to_save(self, *_: Any, **__: Any) -> tuple[str, str]:
        """What the user names: a sound place, one that cannot be written, or nothing."""
        ending = self.dice.choice(ENDINGS)
        sound = str(self.folder / "out" / f"file{self.dice.randrange(5)}{ending}")
        bad = (str(self._blocked / f"x{ending}"), str(self.folder / "none" / "x.csv"), str(self.folder / "out"))
        worse = (f"/proc/rvsim{ending}", str(self.folder / ("x" * 300 + ending)), "")
        return self.dice.choice((sound, sound, sound, *bad, *worse)), ""

    def folder_to_save(self, *_: Any, **__: Any) -> str:
        """A folder that is there, maybe one in which nothing can be written, or none."""
        return self.dice.choice((str(self.folder / "out"), str(self.folder), "/proc", ""))

    def path_to_open(self, *_: Any, **__: Any) -> tuple[str, str]:
        """What the user picks: files good and bad, a folder, nothing."""
        odd = ("", str(self.folder), str(self.folder / "none.toml"), "/proc/self/mem")
        return self.dice.choice((*map(str, self._inputs), *odd)), ""

    def dropped(self) -> QMimeData:
        """What the user drops on the window."""
        data = QMimeData()
        if self.dice.random() < 0.2:
            data.setText("nonsense")
        else:
            data.setUrls([QUrl.fromLocalFile(self.path_to_open()[0]) for _ in range(self.dice.randint(1, 3))])
        return data

    # --- in force --------------------------------------------------------------------------------------------------

    def __enter__(self) -> World:
        real = time.time
        self._put(QFileDialog, "getSaveFileName", staticmethod(self.path_to_save))
        self._put(QFileDialog, "getOpenFileName", staticmethod(self.path_to_open))
        self._put(QFileDialog, "getExistingDirectory", staticmethod(self.folder_to_save))
        self._put(QDesktopServices, "openUrl", staticmethod(lambda *_: True))
        self._put(serial.tools.list_ports, "comports", lambda *_, **__: [])
        self._put(time, "time", lambda: real() + self._jump)
        self._folder = os.getcwd()
        os.chdir(self.folder / "out")
        return self

    def _put(self, owner: Any, name: str, value: Any) -> None:
        self._saved.append((owner, name, vars(owner)[name]))
        setattr(owner, name, value)

    def __exit__(self, *_: object) -> None:
        self.fill_disk(False)
        os.chdir(self._folder)
        for owner, name, value in reversed(self._saved):
            setattr(owner, name, value)
        self._saved.clear()


@contextmanager
def temporary_world(hard: bool = True) -> Iterator[World]:
    """A world in a folder that goes afterwards."""
    before = os.environ.get("RVSIM_USER_FOLDER")
    with tempfile.TemporaryDirectory(prefix="rvsim-soak-", ignore_cleanup_errors=True) as folder:
        try:
            with World(Path(folder), hard) as world:
                yield world
        finally:
            QCoreApplication.processEvents()
            if before is None:
                os.environ.pop("RVSIM_USER_FOLDER", None)
            else:
                os.environ["RVSIM_USER_FOLDER"] = before
