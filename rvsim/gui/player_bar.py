"""The row below the scene: play, stop, step, the time slider, speed and loop."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, QSize, Qt, QTimer
from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QToolButton, QWidget

from rvsim.gui.calm_boxes import ComboBox, Slider
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.preferences import SETTINGS, Preferences
from rvsim.gui.quantities import format_number
from rvsim.gui.theme import set_role
from rvsim.language import left_to_right, tr, tr_later

_TICKS = 10_000
_NARROWEST, _SHORTEST = 320, 40  # [pixels] of the bar and of its slider
_WORDS = {
    True: (tr_later("❚❚ Pause"), tr_later("▶ Play"), tr_later("■ Stop")),
    False: ("❚❚", "▶", "■"),
}  # with words, and as signs alone


class PlayerBar(QWidget):
    """Time. Empty, it says what would fill it."""

    def __init__(self, motion: MotionControl, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("player_bar")
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # as time runs in the plots, in any language
        self._motion, self._preferences = motion, preferences
        self._least = 0  # [pixels] that signs, slider, speed and loop need
        self.play = self._button("play_button", tr("▶ Play"), tr("Play or pause (F5)"), motion.toggle)
        self.stop = self._button("stop_button", tr("■ Stop"), tr("Stop and go back to the beginning"), motion.stop)
        self.slider = Slider()
        self.slider.setObjectName("time_slider")
        self.slider.setAccessibleName(tr("Time"))
        self.slider.setRange(0, _TICKS)
        self.slider.setMinimumWidth(_SHORTEST)
        self.slider.setPageStep(_TICKS // 20)
        self.slider.setSingleStep(_TICKS // 200)
        self.slider.valueChanged.connect(self._on_slider)
        self.time = QLabel(tr("No motion yet"))
        self.time.setObjectName("time_label")
        set_role(self.time, role="muted")
        self.speed = ComboBox()
        self.speed.setObjectName("speed_selector")
        self.speed.setAccessibleName(tr("Speed"))
        self.speed.setToolTip(tr("Speed of the motion"))
        for speed in SETTINGS["speed"].choices:
            self.speed.addItem(left_to_right(f"{speed:g}×"), speed)
        self.speed.setCurrentIndex(self.speed.findData(preferences["speed"]))
        self.speed.currentIndexChanged.connect(self._on_speed)
        self.loop = QCheckBox(tr("Loop"))
        self.loop.setObjectName("loop_switch")
        self.loop.toggled.connect(motion.set_loop)
        row = self._row = QHBoxLayout(self)
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
        self._show_words(words=True)
        self._show_loaded()

    def minimumSizeHint(self) -> QSize:
        """As narrow as the buttons and the slider: the scene must not be held wide by what can be left out."""
        return QSize(max(_NARROWEST, self._least), super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave out what does not fit."""
        super().resizeEvent(event)
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        """Larger letters need more room."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            QTimer.singleShot(0, self, self._fit)  # when the buttons have the font too

    def _fit(self) -> None:
        """Leave out what does not fit: first the words and the whole time, then the time."""
        self.time.show()
        self._show_words(words=False)
        least = self._needed() - self._row.spacing() - self.time.minimumSizeHint().width()
        if least != self._least:
            self._least = least
            self.updateGeometry()
        self._show_words(words=True)
        if self._needed() > self.width():
            self._show_words(words=False)
        self.time.setVisible(self._needed() <= self.width())

    def _needed(self) -> int:
        """How wide the row must be [pixels] for nothing in it to be cut."""
        return self._row.minimumSize().width()

    def _show_words(self, *, words: bool) -> None:
        self._with_words = words
        pause, _, stop = map(tr, _WORDS[words])
        self.play.setMinimumWidth(QFontMetrics(self.play.font()).horizontalAdvance(pause) + 24)
        self.stop.setText(stop)
        self._show_state(self._motion.player.state)
        self._show_time(self._motion.player.time)
        self._row.invalidate()

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
        self._fit()

    def _show_state(self, state: str) -> None:
        pause, play, _ = map(tr, _WORDS[self._with_words])
        self.play.setText(pause if state == "playing" else play)

    def _show_time(self, time: float) -> None:
        duration = self._motion.player.duration
        if self._motion.player.trajectory is None:
            self.time.setText(tr("No motion yet") if self._with_words else "")
            ticks = 0
        else:
            whole = f" / {format_number(duration, 2)}" if self._with_words else ""
            self.time.setText(left_to_right(f"{format_number(time, 2)}{whole} s"))
            ticks = round(time / duration * _TICKS) if duration else 0
        with QSignalBlocker(self.slider):
            self.slider.setValue(ticks)
