"""All four solvers side by side: what they are asked, their error curves, a table, and what it means."""

from __future__ import annotations

import threading
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QScrollArea,
    QSizePolicy,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from rvsim.experiment import Experiment
from rvsim.gui.panels.laboratory_fields import ContentArea
from rvsim.gui.panels.laboratory_looks import SOLVER_LOOKS, Legend
from rvsim.gui.panels.laboratory_page import Page
from rvsim.gui.panels.laboratory_rules import RulesChooser
from rvsim.gui.panels.laboratory_setup import StartChooser, TargetChooser
from rvsim.gui.panels.laboratory_table import ContestModel, ContestTable
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, length_kind, shown_units
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, scrolled
from rvsim.gui.workers import LatestWorker
from rvsim.kinematics.numeric import Preset
from rvsim.lab.laboratory import TITLES, Contest, Outcome, Trial, contest_sentence, run_contest, verdict
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

if TYPE_CHECKING:
    from rvsim.gui.panels.laboratory_plot import LogPlot

_EMPTY = tr_later(
    "Press Run: all four solvers start from the same joints, and their errors are drawn over the iterations."
)
_WIDE = 680  # pixels from which the settings stand beside the results
_LOW = 500  # pixels below which the table scrolls
_SETUP_WIDTH = 340
_PATIENCE_MS = 100
_LINES = 3  # of the sentence; a longer one scrolls
_WIDEST = 16_777_215  # Qt's largest size, which means no limit


class Iterates(NamedTuple):
    """What one solver went through: q (k, n), and the target T (4, 4) that it was after."""

    robot: Robot
    solver: str
    q: FloatArray
    T: FloatArray


