"""A file that cannot be read or written: said in the status line, and in a box that does not hold up the window."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from rvsim.gui.session import Session


def tell_problem(window: QWidget, session: Session, what: str, problem: str) -> None:
    """`what` was not done, a sentence, and why."""
    session.say(f"{what} {problem}", "error")
    box = QMessageBox(QMessageBox.Icon.Warning, "rvsim", what, parent=window)
    box.setObjectName("file_problem")
    box.setInformativeText(problem)
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.open()
