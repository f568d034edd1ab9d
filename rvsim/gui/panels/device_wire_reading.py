"""What stands below the wire's table: the picked line in full and in words, and a line to try."""

from __future__ import annotations

import re

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from rvsim.gui.panels.device_wire_lines import Line, shown_bytes
from rvsim.gui.panels.device_wire_table import fixed_style
from rvsim.gui.panels.device_wire_words import Words, what_it_would_do
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.tables import text_metrics
from rvsim.gui.theme import set_role
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot

_HINT = tr_later("Point at a line, or click it, to read what it means.")
_ROWS = 5
_LONGEST_PART = 20  # characters that are kept together
_BREAK = "\u200b"  # where a long line may go on below


class LineReading(QWidget):
    """One line of the wire: when, all its bytes, and what they mean."""

    def __init__(self) -> None:
        super().__init__()
        self.head, self.bytes, self.words = wrapped_label("muted"), wrapped_label(), wrapped_label()
        for label, name in ((self.head, "wire_when"), (self.bytes, "wire_bytes"), (self.words, "wire_words")):
            label.setObjectName(name)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.bytes.setStyleSheet(fixed_style())
        self.bytes.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        _column(self, self.head, self.bytes, self.words).addStretch(1)
        self._keep_room()

    def show_line(self, line: Line | None, words: Words | None) -> None:
        """Show a line, or how to choose one."""
        for label in (self.bytes, self.words):
            label.setVisible(line is not None)
        if line is None or words is None:
            self.head.setText(tr(_HINT))
            return
        self.head.setText(_head(line))
        self.bytes.setText(breakable(shown_bytes(line, words.language)))
        self.words.setText(words.told(line))

    def changeEvent(self, event: QEvent) -> None:
        """Another font: another room."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._keep_room()

    def _keep_room(self) -> None:
        """For most lines, or the table would jump with each that is picked."""
        self.setMinimumHeight(_ROWS * (text_metrics().height() + 2))


class TryLine(QWidget):
    """Says what an SSC-32 would do with a line, without sending it."""

    def __init__(self) -> None:
        super().__init__()
        self._robot: Robot | None = None
        self.title = wrapped_label("title")
        self.title.setText(tr("Try a line: what would it do?"))
        self.box = QLineEdit()
        self.box.setObjectName("wire_try")
        self.box.setAccessibleName(tr("A line for the SSC-32, to be explained and not sent"))
        self.box.setPlaceholderText("#0P1500#1P1800T700")
        self.box.setToolTip(tr("A line in the language of the SSC-32. It is explained, nothing is sent"))
        self.box.setStyleSheet(fixed_style())
        self.box.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.words = wrapped_label("muted")
        self.words.setObjectName("wire_try_words")
        self.words.setTextFormat(Qt.TextFormat.PlainText)
        self.box.textChanged.connect(lambda _: self._say())
        _column(self, self.title, self.box, self.words)

    def use_robot(self, robot: Robot) -> None:
        """With the names of this arm's joints."""
        if robot is not self._robot:
            self._robot = robot
            self._say()

    def _say(self) -> None:
        typed = self.box.text()
        if self._robot is None or not typed:
            self.words.setText(tr("Type a line of the SSC-32's language. Nothing is sent."))
            set_role(self.words, role="muted")
            return
        self.words.setText(what_it_would_do(typed, self._robot))
        set_role(self.words, role="")


def _head(line: Line) -> str:
    """When it went, how long it is, and which way."""
    count, time = len(line.entry.data), line.entry.time
    if line.sent:
        return trn(
            "{time:.3f} s after the start, {n} byte to the arm",
            "{time:.3f} s after the start, {n} bytes to the arm",
            count,
            time=time,
        )
    return trn(
        "{time:.3f} s after the start, {n} byte from the arm",
        "{time:.3f} s after the start, {n} bytes from the arm",
        count,
        time=time,
    )


def breakable(text: str) -> str:
    """May go on below before each #, and anywhere in what has none."""
    parts = re.split(r"(?<!^)(?=#)", text)
    return _BREAK.join(part if len(part) <= _LONGEST_PART else _BREAK.join(part) for part in parts)


def _column(widget: QWidget, *inside: QWidget) -> QVBoxLayout:
    column = QVBoxLayout(widget)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(4)
    for each in inside:
        column.addWidget(each)
    return column
