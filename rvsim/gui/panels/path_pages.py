"""The pages beside the Path panel, in the order of their buttons, each with what it shows."""

from __future__ import annotations

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.page_stack import Page
from rvsim.gui.panels.path_check import CheckPage
from rvsim.gui.panels.path_compare import ComparePage
from rvsim.gui.panels.path_program import ProgramPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.language import tr_later

_KINDS = (
    (CheckPage, tr_later("What the path asks of the arm, before it moves, and what would help")),
    (ProgramPage, tr_later("An ordered list of moves: teach, check and run it")),
    (ComparePage, tr_later("The closed form and every numeric solver along the same path")),
)


def path_pages(
    session: Session, preferences: Preferences, stage: Stage, tracker: PathTracker, motion: MotionControl
) -> tuple[Page, ...]:
    """Every page, made."""
    arguments = (session, preferences, stage, tracker, motion)
    return tuple(Page(kind.name.removeprefix("path_"), kind.title, tip, kind(*arguments)) for kind, tip in _KINDS)
