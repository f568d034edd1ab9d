"""Python's rubbish is collected in the window's thread alone.

Otherwise the interpreter collects in whichever thread is busy: a worker then destroys Qt objects of the window that
only refer to each other any more, which Qt does not allow. It says "Timers cannot be started from another thread", or
crashes.
"""

from __future__ import annotations

import gc
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QObject, QTimer

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

    def collect(self) -> None:
        """Collect the oldest generation that is due, as the interpreter would."""
        counts = zip(gc.get_count(), gc.get_threshold(), strict=True)
        due = [generation for generation, (count, most) in enumerate(counts) if count > most]
        if due:
            gc.collect(due[-1])

    def end(self) -> None:
        """Give it back to the interpreter, once the last one ends: all other threads of the window have ended."""
        self._timer.stop()
        _give_back(id(self))


def _give_back(which: int, *_: object) -> None:
    RubbishCollector._at_work.discard(which)
    if not RubbishCollector._at_work:
        gc.enable()
