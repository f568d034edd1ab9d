"""The help pages in other languages: the same examples, formulas and headings, and the names that the window uses."""

from __future__ import annotations

import re

import polib
import pytest

from rvsim.gui.help.document import prepared
from rvsim.language import LANGUAGES, catalogue_file
from rvsim.resources import resource

ENGLISH = {file.name: file.read_text(encoding="utf-8") for file in resource("help").glob("*.md")}
# A specification for who builds a board: it is read beside the code.
ENGLISH_ONLY = {"encoder-bridge.md"}
BOLD = re.compile(r"\*\*([^*]+)\*\*")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
EMPHASIZED = 8  # stretches in bold type that name no control
TARGET = re.compile(r"\]\(([^)#]*)[^)]*\)")
HEADING = re.compile(r"^#+ ", re.MULTILINE)
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


@pytest.fixture(params=[code for code in LANGUAGES if code != "en"])
def code(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def plain(text: str) -> str:
    """A label without its signs and its mnemonic."""
    text = re.sub(r"[▸▾▲▼↑↓⌂●■▶◐↶↷\u2066-\u2069]", "", text).replace("&&", "\0").replace("&", "").replace("\0", "&")
    return re.sub(r"[\s…:]+|\.\.\.$", " ", text).strip().casefold()


def pages(code: str) -> dict[str, str]:
    return {file.name: file.read_text(encoding="utf-8") for file in resource("help", code).glob("*.md")}


def test_every_page_is_translated(code: str) -> None:
    assert sorted(set(ENGLISH) - ENGLISH_ONLY - set(pages(code))) == []
    assert sorted(set(pages(code)) - set(ENGLISH)) == []


def test_a_translation_has_the_same_links_formulas_and_parts(code: str) -> None:
    for name, page in pages(code).items():
        english = ENGLISH[name]
        assert sorted(TARGET.findall(page)) == sorted(TARGET.findall(english)), name
        assert sorted(prepared(page).formulas) == sorted(prepared(english).formulas), name
        assert FENCE.findall(page) == FENCE.findall(english), name
        assert len(HEADING.findall(page)) == len(HEADING.findall(english)), name


def test_what_is_bold_is_a_word_of_the_catalogue(code: str) -> None:
    forms = {
        form
        for one in polib.pofile(str(catalogue_file(code)))
        for form in (one.msgid, one.msgstr, *one.msgstr_plural.values())
    }
    known = {plain(form) for form in forms} | {plain(form.partition(":")[0]) for form in forms} | {"f1", "esc", "dls λ"}
    missing = [
        (name, bold)
        for name, page in pages(code).items()
        for bold in BOLD.findall(CODE.sub("", page))
        for part in re.split(r" ?[›→] ", bold)
        if re.search(r"\w\w", part) and not {plain(part), plain(bold)} & known
    ]
    assert len(missing) <= EMPHASIZED, missing
