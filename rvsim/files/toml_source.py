"""The bytes of a TOML file, and the one clear error when they are none."""

from __future__ import annotations

import stat
import tomllib
from pathlib import Path
from typing import Any

from rvsim.errors import RobotFileError

LARGEST = 256 * 1024  # [bytes]; the largest of our own has a twentieth of it
_AS_UTF8 = "Save it as UTF-8 text."


def read_toml(path: Path) -> dict[str, Any]:
    """The tables of a TOML file.

    Raises:
        RobotFileError: it cannot be opened, is no regular file, is too large, is no UTF-8 or no TOML.
    """
    return tables_from(path, _bytes_of(path))


def tables_from(path: object, data: bytes) -> dict[str, Any]:
    """The tables that the bytes of a TOML file hold; `path` is for the message.

    Raises:
        RobotFileError: they are too many, no UTF-8 or no TOML.
    """
    if len(data) > LARGEST:
        raise RobotFileError(path, "the file", "a large file", f"at most {LARGEST // 1024} kB of text")
    try:
        return tomllib.loads(_text_of(path, data))
    except RecursionError:
        raise RobotFileError(path, "the file", "lists nested too deeply", "tables of plain keys") from None
    except ValueError as problem:  # a TOMLDecodeError, or Python's refusal of an integer of thousands of digits
        raise RobotFileError(path, *_syntax(str(problem)), "Texts stand in quotes, lists in brackets.") from None


def _bytes_of(path: Path) -> bytes:
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            found = "a folder" if path.is_dir() else "something that is no file"
            raise RobotFileError(path, "the file", found, "a robot file (.toml)")
        with path.open("rb") as file:
            return file.read(LARGEST + 1)
    except (OSError, ValueError) as problem:
        if isinstance(problem, RobotFileError):
            raise
        reason = problem.strerror if isinstance(problem, OSError) and problem.strerror else str(problem)
        raise RobotFileError(path, "the file", reason.lower(), "a file that can be read") from None


def _text_of(path: object, data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise RobotFileError(path, "the file", "UTF-16 text", "UTF-8 text", _AS_UTF8)
    try:
        return data.decode("utf-8-sig")  # some editors put a mark before the first letter
    except UnicodeDecodeError as problem:
        line = data.count(b"\n", 0, problem.start) + 1
        found = f"the byte 0x{data[problem.start]:02x}"
        raise RobotFileError(path, f"line {line}", found, "UTF-8 text", _AS_UTF8) from None


def _syntax(message: str) -> tuple[str, str, str]:
    # tomllib says "Invalid value (at line 3, column 9)".
    what, _, place = message.partition(" (at ")
    return place.rstrip(")") or "the file", what[:1].lower() + what[1:], "TOML"
