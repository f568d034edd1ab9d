"""The Measured page: what the arm was to do, what it was sent, and what came back, over time and in the scene."""

from __future__ import annotations

import math
from pathlib import Path
from typing import cast

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QSignalBlocker, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QFileDialog, QHeaderView, QLabel, QVBoxLayout, QWidget

from rvsim.device.driver.state import MEASURED_WORDS, MeasuredKind
from rvsim.errors import FileWriteError
from rvsim.files.atomic import write_atomically
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, dot, fit_height, plain_table
from rvsim.gui.plots.catalogue import Drawing, Line
from rvsim.gui.plots.time_plot import TimePlot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_quantity, joint_kind, length_kind
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import THEMES
from rvsim.gui.widgets import button, column_of, combo, scrolled
from rvsim.lab.recording_table import recording_csv
from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.primitives import Color, Item, Polyline

_EMPTY = (
    "Nothing has run on an arm yet. Connect one on the Drive page, track a line or a trajectory, and press "
    "“Run the motion on the arm”: what was wanted, sent and measured is compared here."
)
_TOOL = -1
_COLORS = {"desired": "#0072B2", "commanded": "#009E73", "measured": "#D55E00"}
_SENT = "sent"
_PLOT_HEIGHT = 150
_ON_DARK = 150  # per cent of brightness
_COLUMNS = ("Error", "Sent RMS", "Back RMS", "Back max")
_TIPS = (
    "A joint, or the tool",
    "Between what was wanted and what was sent, at the same moments",
    "Between what was wanted and what came back, at the same moments",
    "The largest of them",
)
_Role = Qt.ItemDataRole


