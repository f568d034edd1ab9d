"""Buttons stand in as few rows as fit, and these are filled alike."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.panels.folding_row import WrappedRow
from rvsim.gui.rows import rows_of


@pytest.mark.parametrize(
    ("widths", "rows"),
    [
        ([60] * 5, (5,)),
        ([80] * 5, (3, 2)),
        ([100, 70, 100, 120], (2, 2)),
        ([134, 166, 88, 68, 92, 127, 81], (2, 3, 2)),
        ([400, 20, 20], (1, 1, 1)),
        ([], ()),
    ],
)
def test_rows_are_few_and_filled_alike(widths: list[int], rows: tuple[int, ...]) -> None:
    assert rows_of(widths, gap=2, room=342) == rows


def test_a_row_wraps_where_its_buttons_would_be_cut_and_unwraps_again(qtbot: QtBot) -> None:
    buttons = [QPushButton(text) for text in ("Stellung", "Gerade", "Bogen", "Warten", "Greifen")]
    row, around = WrappedRow(buttons, 4, QLabel("Neu")), QWidget()
    row.setParent(around)
    qtbot.addWidget(around)
    around.show()
    counts = []
    for width in (900, row.minimumSizeHint().width(), 900):
        row.resize(width, 300)
        QApplication.processEvents()
        assert all(button.width() >= button.minimumSizeHint().width() for button in buttons)
        counts.append(row.counts)
    assert counts[0] == counts[2] == (5,)
    assert len(counts[1]) > 1
    assert sum(counts[1]) == len(buttons)
