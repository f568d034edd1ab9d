"""Desired against actual: how far the tool is off the tracked path, in numbers and magnified in the scene."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGroupBox, QHBoxLayout, QVBoxLayout

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_rows import RowsModel, TextRow, as_csv, as_text, rows_table
from rvsim.gui.path_legend import Entry
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_scientific, length_kind
from rvsim.gui.session import Session
from rvsim.gui.widgets import button, combo
from rvsim.language import tr, tr_later, trn
from rvsim.motion import Tracking, Trajectory
from rvsim.motion.between import OffPath, off_at_points, off_between, ways_off_path
from rvsim.motion.honesty import time_of_index
from rvsim.scene.palette import ScenePalette
from rvsim.scene.paths import deviation_items
from rvsim.scene.primitives import Item

_EMPTY = tr_later("Track a line or a trajectory on the Track page: here is told how far the tool is off it.")
_NO_WAY = tr_later("No two neighbouring points are reached: there is no way between them.")
_WHERE = {"between": tr_later("On the whole way"), "points": tr_later("At the points")}
_TIMES = {
    "1": tr_later("Drawn as it is"),
    "10": tr_later("Drawn 10 ×"),
    "100": tr_later("Drawn 100 ×"),
    "1000": tr_later("Drawn 1000 ×"),
    "10000": tr_later("Drawn 10,000 ×"),
}
_DRAWN = {
    "10": tr_later("deviation 10 ×"),
    "100": tr_later("deviation 100 ×"),
    "1000": tr_later("deviation 1000 ×"),
    "10000": tr_later("deviation 10,000 ×"),
}
_ROWS = ("x", "y", "z", tr_later("all"))
_COPY_HEADS = ("axis", "rms_m", "mean_m", "largest_m")


class DeviationSection(QGroupBox):
    """Numbers of the tracked path at its points, or of the motion between them; `items` is what the scene shows.

    Signals:
        chosen(): something else is to be measured, or drawn.
    """

    chosen = Signal()

    def __init__(self, session: Session, preferences: Preferences, motion: MotionControl) -> None:
        super().__init__(tr("Asked and done"))
        self._session, self._preferences, self._motion = session, preferences, motion
        self._measured: tuple[Tracking, Trajectory | None, OffPath] | None = None
        self.where = combo("deviation_where", tr("Where the deviation is measured"), _WHERE)
        self.times = combo("deviation_times", tr("How the deviation is drawn in the scene"), _TIMES)
        self.model = RowsModel(self._heads())
        self.table = rows_table("deviation_table", tr("Deviation along each axis"), self.model)
        self.told = wrapped_label()
        self.told.setObjectName("deviation_sentence")
        self.solved = wrapped_label("muted")
        self.solved.setObjectName("deviation_solved")
        tip = tr("Show the moment at which the tool is the farthest off")
        self.worst = button("deviation_worst", tr("Go to the largest"), tip, self.go_to_worst)
        self.curves = button("deviation_curves", tr("Curves"), tr("Plot the deviation over time"), self._show_curves)
        formats = {tr_later("text"): partial(self._copied, as_text), "CSV": partial(self._copied, as_csv)}
        self.copy = CopyButton("deviation_copy", tr("the deviation"), formats, session)
        for box in (self.where, self.times):
            box.activated.connect(lambda _: self.chosen.emit())
        self._lay_out()

    def _lay_out(self) -> None:
        choices, actions = QHBoxLayout(), QHBoxLayout()
        for box in (self.where, self.times):
            choices.addWidget(box, 1)
        for widget in (self.worst, self.curves, self.copy):
            actions.addWidget(widget)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 6, 0, 0)
        column.setSpacing(6)
        column.addLayout(choices)
        for part in (self.table, self.told, self.solved):
            column.addWidget(part)
        column.addLayout(actions)

    # --- what is measured --------------------------------------------------------------------------------------------

    def measure(self, trajectory: Trajectory | None) -> None:
        """Look at the tracked path and the motion along it, and tell."""
        tracking = self._session.tracking
        if tracking is None:
            self._measured = None
        elif trajectory is None or self.where.currentData() == "points":
            self._measured = tracking, trajectory, off_at_points(tracking)
        else:
            self._measured = tracking, trajectory, off_between(trajectory, tracking)
        self._show()

    @property
    def off(self) -> OffPath | None:
        """What is told."""
        return self._measured[2] if self._measured else None

    @property
    def _moving(self) -> tuple[Tracking, Trajectory, OffPath] | None:
        """What is measured, where there is a motion."""
        if self._measured is None or self._measured[1] is None:
            return None
        return self._measured[0], self._measured[1], self._measured[2]

    def items(self, palette: ScenePalette) -> tuple[Item, ...]:
        """Where the tool goes, magnified as chosen."""
        if self._moving is None:
            return ()
        tracking, trajectory, off = self._moving
        breaks = np.flatnonzero(np.diff(off.index) > 1.0) + 1
        gaps = ways_off_path(trajectory, tracking)
        return deviation_items(off.place, off.offset, breaks, gaps, palette, times=float(self.times.currentData()))

    def legend(self, palette: ScenePalette) -> tuple[Entry, ...]:
        """What those lines mean."""
        if self._moving is None:
            return ()
        tracking, trajectory, _ = self._moving
        entries = []
        if ways_off_path(trajectory, tracking):
            entries.append(Entry(palette.actual, tr("off the path on purpose"), dashed=True))
        if self.times.currentData() in _DRAWN:
            entries.append(Entry(palette.limit, tr(_DRAWN[self.times.currentData()])))
        return tuple(entries)

    def go_to_worst(self) -> None:
        """Show the moment at which it is the largest."""
        if self._moving is None or self._moving[2].worst is None:
            return
        _, trajectory, off = self._moving
        if self._motion.player.trajectory is not trajectory:
            self._motion.load(trajectory, tr("Show the deviation"))
        self._motion.pause()
        self._motion.seek(time_of_index(trajectory, off.worst or 0.0))

    # --- showing -----------------------------------------------------------------------------------------------------

    def _heads(self) -> tuple[tuple[str, str], ...]:
        unit = display(length_kind(self._session.robot), self._preferences).suffix.strip()
        return (
            ("", tr("The axis of the base")),
            (f"RMS {unit}", tr("The root of the mean square")),
            (tr("mean {unit}", unit=unit), tr("Along an axis with its sign, of all the mean distance")),
            (tr("largest {unit}", unit=unit), tr("The largest without its sign")),
        )

    def _show(self) -> None:
        factor = display(length_kind(self._session.robot), self._preferences).factor
        rows = [
            TextRow((tr(name), *(format_scientific(factor * value) for value in numbers)))
            for name, numbers in self._numbers()
        ]
        self.model.show_rows(rows, self._heads())
        self.table.setVisible(bool(rows))
        self.told.setText(self._sentence())
        self.solved.setText(self._solved())
        for widget in (self.worst, self.copy):
            widget.setEnabled(bool(rows))

    def _numbers(self) -> list[tuple[str, tuple[float, ...]]]:
        spread = self.off.spread if self.off else None
        if spread is None:
            return []
        return [(name, tuple(float(part[i]) for part in spread)) for i, name in enumerate(_ROWS)]

    def _sentence(self) -> str:
        if self._measured is None:
            return tr(_EMPTY)
        tracking, _, off = self._measured
        if off.worst is None:
            return tr(_NO_WAY)
        before = math.floor(off.worst) + 1
        largest = (
            tr("Largest at point {number}.", number=before)
            if off.worst % 1.0 == 0.0
            else tr("Largest between points {number} and {next}.", number=before, next=before + 1)
        )
        if tracking.complete:
            return largest
        missed = trn("{n} point is missed.", "{n} points are missed.", tracking.samples - tracking.reached_count)
        return f"{largest} {missed}"

    def _solved(self) -> str:
        if self._measured is None:
            return ""
        tracking = self._measured[0]
        total, each = 1e3 * tracking.solve_seconds, 1e6 * tracking.seconds_per_point
        return trn(
            "Inverse kinematics: {total:.2f} ms for {n} point, {each:.1f} µs a point.",
            "Inverse kinematics: {total:.2f} ms for {n} points, {each:.1f} µs a point.",
            tracking.samples,
            total=total,
            each=each,
        )

    def _show_curves(self) -> None:
        """The plots, with this one among them."""
        names = [name for name in self._preferences["plots"].split(",") if name]
        if "deviation" not in names:
            self._preferences.set("plots", ",".join([*names, "deviation"]))
        self._preferences.set("show_plots", True)

    def _copied(self, form: object) -> str:
        assert callable(form)
        return str(form(_COPY_HEADS, [(name, *(f"{value:.9g}" for value in row)) for name, row in self._numbers()]))
