"""The bundle of a report: all of it or nothing, needs nothing else, and says who made it."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtGui import QPainterPath

from rvsim import load_robot
from rvsim.errors import FileWriteError
from rvsim.gui.report.artist import PageArtist, path_data
from rvsim.gui.report.bundle import Order, free_folder, write_bundle
from rvsim.gui.report.strips import block_strips
from rvsim.gui.report.table_strips import _grid
from rvsim.gui.report.typography import BODY, Text, aside
from rvsim.lab import default_experiment
from rvsim.lab.repairs import motion_of, path_of
from rvsim.lab.report import Cover, Study
from rvsim.lab.report.values import Column, Formulas, Table
from rvsim.language import speak
from rvsim.motion import track

COVER = Cover("Laboratory 3", "Layla Haddad", "22 November 2026", "It went well.")


def study_of(name: str) -> Study:
    experiment = default_experiment(load_robot(name))
    tracking = track(experiment.robot, path_of("line", experiment), near=experiment.q)
    return Study(experiment, tracking, motion_of(tracking, experiment))


def test_a_bundle_is_complete_and_needs_nothing_else(qapp, tmp_path: Path) -> None:
    folder = tmp_path / "report"
    order = Order(folder, COVER, frozenset({"pose", "jacobian", "path", "motion"}), zipped=True, session=b"{}")
    shares = [progress.share for progress in write_bundle(study_of("rv-1a"), order)]
    assert shares == sorted(shares)
    assert shares[-1] < 1.0
    names = {"report.html", "report.pdf", "script.py", "path.csv", "motion.csv", "experiment.rvsim"}
    assert {file.name for file in folder.iterdir()} == names
    assert {file.name for file in tmp_path.iterdir()} == {"report", "report.zip"}
    assert set(zipfile.ZipFile(tmp_path / "report.zip").namelist()) == names
    _check_page((folder / "report.html").read_text(encoding="utf-8"), str(tmp_path))
    _check_paper((folder / "report.pdf").read_bytes())


def _check_page(page: str, here: str) -> None:
    root = ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))
    assert "http" not in page
    assert "file:" not in page
    assert here not in page
    assert all(image.get("src", "").startswith("data:image/png;base64,") for image in root.iter("img"))
    names = [element.get("id") for element in root.iter() if element.get("id")]
    used = {element.get("href", "#")[1:] for element in root.iter("use")}
    assert len(names) == len(set(names))
    assert used == set(names)
    assert COVER.author in page


def _check_paper(paper: bytes) -> None:
    assert paper.startswith(b"%PDF-")
    assert len(re.findall(rb"/Type\s*/Page\b", paper)) >= 3
    assert COVER.author.encode() in paper or COVER.author.encode("utf-16-be") in paper


def test_nothing_is_written_where_nothing_can_be(qapp, tmp_path: Path) -> None:
    study = Study(default_experiment(load_robot("planar")))
    there = tmp_path / "there"
    there.mkdir()
    for folder, word in ((there, "already"), (tmp_path / "no" / "such", "no folder")):
        with pytest.raises(FileWriteError, match=word):
            next(write_bundle(study, Order(folder, COVER)))
    assert list(tmp_path.iterdir()) == [there]
    assert list(there.iterdir()) == []
    assert free_folder(tmp_path, "there") == tmp_path / "there-2"


def test_giving_up_leaves_nothing_behind(qapp, tmp_path: Path) -> None:
    work = write_bundle(study_of("planar"), Order(tmp_path / "report", COVER, animation=True))
    for _ in range(5):
        next(work)
    assert len(list(tmp_path.iterdir())) == 1
    work.close()
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_is_full_leaves_nothing_behind(qapp, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    work = write_bundle(study_of("planar"), Order(tmp_path / "report", COVER))
    with pytest.raises(FileWriteError, match="no space left"):
        list(work)
    assert list(tmp_path.iterdir()) == []


# --- formulas of the page ------------------------------------------------------------------------------------------


def test_a_formula_outlines_each_letter_once(qapp) -> None:
    drawn = ElementTree.fromstring(PageArtist().formula("a+a+a = 3\\,a"))
    assert len(list(drawn.iter("use"))) == 7 + 1
    assert len(list(drawn.iter("path"))) == 4
    assert drawn.get("aria-label") == "a+a+a = 3 a"


def test_outlines_are_paths_of_svg(qapp) -> None:
    path = QPainterPath()
    path.moveTo(0.0, 1.0)
    path.cubicTo(1.0, 2.0, 3.0, 4.0, 5.0, 6.5)
    path.lineTo(7.0, 8.0)
    assert path_data(path) == "M0 1C1 2 3 4 5 6.5L7 8"


# --- tables and matrices -------------------------------------------------------------------------------------------


def test_text_that_may_break_does_so_before_all_letters_become_smaller(qapp) -> None:
    long, numbers = "shoulder on the right, wrist flipped", ("123.4",) * 8
    for wide in (True, False):
        columns = (Column("", "left", wide=wide), *(Column("q"),) * 8)
        grid = _grid(Table("", columns, ((long, *numbers),)), 340.0)
        assert (grid.scale == 1.0) == wide
        assert grid.lefts[-1] + grid.widths[-1] <= 340.0


def test_formulas_side_by_side_stand_below_each_other_and_inside_the_page(qapp) -> None:
    matrix = "A = \\begin{bmatrix} -0.7642 & -0.6450 & 0.0000 & 299.70 \\end{bmatrix}"
    for count, lines in ((1, 1), (4, 2), (5, 3)):
        strips = list(block_strips(Formulas((matrix,) * count), 453.0))
        assert len(strips) == lines


# --- from right to left --------------------------------------------------------------------------------------------


@pytest.fixture
def arabic() -> Iterator[None]:
    speak("ar")
    yield
    speak("en")


def test_on_a_page_from_the_right_words_begin_there_and_nothing_leaves_their_room(qapp, arabic: None) -> None:
    for words in ("\u0627\u0644\u0645\u0641\u0635\u0644 J1", "q = 3", "3"):
        text = Text(words, BODY, 200.0)
        assert text.left + text.width == pytest.approx(200.0)
    assert aside(200.0, 20.0, 30.0) == 150.0
    speak("en")
    assert Text("q = 3", BODY, 200.0).left == aside(200.0, 0.0, 30.0) == 0.0


def test_tables_of_words_are_mirrored_and_those_of_numbers_are_not(qapp, arabic: None) -> None:
    word, number = Column("", "left"), Column("")
    for columns, mirrored in (((word, word, number), True), ((word, number, number), False)):
        grid = _grid(Table("", columns, (("a",) * 3,)), 400.0)
        assert (grid.lefts[0] > grid.lefts[-1]) == mirrored
        assert grid.left + grid.width == pytest.approx(400.0)
