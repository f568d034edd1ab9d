"""The one owner of the present experiment. Panels ask it and tell it; nobody else keeps a pose."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import fields

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from rvsim.experiment import Experiment, LimitViolation, limit_violations
from rvsim.gui.servo_limits import ServoLimits
from rvsim.language import again, tr
from rvsim.motion import Tracking
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


class _Change(QUndoCommand):
    """From one experiment to the next."""

    def __init__(self, session: Session, text: str, after: Experiment, merge: str, follows: str) -> None:
        super().__init__(text)
        self.name = text
        self._session, self.merge, self.follows = session, merge, follows  # `follows`: the key of the change before it
        self._before, self._after = session.experiment, after

    def belong_to(self, session: Session) -> None:
        """From now on lead another session to its states."""
        self._session = session

    def continues(self, merge: str) -> bool:
        """Whether a change with that key goes on with this one."""
        return bool(merge) and merge == self.merge

    def extend(self, after: Experiment) -> None:
        """Lead on to a still later state."""
        self._after = after
        self.redo()

    @property
    def leads_nowhere(self) -> bool:
        """Whether the later state is the earlier one again, pose and all."""
        others = (field.name for field in fields(Experiment) if field.name != "q")
        same = all(getattr(self._before, name) is getattr(self._after, name) for name in others)
        return same and np.array_equal(self._before.q, self._after.q)

    def redo(self) -> None:
        """Go to the later state."""
        self._session._put(self._after)

    def undo(self) -> None:
        """Go to the earlier state."""
        self._session._put(self._before)


class _Name(QUndoCommand):
    """Changes nothing: the first part of a step of several, which knows the step's name where Qt has plain words."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name