class MeasuredPage(InspectPage):
    """Compares the last motion that ran on the arm with what was wanted."""

    title = "Measured"
    name = "measured"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, device: DeviceControl) -> None:
        super().__init__(session, preferences, stage)
        self._device = device
        self._recording: Recording | None = None
        self.about = wrapped_label("muted")
        self.about.setObjectName("measured_about")
        self.what = combo("measured_axis", "Joint or tool")
        self.what.currentIndexChanged.connect(lambda _: self._draw_curves())
        self.curves, self.errors = TimePlot(preferences), TimePlot(preferences)
        for plot, name in ((self.curves, "measured_curves"), (self.errors, "measured_errors")):
            plot.setObjectName(name)
            plot.setFixedHeight(_PLOT_HEIGHT)
        self.legend = QLabel()
        self.legend.setObjectName("measured_legend")
        self.legend.setTextFormat(Qt.TextFormat.RichText)
        self.summary = QLabel()
        self.summary.setObjectName("measured_summary")
        self.summary.setWordWrap(True)
        self.model = ErrorsModel(preferences)
        self.table = plain_table("measured_table", "Errors of joints and tool", self.model)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.save = button("measured_save", "Save as CSV…", "Times, wanted, sent and measured joints", self._on_save)
        self._lay_out()
        for plot in (self.curves, self.errors):
            plot.picked.connect(device.motion.seek)
            device.motion.moved.connect(plot.set_time)
        device.polled.connect(self._on_polled)

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(8)
        self._parts = (self.summary, self.what, self.legend, self.curves, self.errors, self.table, self.save)
        for widget in (self.about, *self._parts):
            column.addWidget(widget)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- what is shown ---------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the recording there is."""
        recording = self._recording
        for widget in self._parts:
            widget.setVisible(recording is not None)
        if recording is None:
            self.about.setText(_EMPTY)
            self.draw(())
            return
        robot = self._session.robot
        if recording.desired.shape[1] != robot.dof:
            self._recording = None
            self.refresh()
            return
        self.about.setText(MEASURED_WORDS[cast(MeasuredKind, recording.kind)])
        self._offer(robot)
        self.model.show_errors(robot, recording)
        fit_height(self.table)
        self.summary.setText(_summary(robot, recording, self._preferences))
        self.legend.setText(_legend(THEMES[self._preferences["theme"]].dark))
        self._draw_curves()
        self.draw(_paths(robot, recording))

    def set_seen(self, seen: bool) -> None:
        """What has run meanwhile is shown."""
        self._on_polled()
        super().set_seen(seen)

    def _on_polled(self) -> None:
        """Another recording, or a longer one."""
        driver = self._device.driver
        if driver is None:
            return
        recording = driver.recording
        if recording.empty or (self._recording is not None and _same(recording, self._recording)):
            return
        self._recording = recording
        self._refresh_if_seen()

    def _offer(self, robot: Robot) -> None:
        names = ["Tool", *(f"J{i + 1} {name}" for i, name in enumerate(robot.joint_names))]
        if [self.what.itemText(i) for i in range(self.what.count())] != names:
            with QSignalBlocker(self.what):
                self.what.clear()
                for number, name in enumerate(names):
                    self.what.addItem(name, number - 1)

    def _draw_curves(self) -> None:
        recording = self._recording
        if recording is None or self.what.count() == 0:
            return
        axis = int(self.what.currentData())
        make = _tool_drawings if axis == _TOOL else _joint_drawings
        curves, errors = make(self._session.robot, recording, axis, self._preferences)
        self.curves.show_drawing(curves, recording.t, ())
        self.errors.show_drawing(errors, recording.t, ())

    def _on_save(self) -> None:
        if self._recording is None:
            return
        chosen, _ = QFileDialog.getSaveFileName(self, "Save as CSV", "measured.csv", "CSV (*.csv)")
        if not chosen:
            return
        try:
            write_atomically(Path(chosen), recording_csv(self._session.robot, self._recording).encode())
        except (OSError, FileWriteError) as problem:
            self._session.say(f"Not saved: {problem}", "error")
            return
        self._session.say(f"Saved {chosen}.")


class ErrorsModel(QAbstractTableModel):
    """One row a joint, the tool last."""

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._rows: tuple[tuple[str, str, tuple[str, ...]], ...] = ()

    def show_errors(self, robot: Robot, recording: Recording) -> None:
        """Work them out anew."""
        sent, back = recording.joint_errors("commanded"), recording.joint_errors("measured")
        rows = []
        for index, joint in enumerate(robot.joints):
            kind = joint_kind(robot, index)
            values = (sent.rms[index], back.rms[index], back.max[index])
            texts = tuple(_text(value, kind, self._preferences) for value in values)
            rows.append((f"J{index + 1} {joint.name}", joint.color, texts))
        tool_sent, tool_back = recording.tool_errors(robot, "commanded"), recording.tool_errors(robot, "measured")
        values = (tool_sent.rms, tool_back.rms, tool_back.max)
        texts = tuple(_text(float(value), length_kind(robot), self._preferences) for value in values)
        rows.append(("Tool", "#808080", texts))
        self.beginResetModel()
        self._rows = tuple(rows)
        self.endResetModel()

    def rowCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008 (Qt's own signature)
        """Joints and tool."""
        return len(self._rows)

    def columnCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Name and three errors."""
        return len(_COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        """What stands below."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        return {_Role.DisplayRole: _COLUMNS, _Role.ToolTipRole: _TIPS}.get(_Role(role), (None,) * 4)[section]

    def data(self, index: Index, role: int = _Role.DisplayRole) -> object:
        """One cell."""
        name, color, texts = self._rows[index.row()]
        if role == _Role.DisplayRole:
            return name if index.column() == 0 else texts[index.column() - 1]
        if role == _Role.TextAlignmentRole:
            return LEFT if index.column() == 0 else RIGHT
        if role == _Role.DecorationRole and index.column() == 0:
            return dot(color)
        return None


def _text(value: float, kind: Kind, preferences: Preferences) -> str:
    return format_quantity(float(value), kind, preferences) if math.isfinite(value) else "–"


def _same(one: Recording, other: Recording) -> bool:
    return len(one.t) == len(other.t) and one.t[0] == other.t[0] and one.t[-1] == other.t[-1]


def _summary(robot: Robot, recording: Recording, preferences: Preferences) -> str:
    back = recording.tool_errors(robot, "measured")
    if not math.isfinite(float(back.rms)):
        return "Nothing came back of this motion."
    kind = length_kind(robot)
    rms, most = (format_quantity(float(value), kind, preferences) for value in (back.rms, back.max))
    seconds = f"{recording.duration:.1f} s"
    return (
        f"The tool was {rms} (RMS) from where it should have been at the same moment, {most} at most, over {seconds}."
    )


def _joint_drawings(robot: Robot, recording: Recording, axis: int, preferences: Preferences) -> tuple[Drawing, Drawing]:
    shown = display(joint_kind(robot, axis), preferences)
    values = {name: _filled(recording.t, getattr(recording, name)[:, axis]) * shown.factor for name in _COLORS}
    lines = tuple(Line(_name(name), color, values[name], name == "desired") for name, color in _COLORS.items())
    errors = tuple(
        Line(f"{_name(name)} − wanted", _COLORS[name], values[name] - values["desired"])
        for name in ("commanded", "measured")
    )
    unit = shown.suffix.strip()
    name = f"J{axis + 1} {robot.joint_names[axis]}"
    return Drawing(name, unit, lines), Drawing(f"{name}, error", unit, errors)


def _tool_drawings(robot: Robot, recording: Recording, _axis: int, preferences: Preferences) -> tuple[Drawing, Drawing]:
    shown = display(length_kind(robot), preferences)
    places = {name: recording.tool_path(robot, name) * shown.factor for name in _COLORS}
    lines = tuple(
        Line(f"{letter} {_name(name)}", _COLORS[name], _filled(recording.t, places[name][:, column]), name == "desired")
        for column, letter in enumerate("xyz")
        for name in _COLORS
    )
    errors = tuple(
        Line(_name(name), _COLORS[name], _filled(recording.t, recording.tool_distances(robot, name) * shown.factor))
        for name in ("commanded", "measured")
    )
    unit = shown.suffix.strip()
    return Drawing("Tool x, y, z", unit, lines), Drawing("Tool, distance from wanted", unit, errors)


def _name(source: str) -> str:
    return {"desired": "wanted", "commanded": _SENT}.get(source, source)


def _legend(dark: bool) -> str:
    """The words in the colours of their curves, as the plots brighten them on a dark ground."""
    signs = {"desired": "┄", "commanded": "━", "measured": "━"}
    parts = []
    for source, text in _COLORS.items():
        color = QColor(text).lighter(_ON_DARK if dark else 100).name()
        parts.append(f'<span style="color:{color}">{signs[source]}</span>&nbsp;{_name(source)}')
    return " &nbsp; ".join(parts)


def _filled(t: FloatArray, values: FloatArray) -> FloatArray:
    """Straight lines between the moments at which something is known; nothing before the first or after the last."""
    known = np.isfinite(values)
    if known.sum() < 2:
        return values
    return np.asarray(np.interp(t, t[known], values[known], left=np.nan, right=np.nan))


def _paths(robot: Robot, recording: Recording) -> tuple[Item, ...]:
    items = []
    for source, color in _COLORS.items():
        places = recording.tool_path(robot, source)
        places = places[np.isfinite(places).all(axis=1)]
        if len(places) >= 2:
            items.append(Polyline(f"measured.{source}", places, Color.from_hex(color), 2.0, dashed=source == "desired"))
    return tuple(items)
