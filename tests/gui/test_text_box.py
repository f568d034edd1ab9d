"""A box for several lines takes what there is room for, and stays quick."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QTextOption
from pytestqt.qtbot import QtBot

from rvsim.gui.text_box import TextBox


@pytest.fixture
def box(qtbot: QtBot) -> TextBox:
    made = TextBox("abc", longest=5000)
    qtbot.addWidget(made)
    return made


def paste(box: TextBox, text: str) -> None:
    data = QMimeData()
    data.setText(text)
    box.insertFromMimeData(data)


def test_of_ten_megabytes_it_takes_what_there_is_room_for_and_says_so(box: TextBox, qtbot: QtBot) -> None:
    with qtbot.waitSignal(box.left_out):
        paste(box, "١٢٣ " * 2_500_000)
    assert len(box.toPlainText()) == 5000
    assert box.toPlainText().startswith("١٢٣ ")
    assert box.toPlainText().endswith("abc")


def test_what_is_replaced_makes_room(box: TextBox, qtbot: QtBot) -> None:
    box.selectAll()
    with qtbot.assertNotEmitted(box.left_out):
        paste(box, "x" * 5000)
    assert box.toPlainText() == "x" * 5000
    box.undo()
    assert box.toPlainText() == "abc"


def test_a_word_without_an_end_is_broken_anywhere_and_others_between_words(box: TextBox) -> None:
    """Qt looks for the places to break a word with the square of its length."""
    paste(box, "two words " * 400)
    assert box.wordWrapMode() == QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere
    box.setPlainText("١" * 4000)
    assert box.wordWrapMode() == QTextOption.WrapMode.WrapAnywhere


def test_a_text_stands_on_the_side_where_it_begins(box: TextBox) -> None:
    sides = []
    for text in ("abc", "\u2212156.7\u00b0 \u0632\u0627\u0648\u064a\u0629", "elbow"):
        box.setPlainText(text)
        sides.append(box.document().defaultTextOption().alignment())
    assert sides == [Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignRight, Qt.AlignmentFlag.AlignLeft]
