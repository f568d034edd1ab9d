"""Python's rubbish is collected in the window's thread alone, and what Python still knows of dead layout items too.

Otherwise the interpreter collects in whichever thread is busy: a worker then destroys Qt objects of the window that
only refer to each other any more, which Qt does not allow. It says "Timers cannot be started from another thread", or
crashes.

Where a layout with something in it is put into another, Qt for Python 6.11 makes a Python object for each item, kept
as long as the outer layout, but is not told when Qt deletes the item. Whatever Qt makes at that address later, a
menu's window for instance, was taken for the dead item: a wrong type, or the end of the program.
"""

from __future__ import annotations

import gc
from functools import partial
from sys import getrefcount
from typing import ClassVar

from PySide6.QtCore import QAbstractEventDispatcher, QObject, QTimer
from PySide6.QtWidgets import QSpacerItem, QWidgetItem
from shiboken6 import createdByPython, getAllValidWrappers, invalidate

_EVERY_MS = 300


class RubbishCollector(QObject):
    """Takes the collecting over from the interpreter until `end`; several of them are as good as one.

    Args:
        parent: in whose thread it is done.
    """

    _at_work: ClassVar[set[int]] = set()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._at_work.add(id(self))
        gc.disable()
        self.destroyed.connect(partial(_give_back, id(self)))  # of a window that was never closed
        self._timer = QTimer(self, interval=_EVERY_MS)
        self._timer.timeout.connect(self.collect)
        self._timer.start()
        self._items = 0
        QAbstractEventDispatcher.instance().awake.connect(self._watch_items)

    def _watch_items(self) -> None:
        """At each turn of the event loop: it costs a look at how often their type is referred to."""
        items = getrefcount(QWidgetItem) + getrefcount(QSpacerItem)
        if items != self._items:
            forget_layout_items()
            self._items = getrefcount(QWidgetItem) + getrefcount(QSpacerItem)

    def collect(self) -> None:
        """Collect the oldest generation that is due, as the interpreter would."""
        counts = zip(gc.get_count(), gc.get_threshold(), strict=True)
        due = [generation for generation, (count, most) in enumerate(counts) if count > most]
        if due:
            gc.collect(due[-1])
        forget_layout_items()

    def end(self) -> None:
        """Give it back to the interpreter, once the last one ends: all other threads of the window have ended."""
        self._timer.stop()
        _give_back(id(self))


def forget_layout_items() -> None:
    """Let Python know nothing of items that Qt has made for layouts: nobody here ever asks for them."""
    for known in getAllValidWrappers():
        if type(known) in (QWidgetItem, QSpacerItem) and not createdByPython(known):
            invalidate(known)


def _give_back(which: int, *_: object) -> None:
    RubbishCollector._at_work.discard(which)
    if not RubbishCollector._at_work:
        gc.enable()
