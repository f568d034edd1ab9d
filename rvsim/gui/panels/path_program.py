"""The Program page: moves one after the other, taught by driving the arm there, checked as they change, and run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QFileDialog, QLabel, QPushButton, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment
from rvsim.experiment.program import Gripper, Move, Program, Wait, duplicated, inserted, removed, replaced, shifted
from rvsim.files.program_file import load_program, save_program
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.folding_row import WrappedRow
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_page import PathPage
from rvsim.gui.panels.path_program_editor import MoveEditor
from rvsim.gui.panels.path_program_list import ProgramList, ProgramModel, Row
from rvsim.gui.panels.path_program_new import new_move
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import button, scrolled
from rvsim.gui.workers import LatestWorker
from rvsim.kinematics import forward_kinematics
from rvsim.lab.program_words import move_words, plan_sentence, problem_sentence
from rvsim.language import tr, tr_later, trn
from rvsim.motion.program import Plan, plan_program
from rvsim.robot.arrays import FloatArray
from rvsim.scene.paths import path_items

_CHECK_MS = 150  # after the last change
_DRAWN = 60  # places a move
_LABEL_MARGIN = 5  # [pixels] around it: the word stands beside those in the buttons
_FILES = tr_later("Programs (*.toml)")
_ADD_TEXTS = {  # of the undo steps
    "joint": tr_later("Add joint move"),
    "line": tr_later("Add line move"),
    "arc": tr_later("Add arc move"),
    "wait": tr_later("Add wait move"),
    "gripper": tr_later("Add gripper move"),
}
_ADD = (
    ("joint", tr_later("Pose"), tr_later("Add a move of all joints to the present pose")),
    ("line", tr_later("Line"), tr_later("Add a straight line of the tool to where it is now")),
    ("arc", tr_later("Arc"), tr_later("Add an arc of the tool to where it is now; then move its middle")),
    ("wait", tr_later("Wait"), tr_later("Add a rest")),
    ("gripper", tr_later("Grip"), tr_later("Add an opening or closing of the gripper")),
)


class ProgramPage(PathPage):
    """Edits `experiment.program`, keeps a plan of it that is worked out aside, and plays it."""

    title = tr_later("Program")
    name = "program"

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        stage: Stage,
        tracker: PathTracker,
        motion: MotionControl,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(session, preferences, stage, tracker, motion, parent)
        self.plan: Plan | None = None  # of the program as it stands, None while it is worked out
        self._asked: Experiment | None = None  # the state that the last plan was asked for
        self._running: Plan | None = None
        self._chosen = -1
        self._then: Callable[[Plan], None] | None = None  # what waits for the plan
        self.model = ProgramModel(preferences, self)
        self.list = ProgramList(self.model)
        self.editor = MoveEditor(preferences)
        self.verdict = wrapped_label()
        self.verdict.setObjectName("program_verdict")
        self._worker = LatestWorker(self)
        self._later = QTimer(self, singleShot=True, interval=_CHECK_MS)
        self._buttons: dict[str, QPushButton] = {}
        self._lay_out()
        self._connect()

    def close_worker(self) -> None:
        """End the worker, for the window closes."""
        self._later.stop()
        self._worker.close()

    # --- assembly --------------------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(8)
        column.addWidget(self._adders())
        column.addWidget(self.list)
        column.addWidget(self._arrangers())
        column.addWidget(self.verdict)
        column.addLayout(self._runners())
        column.addWidget(self.editor)
        column.addStretch(1)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(scrolled(inside))

    def _adders(self) -> WrappedRow:
        label = QLabel(tr("Add"))
        set_role(label, role="muted")
        label.setMargin(_LABEL_MARGIN)
        made = [button(f"program_add_{kind}", text, tip, partial(self.add, kind)) for kind, text, tip in _ADD]
        return WrappedRow(made, 4, label)

    def _arrangers(self) -> WrappedRow:
        made = [
            self._button(name, text, tip, slot)
            for name, text, tip, slot in (
                ("up", tr("▲ Up"), tr("Move the chosen one up (Alt+Up)"), lambda: self.shift(-1)),
                ("down", tr("▼ Down"), tr("Move the chosen one down (Alt+Down)"), lambda: self.shift(1)),
                ("duplicate", tr("Duplicate"), tr("The chosen one once more"), self.duplicate),
                ("delete", tr("Delete"), tr("Take the chosen one out (Delete)"), self.delete),
            )
        ]
        return WrappedRow(made, 4)

    def _runners(self) -> QVBoxLayout:
        made = [
            self._button(name, text, tip, slot, primary=name == "run")
            for name, text, tip, slot in (
                ("run", tr("Run program"), tr("Play it from where the arm is, as far as it can be done"), self.run),
                ("check", tr("Check"), tr("Say whether each move can be done"), self.check),
                ("save", tr("Save…"), tr("Write it to a file"), self.ask_save),
                ("open", tr("Open…"), tr("Take one from a file"), self.ask_open),
            )
        ]
        column = QVBoxLayout()
        column.setSpacing(4)
        for pair in (made[:2], made[2:]):
            column.addWidget(WrappedRow(pair, 4))
        return column

    def _button(
        self, name: str, text: str, tip: str, slot: Callable[[], object], *, primary: bool = False
    ) -> QPushButton:
        made = button(f"program_{name}", text, tip, slot, primary=primary)
        self._buttons[name] = made
        return made

    def _connect(self) -> None:
        self.list.chosen.connect(self._on_chosen)
        self.list.delete_asked.connect(self.delete)
        self.list.shift_asked.connect(self.shift)
        self.editor.edited.connect(self._on_edited)
        self.editor.refused.connect(self._session.warn)
        self.editor.finished.connect(self._session.end_stroke)
        self._worker.done.connect(self._on_planned)
        self._later.timeout.connect(self._work_out)
        self._motion.moved.connect(lambda _: self._show_running())
        self._motion.loaded.connect(self._show_running)

    # --- edits -----------------------------------------------------------------------------------------------------

    @property
    def program(self) -> Program:
        """The moves."""
        return self._session.experiment.program

    def add(self, kind: str) -> None:
        """Add a move behind the chosen one, or at the end."""
        index = self._chosen + 1 if self._chosen >= 0 else len(self.program)
        self._put(
            tr(_ADD_TEXTS[kind]),
            inserted(self.program, index, new_move(kind, self._session.experiment, index)),
            index,
        )

    def shift(self, by: int) -> None:
        """Move the chosen one up (negative) or down."""
        goal = self._chosen + by
        if self._chosen >= 0 and 0 <= goal < len(self.program):
            self._put(tr("Shift move {number}", number=self._chosen + 1), shifted(self.program, self._chosen, by), goal)

    def duplicate(self) -> None:
        """The chosen one once more behind it."""
        if self._chosen >= 0:
            self._put(
                tr("Duplicate move {number}", number=self._chosen + 1),
                duplicated(self.program, self._chosen),
                self._chosen + 1,
            )

    def delete(self) -> None:
        """Take the chosen one out."""
        if self._chosen >= 0:
            left = removed(self.program, self._chosen)
            self._put(tr("Delete move {number}", number=self._chosen + 1), left, min(self._chosen, len(left) - 1))

    def _on_edited(self, move: Move, field: str) -> None:
        if self._chosen >= 0:
            after = replaced(self.program, self._chosen, move)
            self._put(
                tr("Edit move {number}", number=self._chosen + 1),
                after,
                self._chosen,
                merge=f"program {self._chosen} {field}",
            )

    def _put(self, text: str, program: Program, chosen: int, merge: str = "") -> None:
        self._chosen = chosen
        self._session.edit(text, replace(self._session.experiment, program=program), merge=merge)

    def _on_chosen(self, row: int) -> None:
        if row >= 0 or not self.program:
            self._chosen = row
            self._show_editor()

    # --- showing ---------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """Whatever a plan depends on."""
        return super().concerns(before, after) or _asks_other(before, after)

    def refresh(self) -> None:
        """Show the program; its plan is worked out when it has rested for a moment."""
        if not self._plan_holds():
            self.plan = None
            self._later.start()
        self._show_rows()
        self._show_running()

    def _plan_holds(self) -> bool:
        """Whether there is a plan of the program as it stands, begun where the arm is or being played."""
        if self.plan is None or not self._is_of(self.plan, self._session.experiment):
            return False
        return np.array_equal(self.plan.q, self._session.q) or self._plays(self.plan)

    def _plays(self, plan: Plan) -> bool:
        """Whether the arm is where the player shows it on this plan."""
        player = self._motion.player
        shown = player.q if self._running is plan and player.trajectory is plan.trajectory else None
        return shown is not None and np.array_equal(shown, self._session.q)

    def _is_of(self, plan: Plan, experiment: Experiment) -> bool:
        return self._asked is not None and plan.moves is experiment.program and not _asks_other(self._asked, experiment)

    def _show_rows(self) -> None:
        experiment = self._session.experiment
        units = shown_units(self._preferences)
        words = [move_words(move, experiment.robot, units) for move in experiment.program]
        self.model.show_rows(tuple(self._row(index, text) for index, text in enumerate(words)))
        self.list.fit()
        self._chosen = min(self._chosen, len(words) - 1)
        self.list.choose(self._chosen)
        self._show_editor()
        self._show_verdict()

    def _row(self, index: int, words: str) -> Row:
        plan = self.plan
        if plan is None:
            return Row(words, "…", tr("Being worked out."))
        done = len(plan.steps)
        if index < done:
            seconds = plan.steps[index].duration
            return Row(words, "✓", tr("Can be done, in {seconds:.2f} s.", seconds=seconds))
        if index > done or plan.problem is None:
            return Row(words, "·", tr("Waits for move {number}.", number=done + 1))
        units = shown_units(self._preferences)
        return Row(words, "✗", problem_sentence(plan.robot, plan.moves[index], plan.problem, units), bad=True)

    def _show_editor(self) -> None:
        chosen = self.program[self._chosen] if 0 <= self._chosen < len(self.program) else None
        self.editor.show_move(chosen, self._session.experiment)
        for name, able in {
            "up": self._chosen > 0,
            "down": 0 <= self._chosen < len(self.program) - 1,
            "duplicate": chosen is not None,
            "delete": chosen is not None,
            "run": bool(self.program),
            "check": bool(self.program),
            "save": bool(self.program),
        }.items():
            self._buttons[name].setEnabled(able)

    def _show_verdict(self) -> None:
        if self.plan is None:
            return  # the old one stays until there is a new one
        bad = self.plan.problem is not None
        self.verdict.setText(plan_sentence(self.plan, shown_units(self._preferences)))
        set_role(self.verdict, role="" if bad else "muted", level="warning" if bad else "")

    def _show_running(self) -> None:
        plan = self._running
        here = plan is not None and self._motion.player.trajectory is plan.trajectory and plan.moves is self.program
        self.model.show_running(plan.move_at(self._motion.player.time) if here and plan is not None else -1)

    def _draw_way(self) -> None:
        """The tool's way through all moves that can be done."""
        plan = self.plan
        if plan is None or plan.trajectory is None:
            self.draw(())
            return
        points = forward_kinematics(plan.robot, plan.trajectory.q(_moments(plan)))[:, :3, 3]
        palette = self._stage.palette
        reached = np.ones(len(points), dtype=bool)
        self.draw(path_items(points, reached, np.empty((0, 3)), palette, key="program", marks=False))

    def set_seen(self, seen: bool) -> None:
        """Draw again what was drawn."""
        super().set_seen(seen)
        if seen:
            self._draw_way()
        else:
            self._later.stop()

    # --- plan, check, run ------------------------------------------------------------------------------------------

    def _work_out(self) -> None:
        self._later.stop()
        experiment = self._session.experiment
        self._asked = experiment
        poses = {pose.name: pose.q for pose in experiment.poses}
        limits, law = experiment.ignore_limits, experiment.law
        job = partial(
            plan_program, experiment.robot, experiment.q, experiment.program,
            poses=poses, ignore_limits=limits, law=law,
        )  # fmt: skip
        self._worker.ask(job)

    def _on_planned(self, plan: Plan) -> None:
        if not self._is_of(plan, self._session.experiment) or not np.array_equal(plan.q, self._session.q):
            self._later.start()
            return
        self.plan = plan
        if self._seen:
            self._show_rows()
            self._draw_way()
        then, self._then = self._then, None
        if then is not None:
            then(plan)

    def _with_plan(self, then: Callable[[Plan], None]) -> None:
        """Do something with the plan from where the arm is, at once or as soon as there is one."""
        if self.plan is not None and self._plan_holds() and np.array_equal(self.plan.q, self._session.q):
            then(self.plan)
            return
        self._then = then
        self._work_out()

    def check(self) -> None:
        """Say whether each move can be done."""
        self._with_plan(lambda plan: self._say(plan))

    def run(self) -> None:
        """Play it from where the arm is, as far as it can be done."""
        self._with_plan(self._start)

    def _start(self, plan: Plan) -> None:
        self._say(plan)
        if plan.trajectory is None:
            return
        self._tracker.cancel()
        self._tracker.clear()
        self._running = plan
        before = self._motion.opening
        self._motion.load(plan.trajectory, tr("Run program"), lambda t: plan.opening_at(t, before))
        self._motion.play()
        self._show_running()

    def _say(self, plan: Plan) -> None:
        self._session.say(plan_sentence(plan, shown_units(self._preferences)), "warning" if plan.problem else "info")

    # --- files -----------------------------------------------------------------------------------------------------

    def ask_save(self) -> None:
        """Ask for a place and save the program there."""
        start = str(Path.home() / f"{self._session.robot.name}-program.toml")
        file, _ = QFileDialog.getSaveFileName(self, tr("Save program"), start, tr(_FILES))
        if file:
            self.save_to(Path(file) if Path(file).suffix else Path(file).with_suffix(".toml"))

    def save_to(self, path: Path) -> None:
        """Write the program to a file, or say why not."""
        try:
            save_program(self.program, self._session.robot, path)
        except OSError as problem:
            self._session.say(
                tr("Not saved: {path} cannot be written ({reason}).", path=path, reason=problem.strerror or problem),
                "error",
            )
            return
        self._session.say(tr("Saved {path}.", path=path))

    def ask_open(self) -> None:
        """Ask for a file and take its program."""
        file, _ = QFileDialog.getOpenFileName(self, tr("Open program"), str(Path.home()), tr(_FILES))
        if file:
            self.open_from(Path(file))

    def open_from(self, path: Path) -> None:
        """Take the program of a file, undoably, or say what is wrong with it."""
        try:
            program = load_program(path, self._session.robot)
        except RvsimError as problem:
            self._session.say(str(problem), "error")
            return
        self._put(tr("Open {name}", name=path.name), program, 0)
        self._session.say(trn("Opened {n} move from {path}.", "Opened {n} moves from {path}.", len(program), path=path))


def _asks_other(before: Experiment, after: Experiment) -> bool:
    """Whether anything but the pose of the arm is another one that a plan depends on."""
    same = before.program is after.program and before.robot is after.robot and before.poses is after.poses
    return not same or before.ignore_limits != after.ignore_limits or before.law != after.law


def _moments(plan: Plan) -> FloatArray:
    """Times of places enough to draw each move that takes the tool somewhere [s]."""
    pairs = zip(plan.starts[:-1], plan.starts[1:], plan.moves, strict=False)
    parts = [np.linspace(a, b, _DRAWN) for a, b, move in pairs if not isinstance(move, Wait | Gripper)]
    return np.concatenate([[0.0], *parts])
