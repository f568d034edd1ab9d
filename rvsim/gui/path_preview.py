"""Shows a path in the scene before it is tracked, and says how much of it the arm can reach."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QObject, Signal

from rvsim.errors import NoClosedFormError, RvsimError
from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import takes_long
from rvsim.gui.workers import LatestWorker
from rvsim.lab.orientations import normal_gap
from rvsim.lab.shape_paths import plane_normal, task_path
from rvsim.language import tr, trn
from rvsim.motion import Path, Tracking, track
from rvsim.scene.paths import path_items

LAYER = "path preview"
_MARKED_POINTS = 25
_WORTH_SAYING = np.radians(0.5)


class Reach(NamedTuple):
    """What the arm can do of a path: `share` 0…1, or None where that is not known; a sentence; whether all is well."""

    share: float | None
    text: str
    good: bool


def _reach_of(experiment: Experiment, path: Path) -> Tracking | None:
    try:
        return track(experiment.robot, path, near=experiment.q, ignore_limits=experiment.ignore_limits)
    except NoClosedFormError:
        return None


class PathPreview(QObject):
    """Follows the experiment's trajectory: what is changed is drawn at once, until it, or a line, is tracked.

    Signals:
        changed(): `path`, `reach` or `problem` is another one.
    """

    changed = Signal()

    def __init__(
        self, session: Session, preferences: Preferences, stage: Stage | None, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._stage = session, stage
        self.path: Path | None = None
        self.reach: Reach | None = None
        self.problem = ""
        self._reached = np.empty(0, dtype=bool)
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_reach)
        session.changed.connect(self._on_changed)
        session.tracking_changed.connect(self._on_tracking)
        preferences.changed.connect(lambda name: self._draw() if name == "theme" else None)

    def close_worker(self) -> None:
        """End the worker, for the window closes."""
        self._worker.close()

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            self._clear()
        elif (after.trajectory is not before.trajectory and not self._is_tracked()) or (
            after.ignore_limits != before.ignore_limits and self.path is not None
        ):
            self._show(after)

    def _is_tracked(self) -> bool:
        """Whether it is a trajectory that is shown as tracked, not a line."""
        shown = self._session.tracking
        return shown is not None and shown.path.name != "line"

    def _on_tracking(self, tracking: Tracking | None) -> None:
        if tracking is not None:
            self._clear()

    def _clear(self) -> None:
        self._worker.cancel()
        self.path, self.reach, self.problem = None, None, ""
        self._draw()
        self.changed.emit()

    def _show(self, experiment: Experiment) -> None:
        self.problem = ""
        try:
            self.path = task_path(experiment.robot, experiment.trajectory, experiment.q)
        except (RvsimError, OSError) as problem:
            self._clear()
            self.problem = str(problem)
            self.changed.emit()
            return
        self._reached = np.ones(self.path.samples, dtype=bool)
        job = partial(_reach_of, experiment, self.path)
        if takes_long(experiment.robot, self.path):
            self.reach = Reach(None, tr("Asking how much is in reach …"), True)
            self._worker.ask(job)
            self._draw()
            self.changed.emit()
            return
        self._worker.cancel()
        self._on_reach(job())

    def _on_reach(self, tracking: Tracking | None) -> None:
        if self.path is None:
            return
        if tracking is None:
            self.reach = Reach(None, tr("How much is in reach is not known for this arm."), True)
        else:
            self._reached = tracking.reached
            self.reach = self._said(tracking)
        self._draw()
        self.changed.emit()

    def _said(self, tracking: Tracking) -> Reach:
        share = tracking.reached_count / tracking.samples
        percent = 100 if tracking.complete else min(int(100.0 * share), 99)
        free = tracking.ignore_limits
        said = tr("{percent} % in reach", percent=percent) if free else tr("{percent} % within limits", percent=percent)
        if tracking.jumps:
            said += tr(", ") + trn("{n} jump between branches", "{n} jumps between branches", len(tracking.jumps))
        return Reach(share, said + self._tilt(tracking), tracking.complete and not tracking.jumps)

    def _tilt(self, tracking: Tracking) -> str:
        """How far the tool is from the normal of the path's plane, where it is wanted to be normal and cannot."""
        experiment = self._session.experiment
        normal = plane_normal(experiment.robot, experiment.trajectory)
        if experiment.trajectory.orientation != "normal" or normal is None:
            return ""
        if tracking.path.rotations is None:
            return tr("; this arm turns its tool as it must, not normal to the plane")
        gap = normal_gap(tracking.path, normal)
        return (
            tr("; up to {gap:.1f}° from the normal, the nearest it can", gap=np.degrees(gap))
            if gap > _WORTH_SAYING
            else ""
        )

    def _draw(self) -> None:
        if self._stage is None:
            return
        if self.path is None:
            self._stage.set_layer(LAYER, ())
            return
        items = path_items(
            self.path.points,
            self._reached,
            np.empty((0, 3)),
            self._stage.palette,
            key="preview",
            marks=self.path.samples <= _MARKED_POINTS,
            pen_up=self.path.pen_up,
        )
        self._stage.set_layer(LAYER, items)
