"""A box for several lines of text, which stays quick whatever is pasted into it."""

from __future__ import annotations

import re

from PySide6.QtCore import QMimeData, Qt, Signal
from PySide6.QtGui import QTextOption
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from rvsim.language import begins_right

# To find where a word may be broken takes Qt time with the square of its length: a minute for a million letters.
_LONG_WORD = re.compile(r"\S{1000}")
_BEGINNING = 1000  # [characters] of the first paragraph, which says where the text stands
_AUTO = Qt.LayoutDirection.LayoutDirectionAuto
_WRAP = QTextOption.WrapMode


def wrap_mode(text: str) -> QTextOption.WrapMode:
    """Between words; anywhere where one of them is so long that it would take long to find places in it."""
    return _WRAP.WrapAnywhere if _LONG_WORD.search(text) else _WRAP.WrapAtWordBoundaryOrAnywhere


class TextBox(QPlainTextEdit):
    """Takes at most `longest` characters; of what is pasted or dropped the rest is left out.

    Signals:
        left_out(): something was.
    """

    left_out = Signal()

    def __init__(self, text: str = "", longest: int = 1_000_000, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._longest = longest
        self.textChanged.connect(self._align)
        self.setPlainText(text)
        self._align()

    def setPlainText(self, text: str) -> None:
        """Show this text, the beginning of it where it is too long."""
        kept = text[: self._longest]
        self._wrap_for(kept)
        super().setPlainText(kept)
        if kept != text:
            self.left_out.emit()

    def insertFromMimeData(self, source: QMimeData) -> None:
        """Paste as much as there is room for."""
        cursor = self.textCursor()
        replaced = cursor.selectionEnd() - cursor.selectionStart()
        room = max(0, self._longest - (self.document().characterCount() - 1 - replaced))
        text = source.text()
        self._wrap_for(text[:room])
        self.insertPlainText(text[:room])
        self.ensureCursorVisible()
        if len(text) > room:
            self.left_out.emit()

    def _align(self) -> None:
        """To the side where the text begins; each paragraph has its own direction."""
        option = self.document().defaultTextOption()
        right = begins_right(self.document().begin().text()[:_BEGINNING])
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        if option.alignment() != side or option.textDirection() != _AUTO:
            option.setAlignment(side)
            option.setTextDirection(_AUTO)
            self.document().setDefaultTextOption(option)

    def _wrap_for(self, text: str) -> None:
        if wrap_mode(text) == _WRAP.WrapAnywhere:
            self.setWordWrapMode(_WRAP.WrapAnywhere)
