"""The text of a TOML file, and the one clear error when it has none."""

from __future__ import annotations

import re
import stat
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rvsim.errors import RobotFileError
from rvsim.files.file_words import empty, too_large, unread
from rvsim.language import tr, tr_later

LARGEST = 256 * 1024  # [bytes]; the largest of our own has a twentieth of it
_AS_UTF8 = tr_later("Save it as UTF-8 text.")
_NOWHERE = r"(?!)"


def read_bytes(path: Path, kind: str = tr_later("a robot file (.toml)")) -> bytes:
    """What is in a file, and never more than just too much of it; `kind` is for messages, what it should be.

    Raises:
        RobotFileError: it cannot be opened, is no regular file, or is empty.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            found = tr("a folder") if path.is_dir() else tr("something that is no file")
            raise RobotFileError(path, tr("the file"), found, tr(kind))
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as problem:
        raise RobotFileError(path, tr("the file"), unread(path, problem), "") from None
    if not data.strip():
        raise RobotFileError(path, tr("the file"), empty(path), "")
    return data


def text_of(data: bytes, path: object) -> str:
    """The bytes as text; `path` is for the message.

    Raises:
        RobotFileError: they are too many or no UTF-8.
    """
    if len(data) > LARGEST:
        raise RobotFileError(path, tr("the file"), too_large(path, LARGEST), "")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise RobotFileError(path, tr("the file"), tr("UTF-16 text"), tr("UTF-8 text"), tr(_AS_UTF8))
    try:
        return data.decode("utf-8-sig")  # some editors put a mark before the first letter
    except UnicodeDecodeError as problem:
        line = data.count(b"\n", 0, problem.start) + 1
        where, found = tr("line {number}", number=line), tr("the byte 0x{byte:02x}", byte=data[problem.start])
        raise RobotFileError(path, where, found, tr("UTF-8 text"), tr(_AS_UTF8)) from None


def tables_of(text: str, path: object) -> dict[str, Any]:
    """The tables of a TOML text; `path` is for the message.

    Raises:
        RobotFileError: it is no TOML.
    """
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise RobotFileError(path, tr("the file"), tr("lists nested too deeply"), tr("tables of plain keys")) from None
    except ValueError as problem:  # a TOMLDecodeError, or Python's refusal of an integer of thousands of digits
        raise RobotFileError(path, *_syntax(str(problem)), tr("Texts stand in quotes, lists in brackets.")) from None


def line_of(text: str, steps: Sequence[str]) -> int:
    """The line of a place such as ("joint 3", "key 'alpha'"), as near as it can be told; 0 if it cannot."""
    lines, found = text.splitlines(), -1
    for step in steps:
        nearer = _line_of_step(lines, found + 1, step)
        if nearer < 0:
            break
        found = nearer
    return found + 1


def _line_of_step(lines: list[str], start: int, step: str) -> int:
    if step.startswith("key "):
        name = re.escape(step[5:-1])
        return _nth(rf"\s*({name}\s*=|\[+\s*{name}\s*\])", lines, start, 1, until=r"\s*\[" if start else _NOWHERE)
    name, _, digits = step.partition(" ")
    return _nth(rf"\s*\[+\s*{re.escape(name)}\s*\]", lines, start, int(digits) if digits.isdecimal() else 1)


def _nth(pattern: str, lines: list[str], start: int, number: int, until: str = _NOWHERE) -> int:
    for index in range(start, len(lines)):
        number -= bool(re.match(pattern, lines[index]))
        if number == 0:
            return index
        if re.match(until, lines[index]):
            break
    return -1


def _syntax(message: str) -> tuple[str, str, str]:
    # tomllib says "Invalid value (at line 3, column 9)"; Python alone speaks of the digits.
    what, _, place = message.partition(" (at ")
    what = tr("an integer has thousands of digits") if "digits" in what else what[:1].lower() + what[1:]
    found = re.fullmatch(r"line (\d+), column (\d+)\)", place)
    where = tr("line {line}, column {column}", line=found[1], column=found[2]) if found else place.rstrip(")")
    return where or tr("the file"), tr("a mistake ({mistake})", mistake=what), "TOML"
