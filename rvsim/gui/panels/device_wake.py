"""Waking an arm: one joint after the other, each told where it will jump to before it does."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from rvsim.device.driver.state import DriverState
from rvsim.device.words import axis_name
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, joint_kind
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import clamped_pulses, pulses_of

_WHY = tr_later(
    "The controller does not know yet where its servos are: the first move of each jumps at full speed, whatever is "
    "asked for. Bring the arm by hand to about the pose that is shown, keep clear, and wake one joint after the other."
)
_WHY_VIRTUAL = tr_later(
    "The controller does not know yet where its servos are: the first move of each jumps at full speed. "
    "With a real arm you would hold it near the pose that is shown."
)
_WHY_GENTLE = tr_later(
    "The encoder bridge measures where the joints are: each begins there and goes slowly to the pose that is shown. "
    "Keep clear, and wake one joint after the other."
)


class WakeSection(QWidget):
    """Emits `wake_wanted(joint)`, where n is the gripper, and `wake_all_wanted()`."""

    wake_wanted = Signal(int)
    wake_all_wanted = Signal()

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._joint, self._skipped = 0, 0
        self._asleep: set[int] = set()
        self.title, self.why, self.what = wrapped_label("title"), wrapped_label("muted"), wrapped_label()
        self.what.setObjectName("device_wake_text")
        set_role(self.what, level="warning")
        self.wake = button(
            "device_wake",
            tr("Wake"),
            tr("Move this joint for the first time, to the pose that is shown"),
            self._on_wake,
        )
        self.skip = button("device_wake_skip", tr("Skip"), tr("Leave this joint asleep for now"), self._on_skip)
        self.all = button(
            "device_wake_all", tr("Wake all"), tr("All joints at once: nothing can be hurt on a virtual arm"),
            self.wake_all_wanted.emit,
        )  # fmt: skip
        row = QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.wake, 2)
        row.addWidget(self.all, 1)
        row.addWidget(self.skip, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (self.title, self.why, self.what):
            column.addWidget(widget)
        column.addLayout(row)

    def begin(self) -> None:
        """From the first joint again: another connection."""
        self._skipped = 0

    def show_state(self, robot: Robot, q: FloatArray, state: DriverState, *, virtual: bool, gentle: bool) -> None:
        """Ask for the next joint that sleeps; hidden when none does.

        Args:
            gentle: the board knows where a joint is that has not been woken.
        """
        asleep = [number for number, awake in enumerate(_awake(robot, state)) if not awake]
        self.setVisible(state.connected and state.phase != "stopped" and bool(asleep))
        if set(asleep) - self._asleep:  # joints that were awake have fallen asleep: a brown-out, another board
            self.begin()
        self._asleep = set(asleep)
        if not asleep:
            return
        later = [number for number in asleep if number >= self._skipped]
        self._joint = (later or asleep)[0]
        count = len(_awake(robot, state))
        name = axis_name(robot, self._joint)
        self.title.setText(tr("Wake the arm: {awake} of {count} awake", awake=count - len(asleep), count=count))
        self.why.setText(tr(_WHY_GENTLE if gentle else _WHY_VIRTUAL if virtual else _WHY))
        self.what.setText(self._says(robot, q, name, gentle))
        self.wake.setText(tr("Wake {joint}", joint=name))
        self.all.setVisible(virtual)

    def _says(self, robot: Robot, q: FloatArray, name: str, gentle: bool) -> str:
        if self._joint == robot.dof:
            assert robot.gripper_servo is not None
            if gentle:
                return tr("The gripper will open at once.")
            return tr("The gripper will open at once ({pulse:.0f} µs).", pulse=robot.gripper_servo.open_us)
        angle = format_quantity(float(q[self._joint]), joint_kind(robot, self._joint), self._preferences)
        if gentle:
            return tr("The {joint} will go to {angle}.", joint=name, angle=angle)
        pulse = clamped_pulses(robot.servos, pulses_of(robot.servos, q))[self._joint]
        return tr("The {joint} will jump to {angle} ({pulse:.0f} µs).", joint=name, angle=angle, pulse=pulse)

    def _on_wake(self) -> None:
        self.wake_wanted.emit(self._joint)

    def _on_skip(self) -> None:
        self._skipped = self._joint + 1


def _awake(robot: Robot, state: DriverState) -> tuple[bool, ...]:
    return state.awake if robot.gripper_servo is None else (*state.awake, state.gripper_awake)
