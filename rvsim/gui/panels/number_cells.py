"""Tables whose numbers can be typed over."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QLineEdit,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from rvsim.gui.panels.tables import Index


class NumberDelegate(QStyledItemDelegate):
    """Editors that fit into their cells; each has the object name `name`."""

    def __init__(self, name: str, table: QTableView) -> None:
        super().__init__(table)
        self._name = name

    def createEditor(self, parent: QWidget, _option: QStyleOptionViewItem, index: Index) -> QWidget:
        """A line without the padding of boxes that stand alone."""
        line = QLineEdit(parent)
        line.setObjectName(self._name)
        line.setAccessibleName(str(index.model().headerData(index.column(), Qt.Orientation.Horizontal)))
        line.setAlignment(Qt.AlignmentFlag.AlignRight)
        line.setStyleSheet("padding: 0 2px; min-height: 0; border-radius: 0;")
        return line

    def updateEditorGeometry(self, editor: QWidget, option: QStyleOptionViewItem, _index: Index) -> None:
        """The whole cell."""
        editor.setGeometry(option.rect)


def make_editable(table: QTableView, name: str) -> None:
    """Let the cells that the model's flags allow be typed into, by a double click or by typing at once."""
    triggers = QAbstractItemView.EditTrigger
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.AnyKeyPressed)
    table.setItemDelegate(NumberDelegate(name, table))
