"""The transforms of the DH table: each A_i with its formula and numbers, and the running product 0T_i."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from rvsim.gui.matrix_view import MatrixView
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.shown import ReadOutPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_quantity, length_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, column_of, scrolled
from rvsim.kinematics import joint_transforms, link_transforms
from rvsim.lab.texts import matrix_latex, matrix_numpy, matrix_text
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Convention, Robot
from rvsim.robot.arrays import FloatArray

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉⁰·", "01234567890*")
# Each factor of A: its name, the DH value it is made of, and that value's letter.
_FACTORS: Mapping[Convention, tuple[tuple[str, int, str], ...]] = {
    "standard": (("Rz", 0, "θ"), ("Tz", 1, "d"), ("Tx", 2, "a"), ("Rx", 3, "α")),
    "modified": (("Rx", 3, "α"), ("Tx", 2, "a"), ("Tz", 1, "d"), ("Rz", 0, "θ")),
}
CONVENTIONS: Mapping[Convention, str] = {
    "standard": tr_later("standard DH: A = Rz · Tz · Tx · Rx"),
    "modified": tr_later("modified DH (Craig): A = Rx · Tx · Tz · Rz, with a and α of the link before"),
}


def subscript(number: int) -> str:
    """12 as ₁₂."""
    return str(number).translate(_SUBSCRIPTS)


def plain_digits(text: str) -> str:
    """A₃ · A₄ as A3 * A4, for copies."""
    return text.translate(_PLAIN)


def link_formula(convention: Convention, joint: int) -> str:
    """A of joint `joint` (from 1) as a product, for instance A₃ = Rz(θ₃) · Tz(d₃) · Tx(a₃) · Rx(α₃)."""
    factors = (
        f"{name}({letter}{subscript(joint - 1 if convention == 'modified' and value > 1 else joint)})"
        for name, value, letter in _FACTORS[convention]
    )
    return f"A{subscript(joint)} = {' · '.join(factors)}"


def link_numbers(robot: Robot, joint: int, q: float, preferences: Preferences) -> str:
    """The same product with the numbers of the present pose put in."""
    row = np.array(robot.dh[joint - 1])
    row[0 if robot.joints[joint - 1].revolute else 1] += q
    length = length_kind(robot)
    factors = (
        f"{name}({format_quantity(float(row[value]), length if value in (1, 2) else 'angle', preferences)})"
        for name, value, _ in _FACTORS[robot.convention]
    )
    return f"= {' · '.join(factors)}"


class TransformSection(QWidget):
    """A titled matrix with a Copy button, and lines of explanation below it."""

    def __init__(self, name: str, title: str, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self._matrix: FloatArray = np.eye(4)
        self._name = ""  # as copies have it
        self.title, self.formula, self.note = ElidedLabel(), QLabel(), QLabel()
        self.view = MatrixView(preferences, title)
        self.view.setObjectName(f"{name}_matrix")
        self.formula.setObjectName(f"{name}_formula")
        self.note.setObjectName(f"{name}_note")
        makers = {tr_later("text"): matrix_text, "NumPy": matrix_numpy, "LaTeX": matrix_latex}
        formats = {
            label: (lambda make=make, label=label: self._copied(make(self._shown()), label))
            for label, make in makers.items()
        }
        self.copy = CopyButton(f"{name}_copy", title, formats, session)
        self._lay_out()

    def _lay_out(self) -> None:
        set_role(self.title, role="title")
        set_role(self.note, role="muted")
        for label in (self.formula, self.note):
            label.setWordWrap(True)
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        head = QHBoxLayout()
        head.addWidget(self.title, 1)
        head.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addLayout(head)
        column.addWidget(self.view)
        column.addWidget(self.formula)
        column.addWidget(self.note)

    def show_transform(
        self, title: str, matrix: FloatArray, formula: str = "", note: str = "", *, name: str = ""
    ) -> None:
        """Show a transform (4, 4) [m] under its title, with its formula and a note.

        Args:
            title, note: English.
            name: of a joint, behind the title; English.
        """
        self._matrix, self._name = matrix, f"{title}  {name}".rstrip()
        self.view.show_matrix(matrix, length_kind(self._session.robot))
        shown = f"{tr(title)}  {tr(name)}".rstrip()
        for label, text in ((self.title, shown), (self.formula, formula), (self.note, tr(note))):
            if label.text() != text:
                label.setText(text)
                label.setVisible(bool(text))

    def _shown(self) -> FloatArray:
        """The matrix in the unit that is shown, in full precision."""
        scaled = np.array(self._matrix)
        scaled[:3, 3] *= display(length_kind(self._session.robot), self._preferences).factor
        return scaled

    def _copied(self, text: str, label: str) -> str:
        """With a line that says the unit, commented out as the format wants it."""
        unit = display(length_kind(self._session.robot), self._preferences).suffix.strip()
        mark = {"NumPy": "# ", "LaTeX": "% "}.get(label, "")
        return f"{mark}{plain_digits(self._name)}, lengths in {unit}\n{text}"


class MatricesPanel(ReadOutPanel):
    """Steps through the joints: A_i above, the product up to it below. Left and right arrows step as well."""

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self.setObjectName("matrices_panel")
        self._robot: Robot | None = None
        self._steps = QButtonGroup(self)
        self._steps.idClicked.connect(lambda _step: self.refresh())
        self._row = QHBoxLayout()
        self._row.setSpacing(2)
        self._row_around = QWidget()
        self._row_around.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # as they stand in the product
        self._row_around.setLayout(self._row)
        self._row.setContentsMargins(0, 0, 0, 0)
        self.link = TransformSection("link", tr("link transform"), session, preferences)
        self.product = TransformSection("product", tr("running product"), session, preferences)
        self._lay_out()
        for key, by in (("Left", -1), ("Right", 1)):
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setContext(shortcut.context().WidgetWithChildrenShortcut)
            shortcut.activated.connect(lambda by=by: self.step(by))

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(16)
        column.addWidget(self._row_around)
        column.addWidget(self.link)
        column.addWidget(self.product)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    @property
    def chosen(self) -> int:
        """What is shown: 0 the base, i the joint i, dof + 1 the tool."""
        return self._steps.checkedId()

    def choose(self, step: int) -> None:
        """Show another step."""
        self._steps.button(step).setChecked(True)
        self.refresh()

    def step(self, by: int) -> None:
        """Go to a neighbour, if there is one."""
        if self._steps.button(self.chosen + by) is not None:
            self.choose(self.chosen + by)

    def refresh(self) -> None:
        """Show the chosen transforms of the present pose."""
        robot, q = self._session.robot, self._session.q
        if self._robot is not robot:
            self._offer(robot)
        step = self.chosen
        products = link_transforms(robot, q)
        if step == robot.dof + 1:
            self._show_tool(robot, products[-1])
        elif step == 0:
            self.link.show_transform(tr_later("⁰T base, where the first frame stands"), robot.T_base_0)
            self.product.show_transform(tr_later("Running product"), products[0])
        else:
            self._show_joint(robot, step, joint_transforms(robot, q)[step - 1], products[step])

    def _show_joint(self, robot: Robot, joint: int, A: FloatArray, T: FloatArray) -> None:
        numbers = link_numbers(robot, joint, float(self._session.q[joint - 1]), self._preferences)
        formula = "\n".join(map(left_to_right, (link_formula(robot.convention, joint), numbers)))
        name, note = robot.joint_names[joint - 1], CONVENTIONS[robot.convention]
        self.link.show_transform(f"A{subscript(joint)}", A, formula, note, name=name)
        product = " · ".join(f"A{subscript(i)}" for i in range(1, joint + 1))
        based = "T base · " if self._steps.button(0) is not None else ""
        self.product.show_transform(f"⁰T{subscript(joint)} = {based}{product}", T)

    def _show_tool(self, robot: Robot, flange: FloatArray) -> None:
        self.link.show_transform(tr_later("T tool, from the flange"), robot.T_flange_tool, tr(robot.tool.title))
        self.product.show_transform(f"⁰T tool = ⁰T{subscript(robot.dof)} · T tool", flange @ robot.T_flange_tool)

    def _offer(self, robot: Robot) -> None:
        """One button a step; the same step stays chosen where the new arm has it."""
        kept = self.chosen if self._robot is not None else robot.dof
        self._robot = robot
        based = not np.array_equal(robot.T_base_0, np.eye(4))
        wanted = [*([0] if based else []), *range(1, robot.dof + 2)]
        if [self._steps.id(button) for button in self._steps.buttons()] != wanted:
            self._clear_steps()
            for step in wanted:
                self._row.addWidget(self._step_button(step, robot))
            self._row.addStretch(1)
        self._steps.button(min(max(kept, wanted[0]), wanted[-1])).setChecked(True)

    def _step_button(self, step: int, robot: Robot) -> QToolButton:
        text = {0: tr("base"), robot.dof + 1: tr("tool")}.get(step, f"A{subscript(step)}")
        button = QToolButton()
        button.setText(text)
        button.setCheckable(True)
        button.setObjectName(f"matrix_step_{step}")
        name = tr("joint {number}", number=step) if 0 < step <= robot.dof else text
        button.setAccessibleName(tr("Transform of {frame}", frame=name))
        button.setToolTip(tr("Show the transform of {frame} (left and right arrows step)", frame=name))
        self._steps.addButton(button, step)
        return button

    def _clear_steps(self) -> None:
        for button in self._steps.buttons():
            self._steps.removeButton(button)
            button.deleteLater()
        while self._row.count():
            self._row.takeAt(0)
