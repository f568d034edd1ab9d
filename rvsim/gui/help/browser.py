"""Shows one help page: Markdown, with formulas that are drawn for the letters and the colours of now."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QUrl
from PySide6.QtGui import QGuiApplication, QImage, QTextCharFormat, QTextCursor, QTextDocument
from PySide6.QtWidgets import QTextBrowser, QTextEdit

from rvsim.gui.help.document import SCHEME, Look, dress, formula_image, prepared
from rvsim.language import tr

_MARGIN = 16.0
_MOST_MARKS = 200


class HelpBrowser(QTextBrowser):
    """Follows no link by itself, and loads nothing: neither from the disk nor from a network."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("help_browser")
        self.setAccessibleName(tr("Help page"))
        self.setOpenLinks(False)
        self._formulas: tuple[str, ...] = ()

    @property
    def formulas(self) -> tuple[str, ...]:
        """The LaTeX of all formulas of the page, in their order."""
        return self._formulas

    def show_markdown(self, source: str, slugs: Sequence[str] = ()) -> None:
        """Show a page, whose headings have these anchors."""
        page = prepared(source)
        self._formulas = page.formulas
        self.document().clear()
        self.document().setDocumentMargin(_MARGIN)
        self.document().setMarkdown(page.markdown, QTextDocument.MarkdownFeature.MarkdownDialectGitHub)
        dress(self.document(), self._look(), slugs)
        self.document().size()  # lays all of it out: else there would be nowhere to scroll to yet
        self.moveCursor(QTextCursor.MoveOperation.Start)

    def loadResource(self, _kind: int, name: QUrl | str) -> Any:
        """A formula as a picture, or nothing."""
        text = name.toString() if isinstance(name, QUrl) else name
        number = text.removeprefix(SCHEME)
        if text.startswith(SCHEME) and number.isdigit() and int(number) < len(self._formulas):
            return formula_image(self._formulas[int(number)], self._look())
        return QImage()

    def _look(self) -> Look:
        colors = QGuiApplication.palette()  # the style sheet gives the browser's own one other grounds
        return Look(
            self.font(), colors.text().color(), colors.mid().color(), colors.window().color(), self.devicePixelRatioF()
        )

    def light(self, words: str) -> None:
        """Mark what was looked for, and nothing else."""
        shape = QTextCharFormat()
        shape.setBackground(self.palette().highlight())
        shape.setForeground(self.palette().highlightedText())
        marks: list[QTextEdit.ExtraSelection] = []
        for word in words.split():
            cursor = self.document().find(word)
            while not cursor.isNull() and len(marks) < _MOST_MARKS:
                mark = QTextEdit.ExtraSelection()
                mark.cursor, mark.format = QTextCursor(cursor), shape
                marks.append(mark)
                cursor = self.document().find(word, cursor)
        self.setExtraSelections(marks)
