"""The language that rvsim speaks: `tr` says a text in it, or in English where nobody has translated it yet.

English is what the code is written in; every other language is a gettext catalogue `resources/languages/CODE.po`.
`packaging/dev.py texts` brings the catalogues up to date with the code. Files, the command line and the log stay
English: machines and forums read them.
"""

from __future__ import annotations

import gettext
import re
import string
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from rvsim.resources import resource


class Language(NamedTuple):
    """A language: its ISO 639 code, its own name for itself, and which way it is written."""

    code: str
    name: str
    right_to_left: bool = False


LANGUAGES = {
    one.code: one
    for one in (Language("en", "English"), Language("ar", "العربية", right_to_left=True), Language("de", "Deutsch"))
}

# Unicode's isolates (UAX #9): what stands between them is laid out by itself, so a minus stays before its number.
_ISOLATE, _ISOLATE_LEFT_TO_RIGHT, _ISOLATE_RIGHT_TO_LEFT, _END = "\u2068", "\u2066", "\u2067", "\u2069"
# What a text begins with to be laid out from right to left, though its first letter is a Latin one or a value's.
_RIGHT_TO_LEFT_MARK = "\u200f"
_SIGN_MARK = "\u200e"  # stands before the sign of a number among words from right to left
_SIGN = re.compile(r"(?<![^\W\d_])(?<!\u200e)(?=[-+\u2212\xb1][.\d])")
_FIELD = re.compile(r"\{[^{}]*\}")
_STRIPPED = str.maketrans(
    "", "", _ISOLATE + _ISOLATE_LEFT_TO_RIGHT + _ISOLATE_RIGHT_TO_LEFT + _END + _RIGHT_TO_LEFT_MARK
)


class Text(str):
    """A text that knows what it was made of, so that `again` can say it in another language."""

    __slots__ = ("many", "number", "template", "values")

    template: str
    many: str
    number: int
    values: Mapping[str, object]


class Catalogue(NamedTuple):
    """What is translated into one language: from the English text to its forms, one for each kind of number."""

    forms: Mapping[str, tuple[str, ...]]
    kind_of_number: Callable[[int], int]


class _Isolating(string.Formatter):
    """Formats like `str.format`, with each value isolated: for texts that are written from right to left."""

    def format_field(self, value: Any, format_spec: str) -> str:
        return f"{_ISOLATE}{format(value, format_spec)}{_END}"


_ISOLATING = _Isolating()
_NONE = Catalogue({}, lambda number: int(number != 1))
_spoken: tuple[Language, Catalogue] = (LANGUAGES["en"], _NONE)


def language() -> Language:
    """The language that is spoken now."""
    return _spoken[0]


def speak(code: str) -> None:
    """Speak this language from now on; texts that were said before stay as they are.

    Raises:
        KeyError: for a code that is none of LANGUAGES.
    """
    global _spoken
    spoken = LANGUAGES[code]
    _spoken = spoken, (_NONE if code == "en" else read_catalogue(catalogue_file(code)))


def catalogue_file(code: str) -> Path:
    """Where the catalogue of a language is."""
    return resource("languages", f"{code}.po")


def read_catalogue(file: Path) -> Catalogue:
    """A gettext catalogue: what is not translated in it, or marked as doubtful, is left out."""
    import polib  # only those who speak another language pay for it

    entries = polib.pofile(str(file), encoding="utf-8")
    forms = {one.msgid: tuple(one.msgstr_plural.values()) or (one.msgstr,) for one in entries if one.translated()}
    rule = entries.metadata.get("Plural-Forms", "nplurals=2; plural=n != 1;").partition("plural=")[2]
    return Catalogue(forms, gettext.c2py(rule.rstrip("; ")))


def tr(text: str, /, **values: object) -> str:
    """A text in the language that is spoken; `{name}` in it is replaced by the value of that name, if there are any.

    A text that is not written here, but comes from a table, is marked there by `tr_later`. One that has been said
    already stays as it is: in another language it may be spelt like another English text.
    """
    if isinstance(text, Text) and not values:
        return text
    return _said(text, "", 1, values)


def trn(one: str, many: str, number: int, /, **values: object) -> str:
    """A text that depends on a number, which it may show as `{n}`: trn("{n} point", "{n} points", len(points))."""
    return _said(one, many, number, {"n": number, **values})


