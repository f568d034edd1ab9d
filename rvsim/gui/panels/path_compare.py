"""The Compare page: asked against done, and the same path by the closed form and each numeric solver (source 000)."""

from __future__ import annotations

import math
from functools import partial

from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_deviation import DeviationSection
from rvsim.gui.panels.path_page import PathPage
from rvsim.gui.panels.path_rows import RowsModel, TextRow, as_csv, as_text, rows_table
from rvsim.gui.parts_worker import PartsWorker
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_scientific, length_kind
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import button, column_of, scrolled
from rvsim.lab.repairs import path_of
from rvsim.language import tr, tr_later, trn
from rvsim.motion import Path
from rvsim.motion.compare import Entry, comparison
from rvsim.robot import Robot

_INTRO = tr_later(
    "The path of the Path page by the closed form with the best sequence of branches, and by each numeric solver, "
    "started at every point in its last solution. Source 000 sets out to compare these."
)
_SHORT = {"closed form": tr_later("Closed"), "newton": tr_later("Newton"), "dls": "DLS", "lm": "LM", "bfgs": "BFGS"}
_AS_SOURCE = tr_later("As 000")
_COPY_HEADS = (
    "method", "total_s", "per_point_s", "rms_m", "largest_m", "largest_rotation_rad", "success", "jumps", "iterations",
)  # fmt: skip


class ComparePage(PathPage):
    """A button, a table that fills row by row, and what the rows mean."""

    title = tr_later("Compare")
    name = "path_compare"

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        stage: Stage,
        tracker: PathTracker,
        motion: MotionControl,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(session, preferences, stage, tracker, motion, parent)
        self.entries: list[Entry] = []
        self._coming: list[Entry] = []
        self._of: tuple[Robot, Path] | None = None  # what the entries are of
        self._asked: tuple[Robot, Path] | None = None
        self.worker = PartsWorker(self)
        self.worker.part.connect(self._on_part)
        self.worker.done.connect(self._on_done)
        self.model = RowsModel(self._heads(session.robot))
        self.deviation = DeviationSection(session, preferences, motion)
        self.deviation.chosen.connect(self._refresh_if_seen)
        session.tracking_changed.connect(lambda _: self._refresh_if_seen())
        motion.loaded.connect(self._refresh_if_seen)
        self._make_widgets()
        self._lay_out()
        self._show_busy(False)

    def close_worker(self) -> None:
        """End the thread, for the window closes."""
        self.worker.close()

    def _make_widgets(self) -> None:
        self.table = rows_table("compare_table", tr("Methods"), self.model)
        tip = tr("Track the present path by every method; it takes about a second for a few hundred points")
        self.run_button = button("compare_run_button", tr("Compare"), tip, self.start, primary=True)
        self.cancel_button = button(
            "compare_cancel_button", tr("Cancel"), tr("Give up; the old table stays"), self.cancel
        )
        self.progress = QProgressBar()
        self.progress.setObjectName("compare_progress")
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(8)
        self.intro, self.verdict = wrapped_label("muted"), wrapped_label()
        self.intro.setText(tr(_INTRO))
        self.verdict.setObjectName("compare_verdict")
        formats = {tr_later("text"): partial(self._copied, as_text), "CSV": partial(self._copied, as_csv)}
        self.copy = CopyButton("compare_copy", tr("the comparison"), formats, self._session)

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(10, 8, 10, 8)
        column.setSpacing(8)
        column.addWidget(self.deviation)
        methods = QLabel(tr("Methods"))
        set_role(methods, role="title")
        column.addWidget(methods)
        column.addWidget(self.intro)
        row = QHBoxLayout()
        for widget in (self.run_button, self.cancel_button):
            row.addWidget(widget)
        row.addWidget(self.progress, 1)
        row.addWidget(self.copy)
        column.addLayout(row)
        column.addWidget(self.table)
        column.addWidget(self.verdict)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- working -----------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Compare on the path that the Path page has."""
        experiment = self._session.experiment
        try:
            path = self._path(experiment)
        except (RvsimError, OSError) as problem:
            self._session.say(str(problem), "error")
            return
        self._coming, self._asked = [], (experiment.robot, path)
        self._show_busy(True)
        ignore = experiment.ignore_limits
        self.worker.start(partial(comparison, experiment.robot, path, near=experiment.q, ignore_limits=ignore))

    def _path(self, experiment: Experiment) -> Path:
        tracking = self._session.tracking
        return path_of(self._tracker.kind, experiment) if tracking is None else tracking.path

    def cancel(self) -> None:
        """Give up; the old table stays."""
        self.worker.cancel()
        self._show_busy(False)

    def _on_part(self, part: Entry | float) -> None:
        if isinstance(part, Entry):
            self._coming.append(part)
        else:
            self.progress.setValue(round(100.0 * part))

    def _on_done(self) -> None:
        self.entries, self._of = self._coming, self._asked
        self._show_busy(False)
        self.refresh()

    def _show_busy(self, busy: bool) -> None:
        self.run_button.setVisible(not busy)
        self.cancel_button.setVisible(busy)
        self.progress.setRange(0, 100)
        self.progress.setValue(0)
        policy = self.progress.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.progress.setSizePolicy(policy)
        self.progress.setVisible(busy)
        self.copy.setEnabled(bool(self.entries))

    # --- showing -----------------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """The deviation of what is tracked, and the last comparison, in the present units."""
        self.deviation.measure(self._tracker.trajectory)
        self.draw(self.deviation.items(self._stage.palette))
        self._stage.explain(self.deviation.legend(self._stage.palette))
        robot = self._session.robot if self._of is None else self._of[0]
        factor = display(length_kind(robot), self._preferences).factor
        rows = [TextRow(_texts(entry, factor), _tip(entry)) for entry in self.entries]
        self.model.show_rows(rows, self._heads(robot))
        self.table.setVisible(bool(rows))
        self.verdict.setText(self._verdict() if self._of else "")
        self.copy.setEnabled(bool(rows))

    def set_seen(self, seen: bool) -> None:
        """The legend tells of this page's lines only while they are there."""
        super().set_seen(seen)
        if not seen:
            self._stage.explain(())

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """Only another arm: the table is of a path, not of a pose."""
        return after.robot is not before.robot

    def _heads(self, robot: Robot) -> tuple[tuple[str, str], ...]:
        unit = display(length_kind(robot), self._preferences).suffix.strip()
        return (
            (tr("method"), tr("The closed form, or the numeric solver")),
            ("ms", tr("Time for all points, in milliseconds")),
            ("µs", tr("Time for a point, in microseconds")),
            (tr("max {unit}", unit=unit), tr("The largest position error over the points found")),
            (tr("found"), tr("For how many of the points joints were found")),
            (tr("jumps"), tr("How often the arm leaves the path to change its branch")),
        )

    def _verdict(self) -> str:
        """Who is how much quicker, and of which path and arm the table is."""
        assert self._of is not None
        robot, path = self._of
        what = trn(
            "{robot}, {path}, {n} point.",
            "{robot}, {path}, {n} points.",
            path.samples,
            robot=tr(robot.title),
            path=tr(path.title or path.name),
        )
        closed = [entry for entry in self.entries if entry.contestant.solver is None]
        others = [entry for entry in self.entries if entry.contestant.solver is not None]
        if not closed or not others or closed[0].seconds <= 0.0:
            return f"{what} {tr('This arm has no closed form.')}"
        nearest = min(others, key=lambda entry: entry.seconds)
        times = nearest.seconds / closed[0].seconds
        verdict = tr(
            "The closed form is {times:.3g} times as quick as the quickest of the others ({name}).",
            times=times,
            name=tr(nearest.contestant.title),
        )
        return f"{what} {verdict}"

    def _copied(self, form: object) -> str:
        assert callable(form)
        return str(form(_COPY_HEADS, [_exact(entry) for entry in self.entries]))


