"""The section "Best way to": all ways to a pose, the best first, and a button to go the chosen one."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QGroupBox, QHBoxLayout, QVBoxLayout

from rvsim.errors import RvsimError
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_rows import RowsModel, TextRow, rows_table
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, joint_kind, length_kind
from rvsim.gui.session import Session
from rvsim.gui.widgets import button, combo, select
from rvsim.kinematics import branch_title, forward_kinematics
from rvsim.language import tr, tr_later
from rvsim.motion.best_way import Criterion, MoveLaw, Way, best_ways
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_CRITERIA = {"quickest": tr_later("Quickest"), "least motion": tr_later("Least motion")}
_HOME, _TARGET = tr_later("Home"), tr_later("The tool's target")
_HEADS = (
    (tr_later("branch"), tr_later("The branch of the inverse kinematics at the end")),
    ("s", tr_later("Time of the quickest law, in seconds")),
    (
        tr_later("motion"),
        tr_later("Length of the way of all joints together; a slide across the arm counts as half a turn"),
    ),
    (tr_later("clear"), tr_later("The least distance from the table and from itself on the way; ✗ where they meet")),
)
_LAWS: dict[MoveLaw, str] = {
    "jerk-limited": tr_later("jerk-limited"),
    "trapezoid": tr_later("trapezoid"),
    "quintic": tr_later("quintic"),
}
# A branch's words in a narrow column, as far as they are other ones.
_SHORT = {
    "left shoulder": tr_later("left"),
    "right shoulder": tr_later("right"),
    "wrist flip": tr_later("flip"),
    "wrist no-flip": tr_later("no-flip"),
    "elbow up": tr_later("up"),
    "elbow down": tr_later("down"),
    "elbow left": tr_later("left"),
    "elbow right": tr_later("right"),
}


class BestWaySection(QGroupBox):
    """Works when it is asked: "Find" fills the table, "Go" plays the chosen row."""

    def __init__(self, session: Session, preferences: Preferences, motion: MotionControl) -> None:
        super().__init__(tr("Best way to"))
        self._session, self._preferences, self._motion = session, preferences, motion
        self.ways: tuple[Way, ...] = ()
        self._robot: Robot | None = None
        self._name = ""
        self.target = combo("best_way_target", tr("Where the arm is to go"))
        self.criterion = combo("best_way_criterion", tr("What is best"), _CRITERIA)
        self.criterion.activated.connect(lambda _: self.search())
        self.find_button = button("best_way_find", tr("Find"), tr("Try every branch and every time law"), self.search)
        self.go_button = button("best_way_go", tr("Go"), tr("Go the chosen way; one undo step leads back"), self.go)
        self.model = RowsModel(_HEADS)
        self.table = rows_table("best_way_table", tr("Ways"), self.model)
        self.table.selectionModel().currentRowChanged.connect(lambda *_: self._tell())
        self.sentence = wrapped_label()
        self.sentence.setObjectName("best_way_sentence")
        first, second = QHBoxLayout(), QHBoxLayout()
        first.addWidget(self.target, 1)
        first.addWidget(self.find_button)
        second.addWidget(self.criterion, 1)
        second.addWidget(self.go_button)
        column = QVBoxLayout(self)
        for part in (first, second):
            column.addLayout(part)
        column.addWidget(self.table)
        column.addWidget(self.sentence)
        self._show()

    def refresh(self) -> None:
        """Another pose, arm or list of poses: what was found before starts somewhere else."""
        experiment = self._session.experiment
        names = (_HOME, *(pose.name for pose in experiment.poses), _TARGET)
        if names != tuple(self.target.itemData(row) for row in range(self.target.count())):
            chosen = self.target.currentData()
            self.target.clear()
            for name in names:
                self.target.addItem(_said(name), name)
            select(self.target, chosen if chosen in names else _HOME)
        if self.ways and (experiment.robot is not self._robot or self._stale()):
            self.ways = ()
            self._show()

    def _stale(self) -> bool:
        """Whether the arm has left the place from which the ways begin, other than on one of them."""
        trajectory = self._motion.player.trajectory
        on_its_way = any(trajectory is move for way in self.ways for move in way.moves.values())
        begin = next((move.q(0.0) for way in self.ways for move in way.moves.values()), None)
        return not on_its_way and (begin is None or bool((begin != self._session.q).any()))

    def search(self) -> None:
        """Fill the table."""
        experiment = self._session.experiment
        self._robot, self._name = experiment.robot, self.target.currentData()
        criterion: Criterion = self.criterion.currentData()
        try:
            self.ways = best_ways(
                experiment.robot, experiment.q, self._goal(), criterion, ignore_limits=experiment.ignore_limits
            )
        except RvsimError as problem:
            self._session.say(str(problem), "error")
            return
        self._show()
        if not self.ways:
            self.sentence.setText(tr("The arm cannot be there in any branch."))
        elif self.ways[0].possible:
            self.table.selectRow(0)

    def _goal(self) -> FloatArray:
        """(4, 4) where the tool is to be."""
        experiment, name = self._session.experiment, self.target.currentData()
        if name == _TARGET:
            T = experiment.target
            return forward_kinematics(experiment.robot, experiment.q) if T is None else T
        known = {pose.name: pose.q for pose in experiment.poses}
        return forward_kinematics(experiment.robot, known.get(name, experiment.robot.home))

    def go(self) -> None:
        """Play the chosen way, if it still begins where the arm is."""
        self.refresh()  # the key that asks may come while the page lies behind others and has not looked since
        way = self._chosen()
        if way is not None and way.possible:
            self._motion.load(way.moves[way.law], tr("Best way to {name}", name=_said(self._name)))
            self._motion.play()

    def _chosen(self) -> Way | None:
        row = self.table.currentIndex().row()
        return self.ways[row] if 0 <= row < len(self.ways) else None

    def _show(self) -> None:
        robot = self._session.robot
        self.model.show_rows(
            [TextRow(self._texts(robot, way), branch_title(way.label), way.possible) for way in self.ways]
        )
        self.table.setVisible(bool(self.ways))
        self._tell()

    def _texts(self, robot: Robot, way: Way) -> tuple[str, ...]:
        seconds = f"{way.seconds:.2f}" if way.possible else tr("limits")
        motion = format_quantity(way.motion, "angle", self._preferences)
        return _short(way.label), seconds, motion, self._clear(robot, way)

    def _clear(self, robot: Robot, way: Way) -> str:
        nearest = min(way.table, way.own)
        if nearest < 0.0:
            return tr("✗ table") if way.table < 0.0 else tr("✗ itself")
        return "✓" if math.isinf(nearest) else f"✓ {format_quantity(nearest, length_kind(robot), self._preferences)}"

    def _tell(self) -> None:
        way = self._chosen()
        self.go_button.setEnabled(way is not None and way.possible)
        self.sentence.setText("" if way is None else self._way_words(way))

    def _way_words(self, way: Way) -> str:
        moves = sorted(way.moves.items(), key=lambda item: item[1].duration)
        laws = tr(", ").join(tr("{law} {time:.2f} s", law=tr(_LAWS[law]), time=move.duration) for law, move in moves)
        branch = branch_title(way.label)
        sentences = [f"{branch[:1].upper()}{branch[1:]}: {laws}."]
        if way.margin_joint is not None:
            robot = self._session.robot
            distance = format_quantity(way.margin, joint_kind(robot, way.margin_joint), self._preferences)
            joint = tr(robot.joint_names[way.margin_joint])
            sentences.append(tr("At the end {joint} is {distance} before its limit.", joint=joint, distance=distance))
        return " ".join(sentences)


def _said(name: str) -> str:
    """A goal as the list says it: the names of poses are their owner's."""
    return tr(name) if name in (_HOME, _TARGET) else name


def _short(label: str) -> str:
    """The branch in a narrow column: "right, no-flip, up" for "right shoulder, wrist no-flip, elbow up"."""
    return tr(", ").join(tr(_SHORT.get(word, word)) for word in label.split(", "))
