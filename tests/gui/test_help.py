"""The help says what is so: pages exist, links lead somewhere, examples work, what is named is in the window."""

from __future__ import annotations

import re
from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QAction, QTextBlock
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QDockWidget,
    QGroupBox,
    QLabel,
    QMenu,
    QTabBar,
    QTabWidget,
    QWidget,
)
from pytestqt.qtbot import QtBot

from rvsim.errors import RvsimError
from rvsim.gui.about import AboutDialog
from rvsim.gui.app import build_window
from rvsim.gui.formula import SIZE, typeset
from rvsim.gui.help.browser import HelpBrowser
from rvsim.gui.help.context import PAGE_OF_WIDGET, help_page_of, page_of_panel
from rvsim.gui.help.document import prepared
from rvsim.gui.help.examples import follow, panel_names
from rvsim.gui.help.library import INDEX, help_pages, plain_line, search
from rvsim.gui.help.show import show_help
from rvsim.gui.help.window import HelpWindow
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.gui.sources_dialog import sources_dialog

PAGES = help_pages()
LINK = re.compile(r"\[([^\]]+)\]\(([^)]+)\)")
BOLD = re.compile(r"\*\*([^*]+)\*\*")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
WIDEST = 440.0  # [px] of a formula in letters of 16 px: what a window 560 wide has room for
# Read by everybody as emphasis: a sentence, or a term that is explained.
EMPHASIS = re.compile(r".*[.:]$")


def links() -> Iterator[tuple[str, str]]:
    for page in PAGES.values():
        for _text, link in LINK.findall(CODE.sub("", page.source)):
            yield page.name, link


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    made.show()
    return made


# --- the pages ---------------------------------------------------------------------------------------------------


def test_every_panel_has_its_page(window: MainWindow) -> None:
    wanted = {page_of_panel(name) for name in panel_names(window)} | set(PAGE_OF_WIDGET.values())
    assert sorted(wanted - set(PAGES)) == []


def test_every_page_can_be_found_from_the_contents() -> None:
    seen, todo = {INDEX}, [INDEX]
    while todo:
        page = todo.pop()
        for name, link in links():
            target = urlsplit(link).path.removesuffix(".md")
            if name == page and link.partition("#")[0].endswith(".md") and target not in seen:
                seen.add(target)
                todo.append(target)
    assert sorted(set(PAGES) - seen) == []


def test_every_link_leads_to_a_page_and_its_heading_or_is_an_example() -> None:
    for page, link in links():
        parts = urlsplit(link)
        if parts.scheme:
            assert parts.scheme == "rvsim", (page, link)
            continue
        target = PAGES[parts.path.removesuffix(".md") or page]
        slugs = {section.slug for section in target.sections}
        assert not parts.fragment or parts.fragment in slugs, (page, link)


def test_every_formula_is_set_and_fits_a_narrow_window() -> None:
    for page in PAGES.values():
        for latex in prepared(page.source).formulas:
            made = typeset(latex)
            assert made is not None, (page.name, latex)
            assert made.width < WIDEST * SIZE / 16.0, (page.name, latex)


def test_no_page_scrolls_sideways(window: MainWindow) -> None:
    shown = show_help(window, INDEX)
    shown.resize(480, 500)
    for name in PAGES:
        shown.show_page(name)
        assert shown.browser.horizontalScrollBar().maximum() == 0, name


# --- the examples ------------------------------------------------------------------------------------------------


def test_every_example_works_and_is_one_undo_step(qtbot: QtBot, window: MainWindow) -> None:
    stack = window.session.undo_stack
    for page, link in {link: (page, link) for page, link in links() if link.startswith("rvsim:")}.values():
        before, steps = window.session.experiment, stack.index()
        done = follow(window, link)
        window.motion.pause()
        if done.undoable and not link.startswith("rvsim:source"):
            assert stack.index() == steps + 1, (page, link)
            stack.undo()
            assert window.session.experiment is before, (page, link)
        window.tracker.cancel()
        window.motion.load(None, "")
    assert window.findChild(AboutDialog) is None