def _texts(entry: Entry, factor: float) -> tuple[str, ...]:
    milliseconds = 1e3 * entry.seconds
    return (
        tr(_SHORT.get(entry.contestant.name, _AS_SOURCE)),
        f"{milliseconds:.1f}" if milliseconds < 100.0 else f"{milliseconds:.0f}",
        f"{1e6 * entry.seconds_per_point:.0f}",
        "–" if math.isnan(entry.largest) else format_scientific(entry.largest * factor),
        f"{100.0 * entry.success:.0f} %",
        str(len(entry.jumps)),
    )


def _tip(entry: Entry) -> str:
    method = tr(entry.contestant.title)
    if entry.iterations is not None:
        method = trn(
            "{method}, {n} iteration in all", "{method}, {n} iterations in all", entry.iterations, method=method
        )
    if math.isnan(entry.largest_rotation):
        return tr(
            "{method}: RMS {rms:.1e} m, at most {largest:.1e} m.", method=method, rms=entry.rms, largest=entry.largest
        )
    return tr(
        "{method}: RMS {rms:.1e} m, at most {largest:.1e} m; orientation within {angle:.1e} rad.",
        method=method,
        rms=entry.rms,
        largest=entry.largest,
        angle=entry.largest_rotation,
    )


def _exact(entry: Entry) -> tuple[str, ...]:
    numbers = (entry.seconds, entry.seconds_per_point, entry.rms, entry.largest, entry.largest_rotation, entry.success)
    counts = (len(entry.jumps), "" if entry.iterations is None else entry.iterations)
    return entry.contestant.title.replace(",", ""), *(f"{value:.9g}" for value in numbers), *map(str, counts)
