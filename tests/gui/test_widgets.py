"""A label with long words keeps them whole as long as it can."""

from __future__ import annotations

from pytestqt.qtbot import QtBot

from rvsim.gui.widgets import ElidedLabel


def test_a_label_breaks_at_a_hyphen_before_it_leaves_letters_out(qtbot: QtBot) -> None:
    whole, broken, cut = ElidedLabel(), ElidedLabel(), ElidedLabel()
    for label, height in ((whole, 40), (broken, 40), (cut, 16)):
        qtbot.addWidget(label)
        label.setText("Handgelenk-Nicken")
        room = label.fontMetrics().horizontalAdvance("Handgelenk-" if label is not whole else label.text()) + 8
        label.setFixedSize(room, height)
    inked = [_ink(label) for label in (whole, broken, cut)]
    assert abs(inked[0] - inked[1]) < 0.1 * inked[0]
    assert inked[2] < 0.8 * inked[0]


def _ink(label: ElidedLabel) -> int:
    picture = label.grab().toImage()
    ground = picture.pixel(0, 0)
    return sum(picture.pixel(x, y) != ground for x in range(picture.width()) for y in range(picture.height()))
