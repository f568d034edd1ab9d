"""The Singular page: how near the arm is to a singularity, which one, what is lost, and ways to see it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QGridLayout, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.gui.formula_view import Typesetter
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_singular_arms import ArmBlock, PlanarBlock, SourceBlock, WristBlock
from rvsim.gui.panels.inspect_singular_families import FamilyList
from rvsim.gui.panels.inspect_singular_scene import ellipse_row_items, ellipsoids_at_tool, lost_items
from rvsim.gui.panels.inspect_singular_widgets import LightLabel, SigmaBars
from rvsim.gui.panels.inspect_singular_words import (
    ALL_ROWS,
    MEASURES,
    PLACE,
    TASK_TITLES,
    bars_sentence,
    light_of,
    lost_sentence,
    measure_texts,
    refusal,
    scale_sentence,
    verdict_sentence,
)
from rvsim.gui.panels.inspect_sources_button import SourcesButton
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, column_of, combo, scrolled
from rvsim.kinematics import (
    LostMotion,
    Measures,
    SingularFamily,
    Singularity,
    families_known,
    forward_kinematics,
    go_to_singularity,
    lost_motions,
    singular_families,
    singularity,
    task_rows,
)
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import original_name

_THRESHOLD = 0.01
_THRESHOLD_TIP = tr_later(
    "Below this σ min / σ max the light says “close”. The ratio, and not σ min itself, because it does not grow with "
    "the arm: of all poses of a six-axis arm some one in eight is below 0.01."
)
_ALL, _RIGHT = Qt.AlignmentFlag(0), Qt.AlignmentFlag.AlignRight  # of a cell
_PARTS = {"linear": tr_later("moving (v)"), "angular": tr_later("turning (ω)")}
_NO_FAMILY = tr_later("This arm has no singularity of its task: J keeps its rank everywhere.")
_PLACE_ONLY = tr_later("Of its pose this arm has none: J keeps its rank everywhere. Its place alone can be singular:")
_UNKNOWN = tr_later("No family is known for the shape of this arm; the numbers above hold all the same.")


class SingularPage(InspectPage):
    """Judges the present pose."""

    title = tr_later("Singular")
    name = "inspect_singular"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._robot: Robot | None = None
        self.block: ArmBlock | None = None
        self.typesetter = Typesetter(self)
        self._make_verdict()
        self._make_ellipsoids()
        self.families = FamilyList(self.typesetter, preferences)
        self.families.asked.connect(self.go_to)
        self.sources = SourcesButton("singularity", self)
        self._lay_out()

    def _make_verdict(self) -> None:
        self.light, self.bars, self.bars_note = LightLabel(), SigmaBars(), wrapped_label("muted")
        self.reason, self.lost = wrapped_label("muted"), wrapped_label()
        self.lost.setObjectName("singular_lost")
        set_role(self.lost, level="error")
        self.threshold = QuantityBox("number", self._preferences, tr("Close below this σ min / σ max"))
        self.threshold.setObjectName("singular_threshold")
        self.threshold.setToolTip(tr(_THRESHOLD_TIP))
        self.threshold.set_range(0.0, 1.0)
        self.threshold.set_quantity(_THRESHOLD)
        self.threshold.quantity_changed.connect(lambda _: self._refresh_if_seen())
        self.heads = (QLabel(), QLabel())
        self.cells = [(QLabel(), QLabel()) for _ in MEASURES]

    def _make_ellipsoids(self) -> None:
        self.velocity, self.force = QCheckBox(tr("Velocity")), QCheckBox(tr("Force"))
        self.parts = combo("singular_part", tr("Which rows of J the ellipsoid shows"), _PARTS)
        for box, name, tip in (
            (self.velocity, "velocity", tr("Draw how fast the tool can move in each direction")),
            (self.force, "force", tr("Draw how hard the tool can push in each direction: hard where it moves badly")),
        ):
            box.setObjectName(f"singular_{name}")
            box.setToolTip(tip)
            box.toggled.connect(lambda _: self._refresh_if_seen())
        self.parts.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        self.scale = wrapped_label("muted")
        self.scale.setObjectName("singular_scale")

    # --- layout ----------------------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        inside = QWidget()
        self._column = QVBoxLayout(inside)
        self._column.setContentsMargins(12, 8, 12, 12)
        self._column.setSpacing(6)
        for widget in (self.light, self.lost, self.reason):
            self._column.addWidget(widget)
        self._column.addSpacing(4)
        self._column.addLayout(self._table())
        self._column.addWidget(self.bars)
        self._column.addWidget(self.bars_note)
        self._column.addLayout(self._threshold_row())
        self._add_section(tr("Ellipsoids at the tool"), self._ellipsoid_row(), self.scale)
        self._add_section(tr("Singularities of this arm"), self.families)
        self._column.addSpacing(12)
        self._place = QVBoxLayout()
        self._column.addLayout(self._place)
        self._column.addWidget(self.sources)
        self._column.addStretch(1)
        column_of(self, scrolled(inside))

    def _add_section(self, title: str, *widgets: QWidget) -> None:
        head = wrapped_label("title")
        head.setText(title)
        self._column.addSpacing(10)
        for widget in (head, *widgets):
            self._column.addWidget(widget)

    def _table(self) -> QGridLayout:
        grid = QGridLayout()
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(2)
        grid.setColumnStretch(0, 1)
        for column, head in enumerate(self.heads, start=1):
            set_role(head, role="muted")
            grid.addWidget(head, 0, column, _RIGHT)
        for row, ((title, tip), cells) in enumerate(zip(MEASURES, self.cells, strict=True), start=1):
            name = ElidedLabel()
            name.setText(tr(title))
            for column, label in enumerate((name, *cells)):
                label.setToolTip(tr(tip))
                grid.addWidget(label, row, column, _RIGHT if column else _ALL)
            cells[0].setObjectName(f"singular_measure_{row}")
        return grid

    def _threshold_row(self) -> QHBoxLayout:
        row, label = QHBoxLayout(), wrapped_label("muted")
        label.setText(tr("Close below σ min / σ max ="))
        label.setToolTip(tr(_THRESHOLD_TIP))
        self.threshold.setMaximumWidth(90)
        row.addWidget(label, 1)
        row.addWidget(self.threshold)
        return row

    def _ellipsoid_row(self) -> QWidget:
        widget = QWidget()
        row = QHBoxLayout(widget)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(10)
        row.addWidget(self.velocity)
        row.addWidget(self.force)
        row.addWidget(self.parts, 1)
        return widget

    # --- what is shown ---------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Judge the present pose."""
        robot, q = self._session.robot, self._session.q
        if robot is not self._robot:
            self._take_robot(robot)
        found = singularity(robot, q)
        self._show_verdict(found)
        self._show_numbers(found)
        self.families.show_pose(q, (*found.families, *found.position_families), robot)
        if self.block is not None:
            self.block.show_pose(robot, q)
        kinds = self.kinds
        self.scale.setText(scale_sentence(robot, self.part, kinds, self._preferences))
        self.scale.setVisible(bool(kinds))
        self._draw(found)

    @property
    def kinds(self) -> tuple[str, ...]:
        """Which ellipsoids are drawn."""
        boxes = {"velocity": self.velocity, "force": self.force}
        return tuple(kind for kind, box in boxes.items() if box.isChecked())

    @property
    def part(self) -> str:
        """Which rows of J they show."""
        return str(self.parts.currentData())

    def _take_robot(self, robot: Robot) -> None:
        self._robot = robot
        self.sources.offer(robot)
        rows = len(task_rows(robot))
        own, other = (TASK_TITLES[rows], PLACE) if rows == 6 else (TASK_TITLES[rows], ALL_ROWS)
        for head, (text, tip) in zip(self.heads, (own, other), strict=True):
            head.setText(tr(text))
            head.setToolTip(tr(tip))
        self.bars_note.setText(bars_sentence(robot, rows))
        self.families.show_families(singular_families(robot), _families_note(robot))
        if self.block is not None:
            self._place.removeWidget(self.block)
            self.block.hide()
            self.block.deleteLater()
        self.block = _block_for(robot, self.typesetter)
        if self.block is not None:
            self.block.go.connect(self._go)
            self.block.changed.connect(self._refresh_if_seen)
            self._place.addWidget(self.block)

    def _show_verdict(self, found: Singularity) -> None:
        light = light_of(found, self.threshold.quantity)
        names = tr(", ").join(family.short_title for family in found.families or found.position_families)
        self.light.show_light(light, names)
        lost = lost_sentence(_lost(found), _judged(found), found.robot, self._preferences)
        for label, text in ((self.lost, lost), (self.reason, verdict_sentence(found))):
            label.setText(text)
            label.setVisible(bool(text))
        self.bars.show_values(found.task.singular_values, self.threshold.quantity, light.level)

    def _show_numbers(self, found: Singularity) -> None:
        for column, measures in enumerate((found.task, _other(found))):
            for row, text in enumerate(measure_texts(measures)):
                self.cells[row][column].setText(text)

    def _draw(self, found: Singularity) -> None:
        if not self.seen:
            return
        palette = self._stage.palette
        items = lost_items(found, _lost(found), palette)
        items += ellipsoids_at_tool(found, self.part, self.kinds, palette)
        if isinstance(self.block, PlanarBlock) and self.block.ellipses.isChecked():
            items += ellipse_row_items(found.robot, found.q, palette)
        self.draw(items)

    # --- ways into a singularity -----------------------------------------------------------------------------------

    def go_to(self, family: SingularFamily) -> None:
        """Move the arm to a near pose of a family; outside the limits only where they are ignored."""
        robot, session = self._session.robot, self._session
        way = go_to_singularity(robot, family, session.q)
        q = way.outside if way.q is None and session.experiment.ignore_limits else way.q
        problem = "" if q is not None else refusal(robot, way, self._preferences)
        self.families.show_problem(family, problem)
        if q is None:
            session.warn(problem)
            return
        self._go(q, tr("Go to the {singularity}", singularity=family.title))

    def _go(self, q: FloatArray, text: str) -> None:
        self._session.move_to(q, text)


