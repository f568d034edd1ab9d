"""The button beside numbers of which the sources print something else: it leads to the Sources page."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QWidget

from rvsim.lab.sources import Topic, errata
from rvsim.language import tr, trn
from rvsim.robot import Robot


class SourcesButton(QPushButton):
    """Seen where the sources of an arm have errata of a topic.

    Signals:
        asked(topic): show them.
    """

    asked = Signal(str)

    def __init__(self, topic: Topic, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._topic: Topic = topic
        self._robot: Robot | None = None
        self.setObjectName(f"what_the_source_says_{topic}")
        self.setToolTip(tr("Go to the printed formulas that are not right, with their values here, ours, and why"))
        self.setVisible(False)
        self.clicked.connect(lambda: self.asked.emit(self._topic))

    def offer(self, robot: Robot) -> None:
        """Count the errata of an arm."""
        if robot is self._robot:
            return
        self._robot = robot
        count = len(errata(robot, self._topic))
        self.setVisible(count > 0)
        self.setText(trn("What the source says: {n} erratum", "What the source says: {n} errata", count))
