"""The Forces page: pull at the tool, and see what the joints have to hold."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import numpy as np
from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.dynamics import STANDARD_GRAVITY, gravity_torques, largest_force, payload_wrench
from rvsim.experiment import Experiment, Load, WrenchAxes
from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.folding_row import FoldingRow, group_of
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_forces_ratings import Ratings
from rvsim.gui.panels.inspect_forces_table import TorqueModel, fit_table, show_weight, torque_table
from rvsim.gui.panels.inspect_forces_words import (
    AXES,
    DIRECTIONS,
    HANGING,
    besides_text,
    counted_text,
    direction_vector,
    largest_text,
    legend,
    ratings,
    torque_equations,
    torque_rows,
)
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_sources_button import SourcesButton
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_quantity, moment_kind, torque_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, combo, scrolled, select, show_whole
from rvsim.gui.wrench_drag import WrenchDrag
from rvsim.kinematics import pose_and_jacobian
from rvsim.lab.texts import NamedValue, values_latex, values_numpy, values_text
from rvsim.language import in_its_order, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.wrench import WrenchArrows, arrow_scale, wrench_items

_FORCES, _MOMENTS = ("fx", "fy", "fz"), ("mx", "my", "mz")
_MEANING = tr_later(
    "F is what the tool exerts, at the tool's origin. Drag the red dot at the tool to pull; with Ctrl in whole newtons."
)
_FORMULA_NOTE = tr_later("J of the tool in base axes; SI units: m, N, N m.")


class ForcesPage(InspectPage):
    """τ = Jᵀ F, live."""

    always = True
    title = tr_later("Forces")
    name = "inspect_forces"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._robot: Robot | None = None
        self._arrows: WrenchArrows | None = None
        self._before_drag = self.load
        self._R: FloatArray = np.eye(3)
        self._torques: FloatArray = np.zeros(0)
        self.axes = combo("wrench_axes", tr("Axes of the wrench"), AXES)
        self.axes.activated.connect(lambda _: self._take_axes())
        self.forces = self._row(_FORCES, "force", 0, tr("Set the force at the tool"))
        self.moments = self._row(_MOMENTS, "torque", 3, tr("Set the moment at the tool"))
        self.payload = QuantityBox("mass", preferences, tr("Payload at the tool"))
        self.payload.setObjectName("payload")
        self.payload.set_range(0.0, 1e4)
        self.payload.quantity_changed.connect(self._take_payload)
        self.payload.editingFinished.connect(session.end_stroke)
        self.payload.refused.connect(self._complain)
        self.weight = QCheckBox(tr("The arm holds its own weight too"))
        self.weight.setObjectName("own_weight")
        self.weight.toggled.connect(self._take_weight)
        self.clear = button("wrench_clear", tr("No force"), tr("Take the wrench and the payload away"), self._clear)
        self.model = TorqueModel(session.robot, preferences, self.catch_up)
        self.table, self.torques_title = torque_table(self.model), _titled("")
        self.directions = combo(
            "force_direction",
            tr("Direction of the largest force"),
            {name: in_its_order(tr(text)) for name, text in DIRECTIONS.items()},
        )
        self.directions.setCurrentIndex(self.directions.findData("+z"))
        self.directions.activated.connect(lambda _: self.refresh())
        self.legend, self.largest, self.message = wrapped_label("muted"), wrapped_label(), wrapped_label()
        self.hanging = wrapped_label("muted")
        self.hanging.setText(tr(HANGING))
        self.hanging.hide()
        self.largest.setObjectName("largest_force")
        self.ratings = Ratings(session, preferences)
        self.equations = EquationsView(Typesetter(self))
        self.sources = SourcesButton("dynamics", self)
        makers = {"text": values_text, "NumPy": values_numpy, "LaTeX": values_latex}
        formats = {name: (lambda make=make: make(self._values())) for name, make in makers.items()}
        self.copy = CopyButton("torque_copy", tr("the joint torques"), formats, session)
        self.drag = WrenchDrag(stage.view, lambda: self._arrows, self)
        self.drag.pulled.connect(self._on_pulled)
        self.drag.lit.connect(lambda _: self._draw())
        self.drag.released.connect(self._on_released)
        self._lay_out()

    # --- construction ----------------------------------------------------------------------------------------------

    def _row(self, names: tuple[str, ...], kind: Kind, first: int, text: str) -> NumberRow:
        row = NumberRow("wrench", names, (kind,) * 3, self._preferences, tr("Wrench"))
        row.edited.connect(lambda _: self._take(text, self.load.with_wrench(first, row.values), kind))
        row.finished.connect(self._session.end_stroke)
        row.refused.connect(self._complain)
        return row

    def _lay_out(self) -> None:
        set_role(self.message, level="warning")
        self.message.hide()
        meaning = wrapped_label("muted")
        meaning.setText(tr(_MEANING))
        carried = QHBoxLayout()
        carried.addWidget(QLabel(tr("Payload")))
        carried.addWidget(self.payload, 1)
        carried.addWidget(self.clear)
        show_whole(self.axes, self.directions)
        asked = FoldingRow(
            group_of(_titled(tr("Largest force along")), stretched=True), group_of(self.directions, stretched=True), 8
        )
        note = wrapped_label("muted")
        note.setText(tr(_FORMULA_NOTE))
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        column.addLayout(_line(_titled(tr("Wrench F")), self.axes))
        for widget in (self.forces, self.moments):
            column.addWidget(widget)
        column.addLayout(carried)
        column.addWidget(self.hanging)
        column.addWidget(self.weight)
        column.addWidget(meaning)
        column.addSpacing(6)
        column.addLayout(_line(self.torques_title, self.copy))
        for shown in (self.table, self.legend, self.message):
            column.addWidget(shown)
        column.addSpacing(6)
        column.addWidget(asked)
        column.addWidget(self.largest)
        column.addSpacing(6)
        column.addWidget(self.ratings)
        column.addSpacing(6)
        column.addWidget(self.equations)
        column.addWidget(note)
        column.addWidget(self.sources)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- what is asked ---------------------------------------------------------------------------------------------

    @property
    def load(self) -> Load:
        """What the arm is asked to hold."""
        return self._session.experiment.load

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The load counts too."""
        return super().concerns(before, after) or after.load is not before.load

    def set_seen(self, seen: bool) -> None:
        """The arrow can be taken hold of only while the page is seen."""
        super().set_seen(seen)
        self.drag.switch(seen)

    def _take(self, text: str, load: Load, merge: str = "") -> None:
        """Another load, undoably."""
        self._session.edit(text, self._session.experiment.with_load(load), merge=f"load {merge}" if merge else "")

    def _take_payload(self, mass: float) -> None:
        self._take(tr("Set the payload"), replace(self.load, payload=mass), "payload")

    def _take_weight(self, on: bool) -> None:
        text = tr("Count the arm's own weight") if on else tr("Leave out the arm's own weight")
        self._take(text, replace(self.load, own_weight=on))

    def _take_axes(self) -> None:
        """The same wrench, seen in other axes."""
        axes = next(axes for axes in get_args(WrenchAxes) if axes == self.axes.currentData())
        if axes != self.load.axes:
            text = tr("Write the wrench in base axes") if axes == "base" else tr("Write the wrench in tool axes")
            self._take(text, self.load.in_axes(axes, self._R))

    def _clear(self) -> None:
        if np.any(self.load.wrench) or self.load.payload:
            self._take(tr("Take the load away"), replace(self.load, wrench=np.zeros(6), payload=0.0))

    def _on_pulled(self, force: FloatArray) -> None:
        """The arrow's end has been dragged there."""
        force = self._R.T @ force if self.load.axes == "tool" else force
        self._take(tr("Pull at the tool"), self.load.with_wrench(0, force), "pull")

    def _on_released(self, given_up: bool) -> None:
        if given_up and self.load is not self._before_drag:
            self._take(tr("Pull at the tool"), self._before_drag, "pull")
        self._session.end_stroke()
        self.refresh()

    def _complain(self, sentence: str) -> None:
        self.message.setText(sentence)
        self.message.setVisible(bool(sentence))

    # --- showing ---------------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the torques of the present pose."""
        robot, q = self._session.robot, self._session.q
        if robot is not self._robot:
            self._take_robot(robot)
        self.message.hide()
        T, J = pose_and_jacobian(robot, q)
        self._R = T[:3, :3]
        wrench = self.load.in_base(self._R)
        carried = payload_wrench(self.load.payload, STANDARD_GRAVITY)
        weight = gravity_torques(robot, q) if self._weighs() else np.zeros(robot.dof)
        pushed = J.T @ (wrench + carried)
        self._torques = pushed + weight
        self._show_boxes()
        fit_table(self.table)
        self.ratings.settle()
        self.model.show_rows(robot, torque_rows(robot, pushed, weight))
        self._show_largest(robot, q, weight + J.T @ carried)
        self.equations.show_equations(torque_equations(J, wrench + carried, pushed))
        self._place_arrows(robot, T, wrench)

    def _weighs(self) -> bool:
        return self.load.own_weight and bool(self._session.robot.masses)

    def _take_robot(self, robot: Robot) -> None:
        self._robot = robot
        self.sources.offer(robot)
        for box in self.moments.boxes:
            box.set_kind(moment_kind(robot))
        self.weight.setVisible(bool(robot.masses))
        self.model.show_rows(robot, torque_rows(robot, np.zeros(robot.dof), np.zeros(robot.dof)))
        self.torques_title.setText(self.model.title)
        self.legend.setText(legend(self.model.rows))
        self.ratings.show_robot(robot)

    def _show_boxes(self) -> None:
        select(self.axes, self.load.axes)
        self.forces.show_values(self.load.wrench[:3])
        self.moments.show_values(self.load.wrench[3:])
        self.payload.set_quantity(self.load.payload)
        self.hanging.setVisible(self.load.payload > 0.0)
        with QSignalBlocker(self.weight):
            self.weight.setChecked(self.load.own_weight)
        show_weight(self.table, self._weighs())

    def _show_largest(self, robot: Robot, q: FloatArray, held: FloatArray) -> None:
        asked = direction_vector(self.directions.currentData(), self.load.wrench)
        found, pure_moment = None, False
        if asked is not None:
            pure_moment = not np.any(asked[:3])
            in_base = replace(self.load, wrench=asked).in_base(self._R)
            found = largest_force(robot, q, in_base, ratings(robot), holding=held)
        held_besides = self.load.payload, self._weighs(), self._preferences
        texts = besides_text(*held_besides), counted_text(*held_besides)
        self.largest.setText(largest_text(robot, found, pure_moment, self._preferences, *texts))

    # --- the scene -------------------------------------------------------------------------------------------------

    def _place_arrows(self, robot: Robot, T: FloatArray, wrench: FloatArray) -> None:
        force, moment = wrench[:3], wrench[3:]
        if self.drag.held and self._arrows is not None:
            scale = self._arrows.scale  # the hand feels the same newtons a millimetre all the way
        else:
            self._before_drag = self.load
            largest = max(float(np.linalg.norm(force)), self.load.payload * STANDARD_GRAVITY)
            scale = arrow_scale(robot.size, max(largest, _typical_force(robot)))
        kinds: tuple[Kind, Kind] = ("force", moment_kind(robot))
        force_text, moment_text = (
            format_quantity(float(np.linalg.norm(part)), kind, self._preferences) if np.any(part) else ""
            for part, kind in zip((force, moment), kinds, strict=True)
        )
        mass = self.load.payload
        mass_text = format_quantity(mass, "mass", self._preferences)
        weight = mass * STANDARD_GRAVITY
        self._arrows = WrenchArrows(
            T[:3, 3], force, moment, scale, robot.size, force_text, moment_text, weight, mass_text
        )
        self._draw()

    def _draw(self) -> None:
        if self.seen and self._arrows is not None:
            self.draw(wrench_items(self._arrows, self._stage.palette, lit=self.drag.lit_now))

    # --- copying ---------------------------------------------------------------------------------------------------

    def _values(self) -> list[NamedValue]:
        robot = self._session.robot
        units = (display(torque_kind(robot, i), self._preferences).suffix.strip() for i in range(robot.dof))
        values = zip(robot.joint_names, self._torques.tolist(), units, strict=True)
        return [NamedValue(f"tau_{i} ({name})", value, unit) for i, (name, value, unit) in enumerate(values, start=1)]


def _typical_force(robot: Robot) -> float:
    """Half of what a drive of this arm could push with at its full reach [N]: the arrow is of use from there on."""
    rated = [joint.max_torque.value for joint in robot.joints if joint.max_torque and joint.revolute]
    return 0.5 * max(rated, default=0.0) / robot.size or 5.0


def _titled(text: str) -> QLabel:
    label = QLabel(text)
    set_role(label, role="title")
    return label


def _line(title: QLabel, *widgets: QWidget) -> QHBoxLayout:
    """A title, what belongs to it at the right end."""
    line = QHBoxLayout()
    line.setSpacing(8)
    line.addWidget(title)
    line.addStretch(1)
    for widget in widgets:
        line.addWidget(widget)
    return line
