"""A value that a box did not take: a red frame around the box and a bubble that says why, for as long as one reads."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtWidgets import QLabel, QWidget

from rvsim.gui.theme import set_role

_SHOWN_MS = 8000
_WIDTH, _GAP = 240, 6  # [pixels]


def show_refusal(box: QWidget, sentence: str) -> None:
    """Say at the box why what was typed there was not taken."""
    if box.isVisible():
        set_role(box, refused=True)
        bubble = _bubble(box.window())
        bubble.setText(sentence)
        bubble.ensurePolished()  # its padding counts
        bubble.resize(_WIDTH, bubble.heightForWidth(_WIDTH))
        bubble.move(_place(box, bubble))
        bubble.show()
        bubble.raise_()
        QTimer.singleShot(_SHOWN_MS, box, lambda: end_refusal(box))


def end_refusal(box: QWidget) -> None:
    """The box has another value, or is being typed into."""
    if box.property("refused"):
        set_role(box, refused=False)
        _bubble(box.window()).hide()


def _bubble(window: QWidget) -> QLabel:
    """The one of a window. No tooltip: that goes with the focus, which leaves the box at the same moment."""
    bubble = window.findChild(QLabel, "refusal_bubble")
    if bubble is None:
        bubble = QLabel(window, wordWrap=True)
        bubble.setObjectName("refusal_bubble")
        bubble.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        bubble.hide()
    return bubble


def _place(box: QWidget, bubble: QWidget) -> QPoint:
    """Beside the box, to the middle of the window: below it is the box that is typed into next."""
    window = box.window()
    left, right = box.mapTo(window, QPoint(0, 0)).x(), box.mapTo(window, QPoint(box.width(), 0)).x()
    inwards = right + _GAP if left + right < window.width() else left - _GAP - bubble.width()
    x = max(0, min(inwards, window.width() - bubble.width()))
    y = max(0, min(box.mapTo(window, QPoint(0, 0)).y(), window.height() - bubble.height()))
    return QPoint(x, y)
