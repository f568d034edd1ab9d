"""The torque ratings of the drives: who says so, and a place to type others."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QSize, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication
from PySide6.QtWidgets import QHeaderView, QLabel, QTableView, QVBoxLayout, QWidget

from rvsim.errors import ExpressionError, RobotDefinitionError
from rvsim.expressions import evaluate
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.number_cells import make_editable
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, dot, fit_height, plain_table, text_metrics
from rvsim.gui.panels.user_robot import own_copy
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, display, format_number, torque_kind, without_unit
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import tr, tr_later
from rvsim.robot import Datum, Robot
from rvsim.robot.rating_edits import RatingOrigin, rating_origin, with_guessed_ratings, with_max_torque

_TOP = QModelIndex()
_JOINT, _RATING, _ORIGIN = range(3)
_HEADS = (tr_later("joint"), tr_later("rating"), tr_later("origin"))
_ORIGINS: Mapping[RatingOrigin, str] = {
    "source": tr_later("source"),
    "assumed": tr_later("assumed"),
    "yours": tr_later("yours"),
}
_TIPS = (
    tr_later("The joint"),
    tr_later("What its drive can hold"),
    tr_later("Who says so: a source, nobody (assumed), or you"),
)
_GAP, _DOT_ROOM = 22, 30  # [pixels]
_NONE = ("", "-", "\u2013", "none")
_HOW = tr_later(
    "Double-click a rating to change it, empty it for none: the arm follows on a copy of your own, which can be saved."
)
_UNKNOWN = tr_later(
    "No source gives this arm's ratings: the bars stay empty, and no force is the largest, until there are some."
)


class RatingModel(QAbstractTableModel):
    """One row a drive; `edited(joint, value)` tells an SI value that has been typed, or None; `refused` why not."""

    edited = Signal(int, object)
    refused = Signal(str)

    def __init__(self, robot: Robot, preferences: Preferences) -> None:
        super().__init__()
        self._robot, self._preferences = robot, preferences
        self._room = 10_000

    def give_room(self, column: int, width: int) -> None:
        """A column is so wide [pixels]: joints have their names in theirs where all of them fit."""
        if column == _JOINT:
            self._room = width - _DOT_ROOM

    def _names(self) -> list[str]:
        names = [f"J{number} {tr(joint.name)}" for number, joint in enumerate(self._robot.joints, start=1)]
        fit = max(map(text_metrics().horizontalAdvance, names)) <= self._room
        return names if fit else [f"J{number}" for number in range(1, self._robot.dof + 1)]

    def show_robot(self, robot: Robot) -> None:
        """Show the ratings of an arm; open editors survive if the joints are as many."""
        resets = robot.dof != self._robot.dof
        if resets:
            self.beginResetModel()
        self._robot = robot
        if resets:
            self.endResetModel()
        else:
            self.dataChanged.emit(self.index(0, 0), self.index(robot.dof - 1, _ORIGIN))

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a drive."""
        return 0 if parent.isValid() else self._robot.dof

    def columnCount(self, parent: Index = _TOP) -> int:
        """Joint, rating, origin."""
        return 0 if parent.isValid() else len(_HEADS)

    def flags(self, index: Index) -> Qt.ItemFlag:
        """The ratings can be edited."""
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.isValid() and index.column() == _RATING else flags

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What stands in a cell."""
        joint, column = self._robot.joints[index.row()], index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole | Qt.ItemDataRole.EditRole:
                return self._text(index, role == Qt.ItemDataRole.EditRole)
            case Qt.ItemDataRole.TextAlignmentRole:
                return LEFT if column == _JOINT else RIGHT
            case Qt.ItemDataRole.SizeHintRole:
                return _origin_size() if column == _ORIGIN else None
            case Qt.ItemDataRole.DecorationRole:
                return dot(joint.color) if column == _JOINT else None
            case Qt.ItemDataRole.FontRole:
                return _font(joint.max_torque) if column == _RATING else None
            case Qt.ItemDataRole.ToolTipRole:
                return self._tip(index.row())
        return None

    def _text(self, index: Index, whole: bool) -> str:
        joint = self._robot.joints[index.row()]
        if index.column() == _JOINT:
            return self._names()[index.row()]
        if joint.max_torque is None:
            return "" if whole else "\u2013"
        if index.column() == _ORIGIN:
            return tr(_ORIGINS[rating_origin(joint.max_torque)])
        shown = self._shown(index.row())
        value = joint.max_torque.value * shown.factor
        if whole:
            return f"{value:.12g}"
        # Nobody rates a drive to more decimals; the tooltip has them.
        text = format_number(value, shown.decimals - self._preferences["extra_decimals"])
        return text if self._common_unit() else text + shown.suffix

    def _common_unit(self) -> str:
        """The unit that all joints share, or nothing."""
        units = {self._shown(joint).suffix for joint in range(self._robot.dof)}
        return units.pop().strip() if len(units) == 1 else ""

    def _tip(self, joint: int) -> str:
        name, rating, shown = (
            tr(self._robot.joints[joint].name),
            self._robot.joints[joint].max_torque,
            self._shown(joint),
        )
        if rating is None:
            return tr("The drive of “{joint}”: no rating is known. Double-click or type to enter one.", joint=name)
        number = f"{rating.value * shown.factor:.12g}{shown.suffix}"
        sentence = tr("The drive of “{joint}”: {rating}.", joint=name, rating=number)
        source = tr(rating.source) or tr("its robot file")
        said = {
            "source": tr("From: {source}.", source=source),
            "assumed": tr("Assumed: {source}.", source=source),
            "yours": tr("Yours: {source}.", source=source),
        }
        return f"{sentence} {said[rating_origin(rating)]}"

    def _shown(self, joint: int) -> Display:
        return display(torque_kind(self._robot, joint), self._preferences)

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Take a typed text: a number or an expression in the shown unit, or nothing for no rating."""
        if role != Qt.ItemDataRole.EditRole or index.column() != _RATING:
            return False
        text, shown = str(value).strip(), self._shown(index.row())
        if text == self._text(index, whole=True):
            return True
        try:
            rating = None if text in _NONE else evaluate(without_unit(text, shown.suffix)) / shown.factor
        except ExpressionError as problem:
            self.refused.emit(str(problem))
            return False
        self.edited.emit(index.row(), rating)
        return True

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a column is."""
        if orientation == Qt.Orientation.Vertical:
            return None
        match role:
            case Qt.ItemDataRole.DisplayRole:
                head = tr(_HEADS[section])
                return f"{head} {self._common_unit()}".strip() if section == _RATING else head
            case Qt.ItemDataRole.ToolTipRole:
                return tr(_TIPS[section])
            case Qt.ItemDataRole.TextAlignmentRole:
                return LEFT if section == _JOINT else RIGHT
        return None


def _origin_size() -> QSize:
    """As wide as its longest word, and a gap to the number before it."""
    metrics = text_metrics()
    widest = max(metrics.horizontalAdvance(tr(origin)) for origin in _ORIGINS.values())
    return QSize(widest + _GAP, metrics.height())


def _font(rating: Datum | None) -> QFont | None:
    """Italic for what is assumed, as everywhere."""
    if rating is None or rating_origin(rating) != "assumed":
        return None
    font = QFont(QGuiApplication.font())
    font.setItalic(True)
    return font


class Ratings(QWidget):
    """The table, what it means, and for an arm without ratings a way to begin. Edits go to the user's own copy."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session = session
        self.model = RatingModel(session.robot, preferences)
        self.model.edited.connect(self.edit)
        self.model.refused.connect(self._complain)
        self.table = _rating_table(self.model)
        self.guess = button(
            "guess_ratings", tr("Start with a guess"), tr("Give each drive 10 N m, sliding ones 100 N"), self._guess
        )
        self.note, self.message = wrapped_label("muted"), wrapped_label()
        set_role(self.message, level="warning")
        self.message.hide()
        title = QLabel(tr("Torque ratings"))
        set_role(title, role="title")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (title, self.guess, self.table, self.message, self.note):
            column.addWidget(widget)

    def show_robot(self, robot: Robot) -> None:
        """Show the ratings of an arm."""
        self.model.show_robot(robot)
        rated = any(joint.max_torque for joint in robot.joints)
        self.guess.setHidden(rated)
        self.note.setText(tr(_HOW) if rated else f"{tr(_UNKNOWN)} {tr(_HOW)}")

    def settle(self) -> None:
        """As high as the rows are now; what was refused is past."""
        self.message.hide()
        fit_height(self.table)
        self.table.setMinimumHeight(self.table.maximumHeight())

    def edit(self, joint: int, value: float | None) -> None:
        """Rate a drive of the user's own copy [N m, N], None for no rating, undoably."""
        try:
            robot = with_max_torque(own_copy(self._session.robot), joint, value)
        except RobotDefinitionError as problem:
            self._complain(_sentence(problem.what))
            return
        self._use(robot, tr("Edit the torque rating of J{joint} of {robot}", joint=joint + 1, robot=tr(robot.title)))

    def _complain(self, sentence: str) -> None:
        self.message.setText(sentence)
        self.message.show()

    def _guess(self) -> None:
        robot = with_guessed_ratings(own_copy(self._session.robot))
        self._use(robot, tr("Give {robot} torque ratings", robot=tr(robot.title)))

    def _use(self, robot: Robot, text: str) -> None:
        self._session.edit(text, self._session.experiment.with_robot(robot))


def _sentence(reason: str) -> str:
    """A reason that stands alone, as the screen writes it."""
    return f"{reason[0].upper()}{reason[1:]}".replace(" -", " \u2212")


def _rating_table(model: RatingModel) -> QTableView:
    table = plain_table("rating_table", tr("Torque ratings"), model)
    header = table.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    header.setSectionResizeMode(_JOINT, QHeaderView.ResizeMode.Stretch)
    make_editable(table, "rating_cell_editor")
    header.sectionResized.connect(lambda column, _, width: model.give_room(column, width))
    return table
