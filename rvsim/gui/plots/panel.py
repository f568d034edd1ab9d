"""The plots below the scene: which are shown, and the one cursor that goes through all of them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.plots.catalogue import NEAR_SINGULAR, PLOTS, PlotKind
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_number
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.language import in_its_order, left_to_right, tr, tr_later
from rvsim.motion import Trajectory
from rvsim.playback.curves import Curves, curves_of

if TYPE_CHECKING:
    from rvsim.gui.plots.time_plot import TimePlot

_MOST_SHOWN = 6
_IN_ROW = 3
_EMPTY = tr_later("No motion yet: press Track line, or track a trajectory, and its curves are drawn here.")
_READOUT_TIP = tr_later(
    "Values at the cursor of the curves that the mouse was in last, and the largest of the whole motion. "
    "▾ beside a curve: near a singularity, or a jump to another branch."
)
_DECIMALS = 2
_NARROW = 170  # [pixels] a plot narrower than this gets a row of its own
_SETTINGS = {"theme", "angle_unit", "length_unit", "presentation"}


class PlotsPanel(QWidget):
    """Buttons for each entry of the catalogue, and the plots that are switched on."""

    def __init__(self, session: Session, motion: MotionControl, preferences: Preferences) -> None:
        super().__init__()
        self.setObjectName("plots_panel")
        self._session, self._motion, self._preferences = session, motion, preferences
        self._curves: Curves | None = None
        self._stale = True
        self._read = ""
        self.plots: dict[str, TimePlot] = {}
        self._buttons = {kind.name: self._button(kind) for kind in PLOTS}
        self.readout = QLabel()
        self.readout.setObjectName("plot_readout")
        self.readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.readout.setTextFormat(Qt.TextFormat.RichText)
        self.empty = QLabel(tr(_EMPTY))
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.empty.setWordWrap(True)
        set_role(self.empty, role="muted")
        self.readout.setContentsMargins(12, 0, 8, 0)
        self._grid = QGridLayout()
        self._lay_out()
        self._later = QTimer(self, singleShot=True, interval=0)
        self._later.timeout.connect(self._refresh)
        motion.loaded.connect(self._on_loaded)
        motion.moved.connect(self._on_moved)
        session.tracking_changed.connect(lambda _tracking: self._on_loaded())
        preferences.changed.connect(self._on_preference)
        self.setMinimumHeight(150)

    def _button(self, kind: PlotKind) -> QToolButton:
        made = QToolButton()
        made.setObjectName(f"plot_{kind.name}_button")
        made.setText(in_its_order(tr(kind.sign)))
        made.setToolTip(tr(kind.tip))
        made.setAccessibleName(tr(kind.tip))
        made.setCheckable(True)
        made.setProperty("role", "page")
        made.setChecked(kind.name in self._preferences["plots"].split(","))
        made.toggled.connect(lambda _on: self._on_chosen(kind.name))
        return made

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.setContentsMargins(8, 2, 8, 0)
        row.setSpacing(2)
        for made in self._buttons.values():
            row.addWidget(made)
        row.addStretch(1)
        self._grid.setContentsMargins(8, 0, 8, 0)
        self._grid.setSpacing(6)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(row)
        column.addWidget(self.readout)
        column.addWidget(self.empty, 1)
        column.addLayout(self._grid, 1)

    @property
    def chosen(self) -> list[str]:
        """The plots that are switched on, in the catalogue's order."""
        return [name for name, made in self._buttons.items() if made.isChecked()]

    def sizeHint(self) -> QSize:
        """Enough for what is chosen: a row of plots needs 150 pixels."""
        rows = -(-len(self.chosen) // _IN_ROW) or 1
        return QSize(400, 60 + 150 * rows)

    def give_room(self) -> None:
        """Take from the scene above what the chosen plots need, but no more than half of the height."""
        parts = self.parentWidget()
        if isinstance(parts, QSplitter) and self.isVisible():
            height = sum(parts.sizes())
            own = min(self.sizeHint().height(), height // 2)
            parts.setSizes([height - own, own])

    # --- what changed ----------------------------------------------------------------------------------------------

    def _on_chosen(self, name: str) -> None:
        for other in self.chosen[: max(len(self.chosen) - _MOST_SHOWN, 0)]:
            if other != name:
                self._buttons[other].setChecked(False)
        self._preferences.set("plots", ",".join(self.chosen))
        self.give_room()
        self._on_loaded()

    def _on_loaded(self) -> None:
        self._stale = True
        if self.isVisible():
            self._later.start()

    def _on_preference(self, name: str) -> None:
        """The same curves in other colours, units or letters."""
        if name == "plots":
            for each, made in self._buttons.items():
                made.setChecked(each in self._preferences["plots"].split(","))
        if name in _SETTINGS and self.isVisible() and not self._stale:
            QTimer.singleShot(0, self, self._draw)  # when the theme is worn

    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what happened while hidden."""
        super().showEvent(event)
        if self._stale:
            self._later.start()

    def _on_moved(self, time: float) -> None:
        if not self.isVisible() or self._stale:
            return
        for plot in self.plots.values():
            plot.set_time(time)
        self._show_values()

    # --- drawing ---------------------------------------------------------------------------------------------------

    def _refresh(self) -> None:
        """Work the curves out, and paint those that are chosen."""
        from rvsim.gui.plots.time_plot import TimePlot  # pyqtgraph takes a quarter of a second to import

        self._stale = False
        trajectory = self._motion.player.trajectory
        there = isinstance(trajectory, Trajectory)
        self.empty.setVisible(not there or not self.chosen)
        self.empty.setText(tr(_EMPTY) if not there else tr("Choose above which curves are to be drawn."))
        self._curves = None
        if isinstance(trajectory, Trajectory):
            self._curves = curves_of(self._session.robot, trajectory, self._session.tracking)
        wanted = self.chosen if self._curves is not None else []
        for name in [name for name in self.plots if name not in wanted]:
            plot = self.plots.pop(name)
            self._grid.removeWidget(plot)
            plot.deleteLater()
        columns = min(_IN_ROW, len(wanted), max(self.width() // _NARROW, 1)) or 1
        for place, name in enumerate(wanted):
            if name not in self.plots:
                self.plots[name] = TimePlot(self._preferences, self)
                self.plots[name].setObjectName(f"plot_{name}")
                self.plots[name].picked.connect(self._motion.seek)
                self.plots[name].entered.connect(partial(self._read_from, name))
            self._grid.addWidget(self.plots[name], place // columns, place % columns)
        self._draw()

    def _draw(self) -> None:
        curves = self._curves
        if curves is None:
            self.readout.clear()
            return
        marks = _marks(curves)
        kinds = {kind.name: kind for kind in PLOTS}
        for name, plot in self.plots.items():
            plot.show_drawing(kinds[name].draw(curves, self._preferences), curves.times, marks)
            plot.set_time(self._motion.player.time)
        self._show_values()

    def _show_values(self) -> None:
        """The values at the cursor of the plot that the mouse was in last: the legend, with numbers."""
        plot = self.plots.get(self._read) or next(iter(self.plots.values()), None)
        if plot is None:
            self.readout.clear()
            return
        signs = {line.name: line.sign or line.name for line in plot.drawing.lines}
        parts = [
            f'<span style="color:{color}">■</span> {signs[name]} {left_to_right(format_number(value, _DECIMALS))}'
            for name, color, value in plot.value_texts()
        ]
        largest = plot.largest()
        if largest is not None:
            name, value, time = largest
            amount = f"{format_number(value, _DECIMALS)} {plot.drawing.unit}".rstrip()
            parts.append(
                tr(
                    "largest {value} ({curve}, at {time} s)",
                    value=amount,
                    curve=signs[name],
                    time=format_number(time, 2),
                )
            )
        self.readout.setText("&nbsp; ".join(f"{self._direction}{part}" for part in parts))
        self.readout.setToolTip(tr(_READOUT_TIP))

    @property
    def _direction(self) -> str:
        """A sign that is not seen: what follows is written from right to left, even where it begins with "J1"."""
        return "\u200f" if self.isRightToLeft() else ""

    def _read_from(self, name: str) -> None:
        """Read out the plot under the mouse."""
        self._read = name
        self._show_values()


def _marks(curves: Curves) -> tuple[float, ...]:
    """Times [s] at which the path jumps, or the arm comes near to a singularity."""
    near = curves.sigma_min < NEAR_SINGULAR
    entered = np.flatnonzero(near & ~np.concatenate([[False], near[:-1]]))
    times = curves.times[entered].tolist()
    if curves.tracking is not None and curves.path_index is not None:
        known = np.flatnonzero(np.isfinite(curves.path_index))
        for jump in curves.tracking.jumps:
            later = known[curves.path_index[known] >= jump]
            times += curves.times[later[:1]].tolist()
    return tuple(sorted(times))
