"""The Dynamics page: what it takes to hold the arm, to keep it moving and to accelerate it, each apart."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np
from PySide6.QtWidgets import QGridLayout, QLabel, QTableView, QVBoxLayout, QWidget

from rvsim.dynamics import STANDARD_GRAVITY, dynamics_parts, kinetic_energy, mass_matrix, potential_energy
from rvsim.errors import RobotDefinitionError
from rvsim.experiment import Experiment
from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_dynamics_masses import CENTER_COLUMNS, INERTIA_COLUMNS, MassModel, mass_table
from rvsim.gui.panels.inspect_dynamics_rates import RateRows, beside
from rvsim.gui.panels.inspect_dynamics_table import PARTS, PartsModel, parts_table
from rvsim.gui.panels.inspect_dynamics_words import (
    PLACES,
    energy_text,
    mass_note,
    matrix_decimals,
    matrix_equation,
    matrix_note,
    no_mass_text,
    rates_note,
    torques_title,
)
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.tables import fit_height
from rvsim.gui.panels.user_robot import own_copy
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, combo, scrolled, select
from rvsim.lab.texts import matrix_latex, matrix_numpy, matrix_text, table_tsv
from rvsim.language import tr, tr_later
from rvsim.motion import Trajectory
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.mass_edits import MassKey, with_guessed_masses, with_mass_value
from rvsim.scene.weights import weight_items

_FREE = ""  # the place whose gravity is none of the known ones


class DynamicsPage(InspectPage):
    """τ = M(q) q̈ + C(q, q̇) q̇ + g(q), live; while a motion is shown, with its velocities and accelerations."""

    title = tr_later("Dynamics")
    name = "inspect_dynamics"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._motion = stage.motion
        self._robot: Robot | None = None
        self._typed: tuple[FloatArray, FloatArray] = (np.zeros(0), np.zeros(0))
        self._M: FloatArray = np.zeros((0, 0))
        self.rates = RateRows(preferences)
        self.rates.edited.connect(self._on_rates)
        self.rates.refused.connect(self._complain)
        self.at_rest = button(
            "dynamics_rest", tr("At rest"), tr("Set all velocities and accelerations to 0"), self._rest
        )
        self.gravity = self._box("gravity", "gravity", tr("Gravity"), STANDARD_GRAVITY)
        self.gravity.quantity_changed.connect(lambda _: self.refresh())
        self.payload = self._box("dynamics_payload", "mass", tr("Payload at the tool"), 0.0)
        self.payload.quantity_changed.connect(self._take_payload)
        self.payload.editingFinished.connect(session.end_stroke)
        self.place = combo("gravity_place", tr("Whose gravity"), {**PLACES, _FREE: tr("own value")})
        self.place.activated.connect(lambda _: self._take_place())
        self.model = PartsModel(session.robot, preferences)
        self.table = parts_table(self.model)
        self.note, self.energy, self.message = wrapped_label("muted"), wrapped_label(), wrapped_label()
        self.torques_title, self.matrix_note = _titled(""), wrapped_label("muted")
        self.equations = EquationsView(Typesetter(self))
        self._copy_buttons(session)
        self._make_masses(session, preferences)
        self._lay_out()

    # --- construction ----------------------------------------------------------------------------------------------

    def _box(self, name: str, kind: Kind, title: str, value: float) -> QuantityBox:
        box = QuantityBox(kind, self._preferences, title)
        box.setObjectName(name)
        box.set_range(0.0, 1e4)
        box.set_quantity(value)
        box.refused.connect(self._complain)
        return box

    def _copy_buttons(self, session: Session) -> None:
        makers = {"text": self._as_text, "NumPy": self._as_numpy, "LaTeX": self._as_latex}
        self.copy = CopyButton("dynamics_copy", tr("the joint torques"), makers, session)
        matrix = {"text": matrix_text, "NumPy": matrix_numpy, "LaTeX": matrix_latex}
        of_matrix = {name: (lambda make=make: make(self._M)) for name, make in matrix.items()}
        self.copy_matrix = CopyButton("mass_matrix_copy", tr("the mass matrix"), of_matrix, session)

    def _make_masses(self, session: Session, preferences: Preferences) -> None:
        self.masses = MassModel(session.robot, preferences)
        self.masses.edited.connect(lambda link, key, value: self.edit_mass(link, cast(MassKey, key), value))
        self.masses.refused.connect(self._complain)
        self.centers = mass_table("mass_table", tr("Masses and their centres"), self.masses, CENTER_COLUMNS)
        self.inertias = mass_table("inertia_table", tr("Moments of inertia"), self.masses, INERTIA_COLUMNS)
        self.mass_note = wrapped_label("muted")
        self.guess = button(
            "guess_masses", tr("Start with 1 kg a link"), tr("Give each link 1 kg, half-way along it"), self._guess
        )
        self.missing = wrapped_label()
        self.missing.setObjectName("no_mass_data")

    def _lay_out(self) -> None:
        set_role(self.message, level="warning")
        self.message.hide()
        self.energy.setObjectName("energies")
        self.known = QWidget()  # what needs masses
        known = QVBoxLayout(self.known)
        known.setContentsMargins(0, 0, 0, 0)
        known.setSpacing(6)
        known.addLayout(beside(_titled(tr("Motion")), self.at_rest))
        known.addWidget(self.rates)
        known.addWidget(self.note)
        known.addLayout(self._surroundings())
        known.addLayout(beside(self.torques_title, self.copy))
        for widget in (self.table, self.energy):
            known.addWidget(widget)
        known.addLayout(beside(_titled(tr("Mass matrix")), self.copy_matrix))
        known.addWidget(self.equations)
        known.addWidget(self.matrix_note)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        for shown in (self.missing, self.guess, self.known, self.message, _titled(tr("Masses of the links"))):
            column.addWidget(shown)
        for shown in (self.centers, self.inertias, self.mass_note):
            column.addWidget(shown)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    def _surroundings(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(6)
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(2, 1)
        rows: tuple[tuple[str, tuple[QWidget, ...]], ...] = (
            (tr("Gravity"), (self.gravity, self.place)),
            (tr("Payload"), (self.payload,)),
        )
        for row, (text, widgets) in enumerate(rows):
            grid.addWidget(QLabel(text), row, 0)
            for column, widget in enumerate(widgets, start=1):
                grid.addWidget(widget, row, column)
        return grid

    # --- showing ---------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The payload counts too."""
        return super().concerns(before, after) or after.load is not before.load

    def refresh(self) -> None:
        """Show the dynamics of the present moment."""
        robot, q = self._session.robot, self._session.q
        if robot is not self._robot:
            self._take_robot(robot)
        self.message.hide()
        for table in (self.table, self.centers, self.inertias):
            _fit(table)
        if not robot.masses:
            self.draw(())
            return
        qd, qdd = self._rates_now(q)
        self._show_torques(robot, q, qd, qdd)
        select(self.place, next((name for name in PLACES if _is_near(float(name), self.gravity.quantity)), _FREE))
        self.draw(weight_items(robot, q, self._stage.palette))

    def _show_torques(self, robot: Robot, q: FloatArray, qd: FloatArray, qdd: FloatArray) -> None:
        g, carried = self.gravity.quantity, self._session.experiment.load.payload
        self.payload.set_quantity(carried)
        parts = dynamics_parts(robot, q, qd, qdd, gravity=g, payload=carried)
        self.model.show_values(robot, np.stack([*parts, parts.total], axis=-1))
        kinetic = float(kinetic_energy(robot, q, qd, payload=carried))
        potential = float(potential_energy(robot, q, gravity=g, payload=carried))
        power = float(parts.total @ qd)
        self.energy.setText(energy_text(kinetic, potential, power, self._preferences))
        self._M = mass_matrix(robot, q, payload=carried)
        self.equations.show_equations([matrix_equation(self._M, matrix_decimals(robot))])

    def _take_robot(self, robot: Robot) -> None:
        before, self._robot = self._robot, robot
        if before is None or before.joint_types != robot.joint_types or before.joint_names != robot.joint_names:
            self._typed = (np.zeros(robot.dof), np.zeros(robot.dof))
            self.rates.show_robot(robot)
        self.known.setVisible(bool(robot.masses))
        self.guess.setVisible(not robot.masses)
        self.missing.setVisible(not robot.masses)
        self.missing.setText(no_mass_text(robot))
        self.mass_note.setText(mass_note(robot))
        self.masses.show_robot(robot)
        if robot.masses:
            self.model.show_values(robot, np.zeros((robot.dof, len(PARTS))))
            self.torques_title.setText(torques_title(self.model.units()))
            self.matrix_note.setText(matrix_note(robot))

    def _rates_now(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Those of the motion where it is what is shown, else those that have been typed."""
        moving = self._moving(q)
        qd, qdd = moving if moving is not None else self._typed
        self.rates.show_rates(qd, qdd, typed=moving is None)
        self.at_rest.setEnabled(moving is None)
        self.note.setText(rates_note(self._motion.player.time if moving is not None else None))
        return qd, qdd

    def _moving(self, q: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        player = self._motion.player
        if player.state not in ("playing", "paused") or not isinstance(player.trajectory, Trajectory):
            return None
        moment = player.trajectory.at(player.time)
        return (moment.qd, moment.qdd) if np.allclose(moment.q, q, atol=1e-9) else None

    # --- what is asked ---------------------------------------------------------------------------------------------

    def _on_rates(self) -> None:
        self._typed = self.rates.values
        self.refresh()

    def _rest(self) -> None:
        self._typed = (np.zeros(self._session.robot.dof), np.zeros(self._session.robot.dof))
        self.refresh()

    def _take_place(self) -> None:
        if self.place.currentData() != _FREE:
            self.gravity.set_quantity(float(self.place.currentData()))
            self.refresh()

    def _take_payload(self, mass: float) -> None:
        experiment = self._session.experiment
        load = replace(experiment.load, payload=mass)
        self._session.edit(tr("Set the payload"), experiment.with_load(load), merge="load payload")

    def _complain(self, sentence: str) -> None:
        self.message.setText(sentence)
        self.message.setVisible(bool(sentence))

    # --- masses ----------------------------------------------------------------------------------------------------

    def edit_mass(self, link: int, key: MassKey, value: float) -> None:
        """Put an SI value into the mass data of the user's own copy, undoably."""
        try:
            robot = with_mass_value(own_copy(self._session.robot), link, key, value)
        except RobotDefinitionError as problem:
            self._complain(str(problem))
            return
        self._use(robot, tr("Edit the mass data of {robot}", robot=tr(robot.title)))

    def _guess(self) -> None:
        robot = with_guessed_masses(own_copy(self._session.robot))
        self._use(robot, tr("Give {robot} masses", robot=tr(robot.title)))

    def _use(self, robot: Robot, text: str) -> None:
        self._session.edit(text, self._session.experiment.with_robot(robot))

    # --- copying ---------------------------------------------------------------------------------------------------

    def _head(self) -> str:
        robot = self._session.robot
        units = ", ".join(f"{name} [{unit}]" for name, unit in zip(robot.joint_names, self.model.units(), strict=True))
        return f"{robot.title}: gravity, Coriolis, inertia, sum of {units}"

    def _as_text(self) -> str:
        joints = zip(self._session.robot.joint_names, self.model.values.tolist(), strict=True)
        header = [self._head(), "gravity", "Coriolis", "inertia", "sum"]
        return table_tsv(header, ([name, *row] for name, row in joints))

    def _as_numpy(self) -> str:
        return f"# {self._head()}\n{matrix_numpy(self.model.values)}"

    def _as_latex(self) -> str:
        return f"% {self._head()}\n{matrix_latex(self.model.values)}"


def _is_near(one: float, other: float) -> bool:
    return abs(one - other) < 1e-9


def _fit(table: QTableView) -> None:
    fit_height(table)
    table.setMinimumHeight(table.maximumHeight())


def _titled(text: str) -> QLabel:
    label = QLabel(text)
    set_role(label, role="title")
    return label
