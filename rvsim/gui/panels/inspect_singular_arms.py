"""Blocks of the Singular page that belong to one kind of arm: source 000's minors and barriers for the RV-M1, the
factors of det J for a spherical wrist, figure 4.1 of source 004 for the planar arm."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QLabel, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_singular_widgets import NumberGrid
from rvsim.gui.panels.inspect_singular_words import small_number
from rvsim.gui.quantities import format_number
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.lab.singular_sources import MINORS, Barrier, barriers, minors, position_jacobian, wrist_split
from rvsim.lab.worked import Equation
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import original_name

MINOR_FORMULAS = tuple(f"{name} = {formula}" for name, _, formula in MINORS)
SPLIT_FORMULAS = (
    r"\det\,J_{11}",
    r"\det\,J_{22}",
    r"\det\,J_{11}\,\det\,J_{22}",
    r"\det\,J",
)
RV_1A_FACTORS = (
    Equation(r"\det\,J_{11}", r"a_2\,(a_3 s_3 - d_4 c_3)\,(a_2 c_2 + a_3 c_{23} + d_4 s_{23})", "", ""),
    Equation(r"\det\,J_{22}", r"-\sin q_5", "", ""),
)


class ArmBlock(QWidget):
    """A titled column; `go(q, title)` when the arm shall go to a pose."""

    go = Signal(object, str)
    changed = Signal()

    def __init__(self, title: str, text: str) -> None:
        super().__init__()
        self.title, self.text = wrapped_label("title"), wrapped_label("muted")
        self.title.setText(title)
        self.text.setText(text)
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 0, 0, 0)
        self.column.setSpacing(6)
        self.column.addWidget(self.title)
        self.column.addWidget(self.text)

    def show_pose(self, robot: Robot, q: FloatArray) -> None:
        """Show the numbers of a pose. For a block to fill in."""


class SourceBlock(ArmBlock):
    """What source 000 says of the RV-M1."""

    def __init__(self, typesetter: Typesetter) -> None:
        super().__init__(
            tr("What source 000 says"),
            tr(
                "It looks at the tip's place alone: Ĵ, (26) and (27), of joints 1 to 4, in its decimetres. Its θ₁ "
                "turns the other way round; all other entries are right. Below, its three minors, (28), worked out."
            ),
        )
        self._robot: Robot | None = None
        self._q: FloatArray = np.zeros(5)
        self.grid = NumberGrid(tr("Position Jacobian of source 000"))
        self.grid.setObjectName("singular_source_jacobian")
        self.minors = _Values(MINOR_FORMULAS, "singular_minor", typesetter)
        self.note = wrapped_label("muted")
        self.note.setText(
            tr(
                "All vanish where sin θ₃ = 0 and sin θ₄ = 0, its (29) and (30): right. They vanish at r = 0 too, the "
                "tip on the base axis: it forgets that. The poses that its procedure finds, with θ₄ as the joint has "
                "it, 90° less than there:"
            )
        )
        self.list = QVBoxLayout()
        self.list.setSpacing(10)
        self.column.insertWidget(2, self.grid)
        self.column.addWidget(self.minors)
        self.column.addWidget(self.note)
        self.column.addLayout(self.list)
        self.rows: list[BarrierRow] = []

    def show_pose(self, robot: Robot, q: FloatArray) -> None:
        """Ĵ, its minors, and the list of barriers."""
        self._q, J = q, position_jacobian(robot, q)
        self.grid.show_numbers(
            [[format_number(10.0 * float(v), 3) for v in row] for row in J], ("θ₁", "θ₂", "θ₃", "θ₄")
        )
        self.minors.show_values([1e3 * minor.value for minor in minors(robot, q)], " dm³")
        if robot is not self._robot:
            self._robot = robot
            self._list_barriers(barriers(robot, q))

    def _list_barriers(self, found: tuple[Barrier, ...]) -> None:
        for row in self.rows:
            self.list.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.rows = [BarrierRow(number, barrier) for number, barrier in enumerate(found, start=1)]
        for row in self.rows:
            row.asked.connect(self._go)
            self.list.addWidget(row)

    def _go(self, barrier: Barrier) -> None:
        """Joints 1 and 5 stay as they are now."""
        q = np.array(barrier.q)
        q[[0, 4]] = self._q[[0, 4]]
        self.go.emit(q, tr("Go to {pose}", pose=tr(barrier.title)))


class BarrierRow(QWidget):
    """One pose of the source's list, its verdict and the way there."""

    asked = Signal(object)

    def __init__(self, number: int, barrier: Barrier) -> None:
        super().__init__()
        printed = f"{barrier.printed}  " if barrier.printed else ""
        self.verdict = wrapped_label()
        self.verdict.setText(tr(barrier.verdict))
        self.verdict.setObjectName(f"singular_barrier_verdict_{number}")
        set_role(self.verdict, level="error" if barrier.singular else "")
        self.go = button(
            f"singular_barrier_{number}",
            f"{printed}{tr(barrier.title)}",
            tr("Go to this pose"),
            lambda: self.asked.emit(barrier),
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.go)
        column.addWidget(self.verdict)


