"""The window's arm on the wire: what the panels ask of it, what it says, and the limits that it brings along."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from rvsim.errors import RobotDefinitionError, RvsimError
from rvsim.experiment import Experiment
from rvsim.files import load_robot
from rvsim.gui.device_witness import Witness
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.user_robot import own_copy
from rvsim.gui.preferences import Preferences
from rvsim.gui.servo_limits import ServoLimits, narrowing_sentence
from rvsim.gui.session import Session
from rvsim.lab.before_running import objections, what_is_touched
from rvsim.lab.sentences import Units
from rvsim.language import tr, tr_later
from rvsim.motion import joint_move
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import original_name

if TYPE_CHECKING:
    from rvsim.device.driver.actions import Refusal
    from rvsim.device.driver.io_thread import ArmDriver
    from rvsim.device.driver.languages import LanguageName
    from rvsim.device.driver.state import DriverState
    from rvsim.device.virtual.arm import VirtualArm
    from rvsim.playback.recording import Recording

_POLL_MS = 33
_AT_START = 2e-3  # [rad]: a motion begins only where the arm is
_VIRTUAL = tr_later("Virtual arm")
_RECOVERED = {
    "stopped": tr_later("The stop is reset. Nothing has moved by that; Run begins a motion from its start."),
    "lost": tr_later("Connecting again …"),
}
_NARROW = tr_later("Limits of arm and servos")


class DeviceControl(QObject):
    """At most one arm on a wire. The driver does the work in its own thread; this asks for its state and tells.

    Signals:
        state_changed(state): a `DriverState`, or None when there is no device any more.
        polled(): some 30 times a second while there is a device: time to read its log or its recording.
        live_changed(on): whether the arm follows the window.
        limits_changed(): a tracked path was dropped, for the limits of the servos count now, or do not any more.
        left(robot): another arm was taken; this one was connected, with its own limits again.
    """

    state_changed = Signal(object)
    polled = Signal()
    live_changed = Signal(bool)
    limits_changed = Signal()
    left = Signal(object)

    def __init__(
        self, session: Session, motion: MotionControl, preferences: Preferences, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._motion, self._preferences = session, motion, preferences
        self._driver: ArmDriver | None = None
        self._state: DriverState | None = None
        self._news = ""  # about limits, to be said once the arm is there
        self._live = False
        self._showing = False
        self._to_wake: list[int | None] = []  # one after the other: the driver takes a jump at a time
        self._witness = Witness()  # of the last motion on the arm
        self.title = ""  # of the device, for people
        self.table: float | None = 0.0  # its height [m], None where there is none
        self._timer = QTimer(self, interval=_POLL_MS)
        self._timer.timeout.connect(self.poll)
        session.settled.connect(self._on_settled)

    # --- what there is ---------------------------------------------------------------------------------------------

    @property
    def driver(self) -> ArmDriver | None:
        """The one that talks to the arm, None when no device is chosen."""
        return self._driver

    @property
    def state(self) -> DriverState | None:
        """What the driver said last."""
        return self._state

    @property
    def motion(self) -> MotionControl:
        """The player of the window, which shows what the arm does."""
        return self._motion

    @property
    def virtual(self) -> VirtualArm | None:
        """The arm behind the wire, where it is one of this process."""
        return self._driver.virtual if self._driver else None

    @property
    def recording(self) -> Recording | None:
        """Of the last motion on the arm, of a virtual one with its true poses; None without a device."""
        return self._witness.recording(self._driver) if self._driver else None

    @property
    def run_words(self) -> str:
        """How the last motion was run: on which arm, and with which faults."""
        return self._witness.words(self._driver, self.title == _VIRTUAL) if self._driver else ""

    @property
    def live(self) -> bool:
        """Whether the arm follows the window."""
        return self._live

    @property
    def moves(self) -> bool:
        """Whether the arm may be moving."""
        return self._state is not None and self._state.busy

    # --- the port --------------------------------------------------------------------------------------------------

    def connect_to(self, url: str, *, baud: int = 9600, language: LanguageName = "ssc32") -> None:
        """Open a port. Nothing moves; the limits of the servos count from now on."""
        from rvsim.device.driver.addresses import completed, has_potentiometers, is_virtual
        from rvsim.device.driver.io_thread import ArmDriver  # nobody who has no arm waits for it at the start

        self.disconnect_device()
        robot = self._session.robot
        if not robot.servos:
            why = tr("The {arm} has no servos in its robot file.", arm=tr(robot.title))
            advice = tr("Take the Lynxmotion AL5B, or an arm of yours with [[servo]] tables.")
            self._session.say(f"{why} {advice}", "error")
            return
        limits = ServoLimits(robot)
        try:
            narrowed = limits.narrow(robot)
            address = completed(url, _name_on_disk(robot), language)
            taps = has_potentiometers(address)
            driver = ArmDriver(robot, address, baud=baud, language=language, potentiometers=taps)
        except RvsimError as problem:
            self._session.say(str(problem), "error")
            return
        self._driver = driver
        self._witness.begin()
        self.title = _VIRTUAL if is_virtual(url) else url
        self._session.servo_limits = limits
        self._news = narrowing_sentence(robot, narrowed)
        if narrowed is not robot:
            self._take_limits(tr(_NARROW), narrowed)
        self._tell(driver.connect())
        self._timer.start()
        self.poll()

    def reconnect(self) -> None:
        """Open the same port again, after it was lost."""
        if self._driver is not None:
            self._tell(self._driver.connect())
            self.poll()

    def disconnect_device(self) -> None:
        """Let the arm hold where it is and close the port."""
        driver, self._driver = self._driver, None
        if driver is None:
            return
        self._timer.stop()
        self._to_wake = []  # what was confirmed for this arm is not for the next one
        self.set_live(False)
        driver.close()
        self._widen()
        self._state = None
        self.state_changed.emit(None)

    def take_over(self, other: DeviceControl) -> None:
        """Go on with the arm of a window that this one takes the place of; nothing moves by that."""
        other._timer.stop()
        self._driver, other._driver = other._driver, None
        self._witness, self.title, self.table = other._witness, other.title, other.table
        if self._driver is not None:
            self._timer.start()
            self.poll()

    def close(self) -> None:
        """The window closes: stop the arm first."""
        if self._driver is not None:
            self._driver.stop(tr("The window was closed."))
        self.disconnect_device()

    def poll(self) -> None:
        """Ask the driver how it is; the timer calls this."""
        if self._driver is None:
            return
        state = self._driver.state
        before, self._state = self._state, state
        self._witness.look(self._driver, state)
        self._go_on(state)
        if before is None or _tells_more(before, state):
            self._say_what_happened(before, state)
        self.state_changed.emit(state)
        self.polled.emit()

    # --- moving ----------------------------------------------------------------------------------------------------

    def wake(self, joint: int | None) -> None:
        """Move one channel for the first time, to what the window shows; None is the gripper. It cannot be slow."""
        if self._driver is None:
            return
        if joint is None:
            self._tell(self._driver.wake("gripper", 1.0))
        else:
            self._tell(self._driver.wake(joint, float(self._session.q[joint])))

    def wake_all(self) -> None:
        """All channels at once: only for an arm that cannot be hurt."""
        if self.virtual is None or self._state is None:
            self._session.say(tr("Only a virtual arm is woken all at once."), "error")
            return
        asleep: list[int | None] = [joint for joint, awake in enumerate(self._state.awake) if not awake]
        if self._session.robot.gripper_servo is not None and not self._state.gripper_awake:
            asleep.append(None)
        self._to_wake = asleep
        self._go_on(self._state)

    def send_pose(self) -> bool:
        """Go calmly to the pose that is shown, if nothing is touched on the way; whether the arm does."""
        if self._driver is None or self._state is None:
            return False
        here, there = self._state.commanded_q, self._session.q
        if np.isfinite(here).all() and not self._is_at(there):
            move = joint_move(self._session.robot, here, there)
            against = objections(self._session.robot, move, self._units, table=self.table)
            if against:
                self._session.say(tr("Not sent: {reasons}", reasons=" ".join(against)), "error")
                return False
        return self._tell(self._driver.move_to(there))

    @property
    def differs(self) -> bool:
        """Whether the arm has been sent to another pose than the one that is shown, as far as is known."""
        return self._state is not None and not self._is_at(self._session.q)

    def take_pose(self) -> None:
        """Show the pose that the arm has been sent to."""
        if self._state is not None and np.isfinite(self._state.commanded_q).all():
            self._session.move_to(self._state.commanded_q, tr("Show where the arm is"))

    def set_live(self, on: bool) -> None:
        """Let the arm follow every pose that is shown; it goes there calmly first. No longer: it stays where it is."""
        if on == self._live:
            return
        if on and not self._can_follow():
            self.live_changed.emit(False)
            return
        self._live = on
        if not on and self._driver is not None and self._state is not None and self._state.phase == "streaming":
            self._driver.hold()
        self.live_changed.emit(on)

    def run_motion(self) -> None:
        """Let the arm do the motion that is in the player, after checking it."""
        motion = self._motion.player.trajectory
        if self._driver is None or self._state is None:
            self._session.say(tr("Connect an arm first."), "error")
            return
        if motion is None:
            self._session.say(tr("There is no motion yet: track a line, a trajectory, or run a program."), "error")
            return
        here = self._state.commanded_q  # from there it goes to the motion's start
        against = objections(self._session.robot, motion, self._units, table=self.table, here=here)
        if against:
            self._session.say(tr("Not run on the arm: {reasons}", reasons=" ".join(against)), "error")
            return
        self.set_live(False)
        self._motion.pause()
        if self._tell(self._driver.run(motion, approach=True)):
            self._witness.begin()
            self._session.say(tr("The arm goes calmly to where the motion begins, and then runs it. Esc stops."))

    def grip(self, opening: float, seconds: float = 0.5) -> None:
        """Open or close the gripper: 0 closed … 1 open."""
        if self._driver is not None:
            self._tell(self._driver.grip(opening, seconds))

    def stop(self, reason: str) -> None:
        """Emergency stop: it latches until `reset`. The motion in the window stops too."""
        refusal = self._driver.stop(reason) if self._driver is not None else None
        self._motion.pause()
        self.set_live(False)
        self.poll()
        if refusal is not None:
            self._session.say(tr("The stop does not reach the arm: cut its power. {refusal}", refusal=refusal), "error")

    def reset(self) -> None:
        """Lead out of the latched stop, deliberately."""
        if self._driver is not None:
            self._tell(self._driver.reset())
            self.poll()

    # --- calibration -----------------------------------------------------------------------------------------------

    def use_servos(self, servos: Sequence[Servo], gripper: GripperServo | None, text: str) -> None:
        """Take another calibration: of a copy of the user's own, in one undo step, and on the wire."""
        robot = replace(own_copy(self._session.at_rest.robot), servos=tuple(servos), gripper_servo=gripper)
        if self._driver is not None and not self._tell(self._driver.use_servos(robot.servos, gripper)):
            return
        if self._session.servo_limits is not None:
            try:
                robot = self._session.servo_limits.narrow(robot)
            except RobotDefinitionError as problem:
                self._session.say(str(problem), "error")
                return
        self._session.edit(text, self._session.experiment.with_robot(robot))

    # --- inside ----------------------------------------------------------------------------------------------------

    @property
    def _units(self) -> Units:
        return Units(self._preferences["angle_unit"], self._preferences["length_unit"])

    def _tell(self, refusal: Refusal | None) -> bool:
        """Say why something was refused; whether it was taken."""
        if refusal is not None:
            self._session.say(refusal.sentence, "error")
        return refusal is None

    def _narrow_again(self) -> None:
        """Undo, or an edit, has given the arm limits that its servos do not have."""
        if self._session.servo_limits is None:
            return
        try:
            narrowed = self._session.servo_limits.narrow(self._session.robot)
        except RobotDefinitionError as problem:
            self._session.say(str(problem), "error")
            return
        if narrowed is self._session.robot:
            return
        if self._session.undo_stack.redoText() == tr(_NARROW):
            self._session.undo_stack.redo()
        else:
            self._take_limits(tr(_NARROW), narrowed)
        self._session.say(
            tr("While an arm is connected the limits of its servos count. Disconnect it to go beyond them.")
        )

    def _widen(self) -> None:
        limits, self._session.servo_limits = self._session.servo_limits, None
        if limits is None:
            return
        robot = limits.alone(self._session.robot)
        if not np.array_equal(robot.limits, self._session.robot.limits):
            self._take_limits(tr("Limits of the arm alone"), robot)

    def _take_limits(self, text: str, robot: Robot) -> None:
        tracked = self._session.tracking is not None
        self._session.edit(text, self._session.experiment.with_robot(robot))
        if tracked:
            self.limits_changed.emit()

    def _can_follow(self) -> bool:
        state = self._state
        if state is None or not state.connected or state.phase == "stopped" or not all(state.awake):
            self._session.say(tr("The arm can follow once every joint is awake and no stop is latched."), "error")
            return False
        return self._is_at(self._session.q) or self.send_pose()

    def _is_at(self, q: FloatArray) -> bool:
        if self._state is None:
            return False
        return bool(np.all(np.abs(self._state.commanded_q - q) < _AT_START))

    def _go_on(self, state: DriverState) -> None:
        """What follows from the new state: the next joint wakes, the window shows the moment at which the arm is."""
        if state.phase in ("stopped", "lost"):
            self._to_wake = []
            self.set_live(False)
        if self._to_wake and state.phase in ("asleep", "ready"):
            self.wake(self._to_wake.pop(0))
        if state.phase == "running":
            self._showing = True
            try:
                self._motion.seek(state.time)
            finally:
                self._showing = False

    def _say_what_happened(self, before: DriverState | None, state: DriverState) -> None:
        words = state.reason
        if state.connected and self._news:
            words, self._news = f"{words} {self._news}".strip(), ""
        if words:
            level = "error" if state.phase in ("stopped", "lost") else "info"
            self._session.say(words, level)
        elif before is not None and (before.phase, state.phase) == ("running", "ready"):
            self._session.say(tr("The arm has done the motion. The Measured page compares what came back."))
        elif before is not None and before.phase in ("stopped", "lost") and state.phase not in ("stopped", "lost"):
            self._session.say(tr(_RECOVERED[before.phase]))
        elif state.clamped:
            joints = tr(", ").join(map(tr, state.clamped))
            self._session.warn(tr("Held at the limits of {joints}: the arm does not go there.", joints=joints))

    def _on_settled(self, before: Experiment, after: Experiment) -> None:
        if self._driver is None:
            return
        if not self._takes_wiring(after.robot):
            self._driver.stop(tr("Another arm was taken."))
            limits, self._session.servo_limits = self._session.servo_limits, None
            self.disconnect_device()
            if limits is not None:
                self.left.emit(limits.alone(before.robot))
        elif after.robot is not before.robot:
            QTimer.singleShot(0, self, self._narrow_again)  # the undo that may have brought it must end first
        elif self._live and not self._showing and after.q is not before.q:
            self._follow(after.q)

    def _follow(self, q: FloatArray) -> None:
        """Send the arm after the window, but into nothing."""
        assert self._driver is not None
        touched = what_is_touched(self._session.robot, q, table=self.table)
        if touched:
            self._session.warn(tr("The arm waits: there it would touch {touched}.", touched=touched))
        else:
            self._tell(self._driver.stream(q))

    def _takes_wiring(self, robot: Robot) -> bool:
        """Whether the driver can go on with the arm that is shown: undo may bring back another calibration of it."""
        assert self._driver is not None
        driven = self._driver.robot
        if original_name(robot) != original_name(driven) or robot.dof != driven.dof or not robot.servos:
            return False
        if (robot.servos, robot.gripper_servo) == (driven.servos, driven.gripper_servo):
            return True
        return self._tell(self._driver.use_servos(robot.servos, robot.gripper_servo))


def _tells_more(before: DriverState, after: DriverState) -> bool:
    return (before.phase, before.reason, before.clamped) != (after.phase, after.reason, after.clamped)


def _name_on_disk(robot: Robot) -> str:
    """The name under which the arm, or the one that it is an edited copy of, can be read: a virtual arm is like it."""
    for name in (robot.name, original_name(robot)):
        try:
            if load_robot(name).servos:
                return name
        except RvsimError:
            continue
    return "al5b"
