"""The sources page: what a source prints of this arm that is not right, its number here, ours, and why."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_source_grid import Grid
from rvsim.gui.panels.inspect_source_scene import printed_tool_items
from rvsim.gui.panels.inspect_source_words import (
    REMARK,
    TOPIC_TITLES,
    Sheets,
    drawn_sentence,
    full_heading,
    heading,
    nothing_known,
    pose_text,
    sheets,
    shown_as,
    verdict,
)
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, combo, scrolled
from rvsim.kinematics import forward_kinematics
from rvsim.lab.sources import Comparison, Erratum, Topic, errata, topics
from rvsim.lab.worked import Equation
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.spatial import rotation_error_angle

_SEEN_ROWS, _FEW_ROWS = 6, 4  # of the list, before it scrolls; where the page is low
_LOW = 560  # [px]
_LIST_LOOK = """
QListWidget { border: 1px solid palette(mid); border-radius: 5px; background: palette(base); }
QListWidget::item { padding: 2px 4px; }
"""
_ALL = ""
_POSE_TIP = tr_later("Go to the pose at which this shows, as in the text; undo brings the present one back")
_THERE_TIP = tr_later("The arm is at the pose of the text already")


class SourcePage(InspectPage):
    """Shows one erratum at the present pose, chosen from the list of the arm's."""

    title = tr_later("Sources")
    name = "inspect_source"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self._robot: Robot | None = None
        self._entries: tuple[Erratum, ...] = ()
        self.topics = combo("source_topics", tr("Topic of the errata"))
        self.topics.currentIndexChanged.connect(lambda _: self._offer_entries())
        self.list = QListWidget()
        self.list.setObjectName("source_errata")
        self.list.setAccessibleName(tr("What the sources print wrongly"))
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setStyleSheet(_LIST_LOOK)
        self.list.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.list.currentItemChanged.connect(lambda *_: self._refresh_if_seen())
        self.nothing = wrapped_label("muted")
        self.nothing.setObjectName("source_nothing")
        self.detail = ErratumView(session, self)
        self._lay_out()

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(8)
        for widget in (self.topics, self.list, self.nothing, self.detail):
            column.addWidget(widget)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    @property
    def chosen(self) -> Erratum | None:
        """The erratum that is shown."""
        item = self.list.currentItem()
        found = None if item is None else item.data(Qt.ItemDataRole.UserRole)
        return found if isinstance(found, Erratum) else None

    def choose(self, key: str) -> None:
        """Show another erratum of this arm, whatever topic is chosen."""
        self._offer_robot(self._session.robot)
        self.topics.setCurrentIndex(0)
        for row in range(self.list.count()):
            entry = self.list.item(row).data(Qt.ItemDataRole.UserRole)
            if isinstance(entry, Erratum) and entry.key == key:
                self.list.setCurrentRow(row)

    def choose_topic(self, topic: str) -> None:
        """Offer the errata of a topic, where this arm has some."""
        self._offer_robot(self._session.robot)
        self.topics.setCurrentIndex(max(self.topics.findData(topic), 0))

    def refresh(self) -> None:
        """Show the chosen erratum at the present pose."""
        robot, q = self._session.robot, self._session.q
        self._offer_robot(robot)
        entry = self.chosen
        self.detail.setVisible(entry is not None)
        if entry is None:
            self.draw(())
            return
        self.detail.show_entry(entry, entry.compare(robot, q), robot, self._preferences)
        self._draw_tool(entry, robot)

    def _draw_tool(self, entry: Erratum, robot: Robot) -> None:
        T = entry.printed_tool(robot, self._session.q)
        tool = forward_kinematics(robot, self._session.q)
        distance = turned = 0.0
        if T is not None:
            T = T @ robot.T_flange_tool
            distance, turned = float(np.linalg.norm(T[:3, 3] - tool[:3, 3])), _angle_between(T, tool)
        if T is None or max(distance, turned) < 1e-9:
            self.draw(())
            self.detail.say_drawn("")
            return
        title = f"{entry.source} {tr(entry.where)}"
        self.draw(printed_tool_items(T, tool, title, robot.size, self._stage.palette))
        self.detail.say_drawn(drawn_sentence(distance, turned, shown_as(robot, self._preferences)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """A low page has a short list."""
        super().resizeEvent(event)
        self._fit_list()

    # --- the list --------------------------------------------------------------------------------------------------

    def _offer_robot(self, robot: Robot) -> None:
        if robot is self._robot:
            return
        self._robot, self._entries = robot, errata(robot)
        with QSignalBlocker(self.topics):
            kept = self.topics.currentData()
            self.topics.clear()
            self.topics.addItem(trn("{n} erratum", "All {n} errata", len(self._entries)), _ALL)
            for topic in topics(robot):
                self.topics.addItem(tr(TOPIC_TITLES[topic]), topic)
            self.topics.setCurrentIndex(max(self.topics.findData(kept), 0))
        for widget in (self.topics, self.list):
            widget.setVisible(bool(self._entries))
        self.nothing.setVisible(not self._entries)
        self.nothing.setText("" if self._entries else nothing_known(robot))
        self._offer_entries()

    def _offer_entries(self) -> None:
        """The errata of the chosen topic under their topics; the same one stays chosen where it is there still."""
        kept, topic = self.chosen, self.topics.currentData()
        with QSignalBlocker(self.list):
            self.list.clear()
            for group in dict.fromkeys(entry.topic for entry in self._in_order()):
                if topic in (_ALL, group):
                    self._add_group(group, with_head=topic == _ALL)
            self._choose_again(kept)
        self._fit_list()
        self._refresh_if_seen()

    def _in_order(self) -> list[Erratum]:
        order = list(TOPIC_TITLES)
        return sorted(self._entries, key=lambda entry: order.index(entry.topic))

    def _add_group(self, topic: Topic, *, with_head: bool) -> None:
        if with_head:
            head = QListWidgetItem(tr(TOPIC_TITLES[topic]))
            head.setFlags(Qt.ItemFlag.NoItemFlags)
            self.list.addItem(head)
        for entry in (entry for entry in self._entries if entry.topic == topic):
            item = QListWidgetItem(f"{tr(entry.where)}   {tr(entry.title)}")
            item.setData(Qt.ItemDataRole.UserRole, entry)
            item.setToolTip(full_heading(entry))
            self.list.addItem(item)

    def _choose_again(self, kept: Erratum | None) -> None:
        entries = [self.list.item(row).data(Qt.ItemDataRole.UserRole) for row in range(self.list.count())]
        rows = [row for row, entry in enumerate(entries) if isinstance(entry, Erratum)]
        same = [row for row in rows if kept is not None and entries[row] is kept]
        if rows:
            self.list.setCurrentRow((same or rows)[0])

    def _fit_list(self) -> None:
        rows = min(self.list.count(), _SEEN_ROWS if self.height() >= _LOW else _FEW_ROWS)
        self.list.setFixedHeight(max(self.list.sizeHintForRow(0), 1) * rows + 2 * self.list.frameWidth())


def _angle_between(T: np.ndarray, tool: np.ndarray) -> float:
    """The angle between two rotations [rad]; half a turn for one that is a mirror."""
    if np.linalg.det(T[:3, :3]) < 0.0:
        return np.pi
    return float(rotation_error_angle(T[:3, :3], tool[:3, :3]))


class ErratumView(QWidget):
    """One erratum: the formulas, why, and the numbers of a pose."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._entry: Erratum | None = None
        typesetter = Typesetter(self)
        self.heading, self.why = wrapped_label("title"), wrapped_label()
        self.printed, self.right = EquationsView(typesetter), EquationsView(typesetter)
        self.right_head = _small(tr("Right"))
        self.verdict, self.units, self.drawn = wrapped_label(), wrapped_label("muted"), wrapped_label("muted")
        for label, part in ((self.heading, "heading"), (self.why, "why"), (self.verdict, "verdict"),
                            (self.drawn, "drawn")):  # fmt: skip
            label.setObjectName(f"source_{part}")
        self.grids = tuple(Grid(f"source_grid_{index}") for index in range(3))
        self.titles = tuple(_small("") for _ in self.grids)
        self.to_pose = button("source_pose", tr("Pose of the text"), tr(_POSE_TIP), self._go)
        self._lay_out()

    def _lay_out(self) -> None:
        here = QHBoxLayout()
        self.here = QLabel(tr("At this pose"))
        set_role(self.here, role="title")
        here.addWidget(self.here, 1)
        here.addWidget(self.to_pose)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (self.heading, _small(tr("Printed")), self.printed, self.right_head, self.right, self.why):
            column.addWidget(widget)
        column.addLayout(here)
        column.addWidget(self.verdict)
        for title, grid in zip(self.titles, self.grids, strict=True):
            column.addWidget(title)
            column.addWidget(grid)
        column.addWidget(self.units)
        column.addWidget(self.drawn)

    def show_entry(self, entry: Erratum, comparison: Comparison | None, robot: Robot, preferences: Preferences) -> None:
        """Show an erratum and, where it has numbers, the comparison at the present pose."""
        if entry is not self._entry:
            self._show_formulas(entry)
        there = bool(np.allclose(self._session.q, entry.pose, atol=1e-9))
        self.to_pose.setEnabled(not there)
        self.to_pose.setToolTip(tr(_THERE_TIP if there else _POSE_TIP))
        self.here.setText(tr("At the pose of the text") if there else tr("At this pose"))
        self.to_pose.setVisible(comparison is not None)
        self.here.setVisible(comparison is not None)
        if comparison is None:
            self._show_remark()
            return
        with_fewer = lru_cache(maxsize=None)(
            lambda fewer: sheets(entry, comparison, shown_as(robot, preferences, fewer=fewer))
        )
        for index in range(len(self.grids)):
            self._show_sheet(index, heading(entry), with_fewer)
        text, level = verdict(entry, comparison, shown_as(robot, preferences))
        self._say(text, level, with_fewer(0).units)

    def _show_sheet(self, index: int, what: str, with_fewer: Callable[[int], Sheets]) -> None:
        """Show that table of the comparison, if it has so many."""
        title, grid, made = self.titles[index], self.grids[index], with_fewer(0).sheets
        seen = index < len(made)
        name = made[index][0] if seen else ""
        grid.setVisible(seen)
        title.setVisible(bool(name))
        _set_text(title, name)
        if seen:
            grid.show_sheet(f"{what}: {name or tr('numbers')}", lambda fewer: with_fewer(fewer).sheets[index][1])

    def say_drawn(self, text: str) -> None:
        """What is drawn in the scene."""
        _set_text(self.drawn, text)
        self.drawn.setVisible(bool(text))

    def _show_formulas(self, entry: Erratum) -> None:
        self._entry = entry
        self.heading.setText(full_heading(entry))
        self.why.setText(tr(entry.why))
        self.printed.show_equations([Equation(line, "", "", "") for line in entry.printed_latex])
        self.right.show_equations([Equation(line, "", "", "") for line in entry.right_latex])
        for widget in (self.right_head, self.right):
            widget.setVisible(bool(entry.right_latex))

    def _show_remark(self) -> None:
        for widget in (*self.grids, *self.titles):
            widget.setVisible(False)
        self._say(tr(REMARK), "", "")

    def _say(self, text: str, level: str, units: str) -> None:
        _set_text(self.verdict, text)
        set_role(self.verdict, level=level)
        self.verdict.setVisible(bool(text))
        _set_text(self.units, units)
        self.units.setVisible(bool(units))

    def _go(self) -> None:
        if self._entry is not None:
            self._session.move_to(self._entry.pose, pose_text(self._entry))


def _small(text: str) -> QLabel:
    label = QLabel(text)
    set_role(label, role="muted")
    return label


def _set_text(label: QLabel, text: str) -> None:
    if label.text() != text:
        label.setText(text)
