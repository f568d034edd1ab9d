"""Rows and grids that fold where they are too narrow, so that nothing in them is cut."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QGridLayout, QHBoxLayout, QVBoxLayout, QWidget

from rvsim.gui.rows import rows_of


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


class FoldingGrid(QWidget):
    """Widgets in two columns alike while the widest of them fit there, else below each other."""

    def __init__(self, widgets: Sequence[QWidget], spacing: int) -> None:
        super().__init__()
        self._widgets, self._columns = tuple(widgets), 0
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(spacing)
        self._place(2)

    @property
    def folded(self) -> bool:
        """Whether there is one column."""
        return self._columns == 1

    def minimumSizeHint(self) -> QSize:
        """As narrow as the widest."""
        return QSize(self._widest(), super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width."""
        super().resizeEvent(event)
        self._fold()

    def event(self, event: QEvent) -> bool:
        """Other widths of what is in it."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._fold()
        return super().event(event)

    def _widest(self) -> int:
        return max(widget.minimumSizeHint().width() for widget in self._widgets)

    def _fold(self) -> None:
        self._place(2 if 2 * self._widest() + self._grid.spacing() <= self.width() else 1)

    def _place(self, columns: int) -> None:
        if columns == self._columns:
            return
        self._columns = columns
        for number, widget in enumerate(self._widgets):
            self._grid.addWidget(widget, number // columns, number % columns)
        self._grid.setColumnStretch(0, 1)
        self._grid.setColumnStretch(1, columns - 1)


class WrappedRow(QWidget):
    """Widgets beside each other, each with its share of the room; in more rows, filled alike, where they would be cut.

    A label may lead the first row.
    """

    def __init__(self, widgets: Sequence[QWidget], spacing: int, lead: QWidget | None = None) -> None:
        super().__init__()
        self._widgets, self._lead = tuple(widgets), lead
        self._counts: tuple[int, ...] = ()
        whole = QHBoxLayout(self)
        self._rows = QVBoxLayout()
        for layout in (whole, self._rows):
            layout.setContentsMargins(0, 0, 0, 0)
            layout.setSpacing(spacing)
        if lead is not None:
            whole.addWidget(lead, 0, Qt.AlignmentFlag.AlignTop)
        whole.addLayout(self._rows, 1)
        self._place((len(self._widgets),))

    @property
    def counts(self) -> tuple[int, ...]:
        """How many stand in each row."""
        return self._counts

    def minimumSizeHint(self) -> QSize:
        """As narrow as the widest."""
        return QSize(max(self._needs()) + self._taken(), super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width."""
        super().resizeEvent(event)
        self._wrap()

    def event(self, event: QEvent) -> bool:
        """Other widths of what is in it."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._wrap()
        return super().event(event)

    def _needs(self) -> list[int]:
        return [widget.minimumSizeHint().width() for widget in self._widgets]

    def _taken(self) -> int:
        return self._lead.sizeHint().width() + self._rows.spacing() if self._lead else 0

    def _wrap(self) -> None:
        self._place(rows_of(self._needs(), self._rows.spacing(), self.width() - self._taken()))

    def _place(self, counts: tuple[int, ...]) -> None:
        if counts == self._counts:
            return
        self._counts, rest = counts, list(self._widgets)
        while (old := self._rows.takeAt(0)) is not None:
            old.deleteLater() if isinstance(old, QHBoxLayout) else None
        for count in counts:
            row = QHBoxLayout()
            row.setSpacing(self._rows.spacing())
            self._rows.addLayout(row)  # while it is empty: Python would keep items of what is in it (collector.py)
            for widget in rest[:count]:
                row.addWidget(widget, widget.minimumSizeHint().width())
            del rest[:count]


def group_of(*widgets: QWidget, stretched: bool) -> QHBoxLayout:
    """Widgets in a row; either the first one takes what is left over, or what is left stays empty."""
    row = QHBoxLayout()
    for i, widget in enumerate(widgets):
        row.addWidget(widget, int(stretched and i == 0))
    if not stretched:
        row.addStretch(1)
    return row
