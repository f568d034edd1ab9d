"""Brings the catalogues resources/languages/*.po up to date with the texts in the code, and says what is missing.

A text is the first argument of `tr` or `tr_later`, or the first two of `trn` (rvsim/language.py), written as a literal.
What the data files say to people is found by MARKED_KEYS. Run in the environment of rvsim: it needs polib.
"""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
CATALOGUES = ROOT / "resources" / "languages"
# Keys of robot files whose texts the window shows; citations of documents stay as they are.
MARKED_KEYS = frozenset({
    "title", "family", "notes", "joint.name", "tool.title", "mass.source", "servo.source", "gripper_servo.source",
    "joint.max_speed.source", "joint.max_acceleration.source", "joint.max_torque.source",
})  # fmt: skip
_SYMBOL = re.compile(r"[a-z]+\d")  # theta1, d3: in any language


class Found(NamedTuple):
    """A text in the code: what it is for one thing and, where it depends on a number, for many; and its places."""

    text: str
    many: str
    places: tuple[str, ...]


def texts(root: Path = ROOT) -> list[Found]:
    """All texts of rvsim, in the order of the files, each once."""
    places: dict[tuple[str, str], list[str]] = {}
    for text, many, place in (*_in_code(root), *_in_data(root)):
        places.setdefault((text, many), []).append(place)
    return [Found(text, many, tuple(where)) for (text, many), where in places.items()]


def _in_code(root: Path) -> Iterator[tuple[str, str, str]]:
    for file in sorted((root / "rvsim").rglob("*.py")):
        name = file.relative_to(root).as_posix()
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                said = _said(node.func.id, node.args)
                if said:
                    yield (*said, f"{name}:{node.lineno}")


def _said(function: str, arguments: list[ast.expr]) -> tuple[str, str] | None:
    """The text, or the two of them, that such a call says; None for another call or one of a variable."""
    count = {"tr": 1, "tr_later": 1, "trn": 2}.get(function, 0)
    given = [one.value for one in arguments[:count] if isinstance(one, ast.Constant) and isinstance(one.value, str)]
    return (given[0], given[1] if count == 2 else "") if count and len(given) == count else None


def _in_data(root: Path) -> Iterator[tuple[str, str, str]]:
    for folder in ("robots", "examples"):
        for file in sorted((root / "resources" / folder).glob("*.toml")):
            name = file.relative_to(root).as_posix()
            for text in _marked(tomllib.loads(file.read_text(encoding="utf-8"))):
                yield text, "", name


def _marked(value: object, key: str = "") -> Iterator[str]:
    if isinstance(value, str) and key in MARKED_KEYS and not _SYMBOL.fullmatch(value):
        yield value.strip()
    elif isinstance(value, dict):
        for name, inner in value.items():
            yield from _marked(inner, f"{key}.{name}".lstrip("."))
    elif isinstance(value, list):
        for inner in value:
            yield from _marked(inner, key)


def update(file: Path, found: Iterable[Found]) -> tuple[int, int]:
    """Bring one catalogue up to date: new texts are added, gone ones taken out; how many there are, how many lack."""
    import polib

    catalogue = polib.pofile(str(file), encoding="utf-8", wrapwidth=110)
    known = {one.msgid: one for one in catalogue}
    entries = polib.POFile(encoding="utf-8", wrapwidth=110)
    entries.metadata = catalogue.metadata
    count = int(catalogue.metadata["Plural-Forms"].partition("nplurals=")[2].partition(";")[0])
    for one in found:
        entry = polib.POEntry(msgid=one.text, occurrences=[(place.partition(":")[0], "") for place in one.places])
        old = known.get(one.text)
        if one.many:
            entry.msgid_plural = one.many
            entry.msgstr_plural = (
                dict(old.msgstr_plural) if old and old.msgstr_plural else dict.fromkeys(range(count), "")
            )
        elif old:
            entry.msgstr = old.msgstr
        entry.occurrences = sorted(set(entry.occurrences))
        entries.append(entry)
    entries.save(str(file))
    return len(entries), len(entries.untranslated_entries())


def main() -> int:
    """Update all catalogues; 1 where a translation is missing."""
    found = texts()
    lacking = 0
    for file in sorted(CATALOGUES.glob("*.po")):
        total, missing = update(file, found)
        lacking += missing
        print(f"{file.stem}: {total} texts, {missing} of them without a translation")
    return int(lacking > 0)


if __name__ == "__main__":
    sys.exit(main())
