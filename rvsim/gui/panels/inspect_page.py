"""What every page of the inspector does: work only while it is seen, and take its drawing out of the scene with it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QTimer
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QWidget

from rvsim.gui.panels.shown import NUMBER_SETTINGS, ReadOutPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.scene.primitives import Item

_REST_MS = 60
SCENE_SETTINGS = NUMBER_SETTINGS | {"theme"}


class InspectPage(ReadOutPanel):
    """A page: `refresh()` shows the present experiment and calls `draw(items)` for what belongs into the scene.

    The container tells with `set_seen` whether the page can be seen; until then nothing is worked out. A page that is
    `always` true is worked out behind others too: in a drag, when the hand rests or somebody reads its table.
    """

    title = ""  # on its button
    name = ""  # of its layer in the scene, of its object and of its help page
    settings = SCENE_SETTINGS

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self._stage = stage
        self._seen = False
        self._at_rest = QTimer(self, singleShot=True, interval=_REST_MS)
        self._at_rest.timeout.connect(self.catch_up)
        self.setObjectName(f"{self.name}_page")

    @property
    def seen(self) -> bool:
        """Whether the page can be seen."""
        return self._seen

    def set_seen(self, seen: bool) -> None:
        """The page comes to the front, or goes: then its drawing goes too."""
        if seen == self._seen:
            return
        self._seen = seen
        if seen:
            self._refresh_if_seen()
        else:
            self.draw(())

    def draw(self, items: tuple[Item, ...]) -> None:
        """Show these items in the scene, instead of those before; nothing of a page that is not seen."""
        if self._seen or not items:
            self._stage.set_layer(self.name, items)

    def _refresh_if_seen(self) -> None:
        self._stale = True
        if self._seen or (self.always and not self._session.continuing):
            self.catch_up()
        elif self.always:
            self._at_rest.start()

    def catch_up(self) -> None:
        """Work out what has been put off."""
        if self._stale:
            self._stale = False
            self.refresh()

    def event(self, event: QEvent) -> bool:
        """Being painted is not being seen: only the container knows."""
        return QWidget.event(self, event)

    def showEvent(self, event: QShowEvent) -> None:
        """The same."""
        QWidget.showEvent(self, event)
