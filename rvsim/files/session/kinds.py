"""The kinds of value in a session file: each reads itself, refuses what it is not, and gives itself as plain JSON.

Numbers are SI and exact. Where a robot file's kinds refuse lengths that no arm has, these take every finite number:
what a student has typed must not be lost because it is odd.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from rvsim.errors import RvsimError, SessionFileError, did_you_mean, without_markup
from rvsim.files.kinds import REQUIRED
from rvsim.files.place import Place, count_of, either, list_of, shown
from rvsim.files.session.json_text import finite
from rvsim.language import tr, tr_later, trn


class Kind(Protocol):
    """A kind of value."""

    def read(self, value: Any, place: Place) -> Any:
        """The value that plain JSON means.

        Raises:
            SessionFileError: it means none.
        """

    def plain(self, value: Any) -> Any:
        """The plain JSON of a value."""


class Field(NamedTuple):
    """One key of a record, and what it is when absent; a `sparse` one is not written where it is that."""

    name: str
    kind: Kind
    default: Any = REQUIRED
    sparse: bool = False


@dataclass(frozen=True)
class Real:
    """A finite number between two bounds."""

    least: float = -math.inf
    most: float = math.inf

    def read(self, value: Any, place: Place) -> float:
        """The number."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            place.refuse(shown(value), self._expected)
        number = finite(value)
        if not (math.isfinite(number) and self.least <= number <= self.most):
            place.refuse(shown(value), self._expected)
        return number

    def plain(self, value: Any) -> float:
        """With all its digits."""
        return float(value)

    @property
    def _expected(self) -> str:
        text = _REALS[math.isfinite(self.least), math.isfinite(self.most)]
        return tr(text, least=self.least, most=self.most)


# What is expected of a number, by whether it has a lower and an upper bound.
_REALS = {
    (False, False): tr_later("a finite number"),
    (True, False): tr_later("a finite number at least {least:g}"),
    (False, True): tr_later("a finite number at most {most:g}"),
    (True, True): tr_later("a finite number at least {least:g} and at most {most:g}"),
}


@dataclass(frozen=True)
class Whole:
    """A whole number between two bounds."""

    least: int
    most: int

    def read(self, value: Any, place: Place) -> int:
        """The number."""
        if isinstance(value, bool) or not isinstance(value, int) or not self.least <= value <= self.most:
            place.refuse(shown(value), tr("a whole number from {least} to {most}", least=self.least, most=self.most))
        return value

    def plain(self, value: Any) -> int:
        """As it is."""
        return int(value)


@dataclass(frozen=True)
class Reals:
    """A list of so many finite numbers; `expected` says it where it is more than their count, in English."""

    count: int
    expected: str = ""

    def read(self, value: Any, place: Place) -> tuple[float, ...]:
        """The numbers."""
        if not isinstance(value, list) or len(value) != self.count:
            counted = trn("a list of {n} number", "a list of {n} numbers", self.count)
            place.refuse(shown(value), tr(self.expected) if self.expected else counted)
        number = Real()
        return tuple(number.read(item, place.at(f"number {i}")) for i, item in enumerate(value, 1))

    def plain(self, value: Any) -> list[float]:
        """With all their digits."""
        return [float(item) for item in value]


@dataclass(frozen=True)
class Rows:
    """A list of rows of numbers: `least` to `most` rows of `width`."""

    width: int
    least: int
    most: int

    def read(self, value: Any, place: Place) -> Any:
        """(rows, width)."""
        if not isinstance(value, list) or not self.least <= len(value) <= self.most:
            place.refuse(shown(value), self._expected)
        row = Reals(self.width)
        found = [row.read(item, place.at(f"row {i}")) for i, item in enumerate(value, 1)]
        return np.array(found, dtype=np.float64).reshape(-1, self.width)

    @property
    def _expected(self) -> str:
        if self.least == self.most:
            return trn("a list of {n} row", "a list of {n} rows", self.least)
        return tr("a list of {least} to {most} rows", least=self.least, most=self.most)

    def plain(self, value: Any) -> list[list[float]]:
        """Row by row."""
        rows: list[list[float]] = np.asarray(value, dtype=np.float64).tolist()
        return rows


@dataclass(frozen=True)
class Words:
    """A text as it stands, but no markup."""

    longest: int = 200
    shortest: int = 0

    def read(self, value: Any, place: Place) -> str:
        """The text."""
        if not isinstance(value, str):
            place.refuse(shown(value), tr("a text in quotes"))
        if not self.shortest <= len(value) <= self.longest:
            place.refuse(
                trn("a text of {n} character", "a text of {n} characters", len(value)),
                tr("{shortest} to {longest} characters", shortest=self.shortest, longest=self.longest),
            )
        return without_markup(value)

    def plain(self, value: Any) -> str:
        """As it is."""
        return without_markup(str(value))