def _lost(found: Singularity) -> tuple[LostMotion, ...]:
    T = forward_kinematics(found.robot, found.q)
    turning = found.J[3:].T[found.robot.is_revolute]
    return lost_motions(_judged(found), found.robot.size, np.concatenate([np.eye(3), T[:3, :3].T, turning]))


def _judged(found: Singularity) -> Measures:
    """The numbers of the arm's own task; those of the place where it alone is singular."""
    return found.task if found.task.lost is not None else found.position


def _other(found: Singularity) -> Measures:
    return found.position if found.task is found.whole else found.whole


def _families_note(robot: Robot) -> str:
    """What the list of families does not say itself."""
    families = singular_families(robot)
    if any(family.part == "pose" for family in families):
        return ""
    if families:
        return tr(_PLACE_ONLY)
    return tr(_NO_FAMILY if families_known(robot) else _UNKNOWN)


def _block_for(robot: Robot, typesetter: Typesetter) -> ArmBlock | None:
    """The block of this arm, or of the arm that it is an edited copy of, if that has one."""
    makers: dict[tuple[str, int], Callable[[], ArmBlock]] = {
        ("rv-m1", 5): lambda: SourceBlock(typesetter),  # its barriers are where joints stop
        ("planar", 2): PlanarBlock,
    }
    maker = makers.get((original_name(robot), robot.dof))
    if maker is not None and np.isfinite(robot.limits).all():
        return maker()
    if families_known(robot) and isinstance(closed_form(robot), SphericalWrist):
        return WristBlock(typesetter)
    return None
