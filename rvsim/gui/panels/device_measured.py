"""The Measured page: what the arm was to do, what it was sent, and what came back, over time and in the scene."""

from __future__ import annotations

import math
from html import escape
from pathlib import Path
from typing import cast

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QSignalBlocker, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QFileDialog, QHeaderView, QLabel, QVBoxLayout, QWidget

from rvsim.device.driver.state import MEASURED_WORDS, MeasuredKind
from rvsim.device.words import axis_name, in_a_row
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
from rvsim.language import tr, tr_later
from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.primitives import Color, Item, Polyline

_EMPTY = tr_later(
    "Nothing has run on an arm yet. Connect one on the Drive page, track a line or a trajectory, and press "
    "“Run the motion on the arm”: what was wanted, sent and came back is compared here."
)
_TOOL = -1
_COLORS = {"desired": "#0072B2", "commanded": "#009E73", "measured": "#D55E00", "true": "#CC79A7"}
# What a curve shows, and the same for the head of a narrow column.
_WORDS = {
    "desired": tr_later("wanted"),
    "commanded": tr_later("sent"),
    "measured": tr_later("measured"),
    "reported": tr_later("reported"),
    "true": tr_later("really (virtual arm)"),
}
_HEADS = {
    "commanded": tr_later("Sent"),
    "measured": tr_later("Measured"),
    "reported": tr_later("Reported"),
    "true": tr_later("Really"),
}
_REPORTED = tr_later(
    "The controller reported pulses that stand for a tool {rms} (RMS) from where it should have been at the same "
    "moment, {most} at most, over {seconds}; that is no measurement: pulses come in steps of 10 µs, about 1°."
)
_MEASURED = tr_later(
    "The tool was {rms} (RMS) from where it should have been at the same moment, {most} at most, over {seconds}."
)
_TRULY = tr_later(
    "Really the virtual arm’s tool was {rms} (RMS) from there, {most} at most: its servos lag, sag, and differ from an "
    "arm’s file until they are calibrated. Of a real arm nobody sees that."
)
_MOST_TIP = tr_later("The largest between what was wanted and what came back")
_TRUE_TIP = tr_later("Between what was wanted and where the virtual arm really was")
_PLOT_HEIGHT = 150
_ON_DARK = 150  # per cent of brightness
_DEVIATION = tr_later("Deviation, RMS")
_TIPS = {
    "commanded": tr_later("Between what was wanted and what was sent, at the same moments"),
    "measured": tr_later("Between what was wanted and what came back, at the same moments"),
    "true": _TRUE_TIP,
}
_NOT_SAVED = tr_later(
    "A saved session does not hold this run. To keep it, save it as CSV here, or make a lab report while the arm is "
    "connected."
)
_Role = Qt.ItemDataRole


