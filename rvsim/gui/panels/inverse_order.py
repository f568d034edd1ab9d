"""The order of preference among the branches: a small list to be put in order, and the button that opens it."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.kinematics import ORDER_CRITERIA
from rvsim.language import tr

_NAME = Qt.ItemDataRole.UserRole  # of a criterion, in English


class OrderList(QListWidget):
    """The criteria, the most important first; only the ticked ones count. `changed()` tells another order."""

    changed = Signal()

    def __init__(self, order: tuple[str, ...]) -> None:
        super().__init__()
        self.setObjectName("order_list")
        self.setAccessibleName(tr("Order of preference"))
        self.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        self.setDefaultDropAction(Qt.DropAction.MoveAction)
        for name in (*order, *(name for name in ORDER_CRITERIA if name not in order)):
            item = QListWidgetItem(tr(name))
            item.setData(_NAME, name)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable & ~Qt.ItemFlag.ItemIsDropEnabled)
            item.setCheckState(Qt.CheckState.Checked if name in order else Qt.CheckState.Unchecked)
            self.addItem(item)
        self.setCurrentRow(0)
        self.model().rowsMoved.connect(lambda *_: self.changed.emit())
        self.itemChanged.connect(lambda _: self.changed.emit())

    @property
    def order(self) -> tuple[str, ...]:
        """The ticked criteria."""
        items = [self.item(row) for row in range(self.count())]
        return tuple(str(item.data(_NAME)) for item in items if item.checkState() == Qt.CheckState.Checked)

    def sizeHint(self) -> QSize:
        """As high as its rows."""
        return QSize(230, self.sizeHintForRow(0) * self.count() + 2 * self.frameWidth() + 4)

    def shift(self, step: int) -> None:
        """The chosen criterion up (−1) or down (1)."""
        row = self.currentRow()
        if 0 <= row + step < self.count():
            item = self.takeItem(row)
            self.insertItem(row + step, item)
            self.setCurrentRow(row + step)
            self.changed.emit()


class OrderButton(QToolButton):
    """Says the order, and opens the list that changes it. `order_changed(order)` tells another one."""

    order_changed = Signal(tuple)

    def __init__(self, order: tuple[str, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("order_button")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self.setAccessibleName(tr("Order of preference among the branches"))
        self.list = OrderList(order)
        self._popup = self._make_popup()
        self.clicked.connect(self.open)
        self.list.changed.connect(self._on_changed)
        self._show()

    def _make_popup(self) -> QFrame:
        popup = QFrame(self, Qt.WindowType.Popup)
        popup.setObjectName("order_popup")
        popup.setFrameShape(QFrame.Shape.StyledPanel)
        what = QLabel(
            tr("Which branch is best? The first criterion decides, the next one between equals."), wordWrap=True
        )
        set_role(what, role="muted")
        row = QHBoxLayout()
        row.addWidget(button("order_up_button", tr("↑ Up"), tr("More important"), lambda: self.list.shift(-1)))
        row.addWidget(button("order_down_button", tr("↓ Down"), tr("Less important"), lambda: self.list.shift(1)))
        row.addStretch(1)
        column = QVBoxLayout(popup)
        column.addWidget(what)
        column.addWidget(self.list)
        column.addLayout(row)
        return popup

    def open(self) -> None:
        """Open the list above or below the button."""
        self._popup.adjustSize()
        above = self.mapToGlobal(QPoint(0, -self._popup.height()))
        self._popup.move(above if above.y() >= 0 else self.mapToGlobal(QPoint(0, self.height())))
        self._popup.show()
        self.list.setFocus()

    def _on_changed(self) -> None:
        self._show()
        if self.list.order:
            self.order_changed.emit(self.list.order)

    def _show(self) -> None:
        order = " › ".join(map(tr, self.list.order)) or tr("as they come")
        self.setText(tr("Order: {order} ▾", order=order))
        self.setToolTip(tr("The best branch: {order}. Press to change the order.", order=order))
