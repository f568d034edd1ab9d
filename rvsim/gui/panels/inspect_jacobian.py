"""The Jacobian page: J with its rows, columns and units, and where each column comes from, here and in the scene."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QCheckBox, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.folding_row import FoldingRow, group_of
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_jacobian_table import JacobianModel, JacobianTable
from rvsim.gui.panels.inspect_jacobian_words import (
    FORMULAS,
    KINDS,
    check_line,
    column_equations,
    column_note,
    column_title,
    entry_units,
    meaning,
    plain_units_line,
    shown_values,
    speed_text,
    table_columns,
    table_rows,
    units_line,
    whole_equations,
)
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_sources_button import SourcesButton
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.widgets import column_of, combo, scrolled, show_whole
from rvsim.kinematics.differences import Rows, jacobian_by_differences
from rvsim.lab.texts import matrix_latex, matrix_numpy, matrix_text
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.scene.jacobian_column import column_items

_PARTS = {"all": tr_later("All of J"), "position": tr_later("Position, Jv"), "turning": tr_later("Turning, Jω")}
_ROWS = {"all": slice(0, 6), "position": slice(0, 3), "turning": slice(3, 6)}
_SIGNS = {"all": "J", "position": "Jv", "turning": "Jω"}
_HINT = tr_later("Point at a column, or go to it with the arrow keys: the scene shows where it comes from.")
_GAP = 6  # [pixels]
_RANK_ABOVE = 1e-6  # a singular value, as everywhere in this program
_MARKS = {"text": "", "NumPy": "# ", "LaTeX": "% "}
_PLAIN = str.maketrans("ẋẏżωφθψ′", "xyzwpts'")


class JacobianPage(InspectPage):
    """Shows J of the present pose."""

    always = True
    title = tr_later("Jacobian")
    name = "inspect_jacobian"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._J: FloatArray = np.zeros((6, 0))
        self.kinds = combo(
            "jacobian_axes", tr("Rows of the Jacobian"), {name: kind.title for name, kind in KINDS.items()}
        )
        self.parts = combo("jacobian_part", tr("Part of the Jacobian"), _PARTS)
        for box in (self.kinds, self.parts):
            box.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        makers = {"text": matrix_text, "NumPy": matrix_numpy, "LaTeX": matrix_latex}
        formats = {
            name: (lambda make=make, name=name: self._copied(make(self.shown), name)) for name, make in makers.items()
        }
        self.copy = CopyButton("jacobian_copy", tr("the Jacobian"), formats, session)
        self.table = JacobianTable(JacobianModel(self, self.catch_up))
        self.table.lit.connect(lambda _: self._show_column())
        self.meaning, self.units, self.rank, self.check = (wrapped_label("muted") for _ in range(4))
        self.column, self.note = wrapped_label("title"), wrapped_label("muted")
        for label, part in ((self.rank, "rank"), (self.check, "check"), (self.column, "column"), (self.note, "note")):
            label.setObjectName(f"jacobian_{part}")
        self.equations = EquationsView(Typesetter(self))
        self.whole = QCheckBox(tr("Every column with its numbers"))
        self.whole.setObjectName("jacobian_whole")
        self.whole.setToolTip(tr("J's definition for this arm, the present values substituted"))
        self.whole.toggled.connect(lambda _: self._show_column())
        self.sources = SourcesButton("jacobian", self)
        self._lay_out()

    def _lay_out(self) -> None:
        show_whole(self.kinds, self.parts)
        head = FoldingRow(group_of(self.kinds, stretched=True), group_of(self.parts, self.copy, stretched=True), _GAP)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        column.addWidget(head)
        above: tuple[QWidget, ...] = (self.meaning, self.table, self.units, self.rank, self.check)
        for widget in above:
            column.addWidget(widget)
        column.addSpacing(8)
        below: tuple[QWidget, ...] = (self.whole, self.column, self.equations, self.note, self.sources)
        for widget in below:
            column.addWidget(widget)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    @property
    def kind(self) -> Rows:
        """What the rows are."""
        kind: Rows = self.kinds.currentData()
        return kind

    @property
    def shown(self) -> FloatArray:
        """The numbers of the table, in full precision."""
        return self.table.jacobian.values

    def refresh(self) -> None:
        """Show J of the present joint values."""
        robot, q, kind, part = self._session.robot, self._session.q, self.kind, self.parts.currentData()
        self._J = FORMULAS[kind](robot, q)
        self.sources.offer(robot)
        rows = _ROWS[part]
        changed = self.table.jacobian.show_values(
            table_rows(kind, robot, self._preferences)[rows],
            table_columns(robot),
            shown_values(self._J, robot, self._preferences)[rows],
            entry_units(robot, self._preferences)[rows],
        )
        if changed:
            self.table.fit()
        self.meaning.setText(meaning(kind, self._J))
        self.units.setText(units_line(robot, self._preferences))
        self.rank.setText(rank_line(self._J[rows], _SIGNS[part]))
        difference = np.abs(jacobian_by_differences(robot, q, kind) - self._J).max(initial=0.0)
        self.check.setText(check_line(float(difference), kind))
        self._show_column()

    # --- one column ------------------------------------------------------------------------------------------------

    def _show_column(self) -> None:
        robot, q, joint = self._session.robot, self._session.q, self.table.jacobian.lit
        lit, whole = 0 <= joint < robot.dof, self.whole.isChecked()
        self.equations.setVisible(lit or whole)
        self.column.setVisible(lit and not whole)
        if whole:
            self.equations.show_equations(whole_equations(robot, q, self.kind, self._J, self._preferences))
        if not lit:
            self.note.setText(tr(_HINT))
            self.draw(())
            return
        self.column.setText(column_title(robot, joint))
        self.note.setText(column_note(robot, joint, self.kind, self._preferences))
        if not whole:
            self.equations.show_equations(column_equations(robot, q, joint, self.kind, self._J, self._preferences))
        if self.seen:
            speed = speed_text(robot, q, joint, self._preferences)
            self.draw(column_items(robot, q, joint, speed, self._stage.palette))

    def _copied(self, text: str, name: str) -> str:
        robot, part = self._session.robot, self.parts.currentData()
        rows = ", ".join(row.translate(_PLAIN) for row in KINDS[self.kind].names[_ROWS[part]])
        title = KINDS[self.kind].title.lower()
        units = plain_units_line(robot, self._preferences)
        return f"{_MARKS[name]}{robot.title}: Jacobian, {title}, rows {rows}; {units}\n{text}"


def rank_line(J: FloatArray, sign: str) -> str:
    """The rank in words."""
    if np.isnan(J).any():
        return ""
    most = min(J.shape)
    rank = int((np.linalg.svd(J, compute_uv=False) > _RANK_ABOVE).sum())
    values = {"sign": sign, "rows": J.shape[0], "columns": J.shape[1], "rank": rank}
    if rank == most:
        return tr("Rank of {sign} ({rows}×{columns}): {rank}, full.", **values)
    return tr(
        "Rank of {sign} ({rows}×{columns}): {rank}, {most} is the most: a direction is lost here.", most=most, **values
    )
