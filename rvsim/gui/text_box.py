"""A box for several lines of text, which stays quick whatever is pasted into it."""

from __future__ import annotations

import re

from PySide6.QtCore import QMimeData, Qt, Signal
from PySide6.QtGui import QTextOption
from PySide6.QtWidgets import QPlainTextEdit, QWidget

# To find where a word may be broken takes Qt time with the square of its length: a minute for a million letters.
_LONG_WORD = re.compile(r"\S{1000}")
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
        option = self.document().defaultTextOption()
        option.setTextDirection(Qt.LayoutDirection.LayoutDirectionAuto)  # each paragraph as it is written
        self.document().setDefaultTextOption(option)
        self.setPlainText(text)

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

    def _wrap_for(self, text: str) -> None:
        if wrap_mode(text) == _WRAP.WrapAnywhere:
            self.setWordWrapMode(_WRAP.WrapAnywhere)
