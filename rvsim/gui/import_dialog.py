"""Import: a table of joints or points, which column is what, in which unit, and what is to be made of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QDialog,
    QFileDialog,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rvsim.errors import PathFileError, RvsimError
from rvsim.experiment import TrajectoryTask
from rvsim.experiment.shapes import PointsShape
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import button, combo, form, select
from rvsim.lab.table_file import Column, ColumnUnit, RawTable, column_for, raw_table, read_text, table_values
from rvsim.lab.table_import import (
    TIME,
    Content,
    Wanted,
    guessed_columns,
    guessed_content,
    guessed_unit,
    joints_in,
    moves_through,
    times_in,
    wanted_columns,
)
from rvsim.language import tr, tr_later, trn
from rvsim.motion.recorded import motion_through
from rvsim.robot.arrays import FloatArray

_CONTENTS = {"joints": tr_later("Joints of the arm"), "points": tr_later("Points of the tool")}
_DELIMITERS = {",": tr_later("Comma"), ";": tr_later("Semicolon"), "\t": tr_later("Tab"), " ": tr_later("Blanks")}
_ANGLES = {"deg": tr_later("degrees"), "rad": tr_later("radians")}
_LENGTHS = {"mm": tr_later("millimetres"), "m": tr_later("metres"), "unit": tr_later("the arm's unit")}
_USES = {
    "joints": {
        "motion": tr_later("Play it as one motion"),
        "program": tr_later("Joint moves, behind those of the program"),
    },
    "points": {
        "path": tr_later("The trajectory to track"),
        "program": tr_later("Lines, behind the moves of the program"),
    },
}
_NO_TIME = -1
_PREVIEW_ROWS = 8
_IN_A_ROW = 3
_MOST_POINTS = 20_000
_FILES = tr_later("Tables (*.csv *.txt *.tsv);;All files (*)")


def ask_import(parent: QWidget, session: Session, motion: MotionControl, tracker: PathTracker) -> None:
    """Ask for a file and open the dialog for it; a file without a table is told of in the status line."""
    file, _ = QFileDialog.getOpenFileName(parent, tr("Import joints or points"), str(Path.home()), tr(_FILES))
    if file:
        open_import(parent, session, motion, tracker, Path(file))


def open_import(
    parent: QWidget, session: Session, motion: MotionControl, tracker: PathTracker, file: Path
) -> ImportDialog | None:
    """Open the dialog for a file; None, and a sentence, where it holds no table."""
    try:
        dialog = ImportDialog(parent, session, motion, tracker, file)
    except (PathFileError, OSError) as problem:
        session.say(str(problem), "error")
        return None
    dialog.open()
    return dialog


class ImportDialog(QDialog):
    """Guesses all of it from the header and the first rows; what is chosen is tried at once on the whole file.

    Raises:
        PathFileError: the file holds no table.
        OSError: it cannot be read.
    """

    def __init__(
        self, parent: QWidget, session: Session, motion: MotionControl, tracker: PathTracker, file: Path
    ) -> None:
        super().__init__(parent)
        self.setObjectName("import_dialog")
        self.setWindowTitle(tr("Import {file}", file=file.name))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._session, self._motion, self._tracker = session, motion, tracker
        self._robot, self._path, self._text = session.robot, file, read_text(file)
        self.table: RawTable = raw_table(file, self._text)
        self._boxes: list[QComboBox] = []
        self._make_choices()
        self._lay_out()
        select(self.content_box, guessed_content(self._robot, self.table))
        self._show_table()

    # --- assembly --------------------------------------------------------------------------------------------------

    def _make_choices(self) -> None:
        self.content_box = combo("import_content", tr("What the file holds"), _CONTENTS)
        self.delimiter_box = combo("import_delimiter", tr("What separates the columns"), _DELIMITERS)
        self.header = QCheckBox(tr("The first row names the columns"))
        self.header.setObjectName("import_header")
        self.header.setChecked(self.table.has_header)
        self.angle_box = combo("import_angle_unit", tr("Unit of the angles"), _ANGLES)
        self.length_box = combo("import_length_unit", tr("Unit of the lengths"), _LENGTHS)
        self.time_box = combo("import_time", tr("Column of the time"))
        self.use_box = combo("import_use", tr("What is made of it"))
        select(self.delimiter_box, self.table.delimiter)
        self.content_box.activated.connect(lambda _: self._show_columns())
        self.delimiter_box.activated.connect(lambda _: self._reread())
        self.header.clicked.connect(lambda _: self._reread())
        for box in (self.angle_box, self.length_box, self.time_box, self.use_box):
            box.activated.connect(lambda _: self._try())

    def _lay_out(self) -> None:
        self.preview = QTableWidget()
        self.preview.horizontalHeader().setMinimumSectionSize(24)  # Qt's own is the widest letter of the font
        self.preview.setObjectName("import_preview")
        self.preview.setAccessibleName(tr("First rows of the file"))
        self.preview.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.preview.setMinimumHeight(150)
        self.preview.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.summary = wrapped_label("muted")
        self.summary.setObjectName("import_summary")
        self._mapping = QGridLayout()
        self._mapping.setSpacing(6)
        self._angle_label, self._length_label, self._time_label = (
            QLabel(tr("Angles")),
            QLabel(tr("Lengths")),
            QLabel(tr("Time")),
        )
        rows = form()
        rows.addRow(tr("Columns"), self.delimiter_box)
        rows.addRow("", self.header)
        rows.addRow(tr("Holds"), self.content_box)
        rows.addRow(self._mapping)
        rows.addRow(self._angle_label, self.angle_box)
        rows.addRow(self._length_label, self.length_box)
        rows.addRow(self._time_label, self.time_box)
        rows.addRow(tr("Make it"), self.use_box)
        self.import_button = button("import_start", tr("Import"), tr("Take it in"), self.take, primary=True)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        buttons.addWidget(self.import_button)
        buttons.addWidget(button("import_cancel", tr("Cancel"), tr("Leave everything as it is"), self.reject))
        column = QVBoxLayout(self)
        column.setSpacing(8)
        column.addWidget(self.preview, 1)
        column.addLayout(rows)
        column.addWidget(self.summary)
        column.addLayout(buttons)
        self.resize(460, 560)

    # --- what is chosen --------------------------------------------------------------------------------------------

    @property
    def content(self) -> Content:
        """What the file holds."""
        return "joints" if self.content_box.currentData() == "joints" else "points"

    @property
    def wanted(self) -> tuple[Wanted, ...]:
        """The values of a row."""
        return wanted_columns(self._robot, self.content)

    @property
    def columns(self) -> tuple[Column, ...]:
        """Where each value stands, and its unit."""
        pairs = zip(self.wanted, self._boxes, strict=True)
        return tuple(Column(box.currentData(), wanted.name, self._unit(wanted)) for wanted, box in pairs)

    def _unit(self, wanted: Wanted) -> ColumnUnit:
        box = self.angle_box if wanted.unit == "deg" else self.length_box
        unit: ColumnUnit = box.currentData()
        return unit

    @property
    def use(self) -> str:
        """What is to be made of it: "motion", "program" or "path"."""
        return str(self.use_box.currentData())

    def _reread(self) -> None:
        """The same text with another separator, or another first row."""
        try:
            delimiter = self.delimiter_box.currentData()
            self.table = raw_table(self._path, self._text, delimiter, self.header.isChecked())
        except PathFileError as problem:
            self._say(str(problem), bad=True)
            return
        self._show_table()

    def _show_table(self) -> None:
        rows = self.table.rows[:_PREVIEW_ROWS]
        self.preview.setColumnCount(len(self.table.names))
        self.preview.setRowCount(len(rows))
        self.preview.setHorizontalHeaderLabels(list(self.table.names))
        self.preview.setVerticalHeaderLabels([str(row.number) for row in rows])
        for r, row in enumerate(rows):
            for c in range(len(self.table.names)):
                self.preview.setItem(r, c, QTableWidgetItem(row.cells[c] if c < len(row.cells) else ""))
        self.preview.resizeColumnsToContents()
        self._show_columns()

    def _show_columns(self) -> None:
        """A box for each value that is wanted, at the column that is most likely."""
        while self._mapping.count():
            item = self._mapping.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.setParent(None)  # gone at once for whoever looks a box up by its name
                widget.deleteLater()
        guesses = guessed_columns(self.table, self.wanted)
        self._boxes = [self._column_box(number, guess) for number, guess in enumerate(guesses)]
        for number, (wanted, box) in enumerate(zip(self.wanted, self._boxes, strict=True)):
            label = QLabel(wanted.name)
            set_role(label, role="muted")
            row, place = divmod(number, _IN_A_ROW)
            self._mapping.addWidget(label, row, 2 * place)
            self._mapping.addWidget(box, row, 2 * place + 1)
            self._mapping.setColumnStretch(2 * place + 1, 1)
        self._show_units(guesses)
        self._show_times()
        with QSignalBlocker(self.use_box):
            self.use_box.clear()
            for use, text in _USES[self.content].items():
                self.use_box.addItem(tr(text), use)
        self._try()

    def _column_box(self, number: int, guess: int) -> QComboBox:
        names = dict(enumerate(self.table.names))
        box = combo(f"import_column_{number + 1}", tr("Column of {value}", value=self.wanted[number].name))
        box.setMinimumContentsLength(4)
        for index, name in names.items():
            box.addItem(name, index)
        box.setCurrentIndex(guess)
        box.activated.connect(lambda _: self._try())
        return box

    def _show_units(self, guesses: tuple[int, ...]) -> None:
        pairs = zip(guesses, self.wanted, strict=True)
        units = {wanted.unit: guessed_unit(self.table, at, wanted) for at, wanted in pairs}
        for box, label, known in (
            (self.angle_box, self._angle_label, _ANGLES),
            (self.length_box, self._length_label, _LENGTHS),
        ):
            found = [unit for wanted, unit in units.items() if wanted in known]
            box.setVisible(bool(found))
            label.setVisible(bool(found))
            if found and found[0] in known:
                select(box, found[0])

    def _show_times(self) -> None:
        joints = self.content == "joints"
        self.time_box.setVisible(joints)
        self._time_label.setVisible(joints)
        with QSignalBlocker(self.time_box):
            self.time_box.clear()
            self.time_box.addItem(tr("none: at the arm's own pace"), _NO_TIME)
            for index, name in enumerate(self.table.names):
                self.time_box.addItem(name, index)
            guess = column_for(self.table, TIME.spellings)
            self.time_box.setCurrentIndex(0 if guess is None else guess + 1)

    # --- trying and taking -----------------------------------------------------------------------------------------

    def _try(self) -> None:
        """Read all of it, and say what it is or where it is spoilt."""
        try:
            values = self._values()
            if self.use == "program":
                moves_through(self.table, values, self.content)
            elif self.content == "joints":
                self._times()
        except PathFileError as problem:
            self._say(str(problem), bad=True)
            return
        count = len(values)
        joints = self.content == "joints"
        self._say(
            trn("{n} pose.", "{n} poses.", count) if joints else trn("{n} point.", "{n} points.", count), bad=False
        )

    def _values(self) -> FloatArray:
        if self.content == "points":
            return table_values(self.table, self.columns)
        ignore = self._session.experiment.ignore_limits
        return joints_in(self.table, self.columns, self._robot, ignore_limits=ignore)

    def _times(self) -> FloatArray | None:
        index = self.time_box.currentData()
        return None if index == _NO_TIME else times_in(self.table, Column(index, "t", "s"))

    def _say(self, sentence: str, *, bad: bool) -> None:
        self.summary.setText(sentence)
        set_role(self.summary, role="" if bad else "muted", level="error" if bad else "")
        self.import_button.setEnabled(not bad)

    def take(self) -> None:
        """Make of it what was chosen, undoably, and close."""
        if self._session.robot is not self._robot:
            self._say(tr("Another arm is in use now: open the file again."), bad=True)
            return
        try:
            {"motion": self._take_motion, "program": self._take_program, "path": self._take_path}[self.use]()
        except RvsimError as problem:
            self._say(str(problem), bad=True)
            return
        self.accept()

    def _take_motion(self) -> None:
        experiment, q = self._session.experiment, self._values()
        motion = motion_through(self._robot, experiment.q, q, self._times(), law=experiment.law)
        self._tracker.cancel()
        self._tracker.clear()
        self._motion.load(motion, tr("Play {file}", file=self._path.name))
        self._motion.play()
        self._session.say(
            trn(
                "{n} pose from {file}, {duration:.1f} s.",
                "{n} poses from {file}, {duration:.1f} s.",
                len(q),
                file=self._path.name,
                duration=motion.duration,
            )
        )

    def _take_program(self) -> None:
        moves = moves_through(self.table, self._values(), self.content)
        experiment = self._session.experiment
        self._session.edit(
            tr("Import {file}", file=self._path.name), replace(experiment, program=(*experiment.program, *moves))
        )
        self._session.say(
            trn(
                "{n} move from {file}, behind those of the program.",
                "{n} moves from {file}, behind those of the program.",
                len(moves),
                file=self._path.name,
            )
        )

    def _take_path(self) -> None:
        points = self._values()
        if len(points) > _MOST_POINTS:
            raise PathFileError(
                self._path,
                tr("the file"),
                trn("{n} point", "{n} points", len(points)),
                tr("at most {most} for a path", most=_MOST_POINTS),
            )
        task = TrajectoryTask("points", "source", shape=PointsShape(points, "none" if len(points) > 2 else "lines"))
        self._session.edit(
            tr("Import {file}", file=self._path.name), replace(self._session.experiment, trajectory=task)
        )
        self._session.say(
            trn(
                "{n} point from {file}: track the trajectory to see what is reached.",
                "{n} points from {file}: track the trajectory to see what is reached.",
                len(points),
                file=self._path.name,
            )
        )
