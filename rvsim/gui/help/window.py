"""The help window: one page at a time, contents, search, back and forward, and examples that set the window up."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtCore import QEvent, QPoint, Qt, QTimer, QUrl
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QToolButton, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.gui.help.browser import HelpBrowser
from rvsim.gui.help.examples import SCHEME, follow
from rvsim.gui.help.library import INDEX, Hit, help_pages, search
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, button
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_WIDTHS = 480, 560  # [pixels]
_SHARE = 0.46  # of the width of the window behind
_HEIGHT = 660
_MARGIN = 48  # [pixels] that the window behind is higher, at least
_AT = QPoint(8, 40)
_AT_LEFT = "arm"  # the page of the one panel at the left
_MOST_HITS = 30
_FEWEST_LETTERS = 2
_ENDING = ".md"
_ENTITIES = {ord(sign): f"&#{ord(sign)};" for sign in "\\`*_[]<>#|$&~"}


class Place(NamedTuple):
    """Where a reader is: a page and an anchor in it, or words that are looked for."""

    page: str
    anchor: str = ""
    words: str = ""


class HelpWindow(QWidget):
    """A window of its own beside the main one, which stays usable.

    Args:
        window: the main window, which the examples set up.
        page: the first page that will be shown.
    """

    def __init__(self, window: MainWindow, page: str = INDEX) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("help_window")
        self._window = window
        self._places: list[Place] = []
        self._scrolls: list[int] = []
        self._now = -1
        self._again = QTimer(self, singleShot=True, interval=0)
        self._again.timeout.connect(self._show_again)
        self._make_bar()
        self._make_foot()
        self.browser = HelpBrowser()
        self.browser.anchorClicked.connect(self._on_link)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.setSpacing(6)
        column.addLayout(self._bar)
        column.addWidget(self.browser, 1)
        column.addWidget(self.foot)
        self._add_keys()
        self._place_window(page)
        window.preferences.changed.connect(self._on_preference)
        window.session.undo_stack.indexChanged.connect(self._on_step)

    # --- construction ------------------------------------------------------------------------------------------------

    def _make_bar(self) -> None:
        signs = "←→" if self.layoutDirection() == Qt.LayoutDirection.LeftToRight else "→←"
        self.back = _tool("help_back", signs[0], tr("Back (Alt+Left)"), self.go_back)
        self.forward = _tool("help_forward", signs[1], tr("Forward (Alt+Right)"), self.go_forward)
        self.contents = _tool(
            "help_contents", tr("Contents"), tr("All pages (Alt+Home)"), lambda: self.show_page(INDEX)
        )
        self.words = QLineEdit()
        self.words.setObjectName("help_search")
        self.words.setPlaceholderText(tr("Search all pages"))
        self.words.setAccessibleName(tr("Search all pages"))
        self.words.setToolTip(tr("Ctrl+F; Enter opens the first page that was found"))
        self.words.setClearButtonEnabled(True)
        self.words.textEdited.connect(self._on_words)
        self.words.returnPressed.connect(self._open_first)
        self._bar = QHBoxLayout()
        self._bar.setSpacing(4)
        for part in (self.back, self.forward, self.contents):
            self._bar.addWidget(part)
        self._bar.addWidget(self.words, 1)

    def _make_foot(self) -> None:
        """What came of an example, and the way back."""
        self.foot = QWidget()
        self.said = ElidedLabel()
        self.said.setObjectName("help_said")
        self.undo = button("help_undo", tr("Undo"), tr("Take back what the example has set up"), self._undo)
        row = QHBoxLayout(self.foot)
        row.setContentsMargins(4, 0, 0, 0)
        row.addWidget(self.said, 1)
        row.addWidget(self.undo)
        self.foot.hide()

    def _add_keys(self) -> None:
        keys = {
            "Alt+Left": self.go_back,
            "Alt+Right": self.go_forward,
            "Alt+Home": lambda: self.show_page(INDEX),
            "Ctrl+F": self._to_search,
            "Escape": self.close,
        }
        for text, slot in keys.items():
            QShortcut(QKeySequence(text), self, slot)

    def _place_window(self, page: str) -> None:
        """As it was left; else where the window behind begins, so that the panel that it explains can be seen."""
        kept = self._window.preferences.window_state("help")
        if not kept.isEmpty() and self.restoreGeometry(kept):
            return
        behind = self._window.geometry()
        narrow, wide = _WIDTHS
        self.resize(min(max(round(_SHARE * behind.width()), narrow), wide), min(_HEIGHT, behind.height() - _MARGIN))
        aside = _AT + (QPoint(self._window.docks.left.width(), 0) if page == _AT_LEFT else QPoint())
        left = behind.right() + 1 - aside.x() - self.width() if self.isRightToLeft() else behind.left() + aside.x()
        self.move(left, behind.top() + aside.y())

    # --- going -------------------------------------------------------------------------------------------------------

    @property
    def place(self) -> Place:
        """Where the reader is."""
        return self._places[self._now] if self._places else Place(INDEX)

    def show_page(self, name: str, anchor: str = "", words: str = "") -> None:
        """Show a page, at a heading if one is named; words are marked in it."""
        self._go(Place(name if name in help_pages() else INDEX, anchor, words))

    def take_over(self, other: HelpWindow) -> None:
        """Open in the place of one in another language: on its page and about there, with what was read before."""
        self._places, self._scrolls, self._now = [*other._places], [*other._scrolls], other._now
        self.words.setText(other.words.text())
        self.restoreGeometry(other.saveGeometry())
        before, bar = other.browser.verticalScrollBar(), self.browser.verticalScrollBar()
        share = before.value() / max(before.maximum(), 1)
        self.show()
        self._show()
        bar.setValue(round(share * bar.maximum()))

    def go_back(self) -> None:
        """To where the reader was before."""
        self._step(-1)

    def go_forward(self) -> None:
        """To where the reader was before going back."""
        self._step(1)

    def _go(self, place: Place) -> None:
        if self._places and place == self.place:
            return
        self._keep_scroll()
        del self._places[self._now + 1 :], self._scrolls[self._now + 1 :]
        self._places.append(place)
        self._scrolls.append(0)
        self._now += 1
        self._show()

    def _step(self, by: int) -> None:
        if 0 <= self._now + by < len(self._places):
            self._keep_scroll()
            self._now += by
            self._show()
            self.browser.verticalScrollBar().setValue(self._scrolls[self._now])

    def _keep_scroll(self) -> None:
        if self._places:
            self._scrolls[self._now] = self.browser.verticalScrollBar().value()

    def _show(self) -> None:
        page, anchor, words = self.place
        if page:
            shown = help_pages()[page]
            self.browser.show_markdown(shown.source, [section.slug for section in shown.sections])
        else:
            self.browser.show_markdown(_results(words))
        self.browser.light(words if page else "")
        if anchor:
            self.browser.scrollToAnchor(anchor)
        title = help_pages()[page].title if page else tr("Search")
        self.setWindowTitle(tr("{title} \u2013 rvsim help", title=title))
        self.back.setEnabled(self._now > 0)
        self.forward.setEnabled(self._now + 1 < len(self._places))
        self._tell("")

    def _show_again(self) -> None:
        """The same in other letters and colours."""
        if self._places:
            scroll = self.browser.verticalScrollBar().value()
            self._show()
            self.browser.verticalScrollBar().setValue(scroll)

    # --- search ------------------------------------------------------------------------------------------------------

    def _to_search(self) -> None:
        self.words.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.words.selectAll()

    def _on_words(self, words: str) -> None:
        """While somebody types, the results of what is typed stand in one place of the history."""
        if len(words.strip()) < _FEWEST_LETTERS:
            return
        place = Place("", "", words.strip())
        if self._places and not self.place.page:
            self._places[self._now] = place
            self._show()
        else:
            self._go(place)

    def _open_first(self) -> None:
        found = search(self.words.text())
        if found:
            self._open_hit(found[0], self.words.text())

    def _open_hit(self, hit: Hit, words: str) -> None:
        self.show_page(hit.section.page, hit.section.slug, words)
        self.browser.setFocus(Qt.FocusReason.OtherFocusReason)

    # --- links -------------------------------------------------------------------------------------------------------

    def _on_link(self, link: QUrl) -> None:
        if link.scheme() == SCHEME:
            self._try(link.toString(QUrl.ComponentFormattingOption.FullyEncoded))
            return
        name = link.path().removesuffix(_ENDING) or self.place.page
        words = self.place.words if not self.place.page else ""
        self.show_page(name, link.fragment(), words)

    def _try(self, link: str) -> None:
        try:
            done = follow(self._window, link)
        except RvsimError as problem:
            self._tell(str(problem), "error")
            return
        self._tell(done.sentence)
        self.undo.setEnabled(done.undoable)

    def _tell(self, sentence: str, level: str = "") -> None:
        self.foot.setVisible(bool(sentence))
        self.said.setText(sentence)
        set_role(self.said, level=level)
        self.undo.setEnabled(False)

    def _on_step(self, _index: int) -> None:
        """Something else has been done since, or the example has been taken back."""
        self.undo.setEnabled(False)

    def _undo(self) -> None:
        self._window.session.undo_stack.undo()
        self._tell("")

    # --- window ------------------------------------------------------------------------------------------------------

    def _on_preference(self, name: str) -> None:
        if name in _LOOKS:
            self._again.start()

    def changeEvent(self, event: QEvent) -> None:
        """Other letters or colours: other pictures of the formulas."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.PaletteChange):
            self._again.start()

    def hideEvent(self, event: QHideEvent) -> None:
        """Remember where it was: it is closed, or the window behind is."""
        self._window.preferences.keep_window_state("help", self.saveGeometry())
        super().hideEvent(event)


_LOOKS = {"theme", "presentation"}


def _tool(name: str, text: str, tip: str, slot: object) -> QToolButton:
    made = QToolButton()
    made.setObjectName(name)
    made.setText(text)
    made.setToolTip(tip)
    made.setAccessibleName(tip)
    made.clicked.connect(lambda _checked=False: slot())  # type: ignore[operator]
    return made


def _results(words: str) -> str:
    """What was found, as a page."""
    found = search(words)
    lines = [f"# “{_plain(words)}”", ""]
    if not found:
        lines.append(tr("Nothing found. Try another word, or look into the [contents](index.md)."))
    for hit in found[:_MOST_HITS]:
        section = hit.section
        title = section.title if section.title == hit.page_title else f"{hit.page_title} › {section.title}"
        lines += [f"**[{_plain(title)}]({section.page}.md#{section.slug})**", "", _plain(hit.excerpt), ""]
    return "\n".join(lines)


def _plain(text: str) -> str:
    """Text in which nothing is a mark of Markdown or a formula."""
    return text.translate(_ENTITIES)
