"""The one owner of the present experiment. Panels ask it and tell it; nobody else keeps a pose."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from rvsim.experiment import Experiment, limit_violations
from rvsim.motion import Tracking
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


class _Change(QUndoCommand):
    """From one experiment to the next. Consecutive changes with the same merge key become one."""

    def __init__(self, session: Session, text: str, after: Experiment, merge: str) -> None:
        super().__init__(text)
        self._session, self._merge = session, merge
        self._before, self._after = session.experiment, after

    def id(self) -> int:
        """Qt offers commands of equal id for merging; −1 is never merged."""
        return 1 if self._merge else -1

    def mergeWith(self, other: QUndoCommand) -> bool:
        """Swallow the next command if it goes on with the same thing."""
        if not isinstance(other, _Change) or other._merge != self._merge:
            return False
        self._after = other._after
        self.setText(other.text())
        self.setObsolete(_is_same(self._before, self._after))  # back where it began: there is nothing to undo
        return True

    def redo(self) -> None:
        """Go to the later state."""
        self._session._put(self._after)

    def undo(self) -> None:
        """Go to the earlier state."""
        self._session._put(self._before)


def _is_same(one: Experiment, other: Experiment) -> bool:
    """Whether nothing has been edited between two states and the pose is the same."""
    kept = (getattr(one, field.name) is getattr(other, field.name) for field in fields(Experiment) if field.name != "q")
    return np.array_equal(one.q, other.q) and all(kept)


class Session(QObject):
    """The present experiment, its undo stack, and the tracking that is shown.

    Signals:
        changed(before, after): the experiment is another one; compare what you show.
        tracking_changed(tracking or None): another path has been tracked, or none is any more.
        said(text, level): a sentence for the status line; level is "info", "warning" or "error".
    """

    changed = Signal(object, object)
    tracking_changed = Signal(object)
    said = Signal(str, str)

    def __init__(self, experiment: Experiment, make_experiment: Callable[[Robot], Experiment]) -> None:
        super().__init__()
        self._experiment = experiment
        self._make_experiment = make_experiment
        self._left: dict[str, Experiment] = {}
        self._tracking: Tracking | None = None
        self._merge_stroke = 0
        self.gliding = False  # while `changed` tells of a whole new pose: whoever draws may go there smoothly
        self.undo_stack = QUndoStack(self)

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

    # --- edits -----------------------------------------------------------------------------------------------------

    def edit(self, text: str, experiment: Experiment, *, merge: str = "") -> None:
        """Go to another state, undoably. Edits with the same `merge` key in a row become one, until `end_stroke`."""
        key = f"{merge}#{self._merge_stroke}" if merge else ""
        self.undo_stack.push(_Change(self, text, experiment, key))

    def end_stroke(self) -> None:
        """A slider has been released, a box left: the next edit is a new one."""
        self._merge_stroke += 1

    def move_to(self, q: ArrayLike, text: str, *, merge: str = "") -> bool:
        """Go to a pose, undoably; outside the limits only if they are ignored, else it is refused with a sentence."""
        violations = () if self._experiment.ignore_limits else limit_violations(self.robot, q)
        if violations:
            names = ", ".join(self.robot.joint_names[violation.joint] for violation in violations)
            self.say(f"Not moved: outside the limits of {names}. Switch “Ignore limits” on to go there.", "warning")
            return False
        self.gliding = not merge
        try:
            self.edit(text, self._experiment.at(q), merge=merge)
        finally:
            self.gliding = False
        return True

    def show_moment(self, q: ArrayLike, text: str, motion: int) -> None:
        """Show a moment of a motion. All moments of the same number in a row are one undo step, back to the first."""
        if not np.array_equal(q, self.q):
            self.undo_stack.push(_Change(self, text, self._experiment.at(q), f"motion {motion}"))

    def use_robot(self, robot: Robot) -> None:
        """Take another arm, as it was left when it was last in use."""
        if robot is self.robot:
            return
        self._left[self.robot.name] = self._experiment
        left = self._left.get(robot.name)
        self.edit(f"Take the {robot.title}", left if left and left.robot is robot else self._make_experiment(robot))

    def set_tracking(self, tracking: Tracking | None) -> None:
        """Show a tracked path, or none."""
        if tracking is not self._tracking:
            self._tracking = tracking
            self.tracking_changed.emit(tracking)

    def say(self, text: str, level: str = "info") -> None:
        """A sentence for the status line."""
        self.said.emit(text, level)

    def warn(self, text: str) -> None:
        """A warning for the status line; nothing for an empty text."""
        if text:
            self.say(text, "warning")

    def _put(self, experiment: Experiment) -> None:
        before, self._experiment = self._experiment, experiment
        if experiment is before:
            return
        if experiment.robot is not before.robot:
            self.set_tracking(None)
        self.changed.emit(before, experiment)