class MeasuredPage(InspectPage):
    """Compares the last motion that ran on the arm with what was wanted."""

    title = tr_later("Measured")
    name = "measured"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, device: DeviceControl) -> None:
        super().__init__(session, preferences, stage)
        self._device = device
        self._recording: Recording | None = None
        self._part: Recording | None = None  # of it, that on the trajectory itself
        self._runs = False
        self.about = wrapped_label("muted")
        self.about.setObjectName("measured_about")
        self.what = combo("measured_axis", tr("Joint or tool"))
        self.what.currentIndexChanged.connect(lambda _: self._draw_curves())
        self.curves, self.errors = TimePlot(preferences), TimePlot(preferences)
        for plot, name in ((self.curves, "measured_curves"), (self.errors, "measured_errors")):
            plot.setObjectName(name)
            plot.setFixedHeight(_PLOT_HEIGHT)
        self.legend = QLabel()
        self.legend.setObjectName("measured_legend")
        self.legend.setTextFormat(Qt.TextFormat.RichText)
        self.legend.setWordWrap(True)
        self.summary = QLabel()
        self.summary.setObjectName("measured_summary")
        self.summary.setWordWrap(True)
        self.model = ErrorsModel(preferences)
        self.table = plain_table("measured_table", tr("Deviations of joints and tool"), self.model)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.save = button(
            "measured_save",
            tr("Save as CSV…"),
            tr("Times, and joints and tool: wanted, sent, come back"),
            self._on_save,
        )
        self.keeping = wrapped_label("muted")
        self.keeping.setObjectName("measured_keeping")
        self.keeping.setText(tr(_NOT_SAVED))
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
        self._parts = (
            self.summary,
            self.what,
            self.legend,
            self.curves,
            self.errors,
            self.table,
            self.keeping,
            self.save,
        )
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
            self.about.setText(tr(_EMPTY))
            self.draw(())
            return
        robot = self._session.robot
        if recording.desired.shape[1] != robot.dof:
            self._recording = None
            self.refresh()
            return
        self.about.setText(tr(MEASURED_WORDS[cast(MeasuredKind, recording.kind)]))
        self._offer(robot)
        self._part = recording.on_trajectory()
        self.model.show_errors(robot, self._part)
        fit_height(self.table)
        self.summary.setText(_summary(robot, recording, self._part, self._preferences, runs=self._runs))
        self.legend.setText(_legend(recording, THEMES[self._preferences["theme"]].dark))
        self._draw_curves()
        self.draw(_paths(robot, self._part))

    def set_seen(self, seen: bool) -> None:
        """What has run meanwhile is shown."""
        self._on_polled()
        super().set_seen(seen)

    def _on_polled(self) -> None:
        """Another recording, or a longer one."""
        recording, state = self._device.recording, self._device.state
        if recording is None or recording.empty:
            return
        runs = state is not None and state.phase == "running"
        if self._recording is not None and runs == self._runs and _same(recording, self._recording):
            return
        self._recording, self._runs = recording, runs
        self._refresh_if_seen()

    def _offer(self, robot: Robot) -> None:
        names: list[str] = [tr("Tool"), *(_joint_title(robot, joint) for joint in range(robot.dof))]
        if [self.what.itemText(i) for i in range(self.what.count())] != names:
            with QSignalBlocker(self.what):
                self.what.clear()
                for number, name in enumerate(names):
                    self.what.addItem(name, number - 1)

    def _draw_curves(self) -> None:
        part = self._part
        if part is None or self.what.count() == 0:
            return
        axis = int(self.what.currentData())
        make = _tool_drawings if axis == _TOOL else _joint_drawings
        curves, errors = make(self._session.robot, part, axis, self._preferences)
        for plot, drawing in ((self.curves, curves), (self.errors, errors)):
            plot.setVisible(not part.empty)
            if not part.empty:
                plot.show_drawing(drawing, part.t, ())

    def _on_save(self) -> None:
        if self._recording is None:
            return
        chosen, _ = QFileDialog.getSaveFileName(self, tr("Save as CSV"), "measured.csv", "CSV (*.csv)")
        if not chosen:
            return
        try:
            write_atomically(Path(chosen), recording_csv(self._session.robot, self._recording).encode())
        except (OSError, FileWriteError) as problem:
            self._session.say(tr("Not saved: {problem}", problem=problem), "error")
            return
        self._session.say(tr("Saved {file}.", file=chosen))


