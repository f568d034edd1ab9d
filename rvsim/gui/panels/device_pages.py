"""The pages of the Device panel, in the order of their buttons."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from rvsim.gui.device_control import DeviceControl
from rvsim.gui.late_page import LatePage
from rvsim.gui.page_stack import Page
from rvsim.gui.panels.device_drive import DrivePage
from rvsim.gui.panels.device_wire import WirePage
from rvsim.gui.preferences import Preferences
from rvsim.gui.served_arm import ServedArm
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.language import tr


def device_pages(
    session: Session, preferences: Preferences, stage: Stage, device: DeviceControl, served: ServedArm
) -> tuple[Page, ...]:
    """Every page is told when it is seen; those that need a connected arm first are made when they are."""
    arguments = (session, preferences, stage, device)

    def calibrate() -> QWidget:
        from rvsim.gui.panels.device_calibrate import CalibratePage

        return CalibratePage(*arguments)

    def measured() -> QWidget:
        from rvsim.gui.panels.device_measured import MeasuredPage

        return MeasuredPage(*arguments)

    def virtual() -> QWidget:
        from rvsim.gui.panels.device_virtual import VirtualPage

        return VirtualPage(*arguments, served)

    return (
        Page("device", tr("Drive"), tr("Connect an arm, wake it, let it follow or run"), DrivePage(*arguments)),
        Page("wire", tr("Wire"), tr("Every line that goes to the arm and comes back, in "
                                    "words"), WirePage(*arguments, served)),
        Page(
            "calibrate", tr("Calibrate"), tr("Find out channel, direction and pulses of each servo, step by step"),
            LatePage(calibrate),
        ),
        Page(
            "measured", tr("Measured"), tr("What was wanted, sent and measured of the last motion on the arm"),
            LatePage(measured),
        ),
        Page(
            "virtual", tr("Virtual"), tr("Faults of the virtual arm, and other programs that drive "
                                         "one"), LatePage(virtual)
        ),
    )  # fmt: skip
