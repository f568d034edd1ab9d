"""A report without a window: what `rvsim report` writes."""

from __future__ import annotations

import os

from PySide6.QtGui import QGuiApplication

from rvsim.gui.report.bundle import Order, write_bundle
from rvsim.gui.theme import load_fonts
from rvsim.lab.report import Study


def write_report(study: Study, order: Order) -> None:
    """Make the whole bundle.

    Raises:
        FileWriteError: it cannot be written there; nothing is.
    """
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    application = QGuiApplication.instance() or QGuiApplication(["rvsim"])
    load_fonts()
    for _ in write_bundle(study, order):
        pass
    del application  # it had to live until here