class ErrorsModel(QAbstractTableModel):
    """One row a joint, the tool last."""

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._rows: tuple[tuple[str, str, tuple[str, ...]], ...] = ()
        self._heads: tuple[str, ...] = (tr(_DEVIATION),)
        self._tips: tuple[str, ...] = ("",)

    def show_errors(self, robot: Robot, recording: Recording) -> None:
        """Work them out anew."""
        sources = _compared(recording)
        most = () if "true" in sources else ("measured",)  # there is room for four columns
        joint_values = [*(recording.joint_errors(name).rms for name in sources)]
        joint_values += [*(recording.joint_errors(name).max for name in most)]
        rows: list[tuple[str, str, tuple[str, ...]]] = []
        for index, joint in enumerate(robot.joints):
            kind = joint_kind(robot, index)
            texts = tuple(_text(values[index], kind, self._preferences) for values in joint_values)
            rows.append((_joint_title(robot, index), joint.color, texts))
        tool = [float(recording.tool_errors(robot, name).rms) for name in sources]
        tool += [float(recording.tool_errors(robot, name).max) for name in most]
        rows.append(
            (tr("Tool"), "#808080", tuple(_text(value, length_kind(robot), self._preferences) for value in tool))
        )
        self._tips = (
            tr("A joint, or the tool"),
            *(tr(_TIPS[name]) for name in sources),
            *(tr(_MOST_TIP) for _ in most),
        )
        self._heads = (tr(_DEVIATION), *(_short(recording, name) for name in sources), *(tr("At most") for _ in most))
        self.beginResetModel()
        self._rows = tuple(rows)
        self.endResetModel()

    def rowCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008 (Qt's own signature)
        """Joints and tool."""
        return len(self._rows)

    def columnCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Name, and the deviation of all that is known."""
        return len(self._heads)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        """What stands below."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        texts = {_Role.DisplayRole: self._heads, _Role.ToolTipRole: self._tips}.get(_Role(role))
        return texts[section] if texts else None

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


def _summary(robot: Robot, recording: Recording, part: Recording, preferences: Preferences, *, runs: bool) -> str:
    """What the motion came to; `part` is that on the trajectory itself."""
    sentences: list[str] = []
    if recording.stopped_at is not None and not runs:
        sentences.append(
            tr(
                "It was stopped at {time:.1f} of {planned:.1f} s.",
                time=recording.stopped_at,
                planned=recording.planned,
            )
        )
    back = _amounts(robot, part, "measured", preferences)
    if back is None:
        sentences.append(
            tr("Nothing came back of this motion.") if recording.t[-1] >= 0.0 else tr("It has not begun yet.")
        )
    else:
        sentences.append(tr(_MEASURED if recording.is_measured else _REPORTED, **back))
    truly = _amounts(robot, part, "true", preferences) if part.true is not None else None
    if truly is not None:
        sentences.append(tr(_TRULY, **truly))
    return " ".join(sentences)


def _amounts(robot: Robot, part: Recording, of: str, preferences: Preferences) -> dict[str, str] | None:
    errors = part.tool_errors(robot, of)
    if not math.isfinite(float(errors.rms)):
        return None
    rms, most = (format_quantity(float(value), length_kind(robot), preferences) for value in (errors.rms, errors.max))
    return {"rms": rms, "most": most, "seconds": f"{part.duration:.1f} s"}


def _compared(recording: Recording) -> tuple[str, ...]:
    return tuple(name for name in recording.sources if name != "desired")


def _joint_drawings(robot: Robot, recording: Recording, axis: int, preferences: Preferences) -> tuple[Drawing, Drawing]:
    shown = display(joint_kind(robot, axis), preferences)
    values = {
        name: _filled(recording.t, getattr(recording, name)[:, axis]) * shown.factor for name in recording.sources
    }
    lines = tuple(Line(_name(recording, name), _COLORS[name], row, name == "desired") for name, row in values.items())
    errors = tuple(
        Line(tr("{curve} − wanted", curve=_name(recording, name)), _COLORS[name], values[name] - values["desired"])
        for name in _compared(recording)
    )
    unit = shown.suffix.strip()
    name = _joint_title(robot, axis)
    return Drawing(name, unit, lines), Drawing(tr("{joint}, deviation", joint=name), unit, errors)


def _tool_drawings(robot: Robot, recording: Recording, _axis: int, preferences: Preferences) -> tuple[Drawing, Drawing]:
    shown = display(length_kind(robot), preferences)
    places = {name: recording.tool_path(robot, name) * shown.factor for name in recording.sources}
    lines = tuple(
        Line(
            f"{letter} {_name(recording, name)}", _COLORS[name], _filled(recording.t, path[:, column]),
            name == "desired",
        )
        for column, letter in enumerate("xyz")
        for name, path in places.items()
    )  # fmt: skip
    errors = tuple(
        Line(
            _name(recording, name), _COLORS[name],
            _filled(recording.t, recording.tool_distances(robot, name) * shown.factor),
        )
        for name in _compared(recording)
    )  # fmt: skip
    unit = shown.suffix.strip()
    return Drawing(_axes_title(recording, places), unit, lines), Drawing(
        tr("Tool, deviation from wanted"), unit, errors
    )


def _axes_title(recording: Recording, places: dict[str, FloatArray]) -> str:
    """Which of the three curves is which: in the order of where they begin, from above."""
    if recording.empty:
        return tr("Tool x, y, z")
    order = np.argsort(-np.nan_to_num(places["desired"][0]))
    return tr("Tool, at the left from above: {order}", order=in_a_row("xyz"[i] for i in order))


def _name(recording: Recording, source: str) -> str:
    return tr(_WORDS[_known(recording, source)])


def _short(recording: Recording, source: str) -> str:
    """For a narrow column: "Sent"."""
    return tr(_HEADS[_known(recording, source)])


def _known(recording: Recording, source: str) -> str:
    """What came back is a measurement, or the controller's report."""
    return "reported" if source == "measured" and not recording.is_measured else source


def _joint_title(robot: Robot, joint: int) -> str:
    """ "J2 shoulder"."""
    return f"J{joint + 1} {axis_name(robot, joint)}"


def _legend(recording: Recording, dark: bool) -> str:
    """The words in the colours of their curves, as the plots brighten them on a dark ground."""
    parts = []
    for source in recording.sources:
        color = QColor(_COLORS[source]).lighter(_ON_DARK if dark else 100).name()
        sign = "┄" if source == "desired" else "━"
        parts.append(f'<span style="color:{color}">{sign}</span>&nbsp;{escape(_name(recording, source))}')
    return " &nbsp; ".join(parts)


def _filled(t: FloatArray, values: FloatArray) -> FloatArray:
    """Straight lines between the moments at which something is known; nothing before the first or after the last."""
    known = np.isfinite(values)
    if known.sum() < 2:
        return values
    return np.asarray(np.interp(t, t[known], values[known], left=np.nan, right=np.nan))


def _paths(robot: Robot, recording: Recording) -> tuple[Item, ...]:
    items = []
    for source in recording.sources:
        places = recording.tool_path(robot, source)
        places = places[np.isfinite(places).all(axis=1)]
        if len(places) >= 2:
            items.append(
                Polyline(
                    f"measured.{source}",
                    places,
                    Color.from_hex(_COLORS[source]),
                    2.0,
                    dashed=source == "desired",
                )
            )
    return tuple(items)
