"""After a crash: what was left of it, and whether to go on with it."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QListWidget, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.files.session_file import load_session
from rvsim.gui.autosave import Leftover, leftovers
from rvsim.gui.document import Document
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import left_to_right, tr, tr_later

_UNREADABLE = tr_later("a copy that cannot be read")


def offer_recovery(document: Document, window: QWidget) -> None:
    """Offer what crashes have left, if there is any."""
    left = leftovers()
    if left:
        RecoveryDialog(document, left, window).open()


class RecoveryDialog(QDialog):
    """The copies, the newest first. What is neither recovered nor deleted is offered again at the next start."""

    def __init__(self, document: Document, left: Sequence[Leftover], parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("recovery_dialog")
        self.setWindowTitle(tr("Recover"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._document = document
        told = sorted(((_words(one), one) for one in left), key=lambda pair: tr(_UNREADABLE) in pair[0])
        self._left = [one for _, one in told]
        title = QLabel(tr("rvsim ended without being closed. Your work is still here."))
        title.setWordWrap(True)
        set_role(title, role="title")
        words = QLabel(tr("Choose what to go on with. Your files are as you last saved them: nothing is replaced yet."))
        words.setWordWrap(True)
        set_role(words, role="muted")
        self.list = QListWidget()
        self.list.setObjectName("recovery_list")
        self.list.setAccessibleName(tr("What can be recovered"))
        self.list.setStyleSheet("QListWidget::item { padding: 6px 8px; }")
        self.list.addItems([words for words, _ in told])
        self.list.currentTextChanged.connect(self._show_chosen)
        self.list.itemActivated.connect(lambda _: self._recover())
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(12)
        for widget in (title, words, self.list):
            column.addWidget(widget)
        column.addLayout(self._buttons())
        self.list.setCurrentRow(0)
        self.resize(480, 320)

    def _buttons(self) -> QHBoxLayout:
        tip = tr("Throw this copy away; a file that you saved stays")
        self.delete_button = button("recovery_delete", tr("Delete copy"), tip, self._delete)
        self.later_button = button("recovery_later", tr("Not now"), tr("Ask again at the next start"), self.close)
        tip = tr("Go on with this copy")
        self.recover_button = button("recovery_recover", tr("Recover"), tip, self._recover, primary=True)
        self.recover_button.setDefault(True)
        row = QHBoxLayout()
        row.addWidget(self.delete_button)
        row.addStretch(1)
        row.addWidget(self.later_button)
        row.addWidget(self.recover_button)
        return row

    def _show_chosen(self, words: str) -> None:
        self.recover_button.setEnabled(tr(_UNREADABLE) not in words)

    def _recover(self) -> None:
        if self._document.recover(self._left[self.list.currentRow()]):
            self.close()

    def _delete(self) -> None:
        row = self.list.currentRow()
        self._left.pop(row).delete()
        self.list.takeItem(row)
        if not self._left:
            self.close()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Leave the others to the next start."""
        self._release()
        super().closeEvent(event)

    def reject(self) -> None:
        """Esc: not now."""
        self._release()
        super().reject()

    def _release(self) -> None:
        for leftover in self._left:
            leftover.release()
        self._left.clear()


def _words(leftover: Leftover) -> str:
    name = leftover.original.stem if leftover.original else tr("Untitled")
    when = _date(leftover.when)
    try:
        arm = tr(load_session(leftover.file).state.experiment.robot.title)
    except RvsimError:
        arm = tr(_UNREADABLE)
    return f"{name}\n{tr('{arm}, {when}', arm=arm, when=left_to_right(when))}"


def _date(seconds: float) -> str:
    """In words, also where a clock was wrong: not every system knows years before 1970 or after 9999."""
    try:
        return datetime.fromtimestamp(seconds).strftime("%Y-%m-%d %H:%M")
    except (OSError, OverflowError, ValueError):
        return tr("at an unknown time")
