"""The pages of the inspector, in the order of their buttons, each with what it shows."""

from __future__ import annotations

from rvsim.gui.panels.inspect_dynamics import DynamicsPage
from rvsim.gui.panels.inspect_forces import ForcesPage
from rvsim.gui.panels.inspect_jacobian import JacobianPage
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.inspect_singular import SingularPage
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.panels.inspect_velocity import VelocityPage
from rvsim.gui.panels.inspect_workspace import WorkspacePage

INSPECT: tuple[tuple[type[InspectPage], str], ...] = (
    (JacobianPage, "The Jacobian, entry by entry, and where each column comes from"),
    (VelocityPage, "From tool to joints and back, and jogging by held buttons"),
    (SingularPage, "How near to a singularity, which one, and what is lost there"),
    (ForcesPage, "Pull at the tool and see what every joint holds"),
    (DynamicsPage, "Gravity, Coriolis and inertia, the mass matrix and the energies"),
    (WorkspacePage, "Where the tool can go, in sections and in the scene"),
    (SourcePage, "What the sources print wrongly, worked out beside what is right"),
)
