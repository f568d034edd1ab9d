"""About rvsim: what it is, its licence and those of its parts, and the facts that help to help."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontDatabase, QGuiApplication, QIcon
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPlainTextEdit, QVBoxLayout

import rvsim
from rvsim.gui.diagnostics import diagnostics
from rvsim.gui.help.show import show_help
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import tr
from rvsim.resources import resource

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_WIDTH, _LINES, _ICON = 480, 12, 48


class AboutDialog(QDialog):
    """Non-modal in effect: nothing waits for it."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("about_dialog")
        self.setWindowTitle(tr("About rvsim"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._window = window
        self._make_facts()
        self.copied = QLabel()
        self.copied.setObjectName("about_copied")
        set_role(self.copied, level="good")
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 12)
        column.setSpacing(10)
        column.addLayout(self._head())
        column.addWidget(self._words())
        column.addWidget(self.facts)
        column.addWidget(self.copied)
        column.addLayout(self._foot())
        self.resize(min(_WIDTH, window.width()), self.sizeHint().height())

    def _head(self) -> QHBoxLayout:
        version = tr("Version {version}", version=rvsim.__version__)
        side = "right" if self.isRightToLeft() else "left"  # the name alone would put it at the left
        title = QLabel(
            f"<p align='{side}'><span style='font-size: large; font-weight: 600'>rvsim</span><br>{version}</p>"
        )
        icon = QLabel()
        icon.setPixmap(QIcon(str(resource("icons", "rvsim.svg"))).pixmap(_ICON, _ICON))
        row = QHBoxLayout()
        row.setSpacing(12)
        row.addWidget(icon)
        row.addWidget(title, 1)
        return row

    def _words(self) -> QLabel:
        words = QLabel(
            tr(
                "See, move, compute and understand a robot arm. Free software under the MIT licence; it comes without "
                "any warranty. The window is made with Qt for Python, which is under the LGPL, version 3."
            )
        )
        words.setWordWrap(True)
        return words

    def _make_facts(self) -> None:
        self.facts = QPlainTextEdit(diagnostics(self._window.scene_view.renderer.description))
        self.facts.setObjectName("about_facts")
        self.facts.setAccessibleName(tr("Versions and diagnostics"))
        self.facts.setReadOnly(True)
        self.facts.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # English, in every language
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPointSizeF(QFont(self.font()).pointSizeF() * 0.95)
        self.facts.setFont(font)
        self.facts.setMinimumHeight(_LINES * self.facts.fontMetrics().lineSpacing())

    def _foot(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.addWidget(button("about_copy", tr("Copy diagnostics"), tr("All that stands above"), self.copy))
        row.addWidget(
            button("about_licences", tr("Licences"), tr("That of rvsim, and those of its parts"), self._licences)
        )
        row.addStretch(1)
        row.addWidget(button("about_close", tr("Close"), "Esc", self.close, primary=True))
        return row

    def copy(self) -> None:
        """The facts on the clipboard."""
        QGuiApplication.clipboard().setText(self.facts.toPlainText())
        self.copied.setText(tr("Copied. Put it into a mail or a report of a fault."))

    def _licences(self) -> None:
        self.close()
        show_help(self._window, "licences")
