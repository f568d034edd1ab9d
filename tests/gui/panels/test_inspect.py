"""The inspector as a whole: what leads from one page to another, and that it fits small screens."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QTableView

from rvsim.experiment import Load
from rvsim.files import load_robot
from rvsim.gui.app import build_window
from rvsim.gui.page_stack import PageStack
from rvsim.gui.panels.folding_row import FoldingGrid
from rvsim.gui.panels.inspect_jacobian_table import JacobianTable
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.panels.inspect_sources_button import SourcesButton
from rvsim.gui.preferences import Preferences
from rvsim.lab.sources import errata


@pytest.mark.parametrize(("page", "topic"), [("jacobian", "jacobian"), ("singular", "singularity")])
def test_where_a_source_errs_a_button_leads_to_what_it_says(qtbot, page, topic):
    window = build_window(Preferences())
    qtbot.addWidget(window)
    window.show()
    window.findChild(QDockWidget, "inspect_dock").raise_()
    stack = window.findChild(PageStack, "inspect_pages")
    stack.show_page(page)
    button = stack.current.widget.findChild(SourcesButton)
    assert str(len(errata("rv-m1", topic))) in button.text()
    button.click()
    assert stack.current.name == "source"
    assert window.findChild(SourcePage).chosen.topic == topic
    window.session.use_robot(load_robot("rv-1a"))
    stack.show_page(page)
    assert button.isHidden()


def cut_cells(table):
    """The texts of a table that are wider than their cells, headers among them."""
    model, header = table.model(), table.horizontalHeader()
    room = table.fontMetrics().horizontalAdvance
    for column in (column for column in range(model.columnCount()) if not table.isColumnHidden(column)):
        cells = [model.index(row, column) for row in range(model.rowCount())]
        icon = 20 if cells and cells[0].data(Qt.ItemDataRole.DecorationRole) else 0
        titles = str(model.headerData(column, Qt.Orientation.Horizontal)).split("\n")
        for text in (*titles, *(str(cell.data()) for cell in cells)):
            if room(text) + (0 if text in titles else icon) > header.sectionSize(column):
                yield f"{table.objectName()}: {text}"


def test_on_a_small_screen_in_large_letters_with_more_decimals_no_cell_is_cut(qtbot):
    preferences = Preferences()
    preferences.set("presentation", True)
    preferences.set("extra_decimals", 2)
    window = build_window(preferences, robot="ur5e", renderer="painter")
    qtbot.addWidget(window)
    window.resize(1024, 600)
    window.show()
    qtbot.waitUntil(lambda: window.width() == 1024)
    assert window.minimumSizeHint().width() <= 1024
    heavy = Load(np.array([-200.0, 0.0, 0.0, 0.0, 0.0, 0.0]), payload=5.0, own_weight=True)
    window.session.edit("Load", window.session.experiment.with_load(heavy))
    stack = window.findChild(PageStack, "inspect_pages")
    for page in stack.pages:
        window.docks.show_panel(page.name)
        QApplication.processEvents()
        tables = [table for table in page.widget.findChildren(QTableView) if not isinstance(table, JacobianTable)]
        assert [cut for table in tables for cut in cut_cells(table)] == [], page.name


def test_a_combo_box_that_would_be_cut_gets_a_line_of_its_own(qtbot):
    boxes = [QLabel("a long word"), QLabel("another one")]
    grid = FoldingGrid(boxes, 6)
    qtbot.addWidget(grid)
    wide = 2 * max(box.minimumSizeHint().width() for box in boxes) + 6
    grid.resize(wide, 80)
    grid.show()
    qtbot.waitUntil(lambda: boxes[0].y() == boxes[1].y())
    grid.resize(wide - 1, 80)
    qtbot.waitUntil(lambda: boxes[0].x() == boxes[1].x() and grid.folded)