class ContestPage(Page):
    """The first page of the laboratory.

    Signals:
        iterates_changed(Iterates or None): these are to be seen in the scene.
    """

    iterates_changed = Signal(object)

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self.contest: Contest | None = None
        self._selected, self._pointed = "", ""
        self._was_wide = False
        self._cancelled = threading.Event()
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_done)
        self._slow = QTimer(self, singleShot=True, interval=_PATIENCE_MS)
        self._slow.timeout.connect(lambda: self._show_waiting(True))
        self.plots: tuple[LogPlot, ...] = ()
        self._make_setup()
        self._make_results()
        self._lay_out()
        self._connect()
        self._show()

    # --- construction ----------------------------------------------------------------------------------------------

    def _make_setup(self) -> None:
        self.target = TargetChooser(self._session, self._preferences)
        self.start = StartChooser(self._session, self._preferences)
        self.rules = RulesChooser(self._session, self._preferences)
        tip = tr("Let all four solvers start from the same joints")
        self.run_button = button("lab_run_button", tr("Run"), tip, self.run, primary=True)
        self.go_button = button("lab_go_button", tr("Go to result"), "", self.go_to_result)
        self.cancel_button = button("lab_cancel_button", tr("Cancel"), tr("Stop; the old result stays"), self.cancel)
        self.live = QCheckBox(tr("Live"))
        self.live.setObjectName("lab_live_switch")
        self.live.setToolTip(tr("Run again after every change"))
        self.live.setChecked(True)
        self.busy = QProgressBar()
        self.busy.setRange(0, 0)
        self.busy.setTextVisible(False)
        self.busy.setFixedHeight(4)
        self.busy.setAccessibleName(tr("The solvers are at work"))
        self.busy.setMinimumWidth(1)
        policy = self.busy.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.busy.setSizePolicy(policy)
        self._run_or_cancel = QStackedWidget()
        self._run_or_cancel.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        for offered in (self.run_button, self.cancel_button):
            self._run_or_cancel.addWidget(offered)
        self._show_waiting(False)

    def _make_results(self) -> None:
        self.legend = Legend(SOLVER_LOOKS, self._preferences)
        self.model = ContestModel(self._preferences, self)
        self.table = ContestTable(self.model)
        self.sentence = QLabel(wordWrap=True)
        self.sentence.setObjectName("lab_sentence")
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        # As high for every sentence: the table above must not jump while the pointer goes over it.
        self.words: QScrollArea = scrolled(self.sentence)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def _lay_out(self) -> None:
        self._box = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._box.setContentsMargins(12, 8, 12, 8)
        self._box.setSpacing(6)
        inside = QWidget()
        setup = QVBoxLayout(inside)
        setup.setContentsMargins(0, 0, 0, 0)
        setup.setSpacing(6)
        for chooser in (self.target, self.start, self.rules):
            setup.addWidget(chooser)
        setup.addStretch(1)
        self._setup = ContentArea(inside)
        left, self._results = QVBoxLayout(), QVBoxLayout()
        left.setSpacing(6)
        left.addWidget(self._setup, 1)
        left.addLayout(self._buttons())
        self._results.setSpacing(4)
        self._results.addWidget(self.busy)
        self._results.addWidget(self.legend)
        self._results.addWidget(self.table)
        self._results.addWidget(self.words)
        self._box.addLayout(left)
        self._box.addLayout(self._results, 1)

    def _buttons(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(8)
        for widget in (self._run_or_cancel, self.go_button, self.live):
            row.addWidget(widget)
        row.addStretch(1)
        return row

    def _connect(self) -> None:
        for chooser in (self.target, self.start, self.rules):
            chooser.changed.connect(self._on_setup)
        self.rules.preset_taken.connect(self._on_preset)
        self.table.pointed.connect(self._on_pointed)
        self.table.chosen.connect(self._on_chosen)
        self._session.changed.connect(self._on_session)
        self._preferences.changed.connect(self._on_preference)

    def _make_plots(self) -> None:
        """Plots are costly to import: only when the page is seen for the first time."""
        from rvsim.gui.panels.laboratory_plot import LogPlot

        self.plots = tuple(LogPlot(SOLVER_LOOKS, ("", ""), self._preferences) for _ in range(2))
        for index, (plot, name) in enumerate(zip(self.plots, ("lab_position_plot", "lab_rotation_plot"), strict=True)):
            plot.setObjectName(name)
            self._results.insertWidget(2 + index, plot, 1)
        self.plots[0].setXLink(self.plots[1])

    # --- running ---------------------------------------------------------------------------------------------------

    @property
    def trial(self) -> Trial:
        """What would be run now."""
        robot = self._session.robot
        return Trial(robot, self.target.T, self.start.q0, self.rules.task, self.rules.options)

    def run(self) -> None:
        """Run all four; what was still running is given up."""
        self._cancelled.set()
        self._cancelled = threading.Event()
        self._worker.ask(partial(run_contest, self.trial, self._cancelled.is_set))
        if not self._slow.isActive() and self.busy.isHidden():
            self._slow.start()

    def cancel(self) -> None:
        """Give up what is running; the old result stays."""
        self._cancelled.set()
        self._worker.cancel()
        self._show_waiting(False)

    def close_worker(self) -> None:
        """Give up, and wait for the thread to end."""
        self.cancel()
        self._worker.close()

    def _on_done(self, contest: Contest | None) -> None:
        self._show_waiting(False)
        if contest is not None and contest.trial.robot is self._session.robot:
            self.contest = contest
            self._show()

    def _show_waiting(self, on: bool) -> None:
        self._slow.stop()
        self.busy.setVisible(on)
        self._run_or_cancel.setCurrentWidget(self.cancel_button if on else self.run_button)

    def _on_setup(self) -> None:
        if self.live.isChecked() and self.seen:
            self.run()

    def _on_preset(self, preset: Preset) -> None:
        self.start.use_guess(preset.guess)

    def _on_session(self, before: Experiment, after: Experiment) -> None:
        if after.robot is before.robot:
            return
        self.cancel()
        self.contest = None
        for chooser in (self.target, self.start, self.rules):
            chooser.show_robot()
        self._show()
        self._on_setup()

    # --- which solver is looked at -----------------------------------------------------------------------------------

    @property
    def lit(self) -> Outcome | None:
        """The outcome under the pointer, else the selected one, else the best."""
        if self.contest is None:
            return None
        by_name = {outcome.solver: outcome for outcome in self.contest.outcomes}
        wanted = by_name.get(self._pointed) or by_name.get(self._selected)  # type: ignore[call-overload]
        return wanted or self.contest.best

    def _on_pointed(self, row: int) -> None:
        self._pointed = self._solver_of(row)
        self._show_lit()

    def _on_chosen(self, row: int) -> None:
        self._selected = self._solver_of(row)
        self._show_lit()

    def _solver_of(self, row: int) -> str:
        return self.model.rows[row].solver if 0 <= row < len(self.model.rows) else ""

    def go_to_result(self) -> None:
        """Let the arm go where the solver that is looked at ended."""
        if (outcome := self.lit) is not None:
            self._session.move_to(outcome.result.q, tr("Go to the result of {solver}", solver=tr(outcome.title)))

    # --- showing ---------------------------------------------------------------------------------------------------

    def _show(self) -> None:
        selected = self._selected
        self.model.show_contest(self.contest)
        self._selected = selected
        self.table.fit()
        self._show_curves()
        self._show_lit()

    def _show_curves(self) -> None:
        if not self.plots or self.contest is None:
            for plot in self.plots:
                plot.show_curves({})
            return
        trial = self.contest.trial
        length = display(length_kind(trial.robot), self._preferences)
        angle = display("angle", self._preferences)
        histories = {outcome.solver: outcome.result.history for outcome in self.contest.outcomes}
        place, turn = self.plots
        place.set_titles("", tr("position, {unit}", unit=length.suffix.strip()))
        turn.set_titles(tr("iteration"), tr("rotation, {unit}", unit=angle.suffix.strip()))
        place.show_curves(
            {name: length.factor * history.position_error for name, history in histories.items()},
            length.factor * trial.options.position_tolerance,
        )
        counts = trial.task == "pose"
        turn.show_curves(
            {name: angle.factor * history.rotation_error for name, history in histories.items()},
            angle.factor * trial.options.rotation_tolerance if counts else 0.0,
        )

    def _show_lit(self) -> None:
        outcome, contest = self.lit, self.contest
        chosen = self._pointed or self._selected
        for plot in self.plots:
            plot.light(chosen)
        self.legend.light(chosen)
        self.go_button.setEnabled(outcome is not None)
        if outcome is None or contest is None:
            self._say(tr(_EMPTY), "")
            self.iterates_changed.emit(None)
            return
        self.go_button.setToolTip(tr("Let the arm go where {solver} ended", solver=tr(TITLES[outcome.solver])))
        units = shown_units(self._preferences)
        if chosen:
            self._say(verdict(contest.trial, outcome, units), "good" if outcome.result.converged else "warning")
        else:
            self._say(contest_sentence(contest, units), "" if contest.converged else "warning")
        self.iterates_changed.emit(self.iterates)

    def _say(self, text: str, level: str) -> None:
        self.sentence.setText(text)
        self.words.setFixedHeight(_LINES * self.sentence.fontMetrics().lineSpacing() + 4)
        set_role(self.sentence, level=level)

    @property
    def iterates(self) -> Iterates | None:
        """The iterates of the solver that is looked at, while the page is seen."""
        outcome, contest = self.lit, self.contest
        if outcome is None or contest is None or not self.seen:
            return None
        trial = contest.trial
        return Iterates(trial.robot, outcome.solver, np.asarray(outcome.result.history.q), trial.T)

    def _on_preference(self, name: str) -> None:
        if name == "theme":
            for plot in self.plots:
                plot.dress()
            self.legend.update()
        if name in ("theme", "angle_unit", "length_unit", "extra_decimals", "presentation"):
            self._show()

    def on_seen(self, seen: bool) -> None:
        """Seen for the first time: run, so that there is something to see."""
        if seen and not self.plots:
            self._make_plots()
        if seen and self.contest is None and self.live.isChecked():
            self.run()
        self._show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Settings beside the results where there is room."""
        super().resizeEvent(event)
        wide = self.width() >= _WIDE
        self.table.set_compact(self.height() < _LOW)
        sides, stack = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom
        self._box.setDirection(sides if wide else stack)
        self._box.setSpacing(16 if wide else 6)
        self._setup.setMinimumWidth(_SETUP_WIDTH if wide else 0)
        self._setup.setMaximumWidth(_SETUP_WIDTH if wide else _WIDEST)
        if wide and not self._was_wide:
            self._was_wide = True
            self.start.disclosure.show_content(True)  # there is room for the sliders