def test_a_link_can_do_nothing_that_is_not_in_the_tables(window: MainWindow) -> None:
    before = window.session.experiment
    for link in (
        "file:///etc/passwd",
        "rvsim:run/rm",
        "rvsim:open/quit",
        "rvsim:show/path?robot=../../x",
        "rvsim:show/path?robot=rv-m1&q=1,2",
        "rvsim:show/path?robot=rv-m1&q=nan,0,0,0,0",
        "rvsim:show/device?press=device_connect_button",
        "rvsim:show/path?file=x",
        "rvsim:source/nothing",
    ):
        with pytest.raises(RvsimError):
            follow(window, link)
        assert window.session.experiment is before


# --- the names ---------------------------------------------------------------------------------------------------


def test_what_is_bold_stands_on_a_control_of_the_window(window: MainWindow) -> None:
    known = texts_of(window)
    missing = [
        (page.name, bold)
        for page in PAGES.values()
        for bold in BOLD.findall(CODE.sub("", page.source))
        if not EMPHASIS.match(bold)
        for part in re.split(r" ?[›→] ", bold)
        if not {plain(part), plain(bold)} & known
    ]
    assert missing == []


def plain(text: str) -> str:
    text = re.sub(r"<[^>]+>|[▸▾▲▼↑↓⌂●■▶◐↶↷]", "", text).replace("&&", "\0").replace("&", "").replace("\0", "&")
    return re.sub(r"[\s…:]+|\.\.\.$", " ", plain_line(text)).strip().casefold()


def texts_of(window: MainWindow) -> set[str]:
    """All that is written on controls: of every page, also of those that are made when they are first seen."""
    for name in panel_names(window):
        window.docks.show_panel(name)
    sources_dialog(window)
    AboutDialog(window)
    found: set[str] = set()
    for kind in (QAbstractButton, QLabel, QAction):
        found |= {widget.text() for widget in window.findChildren(kind)}
    found |= {made.title() for kind in (QGroupBox, QMenu) for made in window.findChildren(kind)}
    found |= {action.shortcut().toString() for action in window.findChildren(QAction)}
    found |= {dock.windowTitle() for dock in window.findChildren(QDockWidget)}
    for box in window.findChildren(QComboBox):
        found |= {box.itemText(index) for index in range(box.count())}
    for tabs in window.findChildren(QTabWidget):
        found |= {tabs.tabText(index) for index in range(tabs.count())}
    heads = {text.split(" › ")[-1] for text in found} | {re.split(r": | \d", text)[0] for text in found}
    return {plain(text.removesuffix("▾").strip()) for text in found | heads} | {plain(text) for text in found}


# --- the window --------------------------------------------------------------------------------------------------


def test_f1_explains_what_has_the_focus(window: MainWindow) -> None:
    for name, page in (("joint_value_1", "arm"), ("scene_view", "scene"), ("time_slider", "curves")):
        assert help_page_of(window.findChild(QWidget, name)) == page
    window.docks.show_panel("forces")
    assert help_page_of(window.findChild(QWidget, "wrench_fx")) == "forces"
    window.docks.show_panel("how")
    assert help_page_of(window.findChild(QWidget, "how_copy")) == "inverse-kinematics"
    assert help_page_of(None) == INDEX
    window.actions_by_name["help"].trigger()
    assert window.findChild(HelpWindow).isVisible()


def test_f1_explains_the_page_that_was_brought_to_the_front_or_clicked_in(qtbot: QtBot, window: MainWindow) -> None:
    def explained() -> str:
        return help_page_of(window.attention.widget)

    left = Qt.MouseButton.LeftButton
    tabs = next(bar for bar in window.findChildren(QTabBar) if bar.count() == len(window.docks.right))
    for number, dock in enumerate(window.docks.right):
        window.scene_view.setFocus()
        qtbot.mouseClick(tabs, left, pos=tabs.tabRect(number).center())
        assert explained() == page_of_panel(window.docks.front_page)
        for page in dock.widget().pages:
            qtbot.mouseClick(dock.findChild(QWidget, f"{page.name}_page_button"), left)
            assert explained() == page_of_panel(page.name)
        window.scene_view.setFocus()
        assert explained() == "scene"
    qtbot.mouseClick(window.docks.front.widget().current.widget, left)
    assert explained() == page_of_panel(window.docks.front_page)
    window.joints.robots.setFocus()
    assert explained() == "arm"
    window.docks.left.hide()
    assert explained() == page_of_panel(window.docks.front_page)


