"""Every box of every page gets every text that is no sane number, and ten million characters from the clipboard.

    python tests/soak/soak_boxes.py [--robot rv-m1 al5b] [--only WORDS ...]

Laws: no exception in any thread; no warning from Qt; each text is dealt with within a second of computing; the arm
stays where a number can say it is. tests/gui/test_extreme_values.py does a few pages.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import sys

import numpy as np
from monkey_watch import Watch
from monkey_world import temporary_world
from PySide6.QtCore import QEvent, QMimeData, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QComboBox, QLineEdit, QPlainTextEdit, QWidget

from rvsim.gui.app import build_window, make_application
from rvsim.gui.main_window import MainWindow
from rvsim.gui.page_stack import PageStack
from rvsim.gui.preferences import Preferences

TEXTS = (
    *("nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "", " ", "1,5", "1.234,5", "٣٫٥", "-١٢٣", "９０", "1/0"),
    *("9" * 400, "2**99999", "(" * 500, "\u202e12", "\ud7ff", "pi/4", "0", "-0", "--3", "30 mm", "1e6 deg"),
)
HUGE = ("1 2;", "١٢٣", "x")  # each pasted until there are ten million characters
_KINDS: tuple[type[QWidget], ...] = (QAbstractSpinBox, QLineEdit, QPlainTextEdit)


class Boxes:
    """The boxes of one window, and what is written into them."""

    def __init__(self, robot: str, watch: Watch) -> None:
        self.window: MainWindow = build_window(Preferences(), robot=robot)
        self.window.show()
        self.watch, self.filled = watch, 0

    @property
    def pages(self) -> list[str]:
        """All pages, and the arm's own panel."""
        return ["arm", *(page.name for stack in self.window.findChildren(PageStack) for page in stack.pages)]

    def fill_page(self, page: str, texts: tuple[str, ...] = TEXTS, huge: tuple[str, ...] = HUGE) -> None:
        """Everything into every box of a page that can be written in."""
        self.window.docks.show_panel(page)
        QApplication.processEvents()
        # What is written may rebuild the page: a box is found again by its place among the others.
        for number in range(len(self._boxes())):
            for text in texts:
                self._fill(page, number, text, pasted=False)
            for text in huge:
                self._fill(page, number, text * (10_000_000 // len(text)), pasted=True)

    def _boxes(self) -> list[QWidget]:
        found: list[QWidget] = []
        for widget in self.window.findChildren(QWidget):
            inside = isinstance(widget.parentWidget(), QAbstractSpinBox | QComboBox)
            if isinstance(widget, _KINDS) and not inside and not widget.visibleRegion().isEmpty():
                found.append(widget)
        return found

    def _fill(self, page: str, number: int, text: str, *, pasted: bool) -> None:
        boxes = self._boxes()
        if number >= len(boxes) or not boxes[number].isEnabled():
            return
        box = boxes[number]
        words = f"{page}/{box.objectName()} {text[:20]!r}"
        self.watch.rest()
        self.watch.turn(0.0, words)
        box.setFocus()
        QTest.keyClick(box, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        if pasted:
            self._paste(box, text)
        else:
            QTest.keyClick(box, Qt.Key.Key_Delete)
            for letter in text:  # QTest itself knows no letters beyond Latin-1
                QApplication.sendEvent(box, QKeyEvent(QEvent.Type.KeyPress, 0, Qt.KeyboardModifier.NoModifier, letter))
        QTest.keyClick(box, Qt.Key.Key_Return)
        QApplication.processEvents()
        self.watch.turn(0.0, words)
        self.filled += 1
        if not np.all(np.isfinite(self.window.session.q)):
            self.watch.find(f"{words}: the arm is at {self.window.session.q}")
        self._tidy()

    def _paste(self, box: QWidget, text: str) -> None:
        data = QMimeData()
        data.setText(text)
        QGuiApplication.clipboard().setMimeData(data)
        QTest.keyClick(box, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
        QGuiApplication.clipboard().clear()

    def _tidy(self) -> None:
        """As before, for the next one."""
        while QApplication.activePopupWidget() is not None or QApplication.activeModalWidget() is not None:
            ahead = QApplication.activePopupWidget() or QApplication.activeModalWidget()
            assert ahead is not None
            ahead.close()
        stack = self.window.session.undo_stack
        while stack.canUndo():
            stack.undo()
        stack.clear()


def main() -> int:
    """All pages, for each arm."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", nargs="*", default=["rv-m1", "al5b"])
    parser.add_argument("--only", nargs="*", default=[""], help="pages with one of these words in their names")
    options = parser.parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    faulthandler.enable()
    app = make_application(["rvsim-soak"])
    app.setQuitOnLastWindowClosed(False)
    sound = True
    for robot in options.robot:
        with temporary_world(), Watch() as watch:
            boxes = Boxes(robot, watch)
            for page in [page for page in boxes.pages if any(words in page for words in options.only)]:
                boxes.fill_page(page)
            boxes.window.close()
        print(*watch.findings, sep="\n", end="\n" * bool(watch.findings))
        print(f"{robot}: {boxes.filled} texts, the slowest {1e3 * watch.percentile(1.0).thread:.0f} ms", flush=True)
        sound = sound and not watch.findings
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
