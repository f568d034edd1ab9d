"""The numbers of the sources, worked out once more: which are right, which are not, and what cannot be reached."""

from __future__ import annotations

import json

import pytest

from rvsim.cli import DONE, main
from rvsim.lab.sources import errata
from rvsim.lab.sources.reproduce import Reproduction, reproduce, reproduction_text


@pytest.fixture(scope="module")
def rows() -> tuple[Reproduction, ...]:
    return reproduce()


def row(rows: tuple[Reproduction, ...], source: str, text: str) -> Reproduction:
    return next(row for row in rows if row.source == source and text in row.item)


@pytest.mark.parametrize(
    ("source", "text", "printed", "ours", "verdict"),
    [
        ("000", "the line, without limits", 11, 11, "confirmed"),
        ("000", "the line, within", 11, 4, "partly reached"),
        ("000", "Program 9: the letter", 50, 0, "cannot be reached"),
        ("000", "divided by 40", 50, 21, "partly reached"),
        ("002", "with the desired rotation", 184, 114, "partly reached"),
        ("002", "with any rotation", 184, 184, "confirmed"),
        ("003", "The spiral", 2001, 2001, "confirmed"),
    ],
)
def test_how_much_of_a_path_can_be_drawn(rows, source: str, text: str, printed: int, ours: int, verdict: str) -> None:
    found = row(rows, source, text)
    assert (found.printed, found.formula, found.ours, found.verdict) == (printed, None, ours, verdict)


@pytest.mark.parametrize(
    ("source", "text", "formula", "ours"),
    [
        ("000", "(1), (3)", (295.9, -152.0, 207.7), (363.7, 210.0, 297.4)),
        ("000", "Program 6: “", 101.8, 0.0),
        ("000", "(4)", 0.361, 1.0),
        ("000", "(22)", 4.0, 5.0),
        ("002", "RMS", 431.35, 0.0),
        ("002", "tool axis", (70.2, 75.7), 0.0),
        ("003", "θ₃ in the program: largest", 176.9, 0.0),
        ("003", "AT with", 0.0, 0.0),
        ("004", "(3.22)", 38.96, 36.03),
        ("004", "(5.22): ", -133.33, 0.0),
        ("004", "(5.22) with", (0.0, 0.0, 0.0, 50.0, -37.5, 7.5), (0.0, 0.0, 0.0, 50.0, -37.5, 7.5)),
    ],
)
def test_what_the_printed_formulas_give(rows, source: str, text: str, formula, ours) -> None:
    found = row(rows, source, text)
    assert found.formula == pytest.approx(formula, abs=0.06)
    assert found.ours == pytest.approx(ours, abs=0.06)
    assert (found.verdict == "confirmed") == (formula == ours)


def test_the_torques_of_source_002s_masses(rows) -> None:
    torques = [found.ours for found in rows if "hold the arm" in found.item]
    assert torques[0] == pytest.approx((0.0, -59.736, -18.433, 0.0, 0.0, 0.0), abs=5e-4)
    assert torques[1] == pytest.approx((0.0, -38.439, -17.788, -1.824, 0.0, 0.0), abs=5e-4)


def test_every_erratum_with_numbers_is_reproduced(rows) -> None:
    for entry in errata():
        if entry.printed is not None and entry.key not in ("002-spacing", "002-ik"):
            assert any(found.source == entry.source and found.item.startswith(entry.where) for found in rows), entry.key


def test_the_command_prints_json_or_sentences(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["reproduce", "--json"]) == DONE
    records = json.loads(capsys.readouterr().out)
    assert {tuple(record) for record in records} == {("source", "item", "printed", "formula", "ours", "verdict")}
    assert {record["source"] for record in records} == {"000", "001", "002", "003", "004"}
    assert any(record["formula"] is None and record["verdict"] == "undefined" for record in records)
    assert main(["reproduce"]) == DONE
    assert capsys.readouterr().out.strip() == reproduction_text(reproduce()).strip()
