"""How fast paths are travelled: the time law, and calm, as quick as possible, or in so many seconds."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtWidgets import QCheckBox, QGroupBox, QHBoxLayout

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.widgets import combo, form, select
from rvsim.language import tr, tr_later
from rvsim.motion.trajectory import LAW_TITLES, Law

_CALM, _QUICK, _SECONDS = "calm", "quick", "seconds"
_TIMES = {_CALM: tr_later("Calm"), _QUICK: tr_later("As quick as possible"), _SECONDS: tr_later("In seconds")}
_FIRST_SECONDS = 10.0

_EDITS = {
    "law": tr_later("Take another law of motion"),
    "path_seconds": tr_later("Set how long paths take"),
    "ease": tr_later("Choose where to slow down"),
}


class PaceSection(QGroupBox):
    """Law and time; another choice times again what is tracked, without solving it again."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__(tr("How fast"))
        self._session = session
        titles: dict[str, str] = {str(law): title for law, title in LAW_TITLES.items()}
        self.law = combo("path_law", tr("How each stretch speeds up and slows down"), titles)
        self.law.activated.connect(lambda _: self._on_law(self.law.currentData()))
        self.time = combo("path_time", tr("How long the whole path takes"), _TIMES)
        self.time.activated.connect(lambda _: self._on_time(self.time.currentData()))
        self.seconds = QuantityBox("time", preferences, tr("Time for the whole path, longer where a joint needs it"))
        self.seconds.setObjectName("path_seconds")
        self.seconds.set_range(0.01, 3600.0, tr("A path takes 0.01 s to an hour."))
        self.seconds.quantity_changed.connect(lambda value: self._edit("path time", path_seconds=value))
        self.seconds.refused.connect(session.warn)
        self.seconds.editingFinished.connect(session.end_stroke)
        self.ease = QCheckBox(tr("Slow down only where a joint needs it"))
        self.ease.setObjectName("path_ease")
        self.ease.setToolTip(tr("Where a joint cannot go as fast as the law has it: off slows the whole stretch down"))
        self.ease.clicked.connect(lambda on: self._edit("", ease=on))
        times = QHBoxLayout()
        times.setSpacing(6)
        times.addWidget(self.time, 1)
        times.addWidget(self.seconds, 1)
        rows = form()
        rows.addRow(tr("Law"), self.law)
        rows.addRow(tr("Time"), times)
        rows.addRow(self.ease)
        self.setLayout(rows)
        self.show_task(session.experiment)

    def show_task(self, experiment: Experiment) -> None:
        """Show the pace of the experiment."""
        select(self.law, experiment.law)
        self.ease.setChecked(experiment.ease)
        seconds = experiment.path_seconds
        select(self.time, _CALM if seconds is None else _QUICK if seconds == 0.0 else _SECONDS)
        self.seconds.setVisible(bool(seconds))
        if seconds:
            self.seconds.set_quantity(seconds)

    def _on_law(self, law: Law) -> None:
        if law != self._session.experiment.law:
            self._edit("", law=law)

    def _on_time(self, choice: str) -> None:
        now = self._session.experiment.path_seconds
        wanted = {_CALM: None, _QUICK: 0.0, _SECONDS: now or _FIRST_SECONDS}[choice]
        if wanted != now:
            self._edit("", path_seconds=wanted)

    def _edit(self, merge: str, **changes: Any) -> None:
        text = next(_EDITS[name] for name in changes)
        self._session.edit(tr(text), replace(self._session.experiment, **changes), merge=merge)
