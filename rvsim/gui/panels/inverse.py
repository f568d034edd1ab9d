"""The Inverse panel: the wanted pose, every branch that gives it, and why not where there is none."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QCheckBox, QFrame, QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.gui.branch_words import singular_words
from rvsim.gui.orientations import MATRIX, NOTATIONS
from rvsim.gui.panels.folding_row import FoldingRow, group_of
from rvsim.gui.panels.inverse_matrix import MatrixDialog
from rvsim.gui.panels.inverse_order import OrderButton
from rvsim.gui.panels.inverse_table import BranchModel, BranchTable, Row
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.panels.orientation_boxes import OrientationBoxes
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, Kind, display, format_quantity, format_scientific, length_kind
from rvsim.gui.target import TargetControl, Wish
from rvsim.gui.target_scene import PANEL
from rvsim.gui.target_solution import CLOSED_FORM, PLACES, SOLVER_TITLES, TASK_TITLES, Answer, NearestPose
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, combo, form, scrolled, select
from rvsim.language import tr, tr_later, trn
from rvsim.robot.arrays import FloatArray

_AXES = ("x", "y", "z")
_HINT = tr_later("Point at a branch to see its ghost; click it, or press Enter, to go there.")
_FREE = tr_later(
    "What is wanted is the place alone: the orientation is free, and the tool takes whichever comes of it."
)
_PASTE_PLACE = tr_later("Three numbers can be pasted or typed into any of the boxes.")
_NEAREST = {  # by whether the orientation counts, and the limits: the sentence above tells of the place alone
    (True, True): tr_later("Nearest pose (with the orientation and the limits): {place} away, turned by {turn}."),
    (True, False): tr_later("Nearest pose (with the orientation): {place} away, turned by {turn}."),
    (False, True): tr_later("Nearest (within the limits): {place} away, turned by {turn}."),
    (False, False): tr_later("Nearest: {place} away, turned by {turn}."),
}
_SOUGHT = {False: tr_later("Looking for the nearest pose…"), True: tr_later("The nearest pose is looked for at rest.")}
_UNITS = ("angle_unit", "length_unit", "extra_decimals")


class TargetSection(QWidget):
    """The wanted pose in boxes, what of it counts, and who solves."""

    def __init__(self, control: TargetControl, preferences: Preferences) -> None:
        super().__init__()
        self._control, self._preferences = control, preferences
        self.position = NumberRow("target", _AXES, ("length",) * 3, preferences, tr("Target"), _PASTE_PLACE)
        self.angles = OrientationBoxes("target", tr("Target"), preferences)
        self.position.edited.connect(lambda index: self._want(control.T[:3, :3], _AXES[index]))
        self.angles.turned.connect(self._want)
        self.angles.told.connect(control.session.say)
        for boxes in (self.position, self.angles):
            boxes.refused.connect(control.session.warn)
            boxes.finished.connect(control.session.end_stroke)
        titles = {name: notation.title for name, notation in NOTATIONS.items()}
        self.notation = combo("target_notation_selector", tr("Notation of the orientation"), titles)
        self.notation.activated.connect(lambda _: preferences.set("orientation", self.notation.currentData()))
        self.task = combo("ik_task_selector", tr("What of the pose counts"))
        self.task.activated.connect(lambda _: control.set_task(self.task.currentData()))
        self.solver = combo("ik_solver_selector", tr("Who solves"))
        self.solver.activated.connect(lambda _: control.set_solver(self.solver.currentData()))
        tip = tr("Read a 4 × 4 matrix, or 3 × 3 and a position, from the clipboard or from what you type")
        self.paste = button("paste_matrix_button", tr("Paste…"), tip, self.ask_matrix)
        self.at_tool = button(
            "target_at_tool_button", tr("To the tool"), tr("Take the tool's own pose"), control.target_at_tool
        )
        self._lay_out()
        self.show_offer()
        self.show_notation()

    def _lay_out(self) -> None:
        rows = form()
        rows.setContentsMargins(0, 0, 0, 0)
        rows.addRow(tr("Wanted"), self.task)
        rows.addRow(tr("Solver"), self.solver)
        ways = group_of(self.paste, self.at_tool, stretched=False)
        tools = FoldingRow(group_of(self.notation, stretched=True), ways, 6)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addLayout(rows)
        column.addWidget(self.position)
        column.addWidget(tools)
        column.addWidget(self.angles)

    def show_offer(self) -> None:
        """What this arm offers."""
        control, offer = self._control, self._control.offer
        for box, titles, names, chosen in (
            (self.task, TASK_TITLES, offer.tasks, control.task),
            (self.solver, SOLVER_TITLES, offer.solvers, control.solver),
        ):
            with QSignalBlocker(box):
                box.clear()
                for name in names:
                    box.addItem(tr(titles.get(name, name)), name)
            select(box, chosen)
        self.solver.setToolTip(
            offer.no_closed_form or tr("A closed form gives every branch; the others iterate to one")
        )
        kind = length_kind(control.session.robot)
        for number in self.position.boxes:
            number.set_kind(kind)

    def show_target(self, T: FloatArray) -> None:
        """Show a target (4, 4)."""
        self.angles.set_free(tr(_FREE) if self._control.task in PLACES else "")
        self.position.show_values(T[:3, 3])
        self.angles.show_rotation(T[:3, :3])

    def show_notation(self) -> None:
        """The notation of the preferences; a matrix is no row of boxes, it is pasted."""
        name = self._preferences["orientation"]
        shown = "rpy" if name == MATRIX else name
        select(self.notation, shown)
        self.notation.setToolTip(f"{tr('Notation of the orientation')}. {tr(NOTATIONS[shown].convention)}")
        self.angles.show_notation(shown)

    def _want(self, R: FloatArray, name: str) -> None:
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = R, self.position.values
        self._control.set_target(Wish(T, tr("Target {coordinate}", coordinate=tr(name)), f"target {name}"))

    def ask_matrix(self) -> None:
        """Ask for a matrix."""
        shown = display(length_kind(self._control.session.robot), self._preferences)
        dialog = MatrixDialog(self._control.T, shown.factor, shown.suffix.strip(), self)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.taken.connect(lambda T: self._control.set_target(Wish(T, tr("Paste a target"), "")))
        dialog.open()


class WhyNot(QFrame):
    """One sentence that says why the arm cannot, and the nearest pose that it can."""

    def __init__(self, control: TargetControl, preferences: Preferences) -> None:
        super().__init__()
        self._control, self._preferences = control, preferences
        self.setObjectName("why_not")
        self.sentence = QLabel(wordWrap=True)
        self.sentence.setObjectName("why_not_sentence")
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.sentence.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        self.left = QLabel(wordWrap=True)
        self.left.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        set_role(self.left, role="muted")
        tip = tr("Go to the nearest pose within the limits, and make it the target")
        self.accept = button("accept_nearest_button", tr("Accept nearest"), tip, control.accept_nearest)
        row = QHBoxLayout()
        row.addWidget(self.left, 1)
        row.addWidget(self.accept)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 2, 0, 2)
        column.setSpacing(6)
        column.addWidget(self.sentence)
        column.addLayout(row)

    def show_answer(self, answer: Answer) -> None:
        """Why not; or what to know although it can."""
        control, nearest = self._control, self._control.nearest
        singular = "" if answer.missed else singular_words(answer.question.robot, control.session.q)
        text = control.sentence or singular
        self.sentence.setText(text)
        set_role(self.sentence, level="error" if answer.missed else "warning")
        self.setVisible(bool(text))
        self.accept.setVisible(answer.missed)
        self.accept.setEnabled(nearest is not None)
        self.left.setVisible(answer.missed)
        self.left.setText(tr(_SOUGHT[answer.hurried]) if nearest is None else self._left(answer, nearest))

    def _left(self, answer: Answer, nearest: NearestPose) -> str:
        place = format_quantity(nearest.position_error, length_kind(self._control.session.robot), self._preferences)
        turn = format_quantity(nearest.rotation_error, "angle", self._preferences)
        counts = not answer.question.place_only, not answer.question.ignore_limits
        return tr(_NEAREST[counts], place=place, turn=turn)


class InversePanel(QWidget):
    """Target, branches, why not. `shown(on)` tells that the panel has come or gone."""

    shown = Signal(bool)

    def __init__(self, control: TargetControl, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("inverse_panel")
        self._control, self._preferences = control, preferences
        self.target = TargetSection(control, preferences)
        self.why_not = WhyNot(control, preferences)
        self.model = BranchModel(control.session.robot, preferences, self)
        self.table = BranchTable(self.model)
        self.detail = QLabel(wordWrap=True)
        self.detail.setObjectName("branch_detail")
        self.order = OrderButton(control.order)
        tip = tr("Go to the best branch, by the order below")
        self.solve = button("solve_button", tr("Solve"), tip, control.solve_now, primary=True)
        self.follow = self._switch(
            "arm_follows", tr("Arm follows"), tr("The arm follows each change at once; off: press Solve")
        )
        self.ghosts = self._switch(
            "all_ghosts", tr("All ghosts"), tr("Every branch as a ghost; off: the one under the pointer")
        )
        self._lay_out()
        self._connect()

    def _switch(self, preference: str, text: str, tip: str) -> QCheckBox:
        box = QCheckBox(text)
        box.setObjectName(f"{preference}_switch")
        box.setToolTip(tip)
        box.setChecked(self._preferences[preference])
        box.toggled.connect(lambda on: self._preferences.set(preference, on))
        return box

    def _lay_out(self) -> None:
        ghosts = group_of(self.ghosts, stretched=False)
        buttons = FoldingRow(group_of(self.solve, self.follow, stretched=False), ghosts, 12)
        self.table.setMinimumHeight(120)
        self.detail.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.detail.setAlignment(Qt.AlignmentFlag.AlignTop)
        set_role(self.detail, role="muted")
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 8)
        column.setSpacing(6)
        column.addWidget(self.target)
        column.addWidget(buttons)
        column.addWidget(self.why_not)
        column.addWidget(self.table, 1)
        column.addWidget(self.detail)
        column.addWidget(self.order)
        column_of(self, scrolled(inside))

    def _connect(self) -> None:
        control = self._control
        control.changed.connect(self._show)
        control.lit_changed.connect(self._show_detail)
        control.offer_changed.connect(self._show_robot)
        self.table.lit.connect(control.light)
        self.table.chosen.connect(lambda row: control.go_to(row.branch))
        self.order.order_changed.connect(lambda order: self._preferences.set("branch_order", ", ".join(order)))
        self._preferences.changed.connect(self._on_preference)
        self._show_robot()

    # --- showing ---------------------------------------------------------------------------------------------------

    def _show_robot(self) -> None:
        self.target.show_offer()
        self.model.show_robot(self._control.session.robot)

    def _show(self) -> None:
        answer = self._control.answer
        if answer is None or not self._control.is_watched_by(PANEL):
            return
        self.target.show_target(self._control.T)
        self.model.show_rows(self._rows(answer))
        self.why_not.show_answer(answer)
        self._show_detail()

    def _rows(self, answer: Answer) -> tuple[Row, ...]:
        usable = set(map(id, answer.usable))
        note = _numeric_note(answer, self._preferences)
        return tuple(
            Row(self._control.name_of(branch), branch, id(branch) in usable, note) for branch in answer.branches
        )

    def _show_detail(self) -> None:
        hint = tr(_HINT) if self.model.rows else ""
        self.detail.setText(self.model.words_of(self._control.lit) or hint)

    def _on_preference(self, name: str) -> None:
        for preference, switch in (("arm_follows", self.follow), ("all_ghosts", self.ghosts)):
            if name == preference:
                switch.setChecked(self._preferences[preference])
        if name == "orientation":
            self.target.show_notation()
        if name in _UNITS:
            self._show_robot()
            self._show()

    def set_seen(self, seen: bool) -> None:
        """Whether the panel can be seen: a dock behind another one counts as shown for Qt, but not for the eye."""
        if seen == self._control.is_watched_by(PANEL):
            return
        self._control.light(None)
        self._control.watch(PANEL, seen)
        self._show()
        self.shown.emit(seen)

    def showEvent(self, event: QShowEvent) -> None:
        """Somebody watches: solve."""
        super().showEvent(event)
        self.set_seen(True)

    def hideEvent(self, event: QHideEvent) -> None:
        """Nobody watches any more."""
        super().hideEvent(event)
        self.set_seen(False)


def _numeric_note(answer: Answer, preferences: Preferences) -> str:
    """How the numeric solver came to its row."""
    found = answer.numeric
    if answer.question.solver == CLOSED_FORM or found is None:
        return ""
    errors: tuple[tuple[float, Kind], ...] = (
        (found.position_error, length_kind(answer.question.robot)),
        (found.rotation_error, "angle"),
    )
    words = tr(", ").join(_error(value, display(kind, preferences)) for value, kind in errors)
    effort = trn(
        "{n} iteration, {time:.1f} ms, errors {errors}.",
        "{n} iterations, {time:.1f} ms, errors {errors}.",
        found.iterations,
        time=1e3 * found.elapsed,
        errors=words,
    )
    return f"{effort} {found.reason}"


def _error(value: float, shown: Display) -> str:
    return f"{format_scientific(value * shown.factor)}{shown.suffix}"
