"""Session files (.rvsim): one JSON document that holds an experiment whole. They are read strictly and run nothing.

Numbers come back exactly (those of an arm or a program of one's own within 1e-12), and what is saved again unchanged
has the same bytes.
"""

from __future__ import annotations

import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from rvsim.errors import FileWriteError, SessionFileError
from rvsim.experiment import SessionState
from rvsim.files.atomic import write_atomically
from rvsim.files.file_words import unread
from rvsim.files.place import shown
from rvsim.files.session.json_text import LARGEST, json_text, json_value
from rvsim.files.session.migrations import MIGRATIONS, VERSION, Migration, migrated, version_of
from rvsim.files.session.place import SessionPlace
from rvsim.files.session.tables import FORMAT, HEAD, SESSION, head
from rvsim.language import tr, trn

ENDING = ".rvsim"


class OpenedSession(NamedTuple):
    """What a file holds; `notice` is a sentence worth saying (or empty), `read_only` that it must not be replaced."""

    state: SessionState
    notice: str = ""
    read_only: bool = False


def session_bytes(state: SessionState, path: object = "") -> bytes:
    """The file of a session; it can be read again, or this raises. `path` is for the message.

    Raises:
        SessionFileError: a value in it that no file may hold.
    """
    path = path or tr("this session")
    plain = SESSION.plain(state)
    SESSION.read(plain, SessionPlace(str(path)))
    data = json_text({**head(VERSION), **plain}).encode()
    if len(data) > LARGEST:
        raise SessionFileError(
            path, tr("the file"), trn("{n} byte", "{n} bytes", len(data)), tr("at most {most} bytes", most=LARGEST)
        )
    return data


def session_of(
    data: bytes,
    path: object,
    migrations: Mapping[int, Migration] = MIGRATIONS,
    current: int = VERSION,
) -> OpenedSession:
    """The session that the bytes of a file mean; `path` is for the message.

    Raises:
        SessionFileError: they mean none, with the place and what is expected there.
    """
    document = json_value(data, path)
    place = SessionPlace(str(path))
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        found = shown(document.get("format")) if isinstance(document, dict) else shown(document)
        place.at("format").refuse(found, f"{FORMAT!r}", tr("Robot files (.toml) are opened as such."))
    version = version_of(document, place)
    newer = version > current
    plain = migrated(document, place, migrations, current)
    body = {key: part for key, part in plain.items() if key not in HEAD}
    state = SESSION.read(body, SessionPlace(str(path), newer=newer))
    return OpenedSession(state, _notice(path, version, current), newer)


def _notice(path: object, version: int, current: int) -> str:
    name = Path(str(path)).name
    if version > current:
        return tr(
            "{name} was written by a newer rvsim (version {version} of the format, {current} is known here): what "
            "is unknown is left out, and the file is not replaced. Save what you change under another name.",
            name=name,
            version=version,
            current=current,
        )
    if version < current:
        return tr(
            "{name} is of an older rvsim (version {version} of the format); saved, it will be of version {current}.",
            name=name,
            version=version,
            current=current,
        )
    return ""


def load_session(path: str | Path) -> OpenedSession:
    """The session in a file.

    Raises:
        SessionFileError: the file cannot be read or holds no session.
    """
    return session_of(_bytes_of(Path(path)), path)


def save_session(state: SessionState, path: str | Path, *, durable: bool = True) -> None:
    """Write a session, whole or not at all; the old file stays until then.

    Args:
        state: what is written.
        path: of the file; its folder must be there.
        durable: wait until the disk has it: it is then there after a power cut too.

    Raises:
        SessionFileError: a value in it that no file may hold.
        FileWriteError: the folder or the file cannot be written.
    """
    data = session_bytes(state, path)
    try:
        write_atomically(Path(path), data, durable=durable)
    except (OSError, ValueError) as problem:  # ValueError: a zero byte in the name
        raise FileWriteError(path, _reason(problem)) from None


def _bytes_of(path: Path) -> bytes:
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            found = tr("a folder") if path.is_dir() else tr("something that is no file")
            raise SessionFileError(path, tr("the file"), found, tr("a session file ({ending})", ending=ENDING))
        with path.open("rb") as file:
            return file.read(LARGEST + 1)
    except (OSError, ValueError) as problem:
        if isinstance(problem, SessionFileError):
            raise
        raise SessionFileError(path, tr("the file"), unread(path, problem), "") from None


def _reason(problem: Exception) -> str:
    text: Any = getattr(problem, "strerror", None) or str(problem)
    return str(text).lower()