def test_back_and_forward_remember_the_way(window: MainWindow) -> None:
    shown = show_help(window, "singular")
    shown.browser.anchorClicked.emit(QUrl("jacobian.md"))
    assert shown.place.page == "jacobian"
    shown.go_back()
    assert (shown.place.page, shown.forward.isEnabled()) == ("singular", True)
    shown.go_forward()
    assert shown.place.page == "jacobian"
    assert show_help(window, "forces") is shown


def test_the_search_finds_all_words_and_opens_where_they_stand(qtbot: QtBot, window: MainWindow) -> None:
    assert search("gimbal lock")[0].section.page in ("conventions", "tool", "glossary")
    assert search("xyzzy") == ()
    assert {hit.section for hit in search("σ")} <= {hit.section for hit in search("sigma")}
    told = " ".join(section.text for page in PAGES.values() for section in page.sections)
    assert not re.findall(r"\b(?:sigma|geq|leq|omega|ddot|rightarrow)\b", told)
    shown = show_help(window, INDEX)
    qtbot.keyClicks(shown.words, "gimbal lock")
    assert "conventions.md" in shown.browser.toMarkdown()
    shown.words.returnPressed.emit()
    assert shown.place.page == search("gimbal lock")[0].section.page
    assert shown.browser.extraSelections()
    assert shown.browser.verticalScrollBar().value() > 0
    assert "&#" not in shown.browser.toPlainText()
    qtbot.keyClicks(shown.words, " <b>$`*")
    assert "Nothing found" in shown.browser.toPlainText()


def test_an_example_can_be_taken_back_in_the_help_itself(window: MainWindow) -> None:
    before = window.session.experiment
    shown = show_help(window, "singular")
    shown.browser.anchorClicked.emit(QUrl("rvsim:show/singular?robot=ur5e"))
    assert window.session.robot.name == "ur5e"
    shown.undo.click()
    assert window.session.experiment is before
    shown.browser.anchorClicked.emit(QUrl("rvsim:show/nothing"))
    assert "nothing" in shown.said.text()


def test_formulas_are_pictures_and_nothing_else_is_loaded(qtbot: QtBot) -> None:
    browser = HelpBrowser()
    qtbot.addWidget(browser)
    browser.show_markdown("# A\n\n```math\n\\tau = J^T F\n```\n\nand $q_1$ ![no](file:///etc/passwd)\n")
    assert browser.formulas == ("\\tau = J^T F", "q_1")
    assert browser.loadResource(2, QUrl("math:0")).width() > 40
    assert browser.loadResource(2, QUrl("file:///etc/passwd")).isNull()
    blocks: list[QTextBlock] = [browser.document().begin()]
    assert blocks[0].blockFormat().headingLevel() == 1


def test_about_comes_while_the_help_is_in_front(qtbot: QtBot, window: MainWindow) -> None:
    shown = show_help(window, INDEX)
    with qtbot.waitActive(shown):
        shown.activateWindow()
    qtbot.keyClick(shown.windowHandle(), Qt.Key.Key_F1, Qt.KeyboardModifier.ControlModifier)
    (dialog,) = window.findChildren(AboutDialog)
    assert dialog.isVisible()
    dialog.close()


def test_about_tells_the_versions_and_copies_them(window: MainWindow) -> None:
    from PySide6.QtGui import QGuiApplication

    window.actions_by_name["about"].trigger()
    dialog = window.findChild(AboutDialog)
    dialog.copy()
    copied = QGuiApplication.clipboard().text()
    for part in ("rvsim ", "Python ", "Qt ", "numpy ", "renderer: "):
        assert part in copied
    dialog.close()


def test_the_columns_of_a_page_from_the_right_begin_there() -> None:
    table = "| 1 | `2` | $3$ |\n|---|---|---|\n| 4 | 5 | 6 |\n\n```\n| a | b |\n```\n"
    arabic = prepared(f"# \u0627\u0644\u0630\u0631\u0627\u0639\n\n{table}").markdown.splitlines()
    english = prepared(f"# Arm\n\n{table}").markdown.splitlines()
    turned = ["|".join(reversed(row.split("|"))) for row in english[2:5]]
    assert arabic[2:5] == turned != english[2:5]
    assert arabic[5:] == english[5:]
