"""The acceleration section: joint accelerations for one of the tool, and the part J̇ q̇ that the speeds make alone."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_jacobian_words import column_vector
from rvsim.gui.panels.inspect_velocity_rows import ACCELERATIONS, JointRows
from rvsim.gui.panels.inspect_velocity_twist import TwistBoxes, in_axes
from rvsim.gui.panels.inspect_velocity_words import acceleration_kinds, damping_line, rank_test, verdict
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.rates import joint_accelerations, tool_acceleration
from rvsim.lab.worked import Equation
from rvsim.language import tr
from rvsim.motion.jog_course import Axes
from rvsim.robot.arrays import FloatArray


class AccelerationSection(QWidget):
    """Closed at first: its title opens it."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self._wish: FloatArray = np.zeros(6)
        self._qd: FloatArray = np.zeros(0)
        self._frame: Axes = "base"
        self.title = QToolButton()
        self.title.setObjectName("acceleration_title")
        self.title.setText(tr("▸ Accelerations"))
        self.title.setCheckable(True)
        self.title.setToolTip(tr("Joint accelerations for a wished acceleration of the tool at these speeds"))
        self.title.toggled.connect(self._open)
        self.twist = TwistBoxes("acceleration", ("a", "α"), preferences)
        self.twist.edited.connect(self._on_wish)
        self.drift, self.drift_words, self.verdict = (
            EquationsView(Typesetter(self)),
            wrapped_label("muted"),
            wrapped_label(),
        )
        self.drift.setObjectName("acceleration_drift")
        self.verdict.setObjectName("acceleration_verdict")
        self.rows = JointRows(ACCELERATIONS, preferences)
        self.rows.set_editable(False)
        self.assumed = wrapped_label("muted")
        self.assumed.setText(tr("* assumed: no source gives this most."))
        self._inside = QWidget()
        column = QVBoxLayout(self._inside)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        inner: tuple[QWidget, ...] = (self.twist, self.verdict, self.drift, self.drift_words, self.rows, self.assumed)
        for widget in inner:
            column.addWidget(widget)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 6, 0, 0)
        outer.addWidget(self.title)
        outer.addWidget(self._inside)
        self._inside.hide()

    def _open(self, opened: bool) -> None:
        self.title.setText(tr("▾ Accelerations") if opened else tr("▸ Accelerations"))
        self._inside.setVisible(opened)
        self._refresh()

    def show_at(self, qd: FloatArray, frame: Axes) -> None:
        """Show the accelerations at these joint speeds (n,)."""
        self._qd, self._frame = qd, frame
        self._refresh()

    def _refresh(self) -> None:
        robot, q = self._session.robot, self._session.q
        if not self.title.isChecked() or len(self._qd) != robot.dof:
            return
        T = forward_kinematics(robot, q)
        self.twist.take_kinds(acceleration_kinds(robot))
        self.twist.show_values(self._wish)
        drift = tool_acceleration(robot, q, self._qd, np.zeros(robot.dof))
        self.drift.show_equations(self._drift_equations(in_axes(drift, T, self._frame)))
        wished = in_axes(self._wish, T, self._frame, inverse=True)
        solution = joint_accelerations(robot, q, self._qd, wished)
        lost = in_axes(solution.lost, T, self._frame)
        self.twist.show_notes(None if solution.feasible else self._wish - lost)
        in_range = rank_test(robot, q, wished - drift).in_range
        text = verdict(robot, self._wish, solution, lost, in_range=in_range)
        self.verdict.setText(f"{text} {damping_line(solution.damping)}".strip())
        set_role(self.verdict, level="" if solution.feasible else "warning")
        self.rows.take_robot(robot)
        self.rows.show_values(solution.qdd)
        self.rows.set_editable(False)
        self.assumed.setVisible(self.rows.assumed)

    def _drift_equations(self, drift: FloatArray) -> tuple[Equation, ...]:
        """Its two halves in the units that are shown."""
        shown = [display(kind, self._preferences) for kind in acceleration_kinds(self._session.robot)]
        halves = [
            column_vector(part * unit.factor, unit.decimals)
            for part, unit in zip((drift[:3], drift[3:]), shown, strict=True)
        ]
        linear, angular = (unit.suffix.strip() for unit in shown)
        self.drift_words.setText(
            tr(
                "What the speeds alone make, in {linear} and {angular}; the joints make up for it.",
                linear=linear,
                angular=angular,
            )
        )
        return (Equation("\\dot{J}\\,\\dot{q}", "", "", "\\quad ".join(halves)),)

    def _on_wish(self, index: int, value: float) -> None:
        self._wish[index] = value
        self._refresh()
