"""The editor in a cell of the DH table: a line that takes expressions, steps with the arrow keys and loses nothing."""

from __future__ import annotations

from typing import cast

from PySide6.QtCore import QAbstractItemModel, QEvent, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent, QWheelEvent
from PySide6.QtWidgets import QLineEdit, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from rvsim.gui.panels.dh_cells import cell_title
from rvsim.gui.panels.dh_model import DHModel
from rvsim.gui.panels.tables import Index

_STEPS = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1, Qt.Key.Key_PageUp: 10, Qt.Key.Key_PageDown: -10}
_DONE = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab, Qt.Key.Key_Backtab)


def step_scale(modifiers: Qt.KeyboardModifier) -> float:
    """Shift steps ten times as far, Ctrl a tenth."""
    if modifiers & Qt.KeyboardModifier.ShiftModifier:
        return 10.0
    return 0.1 if modifiers & Qt.KeyboardModifier.ControlModifier else 1.0


class CellEditor(QLineEdit):
    """The line in a cell. `stepped(steps)` asks for a step from what stands in it."""

    stepped = Signal(float)

    def __init__(self, index: Index, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.index = QPersistentModelIndex(index)
        self.setObjectName("dh_cell_editor")
        self.setAccessibleName(title)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        # The style sheet's padding is for boxes of their own; in a cell it would hide the number.
        self.setStyleSheet("padding: 0 2px; min-height: 0; border-radius: 0;")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows step; everything else is typed."""
        key = Qt.Key(event.key()) if event.key() in _STEPS else None
        if key is None:
            super().keyPressEvent(event)
        else:
            self.stepped.emit(_STEPS[key] * step_scale(event.modifiers()))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """One notch is one step."""
        notches = (event.angleDelta().y() or event.angleDelta().x()) / 120.0
        if notches:
            self.stepped.emit(notches * step_scale(event.modifiers()))
        event.accept()


class CellDelegate(QStyledItemDelegate):
    """Makes the editors. A text that cannot be taken stays in its open editor, and the model says why."""

    def createEditor(self, parent: QWidget, _option: QStyleOptionViewItem, index: Index) -> QWidget:
        """A line, however many decimals the number has."""
        model = self._model(index)
        key = model.key(index)
        assert key is not None, "Qt asks for an editor only where the flags say editable"
        editor = CellEditor(index, cell_title(model.robot, index.row(), key), parent)
        editor.stepped.connect(lambda steps: self._step(editor, steps))
        return editor

    def setEditorData(self, editor: QWidget, index: Index) -> None:
        """Show the number in the cell, unless something else is being typed."""
        line = cast(CellEditor, editor)
        if not line.isModified():
            line.setText(str(index.data(Qt.ItemDataRole.EditRole)))
            line.selectAll()

    def setModelData(self, editor: QWidget, model: QAbstractItemModel, index: Index) -> None:
        """Hand the text over."""
        line = cast(CellEditor, editor)
        if line.isModified():
            model.setData(index, line.text())
            line.setModified(False)

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, _index: Index) -> None:
        """The whole cell, however tall the line would like to be."""
        editor.setGeometry(option.rect)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Do not close an editor on a text that cannot be taken."""
        if isinstance(watched, CellEditor) and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            problem = self._problem(watched) if event.key() in _DONE else ""
            if problem:
                self._model(watched.index).refused.emit(problem)
                watched.selectAll()
                return True
        return super().eventFilter(watched, event)

    def _problem(self, editor: CellEditor) -> str:
        return self._model(editor.index).problem(editor.index, editor.text()) if editor.isModified() else ""

    def _step(self, editor: CellEditor, steps: float) -> None:
        """A step goes on from what has been typed."""
        model = self._model(editor.index)
        if editor.isModified() and not model.setData(editor.index, editor.text()):
            return
        editor.setModified(False)
        if model.step(editor.index, steps):
            self.setEditorData(editor, editor.index)

    @staticmethod
    def _model(index: Index) -> DHModel:
        return cast(DHModel, index.model())
