"""Source 002's algorithm as printed beside the corrected one, along its 184 points."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.files import load_robot
from rvsim.gui.panels.laboratory_looks import SOURCE_002_LOOKS, Legend
from rvsim.gui.panels.laboratory_page import Page
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import column_of, scrolled
from rvsim.gui.workers import LatestWorker
from rvsim.lab.laboratory import SOURCE_002_READING, source_002_sentence
from rvsim.lab.source_002 import Comparison, compare_source_002
from rvsim.language import tr, tr_later

if TYPE_CHECKING:
    from rvsim.gui.panels.laboratory_plot import LogPlot

_ARM = "ur5e"
_POINTS = tr_later("point of the ellipse")
_INTRODUCTION = tr_later(
    "The source leads a UR5e along an ellipse of 184 points by Newton–Raphson, position only. Below, how far the real "
    "arm is from each point with the angles that the printed program finds, and with the same algorithm put right."
)
_IN_SCENE = tr_later(
    "Drawn in the scene while the UR5e is the present arm: the ellipse, and where the printed program leads."
)


class Source002Page(Page):
    """The second page of the laboratory.

    Signals:
        comparison_changed(Comparison or None): this is to be seen in the scene.
    """

    comparison_changed = Signal(object)

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self.comparison: Comparison | None = None
        self.plot: LogPlot | None = None
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_done)
        self.sentence = _text(tr("Working it out…"))
        self.sentence.setObjectName("lab_source_002_sentence")
        self.legend = Legend(SOURCE_002_LOOKS, preferences)
        self._inside = QWidget()
        self._column = QVBoxLayout(self._inside)
        self._column.setContentsMargins(12, 8, 12, 8)
        self._column.setSpacing(8)
        for widget in (_text(tr(_INTRODUCTION)), self.sentence, self.legend):
            self._column.addWidget(widget)
        for text in (_IN_SCENE, SOURCE_002_READING):
            label = _text(tr(text))
            set_role(label, role="muted")
            self._column.addWidget(label)
        self._column.addStretch(0)
        column_of(self, scrolled(self._inside))
        preferences.changed.connect(self._on_preference)

    def close_worker(self) -> None:
        """Wait for the thread to end."""
        self._worker.close()

    def _make_plot(self) -> None:
        from rvsim.gui.panels.laboratory_plot import LogPlot

        self.plot = LogPlot(SOURCE_002_LOOKS, (tr(_POINTS), ""), self._preferences)
        self.plot.setObjectName("lab_source_002_plot")
        self.plot.setMinimumHeight(180)
        self._column.insertWidget(3, self.plot, 1)

    def _on_done(self, comparison: Comparison) -> None:
        self.comparison = comparison
        self._show()
        self._tell()

    def _show(self) -> None:
        """The sentence and the curves, in the units of the screen."""
        if self.comparison is None or self.plot is None:
            return
        printed, corrected = self.comparison
        units = shown_units(self._preferences)
        factor = 1.0 if units.length == "mm" else 1e-3
        self.sentence.setText(source_002_sentence(self.comparison, units))
        self.plot.set_titles(tr(_POINTS), tr("off by, {unit}", unit=units.length))
        curves = {
            "printed": printed.deviations,
            "believed": printed.believed_deviations,
            "corrected": corrected.deviations,
        }
        self.plot.show_curves({name: factor * curve for name, curve in curves.items()})

    def _tell(self) -> None:
        self.comparison_changed.emit(self.comparison if self.seen else None)

    def _on_preference(self, name: str) -> None:
        if name == "length_unit":
            self._show()
        if name in ("theme", "presentation") and self.plot is not None:
            self.plot.dress()
            self.legend.update()

    def on_seen(self, seen: bool) -> None:
        """Seen for the first time: work it out."""
        if seen and self.plot is None:
            self._make_plot()
            self._worker.ask(lambda: compare_source_002(load_robot(_ARM)))
        self._tell()


def _text(text: str) -> QLabel:
    label = QLabel(text, wordWrap=True)
    # A height of its own would be that of a narrow column: it depends on the width alone.
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
    label.setMinimumHeight(1)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label