def tr_later(text: str) -> str:
    """The text itself, marked as one that `tr` will say: for tables, which are made before a language is chosen."""
    return text


def again(text: str) -> str:
    """A text of `tr` or `trn` in the language that is spoken now, with the texts in it; any other as it is."""
    if not isinstance(text, Text):
        return text
    values = {name: again(value) if isinstance(value, str) else value for name, value in text.values.items()}
    return _said(text.template, text.many, text.number, values)


def in_english(text: str) -> str:
    """A text of `tr` or `trn` as the code has it, with the texts in it: for files that machines read."""
    if not isinstance(text, Text):
        return text
    values = {name: in_english(value) if isinstance(value, str) else value for name, value in text.values.items()}
    template = text.many if text.many and text.number != 1 else text.template
    return template.format_map(values) if values else template


def _said(text: str, many: str, number: int, values: Mapping[str, object]) -> Text:
    spoken, (forms, kind_of_number) = _spoken
    found = forms.get(text)
    if not many:
        template = found[0] if found else text
    elif found:
        template = found[min(kind_of_number(number), len(found) - 1)]
    else:
        template = text if number == 1 else many
    if spoken.right_to_left:
        template = _from_the_right(template, bool(found))
    said = Text(template if not values else _fill(template, values, spoken.right_to_left))
    said.template, said.many, said.number, said.values = text, many, number, values
    return said


@lru_cache(maxsize=4096)
def _from_the_right(template: str, translated: bool) -> str:
    """A template of a language that is written from right to left: widgets lay a text out as its first letter is.

    That may be the first of a value, isolated as it is. English that nobody has translated stays as it is, and so do
    names alone.
    """
    words = _FIELD.sub("", template)
    first = next((kind for kind in map(unicodedata.bidirectional, words) if kind in ("L", "R", "AL")), "")
    if (first in ("R", "AL") and not template.startswith("{")) or (first == "L" and not translated):
        return template
    return _RIGHT_TO_LEFT_MARK + template if words != template or has_right_to_left(words) else template


def _fill(template: str, values: Mapping[str, object], right_to_left: bool) -> str:
    return _ISOLATING.vformat(template, (), values) if right_to_left else template.format_map(values)


def listed(words: Sequence[str]) -> str:
    """Words as a list in a sentence: "a", "a and b", "a, b and c"; "" for none."""
    if len(words) < 2:
        return "".join(words)
    return tr("{others} and {last}", others=tr(", ").join(words[:-1]), last=words[-1])


def sentences(*said: str, between: str = " ") -> str:
    """Sentences one after the other, as one text that `again` and `in_english` can say."""
    numbered = {f"s{number}": one for number, one in enumerate(said)}
    return tr("{between}".join(f"{{{name}}}" for name in numbered), between=between, **numbered)


def left_to_right(text: str) -> str:
    """Numbers and formulas, kept in their order where the words around them are written from right to left."""
    return f"{_ISOLATE_LEFT_TO_RIGHT}{text}{_END}" if text and _spoken[0].right_to_left else text


def has_right_to_left(text: str) -> bool:
    """Whether there are letters in a text that are written from right to left."""
    return any(unicodedata.bidirectional(letter) in ("R", "AL") for letter in text)


def in_its_order(text: str) -> str:
    """A text alone, for instance in a table that has another direction: words from right to left, numbers not."""
    if not has_right_to_left(text):
        return left_to_right(text)
    return f"{_ISOLATE_RIGHT_TO_LEFT}{text}{_END}" if _spoken[0].right_to_left else text


def begins_right(text: str) -> bool:
    """Whether a text is written from right to left by its first letter; one of none as the language is."""
    kinds = (unicodedata.bidirectional(letter) for letter in text)
    first = next((kind for kind in kinds if kind in ("L", "R", "AL")), "")
    return first in ("R", "AL") if first else _spoken[0].right_to_left


def signs_in_order(text: str) -> str:
    """What somebody has written, with each sign kept before its number: from right to left it would stand behind."""
    return _SIGN.sub(_SIGN_MARK, text) if has_right_to_left(text) else text


def without_isolates(text: str) -> str:
    """A text as a machine reads it, without the signs that order it on the screen."""
    return text.translate(_STRIPPED)
