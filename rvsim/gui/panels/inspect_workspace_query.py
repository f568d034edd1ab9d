"""Is a place in reach? Three boxes, and the answer of the closed form: in how many ways, or how far away and why."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, length_kind, shown_units
from rvsim.gui.session import Session
from rvsim.gui.target_solution import (
    CLOSED_FORM,
    PLACES,
    Answer,
    Question,
    immediate_sentence,
    nearest_pose,
    offer_of,
    solve,
)
from rvsim.gui.widgets import button
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.inverse import DEFAULT_ORDER
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_ASK = tr_later(
    "This is where the tool is. Type another place, or click one in the map, to ask whether it can be reached."
)
_IN_PLANE = tr_later("This arm moves in a plane, and the place lies outside of it.")
_OTHERWISE = tr_later(
    "Yes, with the tool turned otherwise than now: no branch of the closed form is within the limits, but a search "
    "among its neighbours finds joint values that are."
)
_SAME = 1e-6  # sizes of the arm: nearer is there


class PointQuery(QWidget):
    """The boxes follow the tool until a place is typed.

    Signals:
        asked(): another place has been typed.
        refused(sentence): why what was typed is no number.
    """

    asked = Signal()
    refused = Signal(str)

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self._robot: Robot | None = None
        self._typed = False
        self._question: tuple[object, ...] = ()
        title = wrapped_label("title")
        title.setText(tr("Is a place in reach?"))
        self.place = NumberRow("workspace_point", ("x", "y", "z"), ("length",) * 3, preferences, tr("Place"))
        self.place.edited.connect(lambda _: self._take())
        self.place.refused.connect(self.refused)
        tip = tr("Take the tool's own place")
        self.at_tool = button("workspace_point_at_tool", tr("At the tool"), tip, self._follow)
        self.answer = wrapped_label()
        self.answer.setObjectName("workspace_answer")
        head, column = QHBoxLayout(), QVBoxLayout(self)
        head.addWidget(title, 1)
        head.addWidget(self.at_tool)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addLayout(head)
        column.addWidget(self.place)
        column.addWidget(self.answer)

    def ask(self, point: FloatArray) -> None:
        """Ask for a place (3,) [m]."""
        self.place.show_values(point)
        self._take()

    def _take(self) -> None:
        self._typed = True
        self.asked.emit()

    def _follow(self) -> None:
        self._typed = False
        self.asked.emit()

    def refresh(self, *, held: bool, ignore_limits: bool) -> None:
        """Answer for the present arm; with the tool `held` in its orientation, or free to turn."""
        robot, q = self._session.robot, self._session.q
        T = forward_kinematics(robot, q)
        if robot is not self._robot:
            self._robot, self._typed = robot, False
            for box in self.place.boxes:
                box.set_kind(length_kind(robot))
        self.at_tool.setEnabled(self._typed)
        if not self._typed:
            self._question = ()
            self.place.show_values(T[:3, 3])
            self.answer.setText(tr(_ASK))
            return
        T[:3, 3] = self.place.values
        settings = (shown_units(self._preferences), self._preferences["extra_decimals"])
        asked = (robot, ignore_limits, held, *T[:3, 3], *settings, *(T[:3, :3].ravel() if held else ()))
        if asked != self._question:  # a place is as far away whatever the pose: not asked again while the arm moves
            self._question = asked
            self.answer.setText(self._answer(_question(robot, T, q, held, ignore_limits)))

    def _answer(self, question: Question) -> str:
        answer, units = solve(question), shown_units(self._preferences)
        if answer.usable:
            away = _left_over(answer)
            return _yes(answer) if away < _SAME * question.robot.size else self._no(question, away, tr(_IN_PLANE))
        nearest = nearest_pose(answer, units)
        if nearest.position_error < _SAME * question.robot.size and question.place_only:
            return tr(_OTHERWISE)
        return self._no(question, nearest.position_error, immediate_sentence(answer, units))

    def _no(self, question: Question, away: float, why: str) -> str:
        if away < _SAME * question.robot.size:
            return f"{tr('No.')} {why}"
        distance = format_quantity(away, length_kind(question.robot), self._preferences)
        return f"{tr('No: the tool comes no nearer than {distance}.', distance=distance)} {why}"


def _left_over(answer: Answer) -> float:
    """How far from the place [m] the best branch ends: of an arm in a plane it need not be there."""
    tip = forward_kinematics(answer.question.robot, answer.usable[0].q)[:3, 3]
    return float(np.linalg.norm(tip - answer.question.T[:3, 3]))


def _question(robot: Robot, T: FloatArray, q: FloatArray, held: bool, ignore_limits: bool) -> Question:
    offer = offer_of(robot)
    tasks = offer.tasks if held else [task for task in offer.tasks if task in PLACES] or offer.tasks
    solver = "lm" if offer.no_closed_form else CLOSED_FORM
    return Question(robot, T, tasks[0], solver, np.asarray(q), DEFAULT_ORDER, ignore_limits)


def _yes(answer: Answer) -> str:
    """In how many ways."""
    if answer.question.solver != CLOSED_FORM:
        return tr("Yes, found by Levenberg and Marquardt's method: this arm has no closed form to count its ways.")
    count, beyond = len(answer.usable), len(answer.branches) - len(answer.usable)
    if any(branch.continuum for branch in answer.usable):
        return _yes_endlessly(count, beyond)
    if not beyond:
        return trn("Yes: {n} branch.", "Yes: {n} branches.", count)
    return trn(
        "Yes: {n} branch within the limits, {beyond} beyond them.",
        "Yes: {n} branches within the limits, {beyond} beyond them.",
        count,
        beyond=beyond,
    )


def _yes_endlessly(count: int, beyond: int) -> str:
    """The same where a joint may take any value."""
    if not beyond:
        return trn(
            "Yes: {n} branch, each one of infinitely many ways to turn.",
            "Yes: {n} branches, each one of infinitely many ways to turn.",
            count,
        )
    return trn(
        "Yes: {n} branch within the limits, {beyond} beyond them, each one of infinitely many ways to turn.",
        "Yes: {n} branches within the limits, {beyond} beyond them, each one of infinitely many ways to turn.",
        count,
        beyond=beyond,
    )
