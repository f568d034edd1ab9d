"""From the log of a driver to the model of the table: a slice at a time, held when it is paused."""

from __future__ import annotations

import math
from collections import deque

from PySide6.QtCore import QObject, QTimer, Signal

from rvsim.device.wire_log import MOST_ENTRIES, WireEntry, WireLog
from rvsim.gui.panels.device_wire_lines import READERS, Language, Line, Reader
from rvsim.gui.panels.device_wire_model import WireModel
from rvsim.gui.panels.device_wire_words import Words
from rvsim.robot import Robot

_AT_ONCE = 500  # entries that are read before the window has its turn


class WireFeed(QObject):
    """Reads a log into a model whenever it is told to `pull`.

    Signals:
        fed(): lines have come, or are held back.
    """

    fed = Signal()

    def __init__(self, model: WireModel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self.log: WireLog | None = None
        self._reader: Reader = READERS["ssc32"]()
        self._read = 0  # so many entries there had been when we asked last
        self._waiting: deque[WireEntry] = deque(maxlen=MOST_ENTRIES)
        self.paused = False
        self.latest = self.slowest = 0.0  # answer, after its question [s]; 0 where there was none
        self._again = QTimer(self, singleShot=True, interval=0)
        self._again.timeout.connect(self.pull)

    @property
    def meanwhile(self) -> int:
        """How many entries are not in the model yet."""
        return 0 if self.log is None else self.log.count - self._read + len(self._waiting)

    def use(self, log: WireLog, language: Language, robot: Robot) -> None:
        """Read another log from its beginning, or the same one for an arm with other servos."""
        words = self._model.words
        if log is not self.log:
            self.log, self._reader, self._read = log, READERS[language](), 0
            self._waiting.clear()
            self.paused, self.latest, self.slowest = False, 0.0, 0.0
            self._model.start(Words(language, robot))
        elif robot is not words.robot:
            self._model.say(Words(words.language, robot))

    def pull(self) -> None:
        """Take what is new, unless paused; a lot of it a slice at a time."""
        if self.log is not None and not self.paused:
            self._read, new = self.log.since(self._read)
            self._waiting.extend(new)
            self._model.add(self._slice())
            if self._waiting:
                self._again.start()
        self.fed.emit()

    def rest(self) -> None:
        """Nobody looks: read on when told to."""
        self._again.stop()

    def clear(self) -> None:
        """Forget what has been until now; the log itself keeps it."""
        self._waiting.clear()
        self._read = 0 if self.log is None else self.log.count
        self._model.start(self._model.words)
        self.fed.emit()

    def _slice(self) -> tuple[Line, ...]:
        entries = [self._waiting.popleft() for _ in range(min(len(self._waiting), _AT_ONCE))]
        lines = self._reader.feed(entries)
        answers = [line.latency for line in lines if not math.isnan(line.latency)]
        self.latest = answers[-1] if answers else self.latest
        self.slowest = max((self.slowest, *answers))
        return lines
