"""The pages of the Device panel, in the order of their buttons."""

from __future__ import annotations

from rvsim.gui.device_control import DeviceControl
from rvsim.gui.page_stack import Page
from rvsim.gui.panels.device_drive import DrivePage
from rvsim.gui.panels.device_measured import MeasuredPage
from rvsim.gui.panels.device_virtual import VirtualPage
from rvsim.gui.panels.device_wire import WirePage
from rvsim.gui.preferences import Preferences
from rvsim.gui.served_arm import ServedArm
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage


def device_pages(
    session: Session, preferences: Preferences, stage: Stage, device: DeviceControl, served: ServedArm
) -> tuple[Page, ...]:
    """Every page is told when it is seen."""
    arguments = (session, preferences, stage, device)
    pages = (
        (DrivePage(*arguments), "Connect an arm, wake it, let it follow or run"),
        (WirePage(*arguments), "Every line that goes to the arm and comes back, in words"),
        (MeasuredPage(*arguments), "What was wanted, sent and measured of the last motion on the arm"),
        (VirtualPage(*arguments, served), "Faults of the virtual arm, and other programs that drive one"),
    )
    return tuple(Page(page.name, page.title, tip, page) for page, tip in pages)
