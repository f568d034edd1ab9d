"""The kinds of value in a robot file: each can read itself, refuse what it is not, and write itself as TOML."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from rvsim.errors import did_you_mean, without_markup
from rvsim.files.place import Place, Quantity, Unit, Units, count_of, either, list_of, shown
from rvsim.language import tr, tr_later, trn

# What a saved number may differ from the number in memory, as a fraction of it.
_PRECISION = 1e-15
_HEX_COLOR = re.compile(r"#[0-9a-fA-F]{6}")
REQUIRED: Any = object()


class Kind(Protocol):
    """A kind of value. `read` gives the SI value or refuses; `write` gives TOML on one line."""

    def read(self, value: Any, place: Place) -> Any:
        """The value in SI units.

        Raises:
            RobotFileError: it is not of this kind.
        """

    def write(self, value: Any, units: Units) -> str:
        """TOML text of the SI value."""


class Key(NamedTuple):
    """One key of a table: its kind, what it is when absent, and a comment, which also is the hint to who errs.

    The comment is in English in the file, whatever language is spoken; as a hint it is translated.
    """

    name: str
    kind: Kind
    default: Any = REQUIRED
    comment: str = ""


@dataclass(frozen=True)
class Text:
    """A string; `shortest` = 1 where it may not be empty."""

    shortest: int = 0
    longest: int = 200

    def read(self, value: Any, place: Place) -> str:
        """The text, without blanks around it."""
        expected = tr(
            "a text of {shortest} to {longest} characters in quotes", shortest=self.shortest, longest=self.longest
        )
        if not isinstance(value, str):
            place.refuse(shown(value), expected)
        text = without_markup(value.strip())
        if not self.shortest <= len(text) <= self.longest:
            place.refuse(trn("a text of {n} character", "a text of {n} characters", len(text)), expected)
        return text

    def write(self, value: str, units: Units) -> str:
        """One line, or several between triple quotes."""
        del units
        value = without_markup(value)
        if "\n" not in value:
            return quoted(value)
        body = "\n".join(quoted(line)[1:-1] for line in value.split("\n"))
        return f'"""\n{body}"""'


@dataclass(frozen=True)
class Choice:
    """One of a closed list of words."""

    options: tuple[str, ...]

    def read(self, value: Any, place: Place) -> str:
        """The word as it stands in the list."""
        expected = either(self.options)
        if not isinstance(value, str):
            place.refuse(shown(value), expected)
        if value not in self.options:
            place.refuse(shown(value), expected, did_you_mean(value, self.options))
        return value

    def write(self, value: str, units: Units) -> str:
        """The word in quotes."""
        del units
        return quoted(value)


@dataclass(frozen=True)
class Flag:
    """true or false."""

    def read(self, value: Any, place: Place) -> bool:
        """The truth value."""
        if not isinstance(value, bool):
            place.refuse(shown(value), tr("true or false, without quotes"))
        return value

    def write(self, value: bool, units: Units) -> str:
        """In TOML's spelling."""
        del units
        return "true" if value else "false"


@dataclass(frozen=True)
class HexColor:
    """A colour "#rrggbb"; an empty one where `optional`."""

    optional: bool = False

    def read(self, value: Any, place: Place) -> str:
        """The text "#rrggbb"."""
        if self.optional and value == "":
            return ""
        if not isinstance(value, str) or not _HEX_COLOR.fullmatch(value):
            place.refuse(shown(value), tr('a colour "#rrggbb"'), tr('For instance "#E69F00".'))
        return value

    def write(self, value: str, units: Units) -> str:
        """In quotes."""
        del units
        return quoted(value)


@dataclass(frozen=True)
class Number:
    """A finite number between two bounds, both in the file's unit."""

    quantity: Quantity = "plain"
    least: float = -1e6
    most: float = 1e6
    per: str = ""

    def read(self, value: Any, place: Place) -> float:
        """The number in SI units."""
        number = self._finite(value, place)
        if not self.least <= number <= self.most:
            place.refuse(shown(value), self._expected(place))
        if self.quantity == "angle":
            _refuse_radians(number, place)
        return place.units.of(self.quantity).to_si(number)

    def write(self, value: float, units: Units) -> str:
        """The shortest decimal that means the same."""
        return number_text(value, units.of(self.quantity))

    def _finite(self, value: Any, place: Place) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            place.refuse(shown(value), self._expected(place), _without_quotes(value))
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            place.refuse(shown(value), self._expected(place))
        return number

    def _expected(self, place: Place) -> str:
        name = place.units.of(self.quantity).name
        if not name:
            return tr("a number from {least:.8g} to {most:.8g}", least=self.least, most=self.most)
        unit = tr(f"{name}{self.per}")
        return tr("a number from {least:.8g} to {most:.8g} [{unit}]", least=self.least, most=self.most, unit=unit)


# What a number may be per second of.
_RATES = (
    tr_later("degrees per second"),
    tr_later("degrees per second²"),
    tr_later("millimetres per second"),
    tr_later("millimetres per second²"),
    tr_later("units per second"),
    tr_later("units per second²"),
)


