"""The tables of the read-outs: no grid, no row header, as high as their rows, a dot in the joint's colour."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache

from PySide6.QtCore import QAbstractItemModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor, QFontMetrics, QGuiApplication, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

Index = QModelIndex | QPersistentModelIndex
_AS_SAID = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignAbsolute  # heads too, where one reads from the right
RIGHT = Qt.AlignmentFlag.AlignRight | _AS_SAID
LEFT = Qt.AlignmentFlag.AlignLeft | _AS_SAID
_DOT = 10
_HEAD_PADDING = 13  # [pixels] that the style keeps left and right of a head, together
CELL_MARGIN = 9  # [pixels] that a cell keeps left and right of its text, together


def plain_table(name: str, title: str, model: QAbstractItemModel, table: QTableView | None = None) -> QTableView:
    """A calm table of a model; its columns share the width. `table` is an empty one to be made so.

    Numbers stand from left to right in any language, as they do in formulas.
    """
    table = table or QTableView()
    table.setObjectName(name)
    table.setAccessibleName(title)
    table.setModel(model)
    table.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
    table.setShowGrid(False)
    table.setAlternatingRowColors(True)
    table.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
    table.verticalHeader().hide()
    table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    columns = table.horizontalHeader()
    columns.setMinimumSectionSize(24)
    columns.setHighlightSections(False)
    columns.setTextElideMode(Qt.TextElideMode.ElideRight)
    columns.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
    return table


def fit_height(table: QTableView) -> None:
    """As high as all its rows need, and no higher; lower than that, it scrolls."""
    row = text_metrics().height() + 10
    if row != table.verticalHeader().defaultSectionSize():
        table.verticalHeader().setDefaultSectionSize(row)
    rows = row * table.model().rowCount()
    table.setMaximumHeight(table.horizontalHeader().sizeHint().height() + rows + 2 * table.frameWidth() + 2)


def keep_whole(table: QTableView, columns: Iterable[int], longest: str) -> None:
    """Give these columns the room of their heads and of the longest text, also in other fonts; others share the rest.

    A head that changes is asked for again.
    """
    columns, header = tuple(columns), table.horizontalHeader()

    def fit() -> None:
        model = table.model()
        for column in columns if model is not None else ():  # while its window goes it has none
            head = str(model.headerData(column, Qt.Orientation.Horizontal))
            widest = max(table.fontMetrics().horizontalAdvance(text) for text in (head, longest))
            header.resizeSection(column, widest + _HEAD_PADDING)

    for column in columns:
        header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
    table.model().headerDataChanged.connect(fit)
    header.geometriesChanged.connect(fit)
    fit()


def decimals_that_fit(texts: Callable[[int], Iterable[str]], decimals: int, room: float) -> int:
    """With how many decimals, `decimals` or fewer, all of `texts(decimals)` are no wider than `room` [pixels].

    Numbers that lost their ends would be other ones: those with fewer decimals are only less exact.
    """
    metrics = text_metrics()
    for fewer in range(decimals, 0, -1):
        if metrics.horizontalAdvance(max(texts(fewer), key=len, default="")) <= room:
            return fewer
    return 0


def text_metrics() -> QFontMetrics:
    """The metrics of the window's font: a table may not have heard yet that it changed."""
    return QFontMetrics(QGuiApplication.font())


@lru_cache(maxsize=64)
def dot(color: str) -> QIcon:
    """A round dot of a colour "#rrggbb"."""
    pixmap = QPixmap(2 * _DOT, 2 * _DOT)
    pixmap.setDevicePixelRatio(2.0)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(color))
    painter.drawEllipse(1, 1, _DOT - 2, _DOT - 2)
    painter.end()
    return QIcon(pixmap)
