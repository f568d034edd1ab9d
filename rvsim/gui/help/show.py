"""Opens the help window: on a page, or on that of the panel that the reader attends to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rvsim.gui.help.context import help_page_of
from rvsim.gui.help.window import HelpWindow

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow


def show_help(window: MainWindow, page: str = "") -> HelpWindow:
    """Show a page; "" for that of what the reader attends to. There is one help window, and it stays."""
    name = page or help_page_of(window.attention.widget)
    shown = window.findChild(HelpWindow)
    if not isinstance(shown, HelpWindow):
        shown = HelpWindow(window, name)
    shown.show_page(name)
    shown.showNormal() if shown.isMinimized() else shown.show()
    shown.activateWindow()
    return shown
