"""The Velocity page: from the tool's velocity to the joints' and back, accelerations, and jogging."""

from __future__ import annotations

from typing import Literal

import numpy as np
from PySide6.QtWidgets import QButtonGroup, QPushButton, QVBoxLayout, QWidget

from rvsim.gui.panels.folding_row import WrappedRow
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_velocity_acceleration import AccelerationSection
from rvsim.gui.panels.inspect_velocity_jog import JogPad
from rvsim.gui.panels.inspect_velocity_rows import SPEEDS, JointRows
from rvsim.gui.panels.inspect_velocity_twist import TwistBoxes, in_axes
from rvsim.gui.panels.inspect_velocity_words import (
    arrow_texts,
    damping_line,
    rank_test,
    speed_kinds,
    too_fast,
    verdict,
)
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import column_of, combo, scrolled
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.kinematics.rates import joint_rates
from rvsim.language import tr, tr_later
from rvsim.motion.jog import JogStep
from rvsim.motion.jog_course import Axes
from rvsim.robot.arrays import FloatArray
from rvsim.scene.velocity_arrows import velocity_items

Mode = Literal["tool", "joints", "jog"]
_MODES: dict[Mode, tuple[str, str]] = {
    "tool": (tr_later("Tool → joints"), tr_later("Type a velocity of the tool: which joint speeds make it?")),
    "joints": (tr_later("Joints → tool"), tr_later("Type joint speeds: how does the tool move?")),
    "jog": (tr_later("Jog"), tr_later("Hold a button or a key: the arm moves")),
}
_FIRST_WISH = 0.05  # [m/s] along z: the page has something to show at once


