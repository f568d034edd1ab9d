"""The row below the scene: play, stop, step, the time slider, speed and loop."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QLabel, QSlider, QToolButton, QWidget

from rvsim.gui.motion_control import MotionControl
from rvsim.gui.preferences import SETTINGS, Preferences
from rvsim.gui.quantities import format_number
from rvsim.gui.theme import set_role

_TICKS = 10_000
_NARROWEST, _ROOM_FOR_SPEED, _ROOM_FOR_LOOP = 320, 460, 540  # [pixels]


class PlayerBar(QWidget):
    """Time. Empty, it says what would fill it."""

    def __init__(self, motion: MotionControl, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._motion, self._preferences = motion, preferences
        self.play = self._button("play_button", "▶ Play", "Play or pause (F5)", motion.toggle)
        metrics = QFontMetrics(self.play.font())
        self.play.setMinimumWidth(metrics.horizontalAdvance("❚❚ Pause") + 24)
        self.stop = self._button("stop_button", "■ Stop", "Stop and go back to the beginning", motion.stop)
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setObjectName("time_slider")
        self.slider.setAccessibleName("Time")
        self.slider.setRange(0, _TICKS)
        self.slider.setMinimumWidth(80)
        self.slider.setPageStep(_TICKS // 20)
        self.slider.setSingleStep(_TICKS // 200)
        self.slider.valueChanged.connect(self._on_slider)
        self.time = QLabel("No motion yet")
        self.time.setObjectName("time_label")
        set_role(self.time, role="muted")
        self.speed = QComboBox()
        self.speed.setObjectName("speed_selector")
        self.speed.setAccessibleName("Speed")
        self.speed.setToolTip("Speed of the motion")
        for speed in SETTINGS["speed"].choices:
            self.speed.addItem(f"{speed:g}×", speed)
        self.speed.setCurrentIndex(self.speed.findData(preferences["speed"]))
        self.speed.currentIndexChanged.connect(self._on_speed)
        self.loop = QCheckBox("Loop")
        self.loop.setObjectName("loop_switch")
        self.loop.toggled.connect(motion.set_loop)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 4, 12, 4)
        row.setSpacing(8)
        for widget, stretch in (
            (self.play, 0), (self.stop, 0), (self.slider, 1), (self.time, 0), (self.speed, 0), (self.loop, 0),
        ):  # fmt: skip
            row.addWidget(widget, stretch)
        motion.moved.connect(self._show_time)
        motion.state_changed.connect(self._show_state)
        motion.loaded.connect(self._show_loaded)
        preferences.changed.connect(self._on_preference)
        self._show_loaded()

    def minimumSizeHint(self) -> QSize:
        """As narrow as the buttons and the slider: the scene must not be held wide by what can be left out."""
        return QSize(_NARROWEST, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave out what does not fit: first the loop switch, then the speed."""
        super().resizeEvent(event)
        self.loop.setVisible(self.width() >= _ROOM_FOR_LOOP)
        self.speed.setVisible(self.width() >= _ROOM_FOR_SPEED)

    def _button(self, object_name: str, text: str, tip: str, slot: object) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(object_name)
        button.setText(text)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.clicked.connect(slot)
        return button

    def _on_slider(self, ticks: int) -> None:
        self._motion.seek(ticks / _TICKS * self._motion.player.duration)

    def _on_speed(self, index: int) -> None:
        self._preferences.set("speed", self.speed.itemData(index))

    def _on_preference(self, name: str) -> None:
        if name == "speed":
            self.speed.setCurrentIndex(self.speed.findData(self._preferences["speed"]))

    def _show_loaded(self) -> None:
        there = self._motion.player.trajectory is not None
        for widget in (self.play, self.stop, self.slider):
            widget.setEnabled(there)
        self._show_state(self._motion.player.state)
        self._show_time(self._motion.player.time)

    def _show_state(self, state: str) -> None:
        playing = state == "playing"
        self.play.setText("❚❚ Pause" if playing else "▶ Play")

    def _show_time(self, time: float) -> None:
        duration = self._motion.player.duration
        if self._motion.player.trajectory is None:
            self.time.setText("No motion yet")
            ticks = 0
        else:
            self.time.setText(f"{format_number(time, 2)} / {format_number(duration, 2)} s")
            ticks = round(time / duration * _TICKS) if duration else 0
        with QSignalBlocker(self.slider):
            self.slider.setValue(ticks)