class Session(QObject):
    """The present experiment, its undo stack, and the tracking that is shown.

    Signals:
        changed(before, after): the experiment is another one; compare what you show.
        settled(before, after): the same, once all others have heard of it: the time to draw.
        tracking_changed(tracking or None): another path has been tracked, or none is any more.
        said(text, level): a sentence for the status line; level is "info", "warning" or "error".
    """

    changed = Signal(object, object)
    settled = Signal(object, object)
    tracking_changed = Signal(object)
    said = Signal(str, str)

    def __init__(self, experiment: Experiment, make_experiment: Callable[[Robot], Experiment]) -> None:
        super().__init__()
        self._experiment = experiment
        self._make_experiment = make_experiment
        self._left: dict[str, Experiment] = {}
        self._tracking: Tracking | None = None
        self._merge_stroke = 0
        self.continuing = False  # while `changed` tells of the next step of a drag, or of a motion
        self._fleeting = False  # whether what was said last goes with the next moment of a motion already
        self._showing_moment = False
        self.gliding = False  # while `changed` tells of a whole new pose: whoever draws may go there smoothly
        self.undo_stack = QUndoStack(self)
        self.servo_limits: ServoLimits | None = None  # while an arm is connected

    @property
    def experiment(self) -> Experiment:
        """The present state."""
        return self._experiment

    @property
    def robot(self) -> Robot:
        """The present arm."""
        return self._experiment.robot

    @property
    def q(self) -> FloatArray:
        """(n,) the present pose [rad, m]."""
        return self._experiment.q

    @property
    def tracking(self) -> Tracking | None:
        """The tracked path that is shown, or None."""
        return self._tracking

    @property
    def at_rest(self) -> Experiment:
        """The present state as it is without a device, its arm with its own limits: what files get."""
        if self.servo_limits is None:
            return self._experiment
        robot = self.servo_limits.alone(self.robot)
        same = np.array_equal(robot.limits, self.robot.limits)
        return self._experiment if same else self._experiment.with_robot(robot)

    # --- edits -----------------------------------------------------------------------------------------------------

    def edit(self, text: str, experiment: Experiment, *, merge: str = "") -> None:
        """Go to another state, undoably. Edits with the same `merge` key in a row become one, until `end_stroke`."""
        self._change(text, experiment, f"{merge}#{self._merge_stroke}" if merge else "")

    @contextmanager
    def one_step(self, text: str) -> Iterator[None]:
        """All edits meanwhile are one undo step."""
        self.undo_stack.beginMacro(text)
        self.undo_stack.push(_Name(text))
        try:
            yield
        finally:
            self.undo_stack.endMacro()

    def _change(self, text: str, experiment: Experiment, key: str) -> None:
        experiment = self._without_old_typing(experiment)
        last = self._last_change()
        # Not by QUndoCommand.mergeWith: the stack never lets go of the Python side of the commands that it merged.
        if last is None or not last.continues(key):
            self.undo_stack.push(_Change(self, text, experiment, key, last.merge if last else ""))
            return
        self.continuing = True
        try:
            last.extend(experiment)
        finally:
            self.continuing = False
        if last.leads_nowhere:
            last.setObsolete(True)
            self.undo_stack.undo()  # which takes an obsolete change out

    def _without_old_typing(self, experiment: Experiment) -> Experiment:
        """What was typed and not drawn is forgotten when the arm goes elsewhere."""
        same = experiment.typed is self._experiment.typed
        stale = experiment.typed is not None and same and experiment.q is not self._experiment.q
        return experiment.with_typed(None) if stale else experiment

    def _last_change(self) -> _Change | None:
        """The newest change, if nothing has been undone since and it has not been saved: a saved one stays."""
        stack = self.undo_stack
        open_ended = stack.index() == stack.count() > 0 and not stack.isClean()
        last = stack.command(stack.index() - 1) if open_ended else None
        return last if isinstance(last, _Change) else None

    def successor(self) -> Session:
        """The same for the window that takes the place of this one's, with the undo steps said in its language.

        Whoever listens to this one hears no more, and goes with its window.
        """
        new = Session(self._experiment, self._make_experiment)
        new._left, new.servo_limits = self._left, self.servo_limits
        new.undo_stack, self.undo_stack = self.undo_stack, new.undo_stack
        new.undo_stack.setParent(new)
        self.undo_stack.setParent(self)
        for command in map(new.undo_stack.command, range(new.undo_stack.count())):
            parts = [command, *map(command.child, range(command.childCount()))]
            name = next((part.name for part in reversed(parts[:2]) if isinstance(part, _Change | _Name)), "")
            command.setText(again(name) or command.text())
            for change in parts:
                if isinstance(change, _Change):
                    change.belong_to(new)
        return new

    def end(self) -> None:
        """Let the steps of undo go while all is whole, and tell nobody.

        As rubbish they are freed by Python and by the stack, each in its own order, and the program ends.
        """
        self.undo_stack.blockSignals(True)
        self.undo_stack.clear()

    def end_stroke(self) -> None:
        """A slider has been released, a box left: the next edit is a new one."""
        self._merge_stroke += 1

    def move_to(self, q: ArrayLike, text: str, *, merge: str = "") -> bool:
        """Go to a pose, undoably; outside the limits only if they are ignored, else it is refused with a sentence."""
        violations = () if self._experiment.ignore_limits else limit_violations(self.robot, q)
        if violations:
            self.warn(self._why_not(violations))
            return False
        self.gliding = not merge
        try:
            self.edit(text, self._experiment.at(q), merge=merge)
        finally:
            self.gliding = False
        return True

    def _why_not(self, violations: Sequence[LimitViolation]) -> str:
        names = self._names(violations)
        if self.servo_limits is not None:
            servos = [one for one in violations if self.servo_limits.holds(self.robot, one)]
            if servos:
                return tr(
                    "Not moved: the connected arm’s servos do not reach that ({names}).", names=self._names(servos)
                )
        return tr("Not moved: outside the limits of {names}. Switch “Ignore limits” on to go there.", names=names)

    def _names(self, violations: Sequence[LimitViolation]) -> str:
        return tr(", ").join(tr(self.robot.joint_names[violation.joint]) for violation in violations)

    def show_moment(self, q: ArrayLike, text: str, motion: int) -> None:
        """Show a moment of a motion. All moments of the same number in a row are one undo step, back to the first.

        What is dragged meanwhile is one step too, which takes the moments that pass with it.
        """
        if not np.array_equal(q, self.q):
            self._showing_moment = True
            try:
                self._change(text, self._experiment.at(q), self._moment_key(f"motion {motion}"))
            finally:
                self._showing_moment = False

    def _moment_key(self, motion: str) -> str:
        last = self._last_change()
        dragged = last is not None and last.follows == motion and last.merge.endswith(f"#{self._merge_stroke}")
        return last.merge if last is not None and dragged else motion

    def use_robot(self, robot: Robot) -> None:
        """Take another arm, as it was left when it was last in use."""
        if robot is self.robot:
            return
        self._left[self.robot.name] = self.at_rest
        left = self._left.get(robot.name)
        following = left if left and left.robot is robot else self._make_experiment(robot)
        self.edit(tr("Take the {title}", title=tr(robot.title)), following.with_notes(self._experiment.notes))

    def fresh(self, robot: Robot) -> Experiment:
        """An arm as it is taken for the first time."""
        return self._make_experiment(robot)

    @property
    def left(self) -> tuple[Experiment, ...]:
        """The experiments of other arms, as they were left."""
        return tuple(one for name, one in self._left.items() if name != self.robot.name)

    def begin(self, experiment: Experiment, left: Iterable[Experiment] = ()) -> None:
        """Another experiment altogether, and those left for other arms: no undo leads back."""
        self.undo_stack.clear()
        self._left = {one.robot.name: one for one in left}
        self.set_tracking(None)
        self._put(experiment)

    def set_tracking(self, tracking: Tracking | None) -> None:
        """Show a tracked path, or none."""
        if tracking is not self._tracking:
            self._tracking = tracking
            self.tracking_changed.emit(tracking)

    def say(self, text: str, level: str = "info") -> None:
        """A sentence for the status line; it stays until the next one, or until an edit makes it old."""
        self._fleeting = False
        self.said.emit(text, level)

    def warn(self, text: str) -> None:
        """A warning about what was just tried; it goes with the next change. Nothing for an empty text."""
        if text:
            self.say(text, "warning")
            self._fleeting = True

    def _put(self, experiment: Experiment) -> None:
        before, self._experiment = self._experiment, experiment
        if experiment is before:
            return
        if self._fleeting or not self._showing_moment:
            self.say("")
        if experiment.robot is not before.robot:
            self.set_tracking(None)
        self.changed.emit(before, experiment)
        self.settled.emit(before, experiment)
