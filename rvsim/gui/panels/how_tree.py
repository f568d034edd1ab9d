"""The tree of branches at the end of a worked solution: one row an end, indented by the choices that lead there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from rvsim.gui.panels.how_steps import Path, wrapped_label
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, joint_kind
from rvsim.gui.theme import set_role
from rvsim.kinematics import branch_title
from rvsim.lab.worked import WorkedBranch
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_NO_BRANCH = tr_later("no branch")
_HERE = 1e-6  # [rad, m] the arm is on a branch if it is as close as this


class BranchTree(QWidget):
    """Shows the ends; `chosen(path)` when one is clicked."""

    chosen = Signal(tuple)

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._paths: tuple[Path, ...] = ()
        self.rows: dict[Path, BranchRow] = {}
        self._column = _column(self)
        self._inside: QWidget | None = None

    def show_branches(self, robot: Robot, q: FloatArray, ends: Sequence[WorkedBranch], followed: Path) -> None:
        """Show these ends; the arm is at q."""
        paths = tuple(end.path for end in ends)
        if paths != self._paths:
            self._grow(paths)
        for end in ends:
            self.rows[end.path].show_end(robot, q, end, self._preferences, followed=end.path == followed)

    def _grow(self, paths: tuple[Path, ...]) -> None:
        if self._inside is not None:
            self._column.removeWidget(self._inside)
            self._inside.deleteLater()
        self._paths, self.rows = paths, {}
        self._inside = QWidget()
        self._add(_column(self._inside), paths, 0)
        self._column.addWidget(self._inside)

    def _add(self, column: QVBoxLayout, paths: Sequence[Path], depth: int) -> None:
        """Rows for the paths that are alike in their first `depth` choices."""
        for choice in dict.fromkeys(path[depth : depth + 1] for path in paths):
            group = [path for path in paths if path[depth : depth + 1] == choice]
            if group[0][depth + 1 :] or not choice:
                if not choice:
                    self._add_row(column, group[0], tr(_NO_BRANCH))
                    continue
                heading = QLabel(branch_title(choice[0]))
                column.addWidget(heading)
                below = QWidget()
                below.setObjectName("how_twig")
                below.setStyleSheet("#how_twig { border-left: 1px solid palette(mid); }")
                inner = _column(below)
                inner.setContentsMargins(12, 0, 0, 4)
                self._add(inner, group, depth + 1)
                column.addWidget(below)
            else:
                self._add_row(column, group[0], branch_title(choice[0]))

    def _add_row(self, column: QVBoxLayout, path: Path, name: str) -> None:
        row = BranchRow(path, name)
        row.chosen.connect(self.chosen)
        self.rows[path] = row
        column.addWidget(row)


class BranchRow(QWidget):
    """One end: its name, whether the arm may go there, and its joints or the reason."""

    chosen = Signal(tuple)

    def __init__(self, path: Path, name: str) -> None:
        super().__init__()
        self.button, self.state, self.detail = QToolButton(), QLabel(), wrapped_label("muted")
        self.button.setText(name)
        self.button.setCheckable(True)
        self.button.setObjectName(f"how_branch_{'_'.join(path)}".replace(" ", "_"))
        self.button.clicked.connect(lambda _checked=False: self.chosen.emit(path))
        head = QHBoxLayout()
        head.setSpacing(8)
        head.addWidget(self.button)
        head.addStretch(1)
        head.addWidget(self.state)
        column = _column(self)
        column.setSpacing(1)
        column.addLayout(head)
        self.detail.setContentsMargins(9, 0, 0, 4)
        column.addWidget(self.detail)

    def show_end(
        self, robot: Robot, q: FloatArray, end: WorkedBranch, preferences: Preferences, *, followed: bool
    ) -> None:
        """Show an end; the arm is at q."""
        self.button.setChecked(followed)
        state, level, tip = _state(q, end)
        self.state.setText(state)
        set_role(self.state, level=level)
        self.button.setToolTip(tip)
        self.button.setAccessibleName(f"{end.title or tr(_NO_BRANCH)}: {state.strip('●✓✕ ')}")
        lines = [] if end.branch is None else [_joints(robot, end.branch.q, preferences)]
        self.detail.setText("\n".join([*lines, *([end.reason] if end.reason else [])]))


def _state(q: FloatArray, end: WorkedBranch) -> tuple[str, str, str]:
    """The word, its level, and what a click does."""
    if end.branch is None:
        return tr("✕ no solution"), "error", tr("Read why there is no solution this way")
    if np.abs(end.branch.q - q).max() < _HERE:
        return tr("● the arm is here"), "good", tr("The arm is on this branch")
    if end.within_limits:
        return tr("✓ within limits"), "good", tr("Go there")
    return tr("✕ outside limits"), "warning", tr("Go there, if limits are ignored")


def _joints(robot: Robot, q: FloatArray, preferences: Preferences) -> str:
    texts = (format_quantity(v, joint_kind(robot, i), preferences) for i, v in enumerate(q.tolist()))
    return left_to_right("  ".join(texts))


def _column(widget: QWidget) -> QVBoxLayout:
    column = QVBoxLayout(widget)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(4)
    return column
