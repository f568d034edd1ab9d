"""The text of a session file: JSON with one value a line, and strict reading that ends in a value or a clear error."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

from rvsim.errors import SessionFileError
from rvsim.files.file_words import cut_off, empty, too_large
from rvsim.language import tr, tr_later

LARGEST = 16 * 1024 * 1024  # [bytes]
_MOST_LISTS, _MOST_VALUES = 200_000, 2_000_000
_LINE = 110
_OLDER = tr_later("Look for another copy of it.")
_SPEAKS = tr_later("A session file of rvsim is JSON text in UTF-8.")


# --- writing -------------------------------------------------------------------------------------------------------


def json_text(value: Any) -> str:
    """The document as text: keys in their order, numbers exact, items of a list on one line where they fit."""
    text = "\n".join(_lines(value, "", is_item=False)) + "\n"
    # Half a character, as a paste may bring it, is no text that can be stored.
    return text.encode("utf-8", "replace").decode("utf-8")


def _lines(value: Any, indent: str, *, is_item: bool) -> Iterator[str]:
    compact = json.dumps(value, ensure_ascii=False)
    if not value or not isinstance(value, dict | list) or (_is_flat(value, is_item) and len(compact) <= _LINE):
        yield compact
        return
    is_table = isinstance(value, dict)
    inner, (opening, closing) = indent + "  ", "{}" if is_table else "[]"
    yield opening
    parts = _labelled(value)
    for number, (label, part) in enumerate(parts, 1):
        first, *rest = _lines(part, inner, is_item=not is_table)
        comma = "," if number < len(parts) else ""
        lines = [f"{inner}{label}{first}", *rest]
        yield from (*lines[:-1], lines[-1] + comma)
    yield indent + closing


def _labelled(value: dict[str, Any] | list[Any]) -> list[tuple[str, Any]]:
    if isinstance(value, dict):
        return [(f"{json.dumps(key, ensure_ascii=False)}: ", part) for key, part in value.items()]
    return [("", part) for part in value]


def _is_flat(value: dict[str, Any] | list[Any], is_item: bool) -> bool:
    """Whether it may stand on one line: numbers, and items of a list that hold nothing but numbers and words."""
    if isinstance(value, list):
        return not any(isinstance(part, dict | list | str) for part in value)
    return is_item and all(not isinstance(part, dict) and _is_plain(part) for part in value.values())


def _is_plain(part: Any) -> bool:
    return not isinstance(part, list) or not any(isinstance(item, dict | list) for item in part)


# --- reading -------------------------------------------------------------------------------------------------------


def json_value(data: bytes, path: object) -> Any:
    """What the bytes mean; `path` is for the message.

    Raises:
        SessionFileError: they are too many, no UTF-8, no JSON, or JSON with a key twice or half a character.
    """
    text = _text(data, path)
    try:
        value = json.loads(text, object_pairs_hook=_without_doubles, parse_constant=_refuse_constant)
    except RecursionError:
        raise SessionFileError(path, tr("the file"), tr("lists nested too deeply"), tr("a session")) from None
    except json.JSONDecodeError as problem:
        if _ends_too_early(text, problem):
            line = text.rstrip().count("\n") + 1
            raise SessionFileError(path, tr("the file"), cut_off(path, line), "", tr(_OLDER)) from None
        where = tr("line {line}, column {column}", line=problem.lineno, column=problem.colno)
        found = tr("a mistake ({mistake})", mistake=problem.msg)
        raise SessionFileError(path, where, found, "JSON", tr(_SPEAKS)) from None
    except ValueError as problem:  # of ours, or Python's refusal of an integer of thousands of digits
        found = str(problem) if isinstance(problem, _MistakeError) else tr("an integer of thousands of digits")
        raise SessionFileError(path, tr("the file"), found, tr("JSON with plain numbers and each key once")) from None
    _refuse_half_characters(text, value, path)
    return value


def _ends_too_early(text: str, problem: json.JSONDecodeError) -> bool:
    """Whether the document stops before its last bracket; one with something behind that bracket does not."""
    whole = text.strip()
    return whole.startswith("{") and problem.msg != "Extra data" and (
        problem.pos >= len(text.rstrip()) or not whole.endswith("}")
    )  # fmt: skip


class _MistakeError(ValueError):
    """What JSON's own reader would let pass."""


def _text(data: bytes, path: object) -> str:
    if len(data) > LARGEST:
        raise SessionFileError(path, tr("the file"), too_large(path, LARGEST), "")
    if not data.strip():
        raise SessionFileError(path, tr("the file"), empty(path), "", tr(_OLDER))
    if data.count(b"[") + data.count(b"{") > _MOST_LISTS or data.count(b",") > _MOST_VALUES:
        raise SessionFileError(path, tr("the file"), tr("hundreds of thousands of lists"), tr("a session"))
    try:
        return data.decode("utf-8-sig")  # some editors put a mark before the first letter
    except UnicodeDecodeError as problem:
        line = data.count(b"\n", 0, problem.start) + 1
        where, found = tr("line {number}", number=line), tr("the byte 0x{byte:02x}", byte=data[problem.start])
        raise SessionFileError(path, where, found, tr("UTF-8 text"), tr(_SPEAKS)) from None


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise _MistakeError(tr("the key {key!r} twice", key=twice[:60]))
    return table


def _refuse_constant(name: str) -> float:
    raise _MistakeError(tr("the number {name}", name=name))


def _refuse_half_characters(text: str, value: Any, path: object) -> None:
    if "\\ud" not in text.lower():
        return
    try:
        json.dumps(value, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        raise SessionFileError(
            path, tr("the file"), tr("half of a character (\\ud800 to \\udfff)"), tr("whole ones")
        ) from None


def finite(value: int | float) -> float:
    """The number as a float; infinite where it is too large for one."""
    try:
        return float(value)
    except OverflowError:
        return math.inf
