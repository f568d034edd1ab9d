"""The inspector as a whole: what leads from one page to another."""

import pytest
from PySide6.QtWidgets import QDockWidget

from rvsim.files import load_robot
from rvsim.gui.app import build_window
from rvsim.gui.page_stack import PageStack
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