@dataclass(frozen=True)
class Choice:
    """One of a closed list of words."""

    options: tuple[str, ...]

    def read(self, value: Any, place: Place) -> str:
        """The word."""
        if not isinstance(value, str) or value not in self.options:
            guess = did_you_mean(value[:100], self.options) if isinstance(value, str) else ""
            place.refuse(shown(value), either(self.options), guess)
        return value

    def plain(self, value: Any) -> str:
        """As it is."""
        return str(value)


@dataclass(frozen=True)
class Flag:
    """true or false."""

    def read(self, value: Any, place: Place) -> bool:
        """The truth value."""
        if not isinstance(value, bool):
            place.refuse(shown(value), tr("true or false, without quotes"))
        return value

    def plain(self, value: Any) -> bool:
        """As it is."""
        return bool(value)


@dataclass(frozen=True)
class Maybe:
    """A value, or null for none."""

    kind: Kind

    def read(self, value: Any, place: Place) -> Any:
        """The value, or None."""
        return None if value is None else self.kind.read(value, place)

    def plain(self, value: Any) -> Any:
        """The value, or null."""
        return None if value is None else self.kind.plain(value)


@dataclass(frozen=True)
class Many:
    """A list of values of one kind, called `one` each."""

    one: str
    kind: Kind
    most: int
    fewest: int = 0

    def read(self, value: Any, place: Place) -> tuple[Any, ...]:
        """Each item read."""
        if not isinstance(value, list):
            place.refuse(shown(value), list_of(self.one))
        if not self.fewest <= len(value) <= self.most:
            place.refuse(trn("{n} of them", "{n} of them", len(value)), count_of(self.one, self.fewest, self.most))
        return tuple(self.kind.read(item, place.at(f"{self.one} {i}")) for i, item in enumerate(value, 1))

    def plain(self, value: Any) -> list[Any]:
        """Each item."""
        return [self.kind.plain(item) for item in value]


@dataclass(frozen=True)
class Paragraphs:
    """A text of many lines, as a list of its lines: so that two versions of it can be compared."""

    longest: int

    def read(self, value: Any, place: Place) -> str:
        """The text."""
        if not isinstance(value, list) or not all(isinstance(line, str) for line in value):
            place.refuse(shown(value), tr("a list of lines in quotes"))
        text = "\n".join(value)
        if len(text) > self.longest:
            place.refuse(
                trn("a text of {n} character", "a text of {n} characters", len(text)),
                tr("at most {longest} characters", longest=self.longest),
            )
        return text

    def plain(self, value: Any) -> list[str]:
        """Its lines; none of an empty text."""
        return str(value).split("\n") if value else []


@dataclass(frozen=True)
class Record:
    """A table of fields.

    Args:
        fields: all it may hold.
        build: the value, called with the fields by name; what it refuses is refused here.
        parts: the way back; by default the value's attributes.
    """

    fields: tuple[Field, ...]
    build: Callable[..., Any]
    parts: Callable[[Any], Mapping[str, Any]] = vars

    def read(self, value: Any, place: Place) -> Any:
        """The value that the table means."""
        names = [field.name for field in self.fields]
        if not isinstance(value, dict):
            place.refuse(shown(value), tr("a table of keys"), tr("Its keys: {names}.", names=", ".join(names)))
        for name in () if place.newer else value:
            if name not in names:
                place.at(f"{name[:100]!r}").refuse(
                    tr("an unknown key"), tr("a known one"), did_you_mean(name[:100], names)
                )
        found = {field.name: _read(field, value, place.at(field.name)) for field in self.fields}
        try:
            return self.build(**found)
        except SessionFileError:
            raise
        except RvsimError as problem:
            place.refuse(tr("values that cannot be ({problem})", problem=problem), tr("values that can"))

    def plain(self, value: Any) -> dict[str, Any]:
        """Its keys, in their order."""
        parts = self.parts(value)
        written = [field for field in self.fields if not (field.sparse and parts[field.name] == field.default)]
        return {field.name: field.kind.plain(parts[field.name]) for field in written}


def _read(field: Field, table: dict[str, Any], place: Place) -> Any:
    if field.name in table:
        return field.kind.read(table[field.name], place)
    if field.default is REQUIRED:
        place.refuse(tr("nothing"), tr("this key, which is required"))
    return field.default
