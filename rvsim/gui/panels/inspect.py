"""The pages of the inspector, in the order of their buttons, each with what it shows."""

from __future__ import annotations

from rvsim.gui.page_stack import Page, PageStack
from rvsim.gui.panels.inspect_dynamics import DynamicsPage
from rvsim.gui.panels.inspect_forces import ForcesPage
from rvsim.gui.panels.inspect_jacobian import JacobianPage
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_singular import SingularPage
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.panels.inspect_sources_button import SourcesButton
from rvsim.gui.panels.inspect_velocity import VelocityPage
from rvsim.gui.panels.inspect_workspace import WorkspacePage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.language import tr, tr_later

INSPECT: tuple[tuple[type[InspectPage], str], ...] = (
    (JacobianPage, tr_later("The Jacobian, entry by entry, and where each column comes from")),
    (VelocityPage, tr_later("From tool to joints and back, and jogging by held buttons")),
    (SingularPage, tr_later("How near to a singularity, which one, and what is lost there")),
    (ForcesPage, tr_later("Pull at the tool and see what every joint holds")),
    (DynamicsPage, tr_later("Gravity, Coriolis and inertia, the mass matrix and the energies")),
    (WorkspacePage, tr_later("Where the tool can go, in sections and in the scene")),
    (SourcePage, tr_later("What the sources print wrongly, worked out beside what is right")),
)


def inspector(session: Session, preferences: Preferences, stage: Stage) -> PageStack:
    """All pages behind their buttons; what leads from one to the page of the sources does so."""
    arguments = (session, preferences, stage)
    pages = [
        Page(kind.name.removeprefix("inspect_"), tr(kind.title), tr(tip), kind(*arguments)) for kind, tip in INSPECT
    ]
    stack = PageStack("inspect_pages", pages)
    sources = next(page.widget for page in pages if isinstance(page.widget, SourcePage))

    def show(topic: str) -> None:
        sources.choose_topic(topic)
        stack.show_page("source")

    for button in stack.findChildren(SourcesButton):
        button.asked.connect(show)
    return stack
