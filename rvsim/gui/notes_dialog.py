"""The student's name and notes: beside the window, so that one can write while the arm moves."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker
from PySide6.QtGui import QTextCursor
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLineEdit, QVBoxLayout, QWidget

from rvsim.experiment import Experiment, Notes
from rvsim.files.session.tables import LONGEST_NOTES
from rvsim.gui.session import Session
from rvsim.gui.text_box import TextBox
from rvsim.gui.widgets import form
from rvsim.language import tr

_LONGEST_NAME = 2000


class NotesDialog(QDialog):
    """Every letter is part of the experiment at once; what is written in one go is one undo step."""

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("notes_dialog")
        self.setWindowTitle(tr("Notes"))
        self._session = session
        self.student = QLineEdit()
        self.student.setObjectName("notes_student")
        self.student.setAccessibleName(tr("Your name"))
        self.student.setMaxLength(_LONGEST_NAME)
        self.student.textEdited.connect(lambda _: self._write(tr("Write the name"), "student"))
        self.student.editingFinished.connect(session.end_stroke)
        self.text = TextBox(longest=LONGEST_NOTES)
        self.text.setObjectName("notes_text")
        self.text.setAccessibleName(tr("Notes"))
        self.text.setTabChangesFocus(True)
        self.text.setPlaceholderText(tr("What you did, what you saw, what you conclude. It is saved with the session."))
        self.text.left_out.connect(self._tell_limit)
        self.text.textChanged.connect(lambda: self._write(tr("Write notes"), "text"))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.button(QDialogButtonBox.StandardButton.Close).setText(tr("Close"))
        buttons.rejected.connect(self.close)
        rows = form()
        rows.addRow(tr("Your name"), self.student)
        column = QVBoxLayout(self)
        column.addLayout(rows)
        column.addWidget(self.text, 1)
        column.addWidget(buttons)
        self.resize(460, 380)
        session.changed.connect(self._on_changed)
        self._show(session.experiment.notes)

    def take_over(self, other: NotesDialog) -> None:
        """Open in the place of one in another language, with the cursor where it was."""
        self.restoreGeometry(other.saveGeometry())
        self.show()
        before, cursor = other.text.textCursor(), self.text.textCursor()
        cursor.setPosition(before.anchor())
        cursor.setPosition(before.position(), QTextCursor.MoveMode.KeepAnchor)
        self.text.setTextCursor(cursor)
        self.student.setCursorPosition(other.student.cursorPosition())
        (self.student if other.focusWidget() is other.student else self.text).setFocus()
        self.text.verticalScrollBar().setValue(other.text.verticalScrollBar().value())

    def _write(self, text: str, merge: str) -> None:
        written = self.text.toPlainText()
        if len(written) > LONGEST_NOTES:
            self._tell_limit()
        notes = Notes(self.student.text(), written[:LONGEST_NOTES])
        self._session.edit(text, self._session.experiment.with_notes(notes), merge=f"notes {merge}")

    def _tell_limit(self) -> None:
        self._session.warn(tr("Notes have at most {most} characters: the rest was left out.", most=LONGEST_NOTES))

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.notes is not before.notes:
            self._show(after.notes)

    def _show(self, notes: Notes) -> None:
        if notes.student != self.student.text():
            self.student.setText(notes.student)
        if notes.text != self.text.toPlainText():
            with QSignalBlocker(self.text):
                self.text.setPlainText(notes.text)
