"""The owner of the wanted tool pose: it solves for it, lets the arm follow, and knows why the arm cannot."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal

from rvsim.experiment import Experiment, limit_violations
from rvsim.gui.branch_words import limit_words
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.target_solution import (
    LEAP,
    Answer,
    NearestPose,
    Offer,
    Question,
    Step,
    branch_at,
    followed,
    immediate_sentence,
    label_title,
    landed,
    nearer,
    nearest_pose,
    offer_of,
    seen_from,
    solve,
    towards,
)
from rvsim.gui.workers import LatestWorker
from rvsim.kinematics import DEFAULT_ORDER, ORDER_CRITERIA, Branch, branch_labels, forward_kinematics
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_FRAME_MS, _REST_MS = 16, 80
_STRIDES = 40  # after which an arm that creeps is given up


class Wish(NamedTuple):
    """A wanted pose T (4, 4) on its way: the text and merge key of its undo step, and another task than the chosen.

    Where the arm cannot follow a hand, it `creeps`: it goes as near as it can, at once; why not is asked when the hand
    rests.
    """

    T: FloatArray
    text: str
    merge: str
    task: str = ""
    creeps: bool = False


class TargetControl(QObject):
    """The target and its live solution, worked out only while somebody watches.

    Signals:
        changed(): target, answer, nearest pose or what is said about them are others.
        lit_changed(): another branch is lit.
        watched_changed(): panel or gizmo have come or gone.
        offer_changed(): another arm: other tasks and solvers.
    """

    changed = Signal()
    lit_changed = Signal()
    watched_changed = Signal()
    offer_changed = Signal()

    def __init__(self, session: Session, preferences: Preferences, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.session, self._preferences = session, preferences
        self._watchers: set[str] = set()
        self._own = False
        self._stale = True
        self._label = ""  # the branch on which the arm was last seen
        self._take_robot(session.robot)
        self.T: FloatArray = forward_kinematics(session.robot, session.q)
        self._wanted: FloatArray | None = None  # where it is not the tool's own pose
        self.answer: Answer | None = None
        self.nearest: NearestPose | None = None
        self.sentence = ""
        self.lit: str | None = None
        self._pending: Wish | None = None
        self._since = QElapsedTimer()
        self._frame = QTimer(self, singleShot=True)
        self._frame.setTimerType(Qt.TimerType.PreciseTimer)
        self._frame.timeout.connect(self.flush)
        self._rest = QTimer(self, singleShot=True, interval=_REST_MS)
        self._rest.timeout.connect(self._on_rest)
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_nearest)
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)

    def close(self) -> None:
        """End the thread that looks for nearest poses."""
        self._worker.close()

    def _take_robot(self, robot: Robot) -> None:
        self.offer: Offer = offer_of(robot)
        self.task, self.solver = self.offer.tasks[0], self.offer.solvers[0]
        self._names = {} if self.offer.no_closed_form else {n: str(i) for i, n in enumerate(branch_labels(robot), 1)}

    # --- what is asked ---------------------------------------------------------------------------------------------

    @property
    def follows(self) -> bool:
        """Whether the arm follows the target at once."""
        return bool(self._preferences["arm_follows"])

    @property
    def order(self) -> tuple[str, ...]:
        """The criteria that put the branches in order, the most important first."""
        kept = [name for name in self._preferences["branch_order"].split(", ") if name in ORDER_CRITERIA]
        return tuple(dict.fromkeys(kept)) or DEFAULT_ORDER

    def set_task(self, task: str) -> None:
        """Ask for another part of the pose."""
        self.task = task
        self._solve_again()

    def set_solver(self, solver: str) -> None:
        """Solve in another way."""
        self.solver = solver
        self._solve_again()

    def _question(self, T: FloatArray, task: str = "") -> Question:
        experiment = self.session.experiment
        asked = (task or self.task, self.solver, experiment.q, self.order, experiment.ignore_limits)
        return Question(experiment.robot, T, *asked)

    # --- who watches -----------------------------------------------------------------------------------------------

    def watch(self, watcher: str, on: bool) -> None:
        """A watcher comes or goes; while there is none nothing is solved."""
        if on == (watcher in self._watchers):
            return
        (self._watchers.add if on else self._watchers.discard)(watcher)
        if on and self._stale:
            self._refresh(self._stale_target())
        self.watched_changed.emit()

    @property
    def is_watched(self) -> bool:
        """Whether anybody is there."""
        return bool(self._watchers)

    def is_watched_by(self, watcher: str) -> bool:
        """Whether that watcher is there."""
        return watcher in self._watchers

    # --- the target moves ------------------------------------------------------------------------------------------

    def request(self, wish: Wish) -> None:
        """Move the target at the next frame; of several requests before it only the last one counts."""
        self._pending = wish
        if not self._frame.isActive():
            gone = self._since.elapsed() if self._since.isValid() else _FRAME_MS
            self._frame.start(max(_FRAME_MS - gone, 0))

    def flush(self) -> None:
        """Do what was requested, now."""
        self._flush(1)

    def settle(self) -> None:
        """Do what was requested, let an arm that creeps arrive, and know why it could come no nearer."""
        self._flush(_STRIDES)
        if self._rest.isActive():
            self._on_rest()

    def _flush(self, strides: int) -> None:
        self._frame.stop()
        wish, self._pending = self._pending, None
        if wish is not None:
            self._since.start()
            self._follow(wish, strides)

    def set_target(self, wish: Wish) -> None:
        """Want the tool in another pose; the arm follows on its branch if it is to and can."""
        self._follow(wish, 1)

    def _follow(self, wish: Wish, strides: int) -> None:
        left_behind = self._wanted is not None
        answer = solve(self._question(np.asarray(wish.T), wish.task), hurried=wish.creeps)
        step = followed(answer, self._label if left_behind else "") if self.follows else None
        if wish.creeps and self.follows and not _at_hand(step, left_behind):
            self._creep(answer, step, wish, strides)
        elif step is not None:
            self._arrive(answer, step, wish)
        else:
            self._miss(answer, wish, answer.question.q)

    def _creep(self, answer: Answer, step: Step | None, wish: Wish, strides: int) -> None:
        """A hand is followed without a jump: not over to another branch either."""
        own = step.branch if step is not None and not step.changed_branch else None
        crept = nearer(answer, strides) if own is None else towards(answer, own, strides)
        landing = landed(answer, crept.q) if crept.settled else None
        if landing is not None:
            self._arrive(answer, landing, wish)
            return
        self._miss(answer, wish, crept.q)
        if not crept.settled and strides == 1 and self._pending is None:
            self.request(wish)  # there is still some way to go

    def take_back(self, experiment: Experiment, text: str, merge: str) -> None:
        """Be again where a drag began, as if it had never been."""
        self._frame.stop()
        self._pending = None
        if self.session.experiment is not experiment:
            self._put(experiment, text, merge)
            self._wanted = experiment.target
            self._refresh(self._stale_target())

    def target_at_tool(self) -> None:
        """Want the tool where it is."""
        self._wanted = None
        self._refresh(self._stale_target())
        if self.session.experiment.target is not None:
            self._put(replace(self.session.experiment, target=None), tr("Target at the tool"))

    def go_to(self, branch: Branch) -> None:
        """Let the arm go to a branch."""
        self._go(branch.q, tr("Go to “{branch}”", branch=label_title(branch.label)))

    def solve_now(self) -> None:
        """Solve, and go to the best branch by the order."""
        self._refresh(self.T)
        usable = self.answer.usable if self.answer is not None else ()
        if usable:
            self.go_to(usable[0])
        else:
            self.session.warn(self.sentence)

    def accept_nearest(self) -> None:
        """Go to the nearest pose that can be reached, and want that."""
        if self.nearest is not None:
            self._go(self.nearest.q, tr("Accept the nearest pose"))

    def light(self, name: str | None) -> None:
        """Light the ghost of a branch, by its name, or none."""
        if name != self.lit:
            self.lit = name
            self.lit_changed.emit()

    def name_of(self, branch: Branch) -> str:
        """What a branch is called in scene and table: its number among all that the arm has."""
        return self._names.get(branch.label, "•")

    # --- inside ----------------------------------------------------------------------------------------------------

    def _arrive(self, answer: Answer, step: Step, wish: Wish) -> None:
        q = step.branch.q
        # What the task leaves open is as the arm has it.
        self.T, self._wanted = forward_kinematics(answer.question.robot, q), None
        before = self._label
        self._show(seen_from(answer, q), q)
        if step.changed_branch and before and before != self._label:
            self.sentence = self._changed_branch(answer, before)
            self.session.warn(self.sentence)
        self.changed.emit()
        self._put(replace(self.session.experiment, q=q, target=None), wish.text, wish.merge)

    def _miss(self, answer: Answer, wish: Wish, q: FloatArray) -> None:
        """The arm stays, or goes to q (n,) as near as it can; the target goes without it."""
        self.T = self._wanted = wish.T
        self._show(seen_from(answer, q), q)
        if wish.creeps and self.follows:
            self.sentence = self._creeping_sentence(answer)
        self.changed.emit()
        self._put(replace(self.session.experiment, q=q, target=wish.T), wish.text, wish.merge)

    def _creeping_sentence(self, answer: Answer) -> str:
        if not answer.missed:
            return f"{self._ended(answer, self._label)} {tr('Others go on: choose one in the table.')}"
        asked = answer.failure is not None or answer.numeric is not None
        return self.sentence if asked else tr("Out of reach: the arm follows along the edge.")

    def _on_rest(self) -> None:
        """The hand rests: time to know why not, and what is nearest."""
        self._rest.stop()
        if self.answer is not None and self.answer.hurried:
            self._show(solve(replace(self.answer.question, q=self.session.q)), self.session.q)
            self.changed.emit()

    def _changed_branch(self, answer: Answer, before: str) -> str:
        went_over = tr("The arm went over to “{branch}”.", branch=label_title(self._label))
        return f"{self._ended(answer, before)} {went_over}"

    def _ended(self, answer: Answer, before: str) -> str:
        old = [branch for branch in answer.branches if branch.label == before]
        words = limit_words(answer.question.robot, old[0], self._preferences) if old else ""
        title = label_title(before)
        if not words:
            return tr("The branch “{branch}” ends here.", branch=title)
        return tr("The branch “{branch}” ends here: {words}.", branch=title, words=words)

    def _go(self, q: ArrayLike, text: str) -> None:
        experiment = self.session.experiment
        if np.array_equal(q, experiment.q) and experiment.target is None:
            return
        if not experiment.ignore_limits and limit_violations(experiment.robot, q):
            self.session.move_to(q, text)  # refuses, and says why
            return
        self.session.gliding = True
        try:
            self._put(replace(experiment.at(q), target=None), text)
        finally:
            self.session.gliding = False
        self._wanted = None
        self._refresh(self._stale_target())

    def _refresh(self, T: FloatArray) -> None:
        """Solve for a target with the arm where it is; while that moves, without what takes long."""
        self.T, self._stale = T, False
        self._show(solve(self._question(T), hurried=self.session.continuing), self.session.q)
        self.changed.emit()

    def _solve_again(self) -> None:
        if self._watchers:
            self._refresh(self.T)
        else:
            self._stale = True

    def _show(self, answer: Answer, q: FloatArray) -> None:
        self.answer, self.nearest = answer, None
        units = shown_units(self._preferences)
        self.sentence = immediate_sentence(answer, units)
        here = branch_at(answer, q)
        self._label = here.label if here is not None else self._label
        self._rest.stop()
        if answer.missed and answer.hurried:
            self._worker.cancel()
            self._rest.start()
        elif answer.missed:
            self._worker.ask(partial(nearest_pose, answer, units))
        else:
            self._worker.cancel()

    def _on_nearest(self, nearest: NearestPose) -> None:
        self.nearest, self.sentence = nearest, nearest.sentence
        self.changed.emit()

    def _put(self, experiment: Experiment, text: str, merge: str = "") -> None:
        with self._by_itself():
            self.session.edit(text, experiment, merge=merge)

    @contextmanager
    def _by_itself(self) -> Iterator[None]:
        self._own = True
        try:
            yield
        finally:
            self._own = False

    # --- others move the arm ---------------------------------------------------------------------------------------

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if self._own:
            return
        if after.robot is not before.robot:
            self._take_other_robot(after.robot)
        elif after.q is before.q and after.target is before.target and after.ignore_limits == before.ignore_limits:
            return
        self._pending = None
        self._rest.stop()
        self._wanted = after.target
        self._stale = True
        if self._watchers:
            self._refresh(self._stale_target())

    def _stale_target(self) -> FloatArray:
        """The target that the experiment remembers, else the tool's own pose."""
        experiment = self.session.experiment
        return self._wanted if self._wanted is not None else forward_kinematics(experiment.robot, experiment.q)

    def _take_other_robot(self, robot: Robot) -> None:
        task, solver = self.task, self.solver
        self._take_robot(robot)
        self._label = ""
        self._worker.cancel()
        self.answer = self.nearest = None  # they speak of the other arm's joints
        # An arm that is being edited keeps what was chosen, where it still can.
        self.task = task if task in self.offer.tasks else self.task
        self.solver = solver if solver in self.offer.solvers and not self.offer.no_closed_form else self.solver
        self.offer_changed.emit()

    def _on_preference(self, name: str) -> None:
        if name in ("branch_order", "arm_follows", "angle_unit", "length_unit"):
            self._solve_again()


def _at_hand(step: Step | None, left_behind: bool) -> bool:
    """Whether the arm can go there at once, and nobody who looks will call it a jump."""
    return step is not None and not step.changed_branch and not (left_behind and step.branch.distance > LEAP)
