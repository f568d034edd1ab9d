"""The How panel: the closed form of the inverse kinematics, step by step, with the numbers of the present tool pose."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from rvsim.errors import NoClosedFormError
from rvsim.gui.formula_view import Typesetter
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how_steps import Path, StepView, wrapped_label
from rvsim.gui.panels.how_tree import BranchTree
from rvsim.gui.panels.shown import ReadOutPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import column_of, scrolled
from rvsim.kinematics import branch_title, forward_kinematics
from rvsim.lab.worked import WorkedBranch, WorkedSolution, worked_latex, worked_solution
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_AT_MOST_EVERY_MS = 60  # while the tool is dragged


class HowPanel(ReadOutPanel):
    """Works the inverse kinematics out for the present tool pose, or for a target.

    It follows one branch, that of the arm unless another is chosen; a click on a branch of the tree goes there.
    """

    costly = True

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self.setObjectName("how_panel")
        self._target: FloatArray | None = None
        self._wish: Path | None = None
        self._shown_for: tuple[Robot, FloatArray] | None = None
        self.solution: WorkedSolution | None = None
        self.typesetter = Typesetter(self)
        self.steps: list[StepView] = []
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.timeout.connect(self._after_pause)
        self._waiting = False
        self._make_widgets()
        self._lay_out()

    def _make_widgets(self) -> None:
        formats = {
            "LaTeX": lambda: self._latex(None),
            tr_later("LaTeX of this way only"): lambda: self._latex(self.followed),
        }
        self.copy = CopyButton("how_copy", tr("worked solution"), formats, self._session)
        self.title, self.hint, self.refusal = wrapped_label("title"), wrapped_label("muted"), wrapped_label()
        set_role(self.refusal, level="warning")
        self.tree_title = wrapped_label("title")
        self.tree_title.setText(tr("All branches"))
        self.tree = BranchTree(self._preferences)
        self.tree.chosen.connect(self.go_to)

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(22)
        words = QVBoxLayout()
        words.setSpacing(4)
        for label in (self.title, self.hint, self.refusal):
            words.addWidget(label)
        head = QHBoxLayout()
        head.addLayout(words, 1)
        head.addWidget(self.copy)
        head.setAlignment(self.copy, Qt.AlignmentFlag.AlignTop)
        column.addLayout(head)
        self._steps = QVBoxLayout()
        self._steps.setSpacing(22)
        column.addLayout(self._steps)
        ends = QVBoxLayout()
        ends.setSpacing(8)
        ends.addWidget(self.tree_title)
        ends.addWidget(self.tree)
        column.addLayout(ends)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- what is shown ---------------------------------------------------------------------------------------------

    def set_target(self, T: ArrayLike | None) -> None:
        """Work out another tool pose (4, 4); None: that of the arm, whatever it is."""
        self._target = None if T is None else np.array(T, dtype=np.float64)
        self._wish = None
        self._refresh_if_seen()

    @property
    def followed(self) -> Path:
        """The choices of the branch that is worked out: the chosen one, or that of the arm."""
        ends = self.solution.branches if self.solution else ()
        if not ends:
            return ()
        wish = self._wish
        wanted = [end for end in ends if wish is not None and end.path[: len(wish)] == wish] or list(ends)
        return min(wanted, key=self._distance).path

    def _distance(self, end: WorkedBranch) -> float:
        return float("inf") if end.branch is None else float(np.abs(end.branch.q - self._session.q).max())

    def refresh(self) -> None:
        """Work out what is now, but not more often than one can read; another arm at once."""
        same_arm = self._shown_for is not None and self._shown_for[0] is self._session.robot
        if same_arm and self._pause.isActive():
            self._waiting = True
            return
        self._work_out()
        self._pause.start(_AT_MOST_EVERY_MS)

    def _after_pause(self) -> None:
        if self._waiting:
            self._waiting = False
            self._refresh_if_seen()

    def _work_out(self) -> None:
        robot, q = self._session.robot, self._session.q
        if self._target is None and self._shown_for is not None and self._shown_for[1] is not q:
            self._wish = None  # the arm has moved: its own branch is of interest
        self._shown_for = robot, q
        T = forward_kinematics(robot, q) if self._target is None else self._target
        try:
            self.solution = worked_solution(robot, T, q, shown_units(self._preferences))
        except NoClosedFormError as refusal:
            self.solution = None
            self.refusal.setText(f"{refusal} {tr('The numeric solvers can still find solutions for it.')}")
        self._show()

    def _show(self) -> None:
        solution, path = self.solution, self.followed
        steps = solution.along(path) if solution else ()
        while len(self.steps) < len(steps):
            self._add_step()
        for number, (view, step) in enumerate(zip(self.steps, steps, strict=False), 1):
            view.show_step(number, step, path)
        for number, view in enumerate(self.steps):
            view.setVisible(number < len(steps))
        self._show_head(path)
        if solution:
            self.tree.show_branches(self._session.robot, self._session.q, solution.branches, path)

    def _show_head(self, path: Path) -> None:
        there = self.solution is not None
        for widget in (self.tree, self.tree_title, self.copy):
            widget.setVisible(there)
        self.refusal.setVisible(not there)
        self.title.setText(
            tr("From the present tool pose to the joints")
            if self._target is None
            else tr("From the target to the joints")
        )
        sentences = [f"{self.solution.title if self.solution else tr(self._session.robot.title)}."]
        if path:
            sentences.append(tr("Branch: {branch}.", branch=branch_title(", ".join(path))))
        self.hint.setText(" ".join(sentences))

    def _add_step(self) -> None:
        view = StepView(self.typesetter)
        view.followed.connect(self.follow)
        self.steps.append(view)
        self._steps.addWidget(view)

    # --- what is done ----------------------------------------------------------------------------------------------

    def follow(self, path: Path) -> None:
        """Work out another way; the arm stays where it is."""
        self._wish = path
        self._show()

    def go_to(self, path: Path) -> None:
        """Go to the branch at the end of these choices, and work it out."""
        assert self.solution is not None
        end = next(end for end in self.solution.branches if end.path == path)
        if end.branch is not None:
            self._session.move_to(end.branch.q, tr("Go to “{branch}”", branch=end.title))
        self.follow(path)

    def _latex(self, path: Path | None) -> str:
        return worked_latex(self.solution, path) if self.solution else ""
