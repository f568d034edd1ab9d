"""The list of an arm's singular families: name, condition, present value, and a button that goes there."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_singular_words import state_text, value_text
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, button
from rvsim.kinematics import SingularFamily
from rvsim.lab.worked import Equation
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_LEVELS = {"active": "error", "near": "warning", "": ""}
_SYMBOLS = {"active": tr_later("✖ active"), "near": tr_later("▲ near"), "": ""}


class FamilyRow(QWidget):
    """One family; `asked` when the arm shall go there."""

    asked = Signal()

    def __init__(self, family: SingularFamily, typesetter: Typesetter) -> None:
        super().__init__()
        self.family = family
        slug = family.name.replace(" ", "_")
        self.name, self.state, self.value = ElidedLabel(), QLabel(), ElidedLabel()
        self.name.setText(_head(family))
        self.name.setToolTip(family.sentence)
        self.state.setObjectName(f"singular_state_{slug}")
        self.value.setObjectName(f"singular_value_{slug}")
        self.formula = EquationsView(typesetter)
        self.formula.show_equations(_equations(family))
        self.formula.setToolTip(family.sentence)
        self.problem = wrapped_label("muted")
        self.problem.hide()
        self.go = button(
            f"singular_go_{slug}",
            tr("Take me there"),
            tr("Go to a near pose of this family. {sentence}", sentence=family.sentence),
            self.asked.emit,
        )
        self._lay_out()

    def _lay_out(self) -> None:
        set_role(self.name, role="title")
        set_role(self.value, role="muted")
        self.go.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        head, body, left = QHBoxLayout(), QHBoxLayout(), QVBoxLayout()
        head.addWidget(self.name, 1)
        head.addWidget(self.state)
        left.setSpacing(0)
        left.addWidget(self.formula)
        left.addWidget(self.value)
        body.addLayout(left, 1)
        body.addWidget(self.go)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(head)
        column.addLayout(body)
        column.addWidget(self.problem)

    def show_pose(self, q: FloatArray, active: bool, robot: Robot, preferences: Preferences) -> None:
        """Show how far q (n,) is from the family."""
        state = state_text(float(self.family.measure(q)), active)
        self.state.setText(tr(_SYMBOLS[state]))
        set_role(self.state, level=_LEVELS[state])
        self.value.setText(value_text(self.family, q, robot, preferences))

    def show_problem(self, text: str) -> None:
        """Say why one cannot go there; "" takes it back."""
        self.problem.setText(text)
        self.problem.setVisible(bool(text))


def _head(family: SingularFamily) -> str:
    if family.part == "position":
        return tr("{family}  ({kind}, place only)", family=family.heading, kind=family.kind_title)
    return tr("{family}  ({kind})", family=family.heading, kind=family.kind_title)


def _equations(family: SingularFamily) -> tuple[Equation, ...]:
    """Each term = 0; a term with a formula of its own as symbol = formula = 0."""
    lines = []
    for term in family.terms:
        left, _, formula = term.formula.partition(" = ")
        lines.append(Equation(left, formula, "", "0") if formula else Equation(left, "0", "", ""))
    return tuple(lines)


class FamilyList(QWidget):
    """All families of an arm; `asked(family)` when the arm shall go to one."""

    asked = Signal(object)

    def __init__(self, typesetter: Typesetter, preferences: Preferences) -> None:
        super().__init__()
        self._typesetter, self._preferences = typesetter, preferences
        self._families: tuple[SingularFamily, ...] | None = None
        self.rows: list[FamilyRow] = []
        self.note = wrapped_label("muted")
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(12)
        self._column.addWidget(self.note)

    def show_families(self, families: tuple[SingularFamily, ...], note: str) -> None:
        """Offer these; `note` is what is said above them."""
        self.note.setText(note)
        self.note.setVisible(bool(note))
        if families is self._families:
            return
        self._families = families
        for row in self.rows:
            self._column.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.rows = [FamilyRow(family, self._typesetter) for family in families]
        for row in self.rows:
            row.asked.connect(lambda family=row.family: self.asked.emit(family))
            self._column.addWidget(row)

    def show_pose(self, q: FloatArray, active: tuple[SingularFamily, ...], robot: Robot) -> None:
        """Show how far the pose is from each."""
        for row in self.rows:
            row.show_pose(q, row.family in active, robot, self._preferences)

    def show_problem(self, family: SingularFamily, text: str) -> None:
        """Say at its row why one cannot go there."""
        for row in self.rows:
            row.show_problem(text if row.family is family else "")