class VelocityPage(InspectPage):
    """Shows (v, ω) = J q̇ both ways round at the present pose."""

    title = tr_later("Velocity")
    name = "inspect_velocity"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._wish: FloatArray = np.array([0.0, 0.0, _FIRST_WISH, 0.0, 0.0, 0.0])  # in the axes that are chosen
        self._qd: FloatArray = np.zeros(0)  # as typed
        self._qd_now: FloatArray = np.zeros(0)  # as shown
        self._modes = QButtonGroup(self)
        self.axes = combo(
            "velocity_axes", tr("Axes of the tool's velocity"), {"base": tr("Base axes"), "tool": tr("Tool axes")}
        )
        self.axes.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        self.twist = TwistBoxes("velocity", ("v", "ω"), preferences)
        self.twist.edited.connect(self._on_wish)
        self.rows = JointRows(SPEEDS, preferences)
        self.rows.edited.connect(self._on_rate)
        self.verdict, self.test = wrapped_label(), wrapped_label("muted")
        self.damping, self.assumed = wrapped_label(), wrapped_label("muted")
        for label, part in ((self.verdict, "verdict"), (self.test, "rank_test"), (self.damping, "damping")):
            label.setObjectName(f"velocity_{part}")
        set_role(self.damping, level="warning")
        self.verdict.setToolTip(tr("Nearest: in least squares, with lengths counted in sizes of the arm."))
        self.assumed.setText(tr("* assumed: no source gives this top speed."))
        self.acceleration = AccelerationSection(session, preferences)
        self.pad = JogPad(session, preferences, lambda: self.frame)
        self.pad.moved.connect(self._on_jogged)
        self._lay_out()

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        column.addWidget(self._mode_row())
        column.addWidget(self.axes)
        column.addWidget(self.pad)
        parts: tuple[QWidget, ...] = (self.twist, self.verdict, self.test, self.damping, self.rows, self.assumed)
        for widget in parts:
            column.addWidget(widget)
        column.addWidget(self.acceleration)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    def _mode_row(self) -> WrappedRow:
        for number, (mode, (text, tip)) in enumerate(_MODES.items()):
            button = QPushButton(tr(text))
            button.setObjectName(f"velocity_mode_{mode}")
            button.setToolTip(tr(tip))
            button.setCheckable(True)
            button.setChecked(number == 0)
            self._modes.addButton(button, number)
        self._modes.idClicked.connect(lambda _: self._refresh_if_seen())
        return WrappedRow(self._modes.buttons(), 4)

    @property
    def mode(self) -> Mode:
        """Which way round."""
        return list(_MODES)[self._modes.checkedId()]

    @property
    def frame(self) -> Axes:
        """The axes of the tool's velocity."""
        frame: Axes = self.axes.currentData()
        return frame

    def choose(self, mode: Mode) -> None:
        """Go to another way round."""
        self._modes.button(list(_MODES).index(mode)).setChecked(True)
        self._refresh_if_seen()

    # --- showing ---------------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Work the present pose out anew."""
        robot = self._session.robot
        if len(self._qd) != robot.dof:
            self._qd = np.zeros(robot.dof)
        self.twist.take_kinds(speed_kinds(robot))
        self.rows.take_robot(robot)
        self.pad.take_robot(robot)
        self.pad.setVisible(self.mode == "jog")
        self.acceleration.setVisible(self.mode != "jog")
        self.assumed.setVisible(self.rows.assumed)
        self.twist.set_editable(self.mode == "tool")
        self.rows.set_editable(self.mode == "joints")
        {"tool": self._show_joints, "joints": self._show_tool, "jog": self._show_jog}[self.mode]()
        if self.mode != "jog":
            self.acceleration.show_at(self._qd_now, self.frame)

    def _show_joints(self) -> None:
        robot, q = self._session.robot, self._session.q
        T = forward_kinematics(robot, q)
        wished = in_axes(self._wish, T, self.frame, inverse=True)
        solution = joint_rates(robot, q, wished)
        lost = in_axes(solution.lost, T, self.frame)
        self.twist.show_values(self._wish)
        self.twist.show_notes(None if solution.feasible else self._wish - lost)
        test = rank_test(robot, q, wished)
        text = verdict(robot, self._wish, solution, lost, in_range=test.in_range)
        self._say(text, bad=not solution.feasible)
        self.test.setText(test.text)
        self._show_rates(solution.qd, damping_line(solution.damping))
        self._draw(T, wished, solution.achieved)

    def _show_tool(self) -> None:
        robot, q = self._session.robot, self._session.q
        T, achieved = forward_kinematics(robot, q), jacobian(robot, q) @ self._qd
        self.twist.show_values(in_axes(achieved, T, self.frame))
        self.twist.show_notes(None)
        self._say("")
        self.test.setText("")
        self._show_rates(self._qd, "")
        self._draw(T, achieved, achieved)

    def _show_jog(self, step: JogStep | None = None) -> None:
        """The speeds of the moment."""
        robot, q = self._session.robot, self._session.q
        T = forward_kinematics(robot, q)
        twist = np.zeros(6) if step is None else step.twist
        if step is None and self.pad.driver.running:
            return  # the step itself is on its way
        self.twist.show_values(in_axes(twist, T if step is None else self.pad.T_at_start, self.frame))
        self.twist.show_notes(None)
        self._say("")
        self.test.setText("")
        self._show_rates(np.zeros(robot.dof) if step is None else step.qd, "")
        self._draw(T, twist, twist)

    def _show_rates(self, qd: FloatArray, damped: str) -> None:
        self._qd_now = qd
        self.rows.show_values(qd)
        notes = [note for note in (damped, too_fast(self._session.robot, qd)) if note]
        self.damping.setText(" ".join(notes))
        for label in (self.damping, self.test, self.verdict):
            label.setVisible(bool(label.text()))

    def _say(self, text: str, *, bad: bool = False) -> None:
        self.verdict.setText(text)
        set_role(self.verdict, level="warning" if bad else "")

    def _draw(self, T: FloatArray, wished: FloatArray, achieved: FloatArray) -> None:
        robot = self._session.robot
        texts = arrow_texts(achieved, speed_kinds(robot), self._preferences)
        self.draw(velocity_items(T[:3, 3], wished, achieved, robot.size, texts, self._stage.palette))

    # --- edits -----------------------------------------------------------------------------------------------------

    def _on_wish(self, index: int, value: float) -> None:
        self._wish[index] = value
        self._refresh_if_seen()

    def _on_rate(self, joint: int, value: float) -> None:
        self._qd[joint] = value
        self._refresh_if_seen()

    def _on_jogged(self, step: JogStep) -> None:
        if self.seen and self.mode == "jog" and len(step.q) == self._session.robot.dof:
            self._show_jog(step)