@dataclass(frozen=True)
class Numbers:
    """A list of as many numbers as there are `names`."""

    names: tuple[str, ...]
    number: Number

    def read(self, value: Any, place: Place) -> tuple[float, ...]:
        """The numbers in SI units."""
        expected = trn("{n} number [{names}]", "{n} numbers [{names}]", len(self.names), names=", ".join(self.names))
        if not isinstance(value, list) or len(value) != len(self.names):
            place.refuse(shown(value), expected)
        pairs = zip(self.names, value, strict=True)
        return tuple(self.number.read(item, place.at(name, place.hint)) for name, item in pairs)

    def write(self, value: Any, units: Units) -> str:
        """The list in brackets."""
        return f"[{', '.join(self.number.write(float(item), units) for item in value)}]"


@dataclass(frozen=True)
class Items:
    """A list of values of one kind, called `one` each."""

    one: str
    kind: Kind
    fewest: int = 0
    most: int = 500

    def read(self, value: Any, place: Place) -> tuple[Any, ...]:
        """Each item read."""
        if not isinstance(value, list):
            place.refuse(shown(value), list_of(self.one))
        if not self.fewest <= len(value) <= self.most:
            place.refuse(trn("{n} of them", "{n} of them", len(value)), count_of(self.one, self.fewest, self.most))
        return tuple(self.kind.read(item, place.item(f"{self.one} {i}")) for i, item in enumerate(value, 1))

    def write(self, value: Any, units: Units) -> str:
        """One item a line."""
        lines = "".join(f"    {self.kind.write(item, units)},\n" for item in value)
        return f"[\n{lines}]"


@dataclass(frozen=True)
class Table:
    """A table of keys.

    Args:
        keys: all it may hold.
        build: the value made of what was read, called with the keys as names; may refuse with the place.
        parts: the way back, from the value to the dict of SI values by key.
        units: the units inside, from those outside and the raw table.
    """

    keys: tuple[Key, ...]
    build: Callable[[dict[str, Any], Place], Any]
    parts: Callable[[Any], dict[str, Any]]
    units: Callable[[dict[str, Any], Units], Units] = lambda _, units: units

    def read(self, value: Any, place: Place) -> Any:
        """The value the table means."""
        if not isinstance(value, dict):
            place.refuse(
                shown(value),
                tr("a table of keys"),
                tr("Its keys: {keys}.", keys=", ".join(key.name for key in self.keys)),
            )
        self._refuse_unknown(value, place)
        inside = place.with_units(self.units(value, place.units))
        return self.build({key.name: _read_key(key, value, inside) for key in self.keys}, inside)

    def write(self, value: Any, units: Units) -> str:
        """An inline table; keys at their default are left out."""
        pairs = (f"{key.name} = {key.kind.write(part, inner)}" for key, part, inner in self.present(value, units))
        return f"{{ {', '.join(pairs)} }}"

    def present(self, value: Any, units: Units) -> list[tuple[Key, Any, Units]]:
        """The keys worth writing, with their values and the units inside."""
        parts = self.parts(value)
        inner = self.units(parts, units)
        return [(key, parts[key.name], inner) for key in self.keys if not _is_default(parts[key.name], key.default)]

    def _refuse_unknown(self, table: dict[str, Any], place: Place) -> None:
        names = [key.name for key in self.keys]
        for name in () if place.newer else table:
            if name not in names:
                here = place.at(f"key {name[:100]!r}")
                here.refuse(tr("an unknown key"), tr("one of the known keys"), did_you_mean(name[:100], names))


def _read_key(key: Key, table: dict[str, Any], place: Place) -> Any:
    nested = isinstance(key.kind, Table | Items)
    hint = f"{key.name}: {key.comment}." if key.comment else ""
    here = place.at(key.name if nested else f"key {key.name!r}", hint)
    if key.name in table:
        return key.kind.read(table[key.name], here)
    if key.default is REQUIRED:
        here.refuse(tr("nothing"), tr("this table, which is required") if nested else tr("this key, which is required"))
    return key.default


def _is_default(value: Any, default: Any) -> bool:
    return value is default or (isinstance(value, str | float | bool | tuple) and bool(value == default))


def quoted(text: str) -> str:
    """A TOML basic string: JSON's escapes are TOML's, but for the DEL character."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")


def number_text(value: float, unit: Unit) -> str:
    """The shortest decimal in `unit` that gives the SI value back within 1e-15 of it."""
    exact = unit.from_si(value)
    for digits in range(1, 18):
        candidate = float(f"{exact:.{digits}g}")
        if abs(unit.to_si(candidate) - value) <= _PRECISION * abs(value):
            break
    return repr(candidate + 0.0).removesuffix(".0")


def _without_quotes(value: object) -> str:
    return tr("Write the number without quotes.") if isinstance(value, str) and _is_number(value) else ""


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _refuse_radians(number: float, place: Place) -> None:
    for degrees in (90.0, 180.0):
        if abs(abs(number) - math.radians(degrees)) < 5e-6:
            right = math.copysign(degrees, number)
            place.refuse(shown(number), tr("degrees"), tr("That looks like radians: write {degrees:g}.", degrees=right))
