"""The jog pad: buttons and keys that move the arm as long as they are held."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QElapsedTimer, QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QHideEvent, QKeyEvent
from PySide6.QtWidgets import (
    QApplication,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_velocity_stop import stop_text
from rvsim.gui.panels.inspect_velocity_words import speed_kinds
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.kinematics import forward_kinematics
from rvsim.language import left_to_right, tr, tr_later
from rvsim.motion.jog import Jog, JogStep
from rvsim.motion.jog_course import Axes, JointMotion, ToolMotion
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_FRAME_MS = 16
_LONGEST = 0.1  # [s] that one step may make up for: a window that was busy must not make the arm leap
_SPEED, _TURN = 0.05, np.radians(20.0)
_UNIT_SPEED = 0.2  # for arms whose lengths have no unit
_AXES = ("x", "y", "z", tr_later("roll"), tr_later("pitch"), tr_later("yaw"))
_IN_A_ROW = 3
_KEYS_HELP = tr_later("← → along x, ↑ ↓ along y, Page Up, Page Down along z; with Shift they turn.")


class Direction(NamedTuple):
    """What a button moves: "x" … "yaw" or a joint (from 0), and the way."""

    what: str | int
    sign: int


_KEYS = {
    Qt.Key.Key_Right: (0, 1),
    Qt.Key.Key_Left: (0, -1),
    Qt.Key.Key_Up: (1, 1),
    Qt.Key.Key_Down: (1, -1),
    Qt.Key.Key_PageUp: (2, 1),
    Qt.Key.Key_PageDown: (2, -1),
}
_KEY_NAMES = {
    (0, 1): "→", (0, -1): "←", (1, 1): "↑", (1, -1): "↓", (2, 1): tr_later("Page Up"), (2, -1): tr_later("Page Down"),
}  # fmt: skip


class JogDriver(QObject):
    """Moves the session's arm while a direction is held; one hold is one step of the undo stack.

    Signals:
        moved(step): a `JogStep`; `running` tells whether it goes on.
    """

    moved = Signal(object)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._jog: Jog | None = None
        self._robot = session.robot
        self._text = ""
        self._next: tuple[ToolMotion | JointMotion, str] | None = None
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setInterval(_FRAME_MS)
        self._timer.timeout.connect(self._on_time)

    @property
    def running(self) -> bool:
        """Whether the arm moves."""
        return self._jog is not None

    def hold(self, motion: ToolMotion | JointMotion, text: str) -> None:
        """Begin, or, while another motion comes to rest, as soon as it has."""
        if self._jog is not None:
            self._jog.release()
            self._next = (motion, text)
            return
        limits = (
            np.tile([-np.inf, np.inf], (self._session.robot.dof, 1)) if self._session.experiment.ignore_limits else None
        )
        self._robot = self._session.robot
        self._jog, self._text = Jog(self._robot, motion, limits), text
        self._clock.start()
        self._timer.start()

    def release(self) -> None:
        """The key is up: come to rest."""
        self._next = None
        if self._jog is not None:
            self._jog.release()

    def _on_time(self) -> None:
        self.advance(min(1e-3 * self._clock.restart(), _LONGEST))

    def advance(self, dt: float) -> None:
        """Move on by dt [s]."""
        jog = self._jog
        if jog is None:
            return
        if self._session.robot is not self._robot:
            self._end()  # another arm has been taken
            return
        step = jog.advance(self._session.q, dt)
        moves = not np.array_equal(step.q, self._session.q)
        refused = moves and not self._session.move_to(step.q, self._text, merge="jog")
        if refused or jog.resting:
            self._end()
        self.moved.emit(step)

    def _end(self) -> None:
        self._jog = None
        self._timer.stop()
        self._session.end_stroke()
        if self._next is not None:
            motion, text = self._next
            self._next = None
            self.hold(motion, text)


class JogPad(QWidget):
    """Buttons for every axis and every joint. Hold one, or hold a key while the pad has the focus.

    Signals:
        moved(step): as of the driver.
    """

    moved = Signal(object)

    def __init__(self, session: Session, preferences: Preferences, axes: Callable[[], Axes]) -> None:
        super().__init__()
        self._session, self._preferences, self._axes = session, preferences, axes
        self.T_at_start: FloatArray = np.eye(4)  # of the tool, when it began to move: its axes are those it moves along
        self._robot: Robot | None = None
        self.driver = JogDriver(session, self)
        self.driver.moved.connect(self._on_moved)
        self.held: Direction | None = None
        self.buttons: dict[Direction, QPushButton] = {}
        self.speed = QuantityBox("length_speed", preferences, tr("Speed of the tool"))
        self.turn = QuantityBox("angle_speed", preferences, tr("Turning speed, of the tool and of joints"))
        for box, name, value in ((self.speed, "jog_speed", _SPEED), (self.turn, "jog_turn", _TURN)):
            box.setObjectName(name)
            box.set_quantity(value)
            box.set_range(0.0, np.inf)
            box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.status = wrapped_label("muted")
        self.status.setObjectName("jog_status")
        self._joints = QGridLayout()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Jog pad: hold the arrow keys, Page Up and Page Down"))
        self._lay_out()
        app = QApplication.instance()
        assert isinstance(app, QApplication)
        app.focusChanged.connect(self._on_focus)

    def _lay_out(self) -> None:
        speeds = QHBoxLayout()
        for text, box in ((tr("Speed"), self.speed), (tr("turning"), self.turn)):
            label = QLabel(text)
            label.setBuddy(box)
            set_role(label, role="muted")
            speeds.addWidget(label)
            speeds.addWidget(box, 1)
        axes = QGridLayout()
        for grid in (axes, self._joints):
            grid.setHorizontalSpacing(4)
            grid.setVerticalSpacing(2)
        for place, name in enumerate(_AXES):
            self._add_pair(axes, place, name, tr(name), self._key_tip(place))
        self.keys = wrapped_label("muted")
        self._show_keys(False)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addLayout(speeds)
        column.addWidget(_from_the_left(axes, self._joints))
        column.addWidget(self.status)
        column.addWidget(self.keys)

    def _add_pair(self, grid: QGridLayout, place: int, what: str | int, name: str, tips: tuple[str, str]) -> None:
        """A name over its two buttons."""
        row, column = 2 * (place // _IN_A_ROW), 2 * (place % _IN_A_ROW)
        label = QLabel(name)
        set_role(label, role="muted")
        grid.addWidget(label, row, column, 1, 2, Qt.AlignmentFlag.AlignHCenter)
        for offset, sign, text, tip in ((0, -1, "\u2212", tips[0]), (1, 1, "+", tips[1])):
            button = QPushButton(text)
            button.setObjectName(f"jog_{'minus' if sign < 0 else 'plus'}_{_slug(what)}")
            button.setAccessibleName(left_to_right(f"{text}{name}"))
            button.setToolTip(f"{tr('Hold to move {direction}', direction=f'{text}{name}')} {tip}".rstrip())
            button.setMinimumWidth(30)
            direction = Direction(what, sign)
            button.pressed.connect(lambda d=direction: self.hold(d))
            button.released.connect(self.release)
            button.installEventFilter(self)
            grid.addWidget(button, row + 1, column + offset)
            self.buttons[direction] = button

    @staticmethod
    def _key_tip(place: int) -> tuple[str, str]:
        """The keys of an axis' two buttons."""
        shift = "Shift+" if place >= _IN_A_ROW else ""
        minus, plus = (tr("(key: {key})", key=f"{shift}{tr(_KEY_NAMES[place % _IN_A_ROW, sign])}") for sign in (-1, 1))
        return minus, plus

    # --- showing ---------------------------------------------------------------------------------------------------

    def take_robot(self, robot: Robot) -> None:
        """Buttons for another arm."""
        if robot is self._robot:
            return
        kind = speed_kinds(robot)[0]
        if self._robot is None or kind != speed_kinds(self._robot)[0]:
            self.speed.set_kind(kind)
            self.speed.set_quantity(_SPEED if kind == "length_speed" else _UNIT_SPEED)
        self._robot = robot
        self.held = None
        for direction in [direction for direction in self.buttons if isinstance(direction.what, int)]:
            button = self.buttons.pop(direction)
            button.hide()
            button.deleteLater()
        while (item := self._joints.takeAt(0)) is not None:
            widget = item.widget()
            if isinstance(widget, QLabel):
                widget.hide()
                widget.deleteLater()
        for index in range(robot.dof):
            self._add_pair(self._joints, index, index, f"J{index + 1}", ("", ""))

    def _on_moved(self, step: JogStep) -> None:
        text = stop_text(self._session.robot, step, self._preferences) if step.stopped_reason else step.slowed_reason
        if self.status.text() != text:
            self.status.setText(text)
            set_role(
                self.status, role="" if step.stopped_reason else "muted", level="warning" if step.stopped_reason else ""
            )
        self.moved.emit(step)

    # --- holding ---------------------------------------------------------------------------------------------------

    def hold(self, direction: Direction) -> None:
        """A button or a key goes down."""
        if direction == self.held:
            return
        self.held = direction
        self.status.setText("")
        motion, text = self._motion(direction)
        self.T_at_start = forward_kinematics(self._session.robot, self._session.q)
        self.driver.hold(motion, text)

    def release(self) -> None:
        """It is up again, or the pad is left: come to rest."""
        self.held = None
        self.driver.release()

    def _motion(self, direction: Direction) -> tuple[ToolMotion | JointMotion, str]:
        sign, robot = direction.sign, self._session.robot
        if isinstance(direction.what, int):
            joint = direction.what
            rate = self.turn.quantity if robot.joints[joint].revolute else self.speed.quantity
            return JointMotion(joint, sign * rate), tr("Jog {joint}", joint=tr(robot.joint_names[joint]))
        place = _AXES.index(direction.what)
        unit = sign * np.eye(3)[place % _IN_A_ROW]
        axis = "xyz"[place % _IN_A_ROW]
        if place < _IN_A_ROW:
            name, v, w = tr("moving along {axis}", axis=axis), self.speed.quantity * unit, np.zeros(3)
        else:
            name, v, w = tr("turning about {axis}", axis=axis), np.zeros(3), self.turn.quantity * unit
        return ToolMotion(v, w, self._axes(), name), tr("Jog {direction}", direction=tr(direction.what))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """A key holds its direction; Escape stops."""
        if not self._take_key(event, down=True):
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """The key is up."""
        if not self._take_key(event, down=False):
            super().keyReleaseEvent(event)

    def _take_key(self, event: QKeyEvent, *, down: bool) -> bool:
        key = Qt.Key(event.key())
        if key == Qt.Key.Key_Escape and down and self.driver.running:
            self.release()
            return True
        if key == Qt.Key.Key_Shift and not down and self.held:
            self.release()  # what was held is another direction now
            return True
        if key not in _KEYS:
            return False
        if not event.isAutoRepeat():
            axis, sign = _KEYS[key]
            turning = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            if down:
                self.hold(Direction(_AXES[axis + _IN_A_ROW * turning], sign))
            else:
                self.release()
        event.accept()
        return True

    def event(self, event: QEvent) -> bool:
        """The pad's keys come before the window's shortcuts."""
        if self._overrides(event):
            event.accept()
            return True
        return super().event(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The pad's keys work while one of its buttons has the focus, too."""
        if self._overrides(event):
            event.accept()
            return True
        if isinstance(event, QKeyEvent) and event.type() in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
            return self._take_key(event, down=event.type() == QEvent.Type.KeyPress)
        return super().eventFilter(watched, event)

    def _overrides(self, event: QEvent) -> bool:
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return False
        key = Qt.Key(event.key())
        return key in _KEYS or (key == Qt.Key.Key_Escape and self.driver.running)

    # --- leaving ---------------------------------------------------------------------------------------------------

    def _on_focus(self, _old: QWidget | None, new: QWidget | None) -> None:
        inside = new is not None and (new is self or self.isAncestorOf(new))
        self._show_keys(inside)
        if self.held is not None and not inside:
            self.release()

    def _show_keys(self, on: bool) -> None:
        """Say whether the keys move the arm now."""
        self.keys.setText(f"{tr('Keys are on:') if on else tr('Click here to use keys:')} {tr(_KEYS_HELP)}")
        set_role(self.keys, role="" if on else "muted")

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Another window has the keys now."""
        super().focusOutEvent(event)
        if event.reason() == Qt.FocusReason.ActiveWindowFocusReason:
            self.release()

    def hideEvent(self, event: QHideEvent) -> None:
        """What cannot be seen does not move the arm."""
        super().hideEvent(event)
        self.release()


def _from_the_left(*grids: QGridLayout) -> QWidget:
    """Grids below each other, minus left of plus in any language, as x goes before y."""
    widget = QWidget()
    widget.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
    column = QVBoxLayout(widget)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(8)
    for grid in grids:
        column.addLayout(grid)
    return widget


def _slug(what: str | int) -> str:
    """What moves, in a button's name for tests: an axis, or a joint."""
    return what if isinstance(what, str) else f"j{what + 1}"