class WristBlock(ArmBlock):
    """det J of an arm with a spherical wrist as a product."""

    def __init__(self, typesetter: Typesetter) -> None:
        super().__init__(
            tr("Arm and wrist apart"),
            tr(
                "Seen at the wrist centre, where axes 4, 5 and 6 meet, the wrist moves nothing: J has a block of "
                "zeros, and its determinant is a product (source 004, §4.2.1)."
            ),
        )
        self.values = _Values(SPLIT_FORMULAS, "singular_split", typesetter)
        self.factors = EquationsView(typesetter)
        self.column.addWidget(self.values)
        self.column.addWidget(self.factors)

    def show_pose(self, robot: Robot, q: FloatArray) -> None:
        """The factors and their product."""
        split = wrist_split(robot, q)
        self.values.show_values([split.arm, split.wrist, split.arm * split.wrist, split.whole], "")
        self.factors.show_equations(RV_1A_FACTORS if original_name(robot) == "rv-1a" else ())
        self.factors.setVisible(robot.name == "rv-1a")


class PlanarBlock(ArmBlock):
    """Figure 4.1 of source 004: the planar arm, stretched."""

    def __init__(self) -> None:
        super().__init__(
            tr("Figure 4.1 of source 004"),
            tr(
                "Stretched out, the planar arm stands at the boundary of its reach: its tip moves only square to the "
                "arm. The velocity ellipse shows how this comes about."
            ),
        )
        self.stretch = button(
            "singular_figure",
            tr("Show figure 4.1"),
            tr("Stretch the arm, q₂ = 0, and draw the ellipses"),
            self._show_figure,
        )
        self.ellipses = QCheckBox(tr("Ellipses along the bend of the elbow"))
        self.ellipses.setObjectName("singular_ellipses")
        self.ellipses.setToolTip(
            tr("Draw the velocity ellipse, at half its size, at every 30° of joint 2, with joint 1 as it is")
        )
        self.ellipses.toggled.connect(lambda _: self.changed.emit())
        self._stretched: FloatArray = np.zeros(2)
        self.column.addWidget(self.ellipses)
        self.column.addWidget(self.stretch)

    def _show_figure(self) -> None:
        self.ellipses.setChecked(True)
        self.go.emit(self._stretched, tr("Stretch"))

    def show_pose(self, robot: Robot, q: FloatArray) -> None:
        """The stretched arm has joint 1 as it is."""
        del robot
        self._stretched = np.array([q[0], 0.0])


class _Values(QWidget):
    """Formulas on the left, their values on the right."""

    def __init__(self, formulas: tuple[str, ...], name: str, typesetter: Typesetter) -> None:
        super().__init__()
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setColumnStretch(0, 1)
        self.labels = [QLabel() for _ in formulas]
        for row, (latex, label) in enumerate(zip(formulas, self.labels, strict=True)):
            left, _, formula = latex.partition(" = ")
            view = EquationsView(typesetter)
            view.show_equations([Equation(left, formula, "", "")])
            label.setObjectName(f"{name}_{row + 1}")
            grid.addWidget(view, row, 0)
            grid.addWidget(label, row, 1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop)

    def show_values(self, values: list[float], unit: str) -> None:
        """One value a formula."""
        for label, value in zip(self.labels, values, strict=True):
            label.setText(f"{small_number(value)}{unit}")
