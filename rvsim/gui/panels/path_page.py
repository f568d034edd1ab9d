"""What the pages beside the Path panel have in common: they know what is tracked, and what plays."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker


class PathPage(InspectPage):
    """A page with the tracker and the motion of the window."""

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        stage: Stage,
        tracker: PathTracker,
        motion: MotionControl,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(session, preferences, stage, parent)
        self._tracker, self._motion = tracker, motion
