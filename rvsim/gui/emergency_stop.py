"""The stop that is always there: a red button, and Esc wherever the focus is while an arm is connected."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QHBoxLayout, QSizePolicy, QToolBar, QToolButton, QWidget

from rvsim.gui.device_control import DeviceControl
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.theme import set_role
from rvsim.language import tr, tr_later

_KEYS = (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress)
_GROWS = (QEvent.Type.LayoutRequest, QEvent.Type.Polish, QEvent.Type.FontChange, QEvent.Type.Show)
_MARGIN = 20
_TIP = tr_later("Stop whatever moves, at once (Esc). An arm that is connected stays stopped until the stop is reset")


class EmergencyStop(QObject):
    """Owns the button; `stop(reason)` is what it, Esc and the closing window do."""

    def __init__(self, device: DeviceControl, motion: MotionControl, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._device, self._motion = device, motion
        self._watching = False
        self.button = QToolButton()
        self.button.setObjectName("emergency_stop_button")
        self.button.setText(tr("● STOP  Esc"))
        self.button.setAccessibleName(tr("Emergency stop"))
        self.button.setToolTip(tr(_TIP))
        set_role(self.button, role="stop")
        # When it goes down, not when it is let go: somebody may be holding the arm.
        self.button.pressed.connect(lambda: self.stop(tr("The stop button was pressed.")))
        device.state_changed.connect(lambda _: self._watch(device.state is not None))

    def stop(self, reason: str) -> None:
        """Stop the arm, if there is one, and the motion in the window."""
        if self._device.state is not None:
            self._device.stop(reason)
        else:
            self._motion.pause()

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Esc stops, in dialogs and menus too; what else it does there goes on."""
        # The override comes before any shortcut, the press where no shortcut took the key.
        if event.type() in _KEYS and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            self._on_escape(event.isAutoRepeat())
        return False

    def _on_escape(self, repeated: bool) -> None:
        state = self._device.state
        if not repeated and state is not None and state.phase != "stopped":
            self.stop(tr("Esc was pressed."))

    def toolbar(self) -> QToolBar:
        """A bar at the right end of its row that is never shortened: it holds nothing but the button."""
        return _StopBar(self.button)

    def _watch(self, on: bool) -> None:
        """Only while an arm is connected: every event of the window passes through the filter."""
        application = QApplication.instance()
        if on == self._watching or application is None:
            return
        self._watching = on
        if on:
            application.installEventFilter(self)
        else:
            application.removeEventFilter(self)


class _StopBar(QToolBar):
    """As wide as the button needs, whatever the style and the size of the letters."""

    def __init__(self, button: QToolButton) -> None:
        super().__init__(tr("Stop"))
        self._button = button
        self.setObjectName("stop_toolbar")
        self.setMovable(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self.toggleViewAction().setEnabled(False)
        inside = QWidget()
        row = QHBoxLayout(inside)
        row.setContentsMargins(0, 0, 0, 0)
        row.addStretch(1)
        row.addWidget(button)
        inside.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.addWidget(inside)

    def event(self, event: QEvent) -> bool:
        """Keep the room that the button needs when its letters or its style change."""
        done = super().event(event)
        if event.type() in _GROWS:
            room = self._button.sizeHint().width() + _MARGIN
            if room != self.minimumWidth():
                self.setMinimumWidth(room)
        return done
