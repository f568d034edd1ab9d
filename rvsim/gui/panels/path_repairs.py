"""The repairs that were tried, as buttons; the same offers wherever they are shown."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QSizePolicy, QVBoxLayout, QWidget

from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import button
from rvsim.lab.repairs import Offer
from rvsim.language import tr, tr_later

_NONE = tr_later("None of the repairs that were tried helps.")


class RepairList(QWidget):
    """A button for each offer, and the search while it goes on.

    Args:
        prefix: of the names of its widgets.
        told: whether what a repair does stands below its button, or only in its tooltip.
    """

    def __init__(self, tracker: PathTracker, prefix: str, *, told: bool) -> None:
        super().__init__()
        self._tracker, self._prefix, self._told = tracker, prefix, told
        self.search = tracker.search
        self._shown: list[Offer] = []
        self.searching = QProgressBar()
        self.searching.setObjectName(f"{prefix}repairs_progress")
        self.searching.setRange(0, 0)
        self.searching.setTextVisible(False)
        self.searching.setFixedHeight(8)
        self.searching.setToolTip(tr("Looking for repairs: each is tried before it is offered"))
        self.cancel_button = button(
            f"{prefix}repairs_cancel", tr("Cancel"), tr("Give up the search for repairs"), self.search.cancel
        )
        self.none = wrapped_label("muted")
        self.none.setText(tr(_NONE))
        self._offered = QVBoxLayout()
        self._offered.setSpacing(6)
        self._lay_out()
        self.search.changed.connect(self.refresh)
        self.refresh()

    def _lay_out(self) -> None:
        waiting = QHBoxLayout()
        waiting.addWidget(self.searching, 1)
        waiting.addWidget(self.cancel_button)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(self._offered)
        column.addLayout(waiting)
        column.addWidget(self.none)

    def refresh(self) -> None:
        """Show what has been found."""
        search = self.search
        if search.offers != self._shown:
            self._shown = list(search.offers)
            self._show_offers()
        busy = search.worker.busy
        self.searching.setVisible(busy)
        self.cancel_button.setVisible(busy)
        self.none.setVisible(search.needed and not busy and not self._shown)
        self.setVisible(search.needed)

    def _show_offers(self) -> None:
        while (item := self._offered.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        for offer in self._shown:
            name = f"{self._prefix}repair_{offer.name.replace(' ', '_')}"
            self._offered.addWidget(button(name, offer.title, offer.tip, partial(self._tracker.apply, offer)))
            if self._told:
                text = wrapped_label("muted")
                text.setText(offer.tip)
                self._offered.addWidget(text)
