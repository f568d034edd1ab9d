"""A text to read: it scrolls where the screen is low, and the window behind it stays usable."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QTextBrowser, QVBoxLayout, QWidget

from rvsim.language import tr

_WIDTH, _SHARE = 560, 0.85  # at most this share of the window behind


class TextDialog(QDialog):
    """Rich text with a Close button, no larger than the window that it belongs to."""

    def __init__(self, parent: QWidget, title: str, text: str) -> None:
        super().__init__(parent)
        self.setObjectName("text_dialog")
        self.setWindowTitle(title)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.browser = QTextBrowser()
        self.browser.setAccessibleName(title)
        self.browser.setHtml(text)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.button(QDialogButtonBox.StandardButton.Close).setText(tr("Close"))
        buttons.rejected.connect(self.close)
        column = QVBoxLayout(self)
        column.addWidget(self.browser)
        column.addWidget(buttons)
        self.resize(self._fitting(parent.size(), buttons.sizeHint().height()))

    def _fitting(self, room: QSize, below: int) -> QSize:
        width = min(_WIDTH, int(_SHARE * room.width()))
        document = self.browser.document()
        document.setTextWidth(width - 48)
        return QSize(width, min(int(document.size().height()) + below + 56, int(_SHARE * room.height())))
