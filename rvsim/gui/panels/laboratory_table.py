"""The laboratory's table: one row a solver, with what it took and what is left."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from rvsim.gui.panels.laboratory_looks import SOLVER_LOOKS, sample_icon
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, fit_height, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_scientific, length_kind, shown_units
from rvsim.lab.laboratory import Contest, Outcome, verdict
from rvsim.language import tr, tr_later

_TOP = QModelIndex()
_HEADS = (tr_later("solver"), tr_later("ok"), tr_later("iter."), "ms", "", "", tr_later("verdict"))
_TIPS = (
    tr_later("The solver; point at a row to see its iterates in the scene"),
    tr_later("Whether every tolerance is kept"),
    tr_later("Iterations, of all tries together"),
    tr_later("Time in milliseconds"),
    tr_later("Position error of the result"),
    tr_later("Rotation error of the result"),
    tr_later("Why it ended"),
)
_VERDICT = len(_HEADS) - 1
_ROOM_FOR_VERDICT = 500
_HEAD_PADDING = 14  # [pixels] left and right together


class ContestModel(QAbstractTableModel):
    """Rows of a contest; empty before the first."""

    def __init__(self, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self.contest: Contest | None = None

    def show_contest(self, contest: Contest | None) -> None:
        """Show another contest, or none."""
        self.beginResetModel()
        self.contest = contest
        self.endResetModel()

    @property
    def rows(self) -> tuple[Outcome, ...]:
        """The outcomes."""
        return self.contest.outcomes if self.contest else ()

    def rowCount(self, parent: Index = _TOP) -> int:
        """The number of solvers."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """Solver, verdict, numbers."""
        return 0 if parent.isValid() else len(_HEADS)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Texts, samples of the curves, and the whole verdict as tip."""
        outcome = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._texts(outcome)[index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if index.column() in (0, _VERDICT) else RIGHT
        if role == Qt.ItemDataRole.DecorationRole and index.column() == 0:
            return sample_icon(SOLVER_LOOKS[outcome.solver], self._preferences["theme"])
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole) and self.contest:
            return verdict(self.contest.trial, outcome, shown_units(self._preferences))
        return None

    def _texts(self, outcome: Outcome) -> tuple[str, ...]:
        result = outcome.result
        place, turn = self._units()
        return (
            tr(SOLVER_LOOKS[outcome.solver].short),
            "✓" if result.converged else "✗",
            str(result.iterations),
            _milliseconds(result.elapsed),
            format_scientific(result.position_error * place[0]),
            format_scientific(result.rotation_error * turn[0]),
            result.reason,
        )

    def _units(self) -> tuple[tuple[float, str], tuple[float, str]]:
        length = length_kind(self.contest.trial.robot) if self.contest else "length"
        shown = [display(kind, self._preferences) for kind in (length, "angle")]
        place, turn = ((each.factor, each.suffix.strip()) for each in shown)
        return place, turn

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Heads with units."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if section in (0, _VERDICT) else RIGHT
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr(_TIPS[section])
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        place, turn = self._units()
        heads = {4: tr("pos. {unit}", unit=place[1]), 5: tr("rot. {unit}", unit=turn[1])}
        return heads.get(section, tr(_HEADS[section]))


def _milliseconds(seconds: float) -> str:
    return f"{seconds * 1e3:.1f}" if seconds < 0.1 else f"{seconds * 1e3:.0f}"


class ContestTable(QTableView):
    """Shows a `ContestModel`.

    Signals:
        pointed(row or −1): the pointer is on that row, or on none.
        chosen(row): a row is the current one.
    """

    pointed = Signal(int)
    chosen = Signal(int)

    def __init__(self, model: ContestModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._compact = False
        self.setObjectName("lab_table")
        self.setAccessibleName(tr("Solvers"))
        self.setModel(model)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # numbers, in any language
        self.setShowGrid(False)
        self.setAlternatingRowColors(True)
        self.setWordWrap(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self.setMouseTracking(True)
        self.setIconSize(QSize(30, 12))
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.horizontalHeader().setHighlightSections(False)
        self.horizontalHeader().setMinimumSectionSize(24)
        self.entered.connect(lambda index: self.pointed.emit(index.row()))
        self.selectionModel().currentRowChanged.connect(lambda index, _: self.chosen.emit(index.row()))
        model.modelReset.connect(self.fit)
        self.fit()

    def fit(self) -> None:
        """Widths for the longest text that comes, the rest for the verdict where there is room for it."""
        metrics = text_metrics()
        roomy = self.width() >= _ROOM_FOR_VERDICT
        self.setColumnHidden(_VERDICT, not roomy)
        names = (tr(look.short) for look in SOLVER_LOOKS.values())
        texts = (max(names, key=metrics.horizontalAdvance), "✓", "1500", "88.8", "8.8e−88", "8.8e−88")
        for column, text in enumerate(texts):
            head = str(self.model().headerData(column, Qt.Orientation.Horizontal))
            width = metrics.horizontalAdvance(text) + (44 if column == 0 else 11)
            self.setColumnWidth(column, max(width, metrics.horizontalAdvance(head) + _HEAD_PADDING))
        header = self.horizontalHeader()
        stretched = QHeaderView.ResizeMode.Stretch
        header.setSectionResizeMode(0, header.sectionResizeMode(1) if roomy else stretched)
        header.setSectionResizeMode(_VERDICT, stretched)
        fit_height(self)
        bar = self.horizontalScrollBar()
        if bar.maximum() > 0:
            self.setMaximumHeight(self.maximumHeight() + bar.sizeHint().height())
        self.setMinimumHeight(self.maximumHeight() // 2 if self._compact else self.maximumHeight())

    def set_compact(self, compact: bool) -> None:
        """Do with half the rows, and scroll."""
        if compact != self._compact:
            self._compact = compact
            self.fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width: with or without the verdict."""
        super().resizeEvent(event)
        self.fit()

    def leaveEvent(self, event: QEvent) -> None:
        """No row is pointed at any more."""
        super().leaveEvent(event)
        self.pointed.emit(-1)

    def changeEvent(self, event: QEvent) -> None:
        """Another font needs other widths."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and self.model() is not None:
            self.fit()
