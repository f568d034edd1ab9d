"""The trajectory: a path of a source or a shape of one's own, where it lies, how the tool is turned, and Track."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path as FilePath

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QFileDialog, QGroupBox, QLabel, QVBoxLayout

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, Shape, TrajectoryTask
from rvsim.experiment.shapes import FormulaShape, PointsShape
from rvsim.gui.panels.path_orientation import OrientationRows
from rvsim.gui.panels.path_place import PlaceRows
from rvsim.gui.panels.path_plane import PlaneRows
from rvsim.gui.panels.path_shape_formulas import FormulaRows
from rvsim.gui.panels.path_shape_points import MOST_POINTS, PointRows
from rvsim.gui.panels.path_shape_rows import ShapeRows
from rvsim.gui.path_drag import PathDrag
from rvsim.gui.path_preview import PathPreview
from rvsim.gui.point_clicks import PointClicks
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.undo_words import trajectory_words
from rvsim.gui.widgets import button, combo, form, silence
from rvsim.lab.named_paths import named_path, path_entry, path_names
from rvsim.lab.shape_paths import SHAPES, is_shape, shape_of
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_NEEDS_HEIGHT = "letter-scaled"  # its source gives no height
_FILE = "file"

Editor = ShapeRows | FormulaRows | PointRows


class TrajectorySection(QGroupBox):
    """What is drawn, with its numbers, what is known about it, and Track trajectory."""

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        tracker: PathTracker,
        preview: PathPreview,
        drag: PathDrag | None,
        clicks: PointClicks | None = None,
    ) -> None:
        super().__init__(tr("Trajectory"))
        self._session, self._preferences, self._preview = session, preferences, preview
        self._clicks = clicks
        self._editor: Editor | None = None
        self._edited: tuple[type[Shape], str] | None = None  # what the editor is for: the kind, and the arm's unit
        self.selector = combo("trajectory_selector", tr("Trajectory"))
        self.selector.activated.connect(self._on_chosen)
        self.turned = OrientationRows(session, preferences)
        self.orientation = self.turned.choice
        self.lies = PlaneRows(session, preferences)
        self.lies.edited.connect(self._put)
        self.lies_label = QLabel()
        self.place = PlaceRows(session, preferences, drag)
        for rows in (self.turned, self.place):
            rows.edited.connect(self._put)
        self.plane = QuantityBox("length", preferences, tr("Height of the drawing plane"))
        self.plane.setObjectName("trajectory_height")
        self.plane.quantity_changed.connect(self._on_height)
        self.plane.refused.connect(session.warn)
        self.plane.editingFinished.connect(session.end_stroke)
        self.plane_label = QLabel(tr("Height"))
        self.notes = QLabel(wordWrap=True)
        set_role(self.notes, role="muted")
        self.reach = QLabel(wordWrap=True)
        self.reach.setObjectName("reach_label")
        tip = tr("Solve the trajectory and move the tool along it (Ctrl+T)")
        self.button = button(
            "track_trajectory_button", tr("Track trajectory"), tip, tracker.track_trajectory, primary=True
        )
        self._lay_out()
        preview.changed.connect(self._show_reach)
        self._show_reach()

    def _lay_out(self) -> None:
        self._editor_place = QVBoxLayout()
        rows = form()
        rows.addRow(self.selector)
        rows.addRow(self.notes)
        rows.addRow(self._editor_place)
        rows.addRow(self.plane_label, self.plane)
        rows.addRow(self.lies_label, self.lies)
        rows.addRow(self.lies.corners)
        rows.addRow(tr("Middle"), self.place)
        rows.addRow(tr("Tool"), self.turned)
        rows.addRow(self.reach)
        rows.addRow(self.button)
        self.setLayout(rows)

    def show_task(self, experiment: Experiment) -> None:
        """Show the trajectory of the experiment."""
        task, robot = experiment.trajectory, experiment.robot
        self._show_choices(robot, task)
        self.notes.setText("" if is_shape(task) else _known_about(task.name))
        self.notes.setVisible(bool(self.notes.text()))
        self._show_shape(robot, task)
        self.place.show_task(experiment)
        self.lies.show_task(experiment)
        self.lies_label.setText(self.lies.label)
        for shown in (self.lies, self.lies_label):
            shown.setVisible(bool(self.lies.label))
        self.turned.show_task(experiment)
        self.plane.set_kind(length_kind(robot))
        self.plane.set_quantity(task.height)
        for widget in (self.plane, self.plane_label):
            widget.setVisible(task.name == _NEEDS_HEIGHT)

    def _show_choices(self, robot: Robot, task: TrajectoryTask) -> None:
        """The sources' own for this arm, then the shapes, then a file."""
        own = [name for name in path_names(robot) if name not in ("line", *SHAPES)]
        with QSignalBlocker(self.selector):
            self.selector.clear()
            for name in own:
                self.selector.addItem(tr(path_entry(name).title), name)
            if own:
                self.selector.insertSeparator(len(own))
            for name, kind in SHAPES.items():
                self.selector.addItem(tr(kind.title), name)
            self.selector.addItem(tr("CSV file…"), _FILE)
            self.selector.setCurrentIndex(self.selector.findData(task.name))

    def _show_shape(self, robot: Robot, task: TrajectoryTask) -> None:
        shape = shape_of(robot, task) if is_shape(task) else None
        wanted = None if shape is None else (type(shape), robot.length_unit)
        if wanted != self._edited:
            self._change_editor(shape, robot)
            self._edited = wanted
        if shape is not None and self._editor is not None:
            if isinstance(self._editor, PointRows):
                self._editor.is_example = task.shape is None
            self._editor.show_shape(shape)

    def _change_editor(self, shape: Shape | None, robot: Robot) -> None:
        if self._clicks is not None:
            self._clicks.switch(False)
        if self._editor is not None:
            silence(self._editor)
            self._editor.setParent(None)
            self._editor.deleteLater()
            self._editor = None
        if shape is None:
            return
        self._editor = _editor_of(shape, robot, self._preferences, self._clicks)
        self._editor.edited.connect(self._on_shape)
        self._editor.refused.connect(self._session.warn)
        self._editor.finished.connect(self._session.end_stroke)
        self._editor_place.addWidget(self._editor)

    def _show_reach(self) -> None:
        reach, problem = self._preview.reach, self._preview.problem
        self.reach.setText(problem or (reach.text if reach is not None else ""))
        level = (
            "error" if problem else "" if reach is None or reach.share is None else "good" if reach.good else "warning"
        )
        set_role(self.reach, level=level)
        self.reach.setVisible(bool(self.reach.text()))

    # --- edits -----------------------------------------------------------------------------------------------------

    def _on_chosen(self, index: int) -> None:
        name = self.selector.itemData(index)
        if name == _FILE:
            self._choose_file()
        elif name != self._session.experiment.trajectory.name:
            title = SHAPES[name].title if name in SHAPES else path_entry(name).title
            self._put(TrajectoryTask(name), "", tr("Trajectory: {name}", name=tr(title)))

    def _choose_file(self) -> None:
        """Ask for a file; its points become the table, to be changed like typed ones."""
        self.selector.setCurrentIndex(self.selector.findData(self._session.experiment.trajectory.name))
        filters = tr("Tables of points (*.csv *.txt *.tsv);;All files (*)")
        dialog = QFileDialog(self, tr("Points x, y, z"), "", filters)
        dialog.setObjectName("path_file_dialog")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.fileSelected.connect(self.load_file)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def load_file(self, file: str) -> None:
        """The points of a CSV file as they are, or a sentence that says why not."""
        try:
            points = _file_points(file, self._session.robot)
        except (RvsimError, OSError) as problem:
            self._session.say(str(problem), "error")
            return
        if len(points) > MOST_POINTS:
            self._session.say(
                tr(
                    "{name} has {count} points; a path has at most {most}.",
                    name=FilePath(file).name,
                    count=len(points),
                    most=MOST_POINTS,
                ),
                "error",
            )
            return
        task = TrajectoryTask("points", "source", shape=PointsShape(points, "none" if len(points) > 2 else "lines"))
        self._put(task, "", tr("Points of {name}", name=FilePath(file).name))

    def _on_shape(self, shape: Shape, merge: str) -> None:
        self._put(replace(self._session.experiment.trajectory, shape=shape), merge)

    def _on_height(self, value: float) -> None:
        self._put(replace(self._session.experiment.trajectory, height=value), "trajectory height")

    def _put(self, task: TrajectoryTask, merge: str, text: str = "") -> None:
        text = text or trajectory_words(self._session.experiment.trajectory, task)
        self._session.edit(text, replace(self._session.experiment, trajectory=task), merge=merge)


def _editor_of(shape: Shape, robot: Robot, preferences: Preferences, clicks: PointClicks | None) -> Editor:
    if isinstance(shape, FormulaShape):
        return FormulaRows(robot, preferences)
    if isinstance(shape, PointsShape):
        return PointRows(robot, preferences, clicks)
    return ShapeRows(type(shape), robot, preferences)


def _known_about(name: str) -> str:
    return "" if name.lower().endswith(".csv") else tr(path_entry(name).citation)


def _file_points(file: str, robot: Robot) -> FloatArray:
    return named_path(file, robot, orientation="free").points
