"""The pages of the inspector, in the order of their buttons, each with what it shows."""

from __future__ import annotations

from rvsim.gui.panels.inspect_page import InspectPage

INSPECT: tuple[tuple[type[InspectPage], str], ...] = ()
