"""Checks what is tracked and looks for repairs beside the window: one search, shown on every page that offers them."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple, Protocol

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.parts_worker import PartsWorker
from rvsim.gui.session import Session
from rvsim.lab.repairs import Offer, repairs
from rvsim.lab.sentences import Units
from rvsim.motion import Tracking, Trajectory
from rvsim.motion.honesty import Report, check

_LATE = 1.01  # times the time asked for


class Tracked(Protocol):
    """What is tracked: "line" or "trajectory", and the units in which repairs are told."""

    kind: str
    units: Units


class _Checked(NamedTuple):
    tracking: Tracking
    trajectory: Trajectory | None
    report: Report
    units: Units


class RepairSearch(QObject):
    """Looks by itself where points are missed or the path is late, and wherever somebody asks for the report.

    Signals:
        changed(): another report, another offer, or the search is over.
    """

    changed = Signal()

    def __init__(
        self, session: Session, motion: MotionControl, tracked: Tracked, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._motion, self._tracked = session, motion, tracked
        self._checked: _Checked | None = None
        self.offers: list[Offer] = []
        self.worker = PartsWorker(self)
        self.worker.part.connect(self._on_offer)
        self.worker.done.connect(self.changed)
        self._later = QTimer(self, singleShot=True, interval=0)  # path and motion change one after the other
        self._later.timeout.connect(self._follow)
        session.tracking_changed.connect(lambda _: self._later.start())
        motion.loaded.connect(self._later.start)

    @property
    def report(self) -> Report | None:
        """Of what was looked at last."""
        return self._checked.report if self._checked else None

    @property
    def trajectory(self) -> Trajectory | None:
        """The motion that was looked at last."""
        return self._checked.trajectory if self._checked else None

    @property
    def busy(self) -> bool:
        """Whether there may be more to come."""
        return self.worker.busy or self._later.isActive()

    @property
    def needed(self) -> bool:
        """Whether there is something to repair."""
        return self.report is not None and self.report.severity != "good"

    def look(self) -> None:
        """Check again if another path has been tracked, it is travelled another way, or other units are spoken."""
        tracking, before = self._session.tracking, self._checked
        trajectory = None if tracking is None else self._trajectory_of(tracking)
        if tracking is None:
            self._checked = None
        elif before is None or before.tracking is not tracking or self._is_other(before, trajectory):
            self._checked = _Checked(tracking, trajectory, check(tracking, trajectory), self._tracked.units)
        elif before.units != self._tracked.units:
            self._checked = before._replace(units=self._tracked.units)
        if self._checked is not before:
            self._search()

    def cancel(self) -> None:
        """Give up the search; what was found stays."""
        self.worker.cancel()
        self.changed.emit()

    def close(self) -> None:
        """End the thread, for the window closes."""
        self._later.stop()
        self.worker.close()

    # --- inside ------------------------------------------------------------------------------------------------------

    def _follow(self) -> None:
        """Nobody has asked: look only where something is plainly wrong; what was found of another path is no more."""
        tracking = self._session.tracking
        if tracking is None or not tracking.complete or self._is_late() or self._checked is not None:
            self.look()

    def _is_late(self) -> bool:
        motion = self._motion.player.trajectory
        stretches = motion.stretches if isinstance(motion, Trajectory) else ()
        return any(0.0 < _LATE * stretch.wanted < stretch.duration for stretch in stretches)

    @staticmethod
    def _is_other(checked: _Checked, trajectory: Trajectory | None) -> bool:
        """Another motion along the same path; while something else is played the old one still counts."""
        return trajectory is not None and checked.trajectory is not trajectory

    def _trajectory_of(self, tracking: Tracking) -> Trajectory | None:
        """The motion in the player, if it is one along this path."""
        loaded = self._motion.player.trajectory
        if not isinstance(loaded, Trajectory) or not tracking.reached_count:
            return None
        first = tracking.q[tracking.reached][0]
        along = np.array_equal(loaded.q(loaded.path_start), first) and loaded.path_start < loaded.duration
        return loaded if along else None

    def _search(self) -> None:
        self.worker.cancel()
        self.offers = []
        report = self.report
        if report is not None and self.needed:
            kind, units = self._tracked.kind, self._tracked.units
            self.worker.start(partial(repairs, kind, self._session.experiment, report, units))
        self.changed.emit()

    def _on_offer(self, offer: Offer) -> None:
        self.offers.append(offer)
        self.changed.emit()
