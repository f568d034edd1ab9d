"""The workspace page: where the tool can go, sampled or asked beside the window, as a map and in the scene."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPixmap, QStandardItemModel
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QProgressBar,
    QVBoxLayout,
    QWidget,
)

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment
from rvsim.files.atomic import write_atomically
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.folding_row import FoldingGrid, FoldingRow, group_of
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_workspace_query import PointQuery
from rvsim.gui.panels.inspect_workspace_survey import Survey, survey_parts
from rvsim.gui.panels.inspect_workspace_words import (
    COLORS,
    EMPTY,
    FIGURES,
    LIMITS,
    ORIENTATIONS,
    POSES,
    SECTIONS,
    axis_titles,
    cloud_shares,
    done_sentence,
    map_csv,
    refusal,
    section_sentence,
    task_of,
    values_of,
)
from rvsim.gui.parts_worker import PartsWorker
from rvsim.gui.picture import save_image
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, display, format_number, length_kind
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.widgets import button, column_of, combo, scrolled, select, show_whole
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.workspace import SectionMap
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.robot.arrays import FloatArray
from rvsim.scene.cloud import cloud_items, section_items
from rvsim.scene.primitives import Item

if TYPE_CHECKING:
    from rvsim.gui.panels.inspect_workspace_map import ScaleBar, SectionPlot

_POINT = tr_later("Point at the map for the place there; click to ask for it below.")
_GAP = 6  # [pixels]
_BESIDE = 0.02  # of the map's width: how far the tool may stand beside the plane of a section and still be in it


class WorkspacePage(InspectPage):
    """Choices, a button, the map; what was worked out last stays until something new is ready."""

    title = tr_later("Workspace")
    name = "inspect_workspace"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, stage, parent)
        self.survey: Survey | None = None
        self._shown: tuple[object, ...] = ()
        self._plot: SectionPlot | None = None
        self._bar: ScaleBar | None = None
        self._make_choices()
        self.query = PointQuery(session, preferences)
        self.query.asked.connect(self._refresh_if_seen)
        self.query.refused.connect(self._session.warn)
        self.pointed = wrapped_label("muted")
        self.pointed.setObjectName("workspace_pointed")
        self.worker = PartsWorker(self)
        self.worker.part.connect(self._on_part)
        worker = self.worker
        self.destroyed.connect(lambda: worker.close())
        self._offer()
        self._lay_out()
        self._show_busy(False)

    def close_worker(self) -> None:
        """End the thread, for the window closes."""
        self.worker.close()

    # --- making ------------------------------------------------------------------------------------------------------

    def _make_choices(self) -> None:
        self.orientations = combo("workspace_orientation", tr("The tool's orientation"), ORIENTATIONS)
        self.colors = combo("workspace_color", tr("What the colours mean"), COLORS)
        self.sections = combo("workspace_section", tr("Which section is shown"), SECTIONS)
        self.limits = combo("workspace_limits", tr("Joint limits"), LIMITS)
        self.poses = combo("workspace_poses", tr("How many poses are sampled"))
        for number in POSES:
            self.poses.addItem(trn("{n:,} pose", "{n:,} poses", number), number)
        select(self.poses, 1_000_000)
        for box in (self.colors, self.sections, self.limits):
            box.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        self.orientations.currentIndexChanged.connect(lambda _: self._offer())
        self.orientations.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        self.in_scene = QCheckBox(tr("Show in scene"))
        self.in_scene.setObjectName("workspace_in_scene")
        self.in_scene.setChecked(True)
        self.in_scene.toggled.connect(lambda _: self._refresh_if_seen())
        tip = tr("Work out where the tool can go, in the plane where the arm stands now")
        self.sample = button("sample_workspace_button", tr("Sample"), tip, self.start, primary=True)
        self.cancel = button(
            "cancel_workspace_button", tr("Cancel"), tr("Give up; the map stays as it was"), self.give_up
        )
        self.progress = QProgressBar()
        self.progress.setObjectName("workspace_progress")
        self.progress.setRange(0, 1000)
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(6)
        self.figure, self.place, self.state = (wrapped_label("muted") for _ in range(3))
        for label, part in ((self.figure, "figure"), (self.place, "place"), (self.state, "state")):
            label.setObjectName(f"workspace_{part}")
        self.copy = CopyButton("workspace_copy", tr("the map"), {"CSV": self._csv}, self._session)
        self.save_csv = button(
            "save_workspace_csv_button", tr("Save CSV…"), tr("Save the map's cells as a table"), self._save_csv
        )
        self.save_png = button(
            "save_workspace_png_button", tr("Save picture…"), tr("Save the map as a picture"), self._save_png
        )

    def _lay_out(self) -> None:
        boxes = (self.orientations, self.colors, self.sections, self.limits, self.poses)
        show_whole(*boxes)
        run = QHBoxLayout()
        run.addWidget(self.sample, 1)
        run.addWidget(self.cancel)
        save = FoldingRow(
            group_of(self.copy, self.save_csv, stretched=False), group_of(self.save_png, stretched=False), _GAP
        )
        inside = QWidget()
        self._column = QVBoxLayout(inside)
        self._column.setContentsMargins(12, 8, 12, 12)
        self._column.setSpacing(6)
        self._column.addWidget(FoldingGrid((*boxes, self.in_scene), _GAP))
        self._column.addLayout(run)
        for label in (self.progress, self.state, self.place, self.figure):
            self._column.addWidget(label)
        self._column.addWidget(save)
        self._column.addSpacing(8)
        self._column.addWidget(self.query)
        self._column.addStretch(0)
        column_of(self, scrolled(inside))

    def _drawn(self) -> tuple[SectionPlot, ScaleBar]:
        """The map and its scale, made when there is something to show: pyqtgraph takes its time to load."""
        if self._plot is None or self._bar is None:
            from rvsim.gui.panels.inspect_workspace_map import ScaleBar, SectionPlot

            self._plot, self._bar = SectionPlot(self._preferences), ScaleBar(self._preferences)
            self._plot.pointed.connect(self._show_pointed)
            self._plot.clicked.connect(self._on_clicked)
            at = self._column.indexOf(self.place)
            self._column.insertWidget(at, self._bar)
            self._column.insertWidget(at, self.pointed)
            self._column.insertWidget(at, self._plot, 1)
        return self._plot, self._bar

    def _offer(self) -> None:
        """Grey out what this arm cannot do, and say why."""
        robot = self._session.robot
        for box, choice, other in ((self.orientations, "fixed", "free"), (self.colors, "branches", "manipulability")):
            why = refusal(robot, choice)
            _enable(box, choice, why)
            if why and box.currentData() == choice:
                select(box, other)
        self.poses.setEnabled(self.orientations.currentData() == "free")

    # --- working it out ----------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Work out what the choices ask for."""
        boxes = {"orientation": self.orientations, "color": self.colors, "poses": self.poses, "limits": self.limits}
        choices = {name: box.currentData() for name, box in boxes.items()}
        self.worker.start(partial(survey_parts, task_of(self._session.robot, self._session.q, choices)))
        self._show_busy(True)

    def give_up(self) -> None:
        """Stop; what was shown before stays."""
        self.worker.cancel()
        self._show_busy(False)
        self._session.say(tr("Given up. The map is as it was before."))

    def _on_part(self, part: float | Survey) -> None:
        if isinstance(part, Survey):
            self._on_done(part)
        else:
            self.progress.setValue(round(1000 * part))

    def _on_done(self, survey: Survey) -> None:
        self._show_busy(False)
        if survey.workspace.task.robot is not self._session.robot:
            return
        self.survey = survey
        self._session.say(done_sentence(survey))
        self._refresh_if_seen()

    def _show_busy(self, busy: bool) -> None:
        self.progress.setValue(0)
        self.cancel.setEnabled(busy)
        self.sample.setEnabled(not busy)

    # --- showing it --------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """Another arm: another workspace."""
        if after.robot is not before.robot:
            self.worker.cancel()
            self._show_busy(False)
            self.survey = None
            self._offer()
            select(self.sections, "top" if after.robot.name == "planar" else self.sections.currentData())
        return super().concerns(before, after)

    def refresh(self) -> None:
        """The map where something new is to be seen in it, the tool in any case."""
        survey = self.survey
        held, ignored = self.orientations.currentData() == "fixed", self.limits.currentData() == "ignored"
        self.query.refresh(held=held, ignore_limits=ignored)
        for widget in (self.copy, self.save_csv, self.save_png):
            widget.setEnabled(survey is not None)
        self.figure.setText(tr(FIGURES.get(self._session.robot.name, "")))
        self.figure.setVisible(bool(self.figure.text()))
        if survey is None:
            self._show_nothing()
            return
        names = ("theme", "length_unit", "angle_unit", "extra_decimals", "presentation")
        what = (survey, self.colors.currentData(), self.sections.currentData(), self.in_scene.isChecked())
        now = (*what, *(self._preferences[name] for name in names), self.font().pointSizeF())
        if now != self._shown:
            self._shown = now
            self._show_map(survey)
            self._draw_scene(survey)
        self._show_tool()

    def set_seen(self, seen: bool) -> None:
        """Coming back, draw again what has been taken out of the scene."""
        if seen != self.seen:
            self._shown = ()
        super().set_seen(seen)

    def _at(self, u: float, v: float) -> FloatArray:
        """(3,) the place in base axes at (u, v) [m] of the map."""
        assert self.section is not None
        return self.section.place((u, v))

    def _on_clicked(self, u: float, v: float) -> None:
        """Ask about a place of the map, if there still is one: another arm has none yet."""
        if self.section is not None:
            self.query.ask(self._at(u, v))

    def _show_pointed(self, u: float, v: float) -> None:
        """Where the pointer is; nan where it has left."""
        if self.section is None or math.isnan(u):
            self.pointed.setText(tr(_POINT))
            return
        x, y, z = (format_number(value * self._length.factor, self._length.decimals) for value in self._at(u, v))
        self.pointed.setText(left_to_right(f"x {x}, y {y}, z {z}{self._length.suffix}"))

    def _show_nothing(self) -> None:
        self._shown = ()
        self.pointed.setText("")
        self.state.setText(tr(EMPTY))
        self.place.setText("")
        self.draw(())
        if self._plot is not None and self._bar is not None:
            self._plot.clear_section()
            self._bar.show_values(None)

    @property
    def section(self) -> SectionMap | None:
        """The section that is shown."""
        if self.survey is None:
            return None
        result = self.survey.workspace
        return result.side if self.sections.currentData() == "side" else result.top

    @property
    def _length(self) -> Display:
        return display(length_kind(self._session.robot), self._preferences)

    def _show_map(self, survey: Survey) -> None:
        plot, bar = self._drawn()
        section, kind = self.section, self.sections.currentData()
        assert section is not None
        values = values_of(survey, section, self.colors.currentData())
        plot.show_section(section, values, axis_titles(section, kind), self._length)
        bar.show_values(values)
        self._show_pointed(math.nan, math.nan)
        counted = self.colors.currentData() != "branches" or section.branches is not None
        self.state.setText(done_sentence(survey) if counted else tr("Press Sample again to count the branches."))
        self.place.setText(section_sentence(survey, kind, self._preferences))

    def _show_tool(self) -> None:
        section, plot = self.section, self._plot
        if section is None or plot is None:
            return
        tool = forward_kinematics(self._session.robot, self._session.q)[:3, 3]
        u, v = section.flat(tool).tolist()
        apart = float(np.linalg.norm(section.place((u, v)) - tool))
        if self.sections.currentData() == "side" and not section.projected:
            away = math.hypot(*(tool - section.origin)[:2])
            u = math.copysign(away, u)  # turned into the plane, as joint 1 would
        near = apart <= _BESIDE * float(section.grid.upper[0] - section.grid.lower[0])
        plot.show_tool(np.array([u, v]), inside=near, shown=self._length)

    def _draw_scene(self, survey: Survey) -> None:
        items: tuple[Item, ...] = ()
        if self.in_scene.isChecked():
            result, palette = survey.workspace, self._stage.palette
            items = cloud_items(result.cloud, cloud_shares(survey, self.colors.currentData()), palette)
            items += section_items(result.side, palette, key="workspace.side")
            items += section_items(result.top, palette, key="workspace.top")
        self.draw(items)

    # --- keeping it --------------------------------------------------------------------------------------------------

    def _csv(self) -> str:
        return map_csv(self.survey, self.sections.currentData(), self._length) if self.survey else ""

    def _save_csv(self) -> None:
        self._save(
            tr("Save map as CSV"),
            "csv",
            tr("Tables (*.csv)"),
            lambda file: write_atomically(file, self._csv().encode()),
        )

    def _save_png(self) -> None:
        self._save(
            tr("Save map as picture"),
            "png",
            tr("Pictures (*.png *.jpg)"),
            lambda file: save_image(self.picture(), file),
        )

    def picture(self) -> QPixmap:
        """The map with its scale, as it is seen."""
        plot, bar = self._drawn()
        whole = plot.geometry().united(bar.geometry() if bar.isVisible() else plot.geometry())
        picture = QPixmap(whole.size() * self.devicePixelRatioF())
        picture.setDevicePixelRatio(self.devicePixelRatioF())
        picture.fill(self.palette().window().color())
        with QPainter(picture) as painter:
            for widget in (plot, bar):
                if widget.isVisible():
                    painter.drawPixmap(widget.pos() - whole.topLeft(), widget.grab())
        return picture

    def _save(self, title: str, ending: str, kinds: str, write: Callable[[Path], object]) -> None:
        start = Path.home() / f"{self._session.robot.name}-workspace-{self.sections.currentData()}.{ending}"
        chosen, _ = QFileDialog.getSaveFileName(self, title, str(start), kinds)
        if not chosen:
            return
        try:
            write(Path(chosen))
        except (RvsimError, OSError) as problem:
            self._session.say(tr("Nothing was written. {problem}", problem=problem), "error")
            return
        self._session.say(tr("Saved {file}.", file=chosen))


def _enable(box: QComboBox, choice: str, why_not: str) -> None:
    """Let an entry be chosen, or say why not."""
    row = box.findData(choice)
    model = box.model()
    assert isinstance(model, QStandardItemModel)
    model.item(row).setEnabled(not why_not)
    box.setItemData(row, why_not, Qt.ItemDataRole.ToolTipRole)
