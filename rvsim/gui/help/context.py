"""Which page belongs to what has the focus: the nearest panel around it says."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from rvsim.gui.help.library import INDEX
from rvsim.gui.page_stack import PageStack

# Where the page is not called as the panel is.
PAGE_OF_PANEL = {"how": "inverse-kinematics"}
# By objectName, those that are in no stack of pages.
PAGE_OF_WIDGET = {
    "arm_dock": "arm",
    "scene_view": "scene",
    "plots_panel": "curves",
    "player_bar": "curves",
    "toolbar": "keyboard",
    "sources_dialog": "sources",
    "path_points_dialog": "path",
    "animation_dialog": "files",
    "import_dialog": "files",
    "report_dialog": "files",
    "notes_dialog": "files",
    "matrix_dialog": "inverse",
}


def help_page_of(widget: QWidget | None) -> str:
    """The name of the page about the panel in which a widget lies; the contents where there is none."""
    while widget is not None:
        if isinstance(widget, PageStack):
            return page_of_panel(widget.current.name)
        if widget.objectName() in PAGE_OF_WIDGET:
            return PAGE_OF_WIDGET[widget.objectName()]
        widget = widget.parentWidget()
    return INDEX


def page_of_panel(name: str) -> str:
    """The page about a page of a panel."""
    return PAGE_OF_PANEL.get(name, name)
