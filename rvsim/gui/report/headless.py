"""A report without a window: what `rvsim report` writes."""

from __future__ import annotations

import os

from PySide6.QtGui import QGuiApplication

from rvsim.gui.picture import save_image
from rvsim.gui.report.bundle import Order, write_bundle
from rvsim.gui.report.picture import pages_picture
from rvsim.gui.theme import load_fonts
from rvsim.lab.report import Study, build


def write_report(study: Study, order: Order, picture: str | None = None) -> None:
    """Make the whole bundle, and a picture of some pages if there is to be one.

    Raises:
        FileWriteError: it cannot be written there; nothing is.
    """
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    application = QGuiApplication.instance() or QGuiApplication(["rvsim"])
    load_fonts()
    for _ in write_bundle(study, order):
        pass
    if picture is not None:
        save_image(pages_picture(build(study, order.cover, order.parts)), picture)
    del application  # it had to live until here
