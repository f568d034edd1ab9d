"""A row that folds in two where it is too narrow, so that no button of it is cut."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QWidget


class FoldingRow(QWidget):
    """Two groups of widgets, beside each other while there is room, else below each other."""

    def __init__(self, first: QHBoxLayout, second: QHBoxLayout, spacing: int) -> None:
        super().__init__()
        self._groups = first, second
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(spacing)
        for group in self._groups:
            group.setSpacing(spacing)
            self._row.addLayout(group, 1 if group is first else 0)

    @property
    def folded(self) -> bool:
        """Whether the second group stands below the first."""
        return self._row.direction() == QBoxLayout.Direction.TopToBottom

    def minimumSizeHint(self) -> QSize:
        """As narrow as the wider group: below that the row cannot fold any further."""
        widest = max(group.minimumSize().width() for group in self._groups)
        return QSize(widest, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width."""
        super().resizeEvent(event)
        self._fold()

    def event(self, event: QEvent) -> bool:
        """Other widths of the buttons: another font, another text."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._fold()
        return super().event(event)

    def _fold(self) -> None:
        needed = sum(group.minimumSize().width() for group in self._groups) + self._row.spacing()
        ways = QBoxLayout.Direction
        self._row.setDirection(ways.LeftToRight if needed <= self.width() else ways.TopToBottom)


def group_of(*widgets: QWidget, stretched: bool) -> QHBoxLayout:
    """Widgets in a row; either the first one takes what is left over, or what is left stays empty."""
    row = QHBoxLayout()
    for i, widget in enumerate(widgets):
        row.addWidget(widget, int(stretched and i == 0))
    if not stretched:
        row.addStretch(1)
    return row
