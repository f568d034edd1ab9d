"""Tracks the line and the chosen trajectory: path → joints → motion, and the repairs offered for missed points."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

from PySide6.QtCore import QObject, Signal

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, TrajectoryTask, limit_violations
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.session import Session
from rvsim.lab.lines import line_presets
from rvsim.lab.named_paths import line_of, named_path
from rvsim.lab.sentences import tracking_sentence
from rvsim.motion import Path, Tracking, Trajectory, track, trajectory_of

# Where a path of a source cannot be drawn as printed: the same path where it can.
_PLACEMENTS = {
    "letter-raw": "letter-board",
    "letter-scaled": "letter-flat",
    "ellipse": "ellipse-moved",
}
_REMEMBERED = 8  # results that undo can bring back


class Repair(NamedTuple):
    """What could be done about missed points: what the button says, and the state in which to track again."""

    title: str
    tip: str
    experiment: Experiment


class _Done(NamedTuple):
    """A tracking, and the state that it is the result of."""

    kind: str
    experiment: Experiment
    tracking: Tracking
    trajectory: Trajectory | None
    text: str

    def still_holds(self, experiment: Experiment) -> bool:
        """Whether tracking in that state would give the same, from wherever the arm stands."""
        own, other = self.experiment, experiment
        same_task = own.line is other.line if self.kind == "line" else own.trajectory is other.trajectory
        same_limits = own.ignore_limits == other.ignore_limits or self._needs_no_choice()
        return same_task and own.robot is other.robot and same_limits

    def _needs_no_choice(self) -> bool:
        """Whether it is whole and within the limits, so that it is the same whether they are heeded or not."""
        tracking = self.tracking
        return tracking.complete and not any(limit_violations(tracking.robot, q) for q in tracking.q)


class PathTracker(QObject):
    """`tracked(kind)` tells that "line" or "trajectory" has been tracked; the result is `session.tracking`."""

    tracked = Signal(str)

    def __init__(self, session: Session, motion: MotionControl, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._motion = session, motion
        self.kind = "line"
        self._done: list[_Done] = []  # the last one is shown
        session.changed.connect(self._on_changed)

    def track_line(self) -> None:
        """Track the line of the panel, and play it."""
        self._track("line", "Track line")

    def track_trajectory(self) -> None:
        """Track the chosen trajectory, and play it."""
        self._track("trajectory", "Track trajectory")

    def repairs(self) -> tuple[Repair, ...]:
        """What would help with the points that were missed; nothing when none was."""
        tracking = self._session.tracking
        if tracking is None or tracking.complete:
            return ()
        offers = (self._free_pitch(tracking), self._ignore_limits(tracking), self._placement(tracking))
        return tuple(offer for offer in offers if offer is not None)

    def apply(self, repair: Repair) -> None:
        """Change what the repair changes, and track again."""
        self._session.edit(repair.title, repair.experiment)
        self._track(self.kind, repair.title)

    def clear(self) -> None:
        """Take the tracked path and its motion out."""
        self._done = []
        self._motion.load(None, "")
        self._session.set_tracking(None)

    def _on_changed(self, _before: Experiment, after: Experiment) -> None:
        """A result stays as long as it is the result of what stands in the panel; undo brings an earlier one back."""
        shown = self._session.tracking
        if shown is not None and self._done[-1].still_holds(after):
            return
        known = next((done for done in reversed(self._done) if done.still_holds(after)), None)
        if known is not None:
            self._done.remove(known)
            self._show(known)
        elif shown is not None:
            self._motion.load(None, "")
            self._session.set_tracking(None)
            self._session.say("Changed: track it again to see what the arm can do now.")

    # --- inside ----------------------------------------------------------------------------------------------------

    def _track(self, kind: str, text: str) -> None:
        self.kind = kind
        experiment = self._session.experiment
        try:
            tracking = track(
                experiment.robot, self._path(experiment), near=experiment.q, ignore_limits=experiment.ignore_limits
            )
        except RvsimError as problem:
            self._session.say(str(problem), "error")
            return
        self._show(_Done(kind, experiment, tracking, trajectory_of(tracking, experiment.q), text))
        self._session.say(tracking_sentence(tracking), "info" if tracking.complete else "warning")
        self.tracked.emit(kind)
        self._motion.play()

    def _show(self, done: _Done) -> None:
        self.kind = done.kind
        self._done = [*self._done, done][-_REMEMBERED:]
        self._motion.load(done.trajectory, done.text)
        self._session.set_tracking(done.tracking)

    def _path(self, experiment: Experiment) -> Path:
        robot, task = experiment.robot, experiment.trajectory
        if self.kind == "line":
            return line_of(robot, experiment.line, experiment.q)
        return named_path(task.name, robot, orientation=task.orientation, height=task.height, q=experiment.q)

    def _with_task(self, **changes: Any) -> Experiment:
        experiment = self._session.experiment
        if self.kind == "line":
            return replace(experiment, line=replace(experiment.line, **changes))
        return replace(experiment, trajectory=replace(experiment.trajectory, **changes))

    def _free_pitch(self, tracking: Tracking) -> Repair | None:
        reachable = any(missed.kind != "reach" for missed in tracking.unreached)
        if tracking.path.rotations is None or not reachable:
            return None
        tip = "Let the tool tilt as it likes: the position is kept, the orientation is not"
        return Repair("Free pitch", tip, self._with_task(orientation="free"))

    def _ignore_limits(self, tracking: Tracking) -> Repair | None:
        if tracking.ignore_limits or not any(missed.kind == "limits" for missed in tracking.unreached):
            return None
        tip = "Go beyond the joint limits, as the source's program did; a real arm cannot"
        return Repair("Ignore limits", tip, replace(self._session.experiment, ignore_limits=True))

    def _placement(self, tracking: Tracking) -> Repair | None:
        experiment, tip = self._session.experiment, "Move it to a place where the arm reaches all of it"
        if self.kind == "line":
            return Repair("Preset line", tip, replace(experiment, line=line_presets(tracking.robot)[0].task()))
        drawable = _PLACEMENTS.get(experiment.trajectory.name)
        if drawable is None:
            return None
        return Repair("Drawable placement", tip, replace(experiment, trajectory=TrajectoryTask(drawable)))
