"""The languages: catalogues are whole and fit their texts, and what is said can be said again in another one."""

from __future__ import annotations

import importlib.util
import string
from collections.abc import Iterator
from pathlib import Path

import polib
import pytest

from rvsim import language as language_module
from rvsim.language import (
    LANGUAGES,
    Catalogue,
    again,
    catalogue_file,
    left_to_right,
    listed,
    read_catalogue,
    sentences,
    signs_in_order,
    speak,
    tr,
    trn,
    without_isolates,
)

TRANSLATED = [code for code in LANGUAGES if code != "en"]
LTR, FIRST, END, RTL_MARK = "\u2066", "\u2068", "\u2069", "\u200f"


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    """Every text of the code, with its form for many things where it depends on a number."""
    path = Path(__file__).parents[1] / "packaging" / "dev_texts.py"
    spec = importlib.util.spec_from_file_location("dev_texts", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {one.text: one.many for one in module.texts()}


@pytest.fixture(autouse=True)
def _english_again() -> Iterator[None]:
    yield
    speak("en")


def fields(template: str) -> set[tuple[str | None, str | None, str | None]]:
    return {(name, spec, how) for _, name, spec, how in string.Formatter().parse(template) if name is not None}


@pytest.mark.parametrize("code", TRANSLATED)
def test_every_text_of_the_code_is_translated_and_nothing_else(code: str, texts: dict[str, str]) -> None:
    known = {one.msgid for one in polib.pofile(str(catalogue_file(code))) if one.translated()}
    assert sorted(set(texts) - known)[:20] == []
    assert sorted(known - set(texts))[:20] == []


@pytest.mark.parametrize("code", TRANSLATED)
def test_a_translation_has_the_fields_of_its_text(code: str, texts: dict[str, str]) -> None:
    for text, forms in read_catalogue(catalogue_file(code)).forms.items():
        allowed = fields(text) | fields(texts[text]) if texts[text] else fields(text)
        for form in forms:
            assert fields(form) <= allowed, (text, form)
            assert texts[text] or fields(form) == allowed, (text, form)
            assert (form[:1].isspace(), form[-1:].isspace()) == (text[:1].isspace(), text[-1:].isspace()), (text, form)


@pytest.mark.parametrize(("code", "kinds"), [("ar", 6), ("de", 2)])
def test_each_number_has_its_form(code: str, kinds: int) -> None:
    catalogue = read_catalogue(catalogue_file(code))
    assert {catalogue.kind_of_number(number) for number in range(200)} == set(range(kinds))
    assert all(len(forms) in (1, kinds) for forms in catalogue.forms.values())


def test_english_needs_no_catalogue() -> None:
    assert tr("Joint {joint}", joint=3) == "Joint 3"
    assert tr("a {brace} stays") == "a {brace} stays"
    assert [trn("{n} point", "{n} points", n) for n in (0, 1, 2)] == ["0 points", "1 point", "2 points"]
    assert [listed(words) for words in ((), ("a",), ("a", "b"), ("a", "b", "c"))] == ["", "a", "a and b", "a, b and c"]


def test_what_was_said_is_said_again_with_the_texts_in_it() -> None:
    inner = tr("Undo")
    outer = tr("{others} and {last}", others=inner, last="J1")
    speak("de")
    assert again(outer) == tr("{others} and {last}", others=tr("Undo"), last="J1") != outer
    assert again("typed by somebody") == "typed by somebody"
    speak("en")
    assert again(outer) == "Undo and J1"


def test_what_was_said_is_no_text_to_be_said() -> None:
    speak("de")
    said = tr("Run")  # German may spell it like another English text
    assert tr(said) is said


def test_numbers_keep_their_order_among_words_from_right_to_left() -> None:
    assert left_to_right("\u221230.0 mm") == "\u221230.0 mm"
    speak("ar")
    assert left_to_right("\u221230.0 mm") == f"{LTR}\u221230.0 mm{END}"
    assert f"{FIRST}\u22123{END}" in tr("{others} and {last}", others="\u22123", last="x")
    assert without_isolates(left_to_right("1, 2")) == "1, 2"


def test_a_text_is_laid_out_from_the_right_whatever_it_begins_with(monkeypatch: pytest.MonkeyPatch) -> None:
    forms = {
        "J of {arm}": ("J \u0644\u0640 {arm}",),
        "{a}: {b}": ("{a}: {b}",),
        "Newton": ("Newton",),
        "base": ("\u0642",),
    }
    monkeypatch.setattr(language_module, "_spoken", (LANGUAGES["ar"], Catalogue(forms, lambda _: 0)))
    assert [tr("J of {arm}", arm="x")[0], tr("{a}: {b}", a="x", b="y")[0]] == [RTL_MARK] * 2
    assert sentences("x", "y")[0] == RTL_MARK
    assert [tr("Newton"), tr("base"), tr("{n} of nobody", n=1)[1:2]] == ["Newton", "\u0642", "1"]
    assert without_isolates(tr("{a}: {b}", a="x", b="y")) == "x: y"


def test_signs_stay_before_numbers_in_what_somebody_has_written() -> None:
    arabic = "\u0627\u0644\u0645\u0631\u0641\u0642 \u2212156.7\u00b0"
    assert signs_in_order(arabic) == arabic.replace("\u2212", "\u200e\u2212")
    assert signs_in_order(signs_in_order(arabic)) == signs_in_order(arabic)
    assert signs_in_order("\u0645 10-20") == "\u0645 10\u200e-20"
    assert signs_in_order("the elbow at \u2212156.7\u00b0") == "the elbow at \u2212156.7\u00b0"


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(KeyError):
        speak("xx")
