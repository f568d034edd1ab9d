"""What each command of `ACTIONS` does. Switches are a table too: command, preference, value when on and off."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog

from rvsim.errors import RvsimError
from rvsim.files.atomic import write_atomically
from rvsim.files.program_file import is_program
from rvsim.gui.actions import shortcut_table
from rvsim.gui.file_problem import tell_problem
from rvsim.gui.panels.path_program import ProgramPage
from rvsim.gui.panels.user_robot import ask_what_to_open, ask_where_to_save, opened, saved
from rvsim.gui.picture import save_image
from rvsim.gui.quantities import format_quantity, joint_kind
from rvsim.gui.text_dialog import TextDialog
from rvsim.kinematics import forward_kinematics
from rvsim.lab.tables import tracking_csv
from rvsim.lab.texts import matrix_latex, matrix_numpy, matrix_text
from rvsim.language import left_to_right, tr

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow
    from rvsim.lab.motion_table import TableUnits


class Switch(NamedTuple):
    """A command that is on when a preference has the value `on`; switched off, the preference gets `off`."""

    preference: str
    on: Any
    off: Any


SWITCHES: dict[str, Switch] = {
    "look_stick": Switch("look", "stick", None),
    "look_solid": Switch("look", "solid", None),
    "look_both": Switch("look", "both", None),
    "show_frames": Switch("show_frames", True, False),
    "show_labels": Switch("show_labels", True, False),
    "show_floor": Switch("show_floor", True, False),
    "show_trail": Switch("show_trail", True, False),
    "show_plots": Switch("show_plots", True, False),
    "orthographic": Switch("orthographic", True, False),
    "dark": Switch("theme", "dark", "light"),
    "presentation": Switch("presentation", True, False),
    "radians": Switch("angle_unit", "rad", "deg"),
    "metres": Switch("length_unit", "m", "mm"),
    "animated": Switch("animated", True, False),
    "live": Switch("live", True, False),
}


class Commands(QObject):
    """Connects the table of actions to what they do."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window, self._session = window, window.session
        self._preferences = window.preferences

    def connect_all(self) -> None:
        """Connect every action; a command of the table without a deed is a programming error."""
        deeds = self._deeds()
        for name, action in self._window.actions_by_name.items():
            if name in SWITCHES:
                action.toggled.connect(self._switcher(name))
            elif name not in ("undo", "redo"):
                deed = deeds[name]
                action.triggered.connect(lambda _checked=False, deed=deed: deed())
        self._preferences.changed.connect(self._show_switches)
        self._session.changed.connect(lambda *_: self._show_ignore())
        self._session.tracking_changed.connect(lambda *_: self._show_enabled())
        self._window.motion.state_changed.connect(lambda *_: self._show_enabled())
        self._window.motion.loaded.connect(self._show_enabled)
        self._window.gizmo.axes_switched.connect(self._window.actions_by_name["tool_axes"].setChecked)
        self._window.gizmo.switched.connect(self._window.actions_by_name["drag_tool"].setChecked)
        self._show_switches("")
        self._show_ignore()
        self._show_enabled()

    def _deeds(self) -> dict[str, Callable[[], object]]:
        window, joints, view, motion = self._window, self._window.joints, self._window.scene_view, self._window.motion
        return {
            "new": lambda: window.document.new(),
            "open": lambda: window.document.ask_open(),
            "save": lambda: window.document.save(),
            "save_as": lambda: window.document.save_as(),
            "notes": self.show_notes,
            "open_robot": self.open_robot,
            "save_robot": self.save_robot,
            "save_picture": self.save_picture,
            "save_csv": self.save_csv,
            "save_motion": self.save_motion,
            "save_motion_si": lambda: self.save_motion("si"),
            "save_script": self.save_script,
            "save_animation": self.save_animation,
            "lab_report": self.lab_report,
            "import_table": self.import_table,
            "open_program": lambda: self._program().ask_open(),
            "save_program": lambda: self._program().ask_save(),
            "run_program": lambda: self._program().run(),
            "quit": window.close,
            "copy_pose_text": lambda: self._copy_pose(matrix_text),
            "copy_pose_numpy": lambda: self._copy_pose(matrix_numpy),
            "copy_pose_latex": lambda: self._copy_pose(matrix_latex),
            **{f"view_{name}": partial(view.view, name) for name in ("iso", "top", "front", "side", "source")},
            "fit": view.fit,
            "box_zoom": view.begin_box_zoom,
            "more_decimals": lambda: self._more_decimals(1),
            "fewer_decimals": lambda: self._more_decimals(-1),
            "home": joints.go_home,
            "zero": joints.go_zero,
            "random": joints.go_random,
            "plot": joints.plot_typed,
            "save_pose": joints.ask_pose_name,
            "ignore_limits": joints.ignore.toggle,
            "tool_axes": lambda: window.gizmo.set_tool_axes(window.actions_by_name["tool_axes"].isChecked()),
            "drag_tool": lambda: window.gizmo.switch(window.actions_by_name["drag_tool"].isChecked()),
            "track_line": window.tracker.track_line,
            "track_trajectory": window.tracker.track_trajectory,
            "clear_path": window.tracker.clear,
            "play": motion.toggle,
            "stop": lambda: window.emergency_stop.stop(tr("Esc was pressed.")),
            "step_forward": lambda: motion.step(0.05),
            "step_back": lambda: motion.step(-0.05),
            **self._help_deeds(),
        }

    def _help_deeds(self) -> dict[str, Callable[[], object]]:
        return {
            "help": self.show_help,
            "help_contents": lambda: self.show_help("index"),
            "quick_start": lambda: self.show_help("quick-start"),
            "tour": self.begin_tour,
            "shortcuts": self.show_shortcuts,
            "about": self.show_about,
        }

    # --- switches --------------------------------------------------------------------------------------------------

    def _switcher(self, name: str) -> Callable[[bool], None]:
        switch = SWITCHES[name]

        def switched(on: bool) -> None:
            value = switch.on if on else switch.off
            if value is not None:
                self._preferences.set(switch.preference, value)

        return switched

    def _show_switches(self, _name: str) -> None:
        for name, switch in SWITCHES.items():
            self._window.actions_by_name[name].setChecked(self._preferences[switch.preference] == switch.on)
        self._window.scene_view.set_orthographic(self._preferences["orthographic"])
        self._window.scene_view.animated = self._preferences["animated"]

    def _show_ignore(self) -> None:
        self._window.actions_by_name["ignore_limits"].setChecked(self._session.experiment.ignore_limits)

    def _show_enabled(self) -> None:
        actions = self._window.actions_by_name
        playing = self._window.motion.player.playing
        there = self._window.motion.player.trajectory is not None
        actions["stop"].setEnabled(playing)
        for name in ("play", "step_forward", "step_back", "save_motion", "save_motion_si", "save_animation"):
            actions[name].setEnabled(there)
        actions["save_script"].setEnabled(there or self._session.tracking is not None)
        for name in ("save_csv", "clear_path"):
            actions[name].setEnabled(self._session.tracking is not None)

    def _more_decimals(self, step: int) -> None:
        self._preferences.set("extra_decimals", min(max(self._preferences["extra_decimals"] + step, 0), 4))

    # --- programs and motions ---------------------------------------------------------------------------------------

    def _program(self) -> ProgramPage:
        """The page of the program, in front: what comes of it is said there."""
        self._window.docks.show_panel("program")
        page = self._window.findChild(ProgramPage)
        assert page is not None
        return page

    # What is rarely asked for is imported when it is: every start would pay for it.

    def save_motion(self, units: TableUnits = "screen") -> None:
        """Ask for a place and write the motion there as CSV."""
        from rvsim.gui.exports import ask_motion_csv

        ask_motion_csv(self._window, self._session, self._window.motion, units)

    def save_script(self) -> None:
        """Ask for a place and write the script there that works the motion out anew."""
        from rvsim.gui.exports import ask_script

        ask_script(self._window, self._session, self._window.motion)

    def lab_report(self) -> None:
        """Ask how the present experiment is to be reported."""
        from rvsim.gui.report.ask import ask_report

        ask_report(self._window)

    def import_table(self) -> None:
        """Ask for a file of joints or points, and how its columns are meant."""
        from rvsim.gui.import_dialog import ask_import

        ask_import(self._window, self._session, self._window.motion, self._window.tracker)

    def save_animation(self) -> None:
        """Ask how the motion is to be written as an animated picture."""
        from rvsim.gui.animation_dialog import AnimationDialog

        window = self._window
        dialog = AnimationDialog(window, self._session, window.motion, window.stage, self._preferences)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.show()

    # --- files -----------------------------------------------------------------------------------------------------

    def open_robot(self) -> None:
        """Ask for a robot file and take its arm."""
        file = ask_what_to_open(self._window, self._session.robot)
        if file is not None:
            self.open_robot_file(file)

    def open_robot_file(self, file: Path) -> None:
        """Take the arm of a robot file, or say what is wrong with it."""
        robot, sentence = opened(file)
        if robot is None:
            self._fail(tr("This robot file cannot be used."), sentence)
            return
        self._session.use_robot(robot)
        self._session.say(sentence)

    def open_toml(self, file: Path) -> None:
        """A file that was dropped: a program where it has moves, else an arm."""
        if is_program(file):
            self._program().open_from(file)
        else:
            self.open_robot_file(file)

    def show_notes(self) -> None:
        """The student's name and notes, beside the window."""
        from rvsim.gui.notes_dialog import NotesDialog

        notes = self._window.findChild(NotesDialog) or NotesDialog(self._session, self._window)
        if notes.isVisible():
            notes.raise_()
        notes.show()
        notes.activateWindow()

    def save_robot(self) -> None:
        """Ask for a place and write the present arm there."""
        file = ask_where_to_save(self._window, self._session.robot)
        if file is None:
            return
        done, sentence = saved(self._session, file)
        if done:
            self._session.say(sentence)
        else:
            self._fail(tr("Nothing was written."), sentence)

    def save_picture(self) -> None:
        """Ask for a place and save the scene there."""
        start = str(Path.home() / f"{self._session.robot.name}.png")
        file, _ = QFileDialog.getSaveFileName(self._window, tr("Save picture"), start, tr("Pictures (*.png *.jpg)"))
        if file:
            self._write(Path(file), lambda path: save_image(self._window.scene_view.image(), path))

    def save_csv(self) -> None:
        """Ask for a place and save the tracked path there."""
        tracking = self._session.tracking
        if tracking is None:
            return
        start = str(Path.home() / f"{tracking.robot.name}-{tracking.path.name}.csv")
        file, _ = QFileDialog.getSaveFileName(self._window, tr("Save path as CSV"), start, tr("Tables (*.csv)"))
        if file:
            self._write(Path(file), lambda path: write_atomically(path, tracking_csv(tracking).encode()))

    def _write(self, file: Path, write: Callable[[Path], object]) -> None:
        try:
            write(file)
        except (RvsimError, OSError) as problem:
            self._fail(tr("Nothing was written."), str(problem))
            return
        self._session.say(tr("Saved {file}.", file=file))

    def _fail(self, what: str, problem: str) -> None:
        tell_problem(self._window, self._session, what, problem)

    # --- the rest --------------------------------------------------------------------------------------------------

    def _copy_pose(self, text_of: Callable[[Any], str]) -> None:
        robot, q = self._session.robot, self._session.q
        T = forward_kinematics(robot, q)
        if text_of is matrix_text:
            joints = ", ".join(
                f"{name} {format_quantity(value, joint_kind(robot, i), self._preferences)}"
                for i, (name, value) in enumerate(zip(robot.joint_names, q, strict=True))
            ).replace("\u2212", "-")
            text = f"{robot.title}: {joints}\n{matrix_text(T)}"
        elif text_of is matrix_numpy:
            text = f"# {robot.title}, radians and metres\nq = {matrix_numpy(q)}\nT = {matrix_numpy(T)}"
        else:
            text = text_of(np.asarray(T))
        QGuiApplication.clipboard().setText(text)
        self._session.say(tr("Pose copied."))

    def show_shortcuts(self) -> None:
        """All shortcuts in one table."""
        onward = -1 if self._window.isRightToLeft() else 1
        rows = ""
        for menu, text, keys in shortcut_table(self._window):
            cells = menu, f"&nbsp;{text}&nbsp;", f"<b>{left_to_right(keys)}</b>"
            rows += f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells[::onward])}</tr>"
        boxes = tr("In a value box: ↑ ↓ step 1, with Shift 10, with Ctrl 0.1.")
        scene = tr("In the scene: arrows turn, + and − zoom.")
        self._tell(tr("Keyboard shortcuts"), f"<table>{rows}</table><p>{boxes} {scene}</p>")

    def show_help(self, page: str = "") -> None:
        """A page of the help; "" for that of the panel that the reader attends to."""
        from rvsim.gui.help.show import show_help

        show_help(self._window, page)

    def begin_tour(self) -> None:
        """One minute through the window."""
        from rvsim.gui.tour import begin_tour

        begin_tour(self._window)

    def show_about(self) -> None:
        """Versions, licences, and what helps to help."""
        from rvsim.gui.about import AboutDialog

        AboutDialog(self._window).open()

    def _tell(self, title: str, text: str) -> None:
        TextDialog(self._window, title, text).open()
