"""Safety copies: every few seconds what has changed goes to the user's folder, so that a crash loses no more than that.

Each process has a copy of its own, named after it, and a lock beside it that goes with the process: nobody takes the
copy of a window that is still open, and two windows that start at once do not both take what a third one left.
"""

from __future__ import annotations

import contextlib
import os
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from rvsim.errors import RvsimError
from rvsim.files import user_folder
from rvsim.files.atomic import write_atomically
from rvsim.files.session_file import ENDING
from rvsim.language import tr

ENVIRONMENT_VARIABLE = "RVSIM_AUTOSAVE_SECONDS"
_SECONDS, _SHORTEST, _LONGEST = 5.0, 0.02, 10.0


def autosave_seconds() -> float:
    """How often a copy is made [s]: what RVSIM_AUTOSAVE_SECONDS says, at most 10."""
    try:
        return min(max(float(os.environ.get(ENVIRONMENT_VARIABLE, _SECONDS)), _SHORTEST), _LONGEST)
    except ValueError:
        return _SECONDS


def autosave_folder() -> Path:
    """Where the copies are."""
    return user_folder() / "autosave"


class Copied(NamedTuple):
    """What a copy is made of: `mark` tells whether it is still the same, `path` is that of the session, if it has one.

    The mark holds frozen values, compared by identity, and words and numbers.
    """

    mark: tuple[object, ...]
    path: Path | None
    data: Callable[[], bytes]


class Autosave(QObject):
    """Asks `wanted` every few seconds: for what is to be copied, or None when there is nothing to lose.

    `failed(sentence)` is said once, until a copy has succeeded again.
    """

    failed = Signal(str)

    def __init__(self, wanted: Callable[[], Copied | None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._wanted = wanted
        self._file: Path | None = None
        self._lock: QLockFile | None = None
        self._mark: tuple[object, ...] | None = None
        self._failing = False
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.tick)

    @property
    def file(self) -> Path | None:
        """Where the copy of this process is, or would be; None before the first one."""
        return self._file

    @property
    def is_made(self) -> bool:
        """Whether there is a copy of this process."""
        return self._mark is not None

    def start(self, seconds: float) -> None:
        """Begin to make copies."""
        self._timer.start(round(1000 * seconds))

    def tick(self) -> None:
        """Make a copy if there is something new; the timer calls this."""
        wanted = self._wanted()
        if wanted is None:
            self.forget()
        elif self._mark is None or not _same(wanted.mark, self._mark):
            self._copy(wanted)

    def forget(self) -> None:
        """There is nothing to lose any more."""
        if self._mark is not None and self._file is not None:
            _remove(self._file)
        self._mark = None

    def close(self) -> None:
        """The window closes as it should."""
        self._timer.stop()
        self.forget()
        if self._lock is not None:
            self._lock.unlock()

    def _copy(self, wanted: Copied) -> None:
        try:
            file = self._place()
            write_atomically(_path_file(file), str(wanted.path or "").encode("utf-8", "replace"), durable=False)
            write_atomically(file, wanted.data(), durable=False)
        except (OSError, RvsimError) as problem:
            reason = getattr(problem, "strerror", None) or str(problem)
            if not self._failing:
                self.failed.emit(tr("No safety copy can be made ({reason}): save your work yourself.", reason=reason))
            self._failing = True
            return
        self._mark, self._failing = wanted.mark, False

    def _place(self) -> Path:
        """The file of this process, its folder there and its lock held."""
        if self._file is None:
            folder = autosave_folder()
            folder.mkdir(parents=True, exist_ok=True)
            file = folder / f"{os.getpid()}-{secrets.token_hex(4)}{ENDING}"
            lock = _lock_of(file)
            if not lock.tryLock(0):
                raise OSError(tr("{folder} cannot be locked", folder=folder))
            self._file, self._lock = file, lock
        return self._file


class Leftover(NamedTuple):
    """A copy whose process has ended without closing; it is locked for this one until `release` or `delete`."""

    file: Path
    original: Path | None
    when: float  # seconds since the epoch
    lock: QLockFile

    def release(self) -> None:
        """Leave it to the next start."""
        self.lock.unlock()

    def delete(self) -> None:
        """It is not needed any more."""
        _remove(self.file)
        self.lock.unlock()


def leftovers() -> tuple[Leftover, ...]:
    """The copies that a crash has left, the newest first; those of open windows are not touched."""
    found = []
    with contextlib.suppress(OSError):
        for file in autosave_folder().glob(f"*{ENDING}"):
            lock = _lock_of(file)
            if not lock.tryLock(0):
                continue
            with contextlib.suppress(OSError):
                found.append(Leftover(file, _original(file), file.stat().st_mtime, lock))
    return tuple(sorted(found, key=lambda leftover: -leftover.when))


def _lock_of(file: Path) -> QLockFile:
    lock = QLockFile(str(file.with_suffix(".lock")))
    lock.setStaleLockTime(0)  # stale when its process is gone, however old it is
    return lock


def _path_file(file: Path) -> Path:
    return file.with_suffix(".path")


def _original(file: Path) -> Path | None:
    try:
        text = _path_file(file).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return None
    return Path(text) if text else None


def _remove(file: Path) -> None:
    for one in (file, _path_file(file)):
        with contextlib.suppress(OSError):
            one.unlink(missing_ok=True)


def _same(mark: tuple[object, ...], other: tuple[object, ...]) -> bool:
    alike = (a is b or (isinstance(a, str | int) and a == b) for a, b in zip(mark, other, strict=False))
    return len(mark) == len(other) and all(alike)
