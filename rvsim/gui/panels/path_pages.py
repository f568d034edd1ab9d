"""The pages beside the Path panel, in the order of their buttons, each with what it shows."""

from __future__ import annotations

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.page_stack import Page
from rvsim.gui.panels.path_program import ProgramPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker

_KINDS = ((ProgramPage, "An ordered list of moves: teach, check and run it"),)


def path_pages(
    session: Session, preferences: Preferences, stage: Stage, tracker: PathTracker, motion: MotionControl
) -> tuple[Page, ...]:
    """Every page, made."""
    arguments = (session, preferences, stage, tracker, motion)
    return tuple(Page(kind.name.removeprefix("path_"), kind.title, tip, kind(*arguments)) for kind, tip in _KINDS)
