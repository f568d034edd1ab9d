"""The Tool panel: where the tool is and how it is turned, in the notation one likes, and editable."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.gui.matrix_view import MatrixView
from rvsim.gui.orientations import MATRIX, MATRIX_CONVENTION, NOTATIONS, notation_titles
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.panels.orientation_boxes import OrientationBoxes
from rvsim.gui.panels.shown import NUMBER_SETTINGS, ReadOutPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_scientific, length_kind, shown_units
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tool_edits import ToolEdit, moved_tool, turned_tool
from rvsim.gui.widgets import column_of, combo, scrolled, select
from rvsim.kinematics import forward_difference, forward_kinematics
from rvsim.lab.texts import NamedValue, matrix_latex, matrix_numpy, pose_text, values_latex, values_numpy, values_text
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_AXES = ("x", "y", "z")
_SECOND_WAY = tr_later(
    "The same pose, computed a second and independent way: not by the DH matrices, but as a product of matrix "
    "exponentials of the joints' screws, derived from the zero pose. The two differ by rounding alone: distance of the "
    "origins, and largest difference in a rotation entry.\n\n"
    "Source 000 makes this test as well (Program 6, against a toolbox) and reports an error of 0. Its number is really "
    "1.018 dm: the DH offsets of joints 4 and 5 are in one of its two paths only."
)
_UNIT_NAMES = {"°": "deg", "rad": "rad", "mm": "mm", "m": "m", "unit": "unit", "": ""}


class ToolPanel(ReadOutPanel):
    """Reads out T_base_tool; an edited number is solved for the joints."""

    always = True

    settings = NUMBER_SETTINGS | {"orientation"}

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self.setObjectName("tool_panel")
        self._robot: Robot | None = None
        self._T: FloatArray = np.eye(4)
        self.tools = combo("tool_selector", tr("Tool"))
        self.tools.activated.connect(self._on_tool)
        self.position = NumberRow("tool", _AXES, ("length", "length", "length"), preferences)
        self.orientations = combo("orientation_selector", tr("Notation of the orientation"), notation_titles())
        self.orientations.activated.connect(lambda _: preferences.set("orientation", self.orientations.currentData()))
        self.angles = OrientationBoxes("tool", tr("Tool"), preferences)
        self.rows = self.angles.rows
        self.matrix = MatrixView(preferences, tr("Tool pose as a matrix"))
        self.matrix.setObjectName("tool_matrix")
        self.convention, self.message, self.difference = QLabel(), QLabel(), QLabel()
        formats = {tr_later("text"): self._as_text, "NumPy": self._as_numpy, "LaTeX": self._as_latex}
        self.copy = CopyButton("tool_copy", tr("the tool pose"), formats, session)
        self._connect()
        self._lay_out()

    # --- construction ----------------------------------------------------------------------------------------------

    def _connect(self) -> None:
        self.position.edited.connect(self._move)
        self.angles.turned.connect(self._turn)
        self.angles.told.connect(self._session.say)
        for boxes in (self.position, self.angles):
            boxes.refused.connect(self._complain)
            boxes.finished.connect(self._session.end_stroke)

    def _lay_out(self) -> None:
        for label, name in (
            (self.convention, "orientation_convention"),
            (self.message, "tool_message"),
            (self.difference, "forward_difference"),
        ):
            label.setObjectName(name)
            label.setWordWrap(True)
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
            set_role(label, role="muted")
        set_role(self.message, role="", level="warning")
        self.message.hide()
        self.difference.setToolTip(f"<qt>{tr(_SECOND_WAY).replace(chr(10) * 2, '<br><br>')}</qt>")
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        column.addLayout(_headed(tr("Tool"), self.tools, self.copy))
        column.addSpacing(4)
        column.addLayout(_headed(tr("Position")))
        column.addWidget(self.position)
        column.addSpacing(6)
        column.addLayout(_headed(tr("Orientation"), self.orientations))
        self.matrix.hide()
        for page in (self.angles, self.matrix):
            column.addWidget(page)
        for label in (self.convention, self.message):
            column.addWidget(label)
        column.addSpacing(6)
        column.addLayout(_headed(tr("Checked a second way")))
        column.addWidget(self.difference)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- showing ---------------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the tool pose of the present joint values."""
        robot, q = self._session.robot, self._session.q
        if robot is not self._robot:
            self._take_robot(robot)
        self._T = forward_kinematics(robot, q)
        self.position.show_values(self._T[:3, 3])
        self._show_orientation(self._preferences["orientation"])
        self.message.hide()
        self._show_second_way(robot, q)

    def _show_second_way(self, robot: Robot, q: FloatArray) -> None:
        difference = forward_difference(robot, q)
        position, rotation = (
            format_scientific(float(difference.position)),
            format_scientific(float(difference.rotation)),
        )
        text = tr(
            "Difference to the product of exponentials:\n{position} m in position, {rotation} in rotation.",
            position=position,
            rotation=rotation,
        )
        if "rv-m1" in robot.name:
            text += "\n" + tr("Source 000's “zero error” here is really 1.018 dm.")
        self.difference.setText(text)

    def _show_orientation(self, chosen: str) -> None:
        select(self.orientations, chosen)
        self.angles.setVisible(chosen != MATRIX)
        self.matrix.setVisible(chosen == MATRIX)
        if chosen == MATRIX:
            self.matrix.show_matrix(self._T, length_kind(self._session.robot))
            self.convention.setText(tr(MATRIX_CONVENTION))
        else:
            self.angles.show_notation(chosen)
            self.angles.show_rotation(self._T[:3, :3])
            self.convention.setText(tr(NOTATIONS[chosen].convention))

    def _take_robot(self, robot: Robot) -> None:
        self._robot = robot
        self.tools.clear()
        for tool in robot.tools:
            self.tools.addItem(tr(tool.title), tool.name)
        select(self.tools, robot.tool_name)
        for box in self.position.boxes:
            box.set_kind(length_kind(robot))

    def _complain(self, sentence: str) -> None:
        if sentence:
            self.message.setText(sentence)
            self.message.show()
            self._session.say(sentence, "warning")

    # --- editing ---------------------------------------------------------------------------------------------------

    def _on_tool(self) -> None:
        name = self.tools.currentData()
        if name != self._session.robot.tool_name:
            robot = self._session.robot.with_tool(name)
            text = tr("Take the {tool}", tool=tr(robot.tool.title))
            self._session.edit(text, self._session.experiment.with_robot(robot))

    def _move(self, axis: int) -> None:
        edit = moved_tool(self._session.experiment, self._T, self.position.values, shown_units(self._preferences))
        self._take(edit, tr("Move the tool along {axis}", axis=_AXES[axis]), f"tool {_AXES[axis]}")

    def _turn(self, R: FloatArray, name: str) -> None:
        edit = turned_tool(self._session.experiment, self._T, R, shown_units(self._preferences))
        self._take(edit, tr("Turn the tool's {angle}", angle=tr(name)), f"tool {name}")

    def _take(self, edit: ToolEdit, text: str, merge: str) -> None:
        if edit.q is not None:
            self._session.move_to(edit.q, text, merge=merge)
        # The boxes show what is: after a refusal the old numbers, after a solution those that the arm reaches.
        self.refresh()
        self._complain(edit.sentence)

    # --- copying ---------------------------------------------------------------------------------------------------

    def _values(self) -> list[NamedValue]:
        """Position and orientation in the units that are shown."""
        length = length_kind(self._session.robot)
        notation = NOTATIONS.get(self._preferences["orientation"], NOTATIONS["rpy"])
        named = [*zip(_AXES, (length,) * 3, self._T[:3, 3], strict=True)]
        named += zip(notation.names, notation.kinds, notation.read(self._T[:3, :3]), strict=True)
        return [_named_value(name, kind, float(value), self._preferences) for name, kind, value in named]

    def _shown_matrix(self) -> FloatArray:
        scaled = np.array(self._T)
        scaled[:3, 3] *= display(length_kind(self._session.robot), self._preferences).factor
        return scaled

    def _matrix_head(self) -> str:
        unit = display(length_kind(self._session.robot), self._preferences).suffix.strip()
        return f"T_base_tool, lengths in {unit}"

    def _is_matrix(self) -> bool:
        return bool(self._preferences["orientation"] == MATRIX)

    def _as_text(self) -> str:
        if self._is_matrix():
            return f"{self._matrix_head()}\n{pose_text(self._shown_matrix())}"
        return values_text(self._values())

    def _as_numpy(self) -> str:
        if self._is_matrix():
            return f"# {self._matrix_head()}\n{matrix_numpy(self._shown_matrix())}"
        return values_numpy(self._values())

    def _as_latex(self) -> str:
        if self._is_matrix():
            return f"% {self._matrix_head()}\n{matrix_latex(self._shown_matrix())}"
        return values_latex(self._values())


_ASCII_NAMES = {"φ": "phi", "θ": "theta", "ψ": "psi"}


def _named_value(name: str, kind: Kind, value: float, preferences: Preferences) -> NamedValue:
    shown = display(kind, preferences)
    return NamedValue(_ASCII_NAMES.get(name, name), value * shown.factor, _UNIT_NAMES[shown.suffix.strip()])


def _headed(title: str, *widgets: QWidget) -> QHBoxLayout:
    """A title, and beside it what belongs to it; the first widget takes the room."""
    line = QHBoxLayout()
    label = QLabel(title)
    set_role(label, role="title")
    line.addWidget(label)
    for index, widget in enumerate(widgets):
        line.addWidget(widget, 1 if index == 0 else 0)
    return line
