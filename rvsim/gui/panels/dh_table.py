"""The DH panel: the table with its convention, edited live on a copy that is the user's own arm."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import cast

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QSizePolicy,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from rvsim.errors import RobotDefinitionError
from rvsim.experiment import Experiment, limit_violations
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.dh_cells import cell_kind, cell_title, cell_value, edit_title
from rvsim.gui.panels.dh_editor import CellDelegate
from rvsim.gui.panels.dh_model import COLUMNS, DH_COLUMNS, LIMIT_COLUMNS, DHModel, column_of_key
from rvsim.gui.panels.folding_row import WrappedRow
from rvsim.gui.panels.shown import NUMBER_SETTINGS, ReadOutPanel
from rvsim.gui.panels.tables import fit_height, plain_table
from rvsim.gui.panels.user_robot import ask_what_to_open, ask_where_to_save, is_own, opened, own_copy, saved
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_quantity, joint_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, button, column_of, scrolled
from rvsim.lab.texts import matrix_latex, matrix_numpy, table_tsv
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import DH_KEYS, DHKey, with_dh_value

CONVENTION_SENTENCES = {
    "standard": tr_later("Standard DH: Aᵢ = Rz(θᵢ) · Tz(dᵢ) · Tx(aᵢ) · Rx(αᵢ)."),
    "modified": tr_later(
        "Modified DH (Craig): Aᵢ = Rx(αᵢ₋₁) · Tx(aᵢ₋₁) · Tz(dᵢ) · Rz(θᵢ). Row i holds a and α of the link "
        "before joint i, so frame i stands at the near end of its link."
    ),
}


class DHTablePanel(ReadOutPanel):
    """Shows the DH table; an edit goes to a copy that is the user's own, and from there to a file and back."""

    settings = NUMBER_SETTINGS

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self.setObjectName("dh_panel")
        self._originals: dict[str, Robot] = {}  # of each own arm
        self.model = DHModel(session.robot, preferences, self)
        self.model.edited.connect(lambda joint, key, value: self.edit_value(joint, cast(DHKey, key), value))
        self.model.refused.connect(self._complain)
        self.rows = self._table("dh_table", tr("DH table"), DH_COLUMNS)
        self.limits = self._table("limits_table", tr("Joint limits and home"), LIMIT_COLUMNS)
        self.title, self.convention, self.message, self.legend = ElidedLabel(), QLabel(), QLabel(), QLabel()
        formats = {tr_later("text"): self._as_text, "NumPy": self._as_numpy, "LaTeX": self._as_latex}
        self.copy = CopyButton("dh_copy", tr("the DH table"), formats, session)
        self.save = button(
            "save_robot_button", tr("Save as robot file…"), tr("Keep this arm in a file"), self.ask_and_save
        )
        self.open = button(
            "open_robot_button", tr("Open robot file…"), tr("Take an arm from a file"), self.ask_and_open
        )
        self.back = button(
            "original_robot_button",
            tr("Back to the original"),
            tr("Take the arm as it was before the edits"),
            self.go_back,
        )
        self._lay_out()

    # --- construction ----------------------------------------------------------------------------------------------

    def _table(self, name: str, title: str, columns: Iterable[str]) -> QTableView:
        table = plain_table(name, title, self.model)
        table.setWordWrap(False)
        table.setTextElideMode(Qt.TextElideMode.ElideMiddle)  # joints of a wrist begin alike
        wanted = [column_of_key(key) for key in columns]
        for column in range(len(COLUMNS)):
            table.setColumnHidden(column, column not in wanted)
        header = table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        # Where the room is short, a stretched column is cut: that of the longest texts may lose its gap, no more.
        header.setSectionResizeMode(
            column_of_key("theta" if "theta" in columns else "name"), QHeaderView.ResizeMode.Stretch
        )
        table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        table.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
            | QAbstractItemView.EditTrigger.AnyKeyPressed
        )
        delegate = CellDelegate(table)
        delegate.closeEditor.connect(lambda *_: self._session.end_stroke())
        table.setItemDelegate(delegate)
        return table

    def _lay_out(self) -> None:
        for label, name in (
            (self.convention, "dh_convention"),
            (self.message, "dh_message"),
            (self.legend, "dh_legend"),
        ):
            label.setObjectName(name)
            label.setWordWrap(True)
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        set_role(self.title, role="title")
        set_role(self.convention, role="muted")
        set_role(self.legend, role="muted")
        self.message.hide()
        head = QHBoxLayout()
        head.addWidget(self.title, 1)
        head.addWidget(self.copy)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(8)
        column.addLayout(head)
        for widget in (self.convention, self.rows, self.limits, self.legend, self.message):
            column.addWidget(widget)
        column.addWidget(WrappedRow((self.save, self.open), 8))
        column.addWidget(self.back)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- showing ---------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The table does not depend on the pose."""
        return after.robot is not before.robot

    @property
    def original(self) -> Robot:
        """The arm that the edits of the present one began with."""
        robot = self._session.robot
        if not is_own(robot):
            return robot
        original = self._originals.setdefault(robot.name, robot)
        # A file may bring another arm under a known name: such an arm is its own original.
        if (original.joint_types, original.convention) != (robot.joint_types, robot.convention):
            self._originals[robot.name] = original = robot
        return original

    def refresh(self) -> None:
        """Show the present arm."""
        robot, original = self._session.robot, self.original
        self.model.show_robot(robot, original)
        for table in (self.rows, self.limits):
            fit_height(table)
            table.setMinimumHeight(table.maximumHeight())
        self.title.setText(tr(robot.title))
        sentences = [tr(CONVENTION_SENTENCES[robot.convention])]
        if robot.name != original.name:
            sentences.insert(0, tr("Edited copy of the {robot}.", robot=tr(original.title)))
        self.convention.setText("\n".join(sentences))
        self.legend.setText(self._legend(robot))
        self.back.setEnabled(self._differs(robot, original))
        self.message.hide()

    def _differs(self, robot: Robot, original: Robot) -> bool:
        cells = ((joint, key) for joint in range(robot.dof) for key in DH_KEYS)
        return robot.name != original.name or any(self.model.is_edited(joint, key) for joint, key in cells)

    def _legend(self, robot: Robot) -> str:
        cells = [(joint, key) for joint in range(robot.dof) for key in DH_KEYS]
        parts = [tr("Double-click a number to change it: the arm follows on a copy of your own.")]
        if any(self.model.is_edited(joint, key) for joint, key in cells):
            parts.append(tr("Bold: changed."))
        if any(self.model.is_assumed(joint, key) for joint, key in cells):
            parts.append(tr("Italic: assumed, no source gives it."))
        return " ".join(parts)

    def _tell(self, sentence: str, level: str) -> None:
        self.message.setText(sentence)
        self.message.setVisible(bool(sentence))
        set_role(self.message, level=level)
        if sentence:
            self._session.say(sentence, "info" if level == "good" else level)

    def _complain(self, sentence: str) -> None:
        self._tell(sentence, "warning")

    # --- editing ---------------------------------------------------------------------------------------------------

    def edit_value(self, joint: int, key: DHKey, value: float) -> None:
        """Put an SI value into a cell of the user's own copy, undoably; the arm follows at once."""
        before, original = self._session.robot, self.original
        own = own_copy(before)
        if own.name != before.name:
            self._originals[own.name] = original = before
        try:
            robot = with_dh_value(own, joint, key, value, look_of=original)
        except RobotDefinitionError as problem:
            self._complain(str(problem))
            return
        text = edit_title(robot, joint, key)
        self._session.edit(text, self._session.experiment.with_robot(robot), merge=f"dh {joint} {key}")
        self._complain(" ".join(self._consequences(before, robot, joint, key)))

    def _consequences(self, before: Robot, after: Robot, joint: int, key: DHKey) -> Iterable[str]:
        """What else the edit did, in sentences."""
        if key != "home" and after.joints[joint].home != before.joints[joint].home:
            home = format_quantity(after.joints[joint].home, cell_kind(after, joint, "home"), self._preferences)
            yield tr(
                "{cell} moved to {home}, the nearest within the new limits.",
                cell=cell_title(after, joint, "home"),
                home=home,
            )
        for violation in limit_violations(after, self._session.q):
            kind = joint_kind(after, violation.joint)
            value, limit = (format_quantity(number, kind, self._preferences) for number in violation[1:])
            yield tr(
                "“{joint}” now stands at {value}, outside its limit {limit}.",
                joint=tr(after.joint_names[violation.joint]),
                value=value,
                limit=limit,
            )
        if any(new.assumed and not old.assumed for old, new in zip(before.masses, after.masses, strict=True)):
            yield tr("The link keeps its mass, which now counts as assumed.")

    def go_back(self) -> None:
        """The arm as it was before the edits; an undo step leads back to them."""
        original = self.original
        self._session.edit(
            tr("Back to the {robot}", robot=tr(original.title)), self._session.experiment.with_robot(original)
        )
        self._tell(tr("This is the {robot} as it was. Undo brings your edits back.", robot=tr(original.title)), "good")

    # --- files -----------------------------------------------------------------------------------------------------

    def ask_and_save(self) -> None:
        """Ask for a file and save the arm in it."""
        path = ask_where_to_save(self, self._session.robot)
        if path is not None:
            self.save_to(path)

    def save_to(self, path: Path) -> None:
        """Save the arm as a robot file, or say why not."""
        done, sentence = saved(self._session, path)
        self._tell(sentence, "good" if done else "error")

    def ask_and_open(self) -> None:
        """Ask for a robot file and take its arm."""
        path = ask_what_to_open(self, self._session.robot)
        if path is not None:
            self.open_from(path)

    def open_from(self, path: Path) -> None:
        """Take the arm of a robot file, or say why not; the present arm stays."""
        robot, sentence = opened(path)
        if robot is not None:
            self._originals[robot.name] = robot
            self._session.use_robot(robot)
        self._tell(sentence, "good" if robot is not None else "error")

    # --- copying ---------------------------------------------------------------------------------------------------

    def _shown_table(self) -> FloatArray:
        """(n, 7) θ, d, a, α, lower, upper, home in the units that are shown."""
        robot = self._session.robot
        table = np.empty((robot.dof, len(DH_KEYS)))
        for joint, column in np.ndindex(*table.shape):
            key = DH_KEYS[column]
            factor = display(cell_kind(robot, joint, key), self._preferences).factor
            table[joint, column] = cell_value(robot, joint, key) * factor
        return table

    def _head(self) -> str:
        units = f"{self._preferences['angle_unit']}, {display('length', self._preferences).suffix.strip()}"
        return f"{self._session.robot.title}, {self._session.robot.convention} DH: {', '.join(DH_KEYS)} [{units}]"

    def _as_text(self) -> str:
        robot = self._session.robot
        header = [self._head(), "type", *DH_KEYS]
        rows = zip(robot.joints, self._shown_table(), strict=True)
        return table_tsv(header, ([joint.name, joint.type, *map(float, row)] for joint, row in rows))

    def _as_numpy(self) -> str:
        return f"# {self._head()}\n{matrix_numpy(self._shown_table())}"

    def _as_latex(self) -> str:
        return f"% {self._head()}\n{matrix_latex(self._shown_table())}"
