"""Tracks the line and the chosen trajectory: path → joints → motion, and repairs when they are wanted."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from PySide6.QtCore import QObject, Signal

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, limit_violations
from rvsim.experiment.session_state import Tracked, TrackedFrom
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.repair_search import RepairSearch
from rvsim.gui.session import Session
from rvsim.gui.workers import LatestWorker
from rvsim.lab.repairs import Offer, motion_of, path_of, track_lifted
from rvsim.lab.sentences import Units, tracking_sentence
from rvsim.language import again, tr
from rvsim.motion import Path, Tracking, Trajectory, track
from rvsim.robot import Robot

_AT_ONCE, _AT_ONCE_FREE = 250, 40  # points that are tracked without a worker
_REMEMBERED = 8  # results that undo can bring back


class _Done(NamedTuple):
    """A tracking, the state that it is the result of, and where it began."""

    kind: str
    experiment: Experiment
    tracking: Tracking
    trajectory: Trajectory | None
    text: str
    began: TrackedFrom

    def still_holds(self, experiment: Experiment) -> bool:
        """Whether tracking in that state would give the same, from wherever the arm stands."""
        return _same_task(self.kind, self.experiment, experiment, limits_matter=not self._needs_no_choice())

    def again(self) -> _Done:
        """The same, named in the language that is spoken now."""
        return self._replace(text=again(self.text))

    def _needs_no_choice(self) -> bool:
        """Whether it is whole and within the limits, so that it is the same whether they are heeded or not."""
        tracking = self.tracking
        return tracking.complete and not any(limit_violations(tracking.robot, q) for q in tracking.q)


def _same_task(kind: str, one: Experiment, other: Experiment, *, limits_matter: bool = True) -> bool:
    """Whether both states ask for the same path of the same arm, under the same rule about its limits."""
    same = one.line is other.line if kind == "line" else one.trajectory is other.trajectory
    return same and one.robot is other.robot and (one.ignore_limits == other.ignore_limits or not limits_matter)


class _Asked(NamedTuple):
    """A path that is to be tracked: of which kind, in which state, and from where."""

    kind: str
    experiment: Experiment
    began: TrackedFrom


def _solved(asked: _Asked, path: Path, text: str) -> _Done:
    kind, experiment, began = asked
    tracking = track(experiment.robot, path, near=began.near, ignore_limits=experiment.ignore_limits)
    if began.lifts and max(began.lifts) < tracking.samples:
        tracking = track_lifted(tracking, began.lifts)
    return _Done(kind, experiment, tracking, motion_of(tracking, experiment.at(began.start)), text, began)


def _timed_again(done: _Done, experiment: Experiment) -> _Done:
    """The same path as another law and time have it, from where the arm stands now."""
    told = replace(done.experiment, law=experiment.law, path_seconds=experiment.path_seconds, ease=experiment.ease)
    began = replace(done.began, start=experiment.q)
    return done._replace(experiment=told, trajectory=motion_of(done.tracking, experiment), began=began)


def _same_pace(one: Experiment, other: Experiment) -> bool:
    return (one.law, one.path_seconds, one.ease) == (other.law, other.path_seconds, other.ease)


def takes_long(robot: Robot, path: Path) -> bool:
    """Whether tracking could hold up the window for a tenth of a second. By size, so that it is always the same."""
    free = path.rotations is None and robot.dof > 3
    return path.samples > (_AT_ONCE_FREE if free else _AT_ONCE)


class PathTracker(QObject):
    """Short paths are tracked at once, long ones in a worker.

    Signals:
        tracked(kind): "line" or "trajectory" has been tracked; the result is `session.tracking`.
        busy_changed(busy): the worker has begun, or ended.
        closed(): the window closes: workers of others about paths end too.
    """

    tracked = Signal(str)
    busy_changed = Signal(bool)
    closed = Signal()

    def __init__(self, session: Session, motion: MotionControl, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._motion = session, motion
        self.kind = "line"
        self.units = Units()  # what it says angles and lengths in
        self._quiet = False  # whether the next result is shown without being played
        self._done: list[_Done] = []  # the last one is shown
        self._belonging: WeakKeyDictionary[Experiment, _Done] = WeakKeyDictionary()  # to the states before the present
        self._pending: _Asked | None = None  # what the worker is at
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_solved)
        self.search = RepairSearch(session, motion, self, self)
        session.changed.connect(self._on_changed)

    def track_line(self) -> None:
        """Track the line of the panel, and play it."""
        self._track("line", tr("Track line"))

    def track_trajectory(self) -> None:
        """Track the chosen trajectory, and play it."""
        self._track("trajectory", tr("Track trajectory"))

    def apply(self, offer: Offer) -> None:
        """Do what a repair says: in the experiment where it stands there, else with the path alone."""
        now = self._session.experiment
        if offer.experiment is None:
            near = self._done[-1].began.near if self._done else now.q
            began = TrackedFrom(near, now.q, offer.lifts)
            self._show(_Done(self.kind, now, offer.tracking, motion_of(offer.tracking, now), offer.title, began))
            self._motion.play()
            return
        retimed = offer.tracking is self._session.tracking
        self._session.edit(offer.title, offer.experiment if offer.name == "branch" else offer.experiment.at(now.q))
        if retimed:
            self._motion.play()
        else:
            self._track(self.kind, offer.title)

    @property
    def asked_for(self) -> Tracked:
        """Which path is tracked, or being worked out: "line", "trajectory", or "" for none."""
        if self._pending is None and self._session.tracking is None:
            return ""
        return "line" if self.kind == "line" else "trajectory"

    @property
    def began(self) -> TrackedFrom | None:
        """From where that path is tracked, None for none."""
        if self._pending is not None:
            return self._pending.began
        return None if self._session.tracking is None else self._done[-1].began

    def track_quietly(self, kind: Tracked, began: TrackedFrom | None = None) -> None:
        """Track this path, "" for none, of a session that has been opened; nothing is played.

        Args:
            began: from where it had been tracked, None for the present pose.
        """
        if kind:
            self._quiet = True
            self._track(kind, tr("Track line") if kind == "line" else tr("Track trajectory"), began)

    def take_over(self, other: PathTracker, shown: Tracking | None) -> None:
        """Go on with the results of a window that this one takes the place of, and with what it was at.

        Args:
            other: the tracker of that window.
            shown: the tracked path that it showed.
        """
        self.kind = other.kind
        self._done = [one.again() for one in other._done]
        self._belonging = WeakKeyDictionary({state: one.again() for state, one in other._belonging.items()})
        self._session.set_tracking(shown)
        if other.busy:
            self.track_quietly(other.asked_for, other.began)

    def track_again(self) -> None:
        """The last path once more, for an arm with other limits; nothing is played."""
        if self._done:
            self._quiet = True
            self._track(self.kind, self._done[-1].text)

    @property
    def busy(self) -> bool:
        """Whether a path is being worked out."""
        return self._pending is not None

    def cancel(self) -> None:
        """Give up what is being worked out; what was tracked before stays."""
        if self._pending is not None:
            self._pending, self._quiet = None, False
            self._worker.cancel()
            self.busy_changed.emit(False)
            self._session.say(tr("Given up. What was tracked before is still there."))

    def close(self) -> None:
        """End the worker, for the window closes."""
        self._pending = None
        self._worker.close()
        self.search.close()
        self.closed.emit()

    def clear(self) -> None:
        """Take the tracked path and its motion out."""
        self._done = []
        self._belonging.clear()
        self._motion.load(None, "")
        self._session.set_tracking(None)

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        """A result stays as long as it is the result of what stands in the panel; undo brings an earlier one back."""
        if self._pending is not None and not _same_task(*self._pending[:2], after):
            self.cancel()
        shown = self._done[-1] if self._session.tracking is not None else None
        if shown is not None:
            self._belonging[before] = shown
        known = self._known(after, shown)
        if known is not None:
            self._bring_back(known, shown, after)
        elif shown is not None:
            self._motion.load(None, "")
            self._session.set_tracking(None)
            self._session.say(tr("Changed: track it again to see what the arm can do now."))

    def _known(self, experiment: Experiment, shown: _Done | None) -> _Done | None:
        """The result that belonged to that state; else the one that is shown, or an earlier one, if it still holds."""
        # Of the same kind: who changes the letter is not shown the line that was tracked before it.
        earlier = (one for one in reversed(self._done) if one.kind == self.kind)
        known = (self._belonging.get(experiment), shown, *earlier)
        return next((one for one in known if one is not None and one.still_holds(experiment)), None)

    def _bring_back(self, known: _Done, shown: _Done | None, experiment: Experiment) -> None:
        """Show a result at the present pace, at the moment in which the arm stands there."""
        if not _same_pace(known.experiment, experiment):
            known = _timed_again(known, experiment)
        if shown is None or known.trajectory is not shown.trajectory:
            self._done = [one for one in self._done if one.tracking is not known.tracking]
            self._show(known)
        if self._motion.player.trajectory is known.trajectory and not self._session.continuing:
            self._motion.wait_for(experiment)

    @property
    def trajectory(self) -> Trajectory | None:
        """The motion along what is tracked, None when nothing is."""
        shown = self._session.tracking is not None and self._done  # neither, while it is being taken out
        return self._done[-1].trajectory if shown else None

    # --- inside ----------------------------------------------------------------------------------------------------

    def _track(self, kind: str, text: str, began: TrackedFrom | None = None) -> None:
        self.kind = kind
        experiment = self._session.experiment
        asked = _Asked(kind, experiment, began or TrackedFrom(experiment.q, experiment.q))
        try:
            path = path_of(kind, experiment.at(asked.began.near))
            job = partial(_solved, asked, path, text)
            if takes_long(experiment.robot, path):
                self._pending = asked
                self._worker.ask(job)
                self.busy_changed.emit(True)
                self._session.say(tr("Working out {samples} points …", samples=path.samples))
                return
            done = job()
        except (RvsimError, OSError) as problem:
            self._quiet = False
            self._session.say(str(problem), "error")
            return
        self._finish(done)

    def _on_solved(self, done: _Done) -> None:
        self._pending = None
        self.busy_changed.emit(False)
        asked, now = done.experiment, self._session.experiment
        # The arm may have been moved meanwhile: the way to the path begins where it is now, at the present pace.
        stayed = np.array_equal(asked.q, now.q) and _same_pace(asked, now)
        self._finish(done if stayed else _timed_again(done, now))

    def _finish(self, done: _Done) -> None:
        self._show(done)
        sentence = tracking_sentence(done.tracking, self.units)
        self._session.say(sentence, "info" if done.tracking.complete else "warning")
        self.tracked.emit(done.kind)
        quiet, self._quiet = self._quiet, False
        if quiet:
            self._motion.wait_for(self._session.experiment)
        else:
            self._motion.play()

    def _show(self, done: _Done) -> None:
        self.kind = done.kind
        self._done = [*self._done, done][-_REMEMBERED:]
        self._motion.load(done.trajectory, done.text)
        self._session.set_tracking(done.tracking)
