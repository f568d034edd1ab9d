"""The Calibrate page: a student looks at the virtual arm, nudges it, marks poses, and finds its hidden servos."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QComboBox, QLabel, QSpinBox, QTableView, QWidget

from rvsim.device.driver import actions, io_thread
from rvsim.device.driver.actions import Axis, Refusal
from rvsim.device.driver.core import DriverCore
from rvsim.device.driver.state import DriverState
from rvsim.device.link.options import new_arm, options_of
from rvsim.device.link.pacing import PacedArm
from rvsim.files import load_robot
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels import device_calibrate
from rvsim.gui.panels.device_calibrate import CalibratePage
from rvsim.gui.panels.device_calibrate_sweep import sweep_seconds
from rvsim.robot import GripperServo, Robot, Servo

from .conftest import StageStub

TICK, LOOK = 0.004, 0.032  # [s] of the driver, and of the window
LONG = 5000  # looks
CLOSE = np.radians(0.2)  # what a student with a set square sees
LOOKS = 3  # in a row without a change: it stands
TURNS = 20  # nudges that a student may need


class TimedDriver:
    """What the page asks of a driver, without a thread: time passes when it is told to, however long it takes."""

    def __init__(self, robot: Robot, url: str, *, baud: int, language: str, potentiometers: bool) -> None:
        self.language = language
        self.virtual = new_arm(options_of(url))
        self._core = DriverCore(robot, language=language, baud=baud, potentiometers=potentiometers)
        self._wire, self._now = PacedArm(self.virtual, baud), 0.0

    @property
    def state(self) -> DriverState:
        return self._core.state

    @property
    def robot(self) -> Robot:
        return self._core.robot

    def pass_time(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self._now += TICK
            self._wire.process(TICK)
            out = self._core.process(self._now, self._wire.receive())
            self._tell_urgent()
            self._wire.send(out)

    def _tell_urgent(self) -> None:
        first = self._core.urgent()
        if first is not None:
            self._wire.cancel_output()
            self._wire.send(first)

    def connect(self) -> Refusal | None:
        return self._core.do(actions.Connect())

    def close(self) -> None:
        self._core.do(actions.Disconnect())

    def wake(self, axis: Axis, value: float) -> Refusal | None:
        return self._core.do(actions.Wake(axis, value))

    def jog_pulse(self, channel: int, pulse_us: float, seconds: float) -> Refusal | None:
        return self._core.do(actions.JogPulse(channel, pulse_us, seconds))

    def use_servos(self, servos: Sequence[Servo], gripper: GripperServo | None) -> Refusal | None:
        return self._core.do(actions.UseServos(servos, gripper))

    def hold(self) -> Refusal | None:
        return self._core.do(actions.Hold())

    def stop(self, reason: str) -> Refusal | None:
        return self._core.do(actions.StopAll(reason))

    def reset(self) -> Refusal | None:
        return self._core.do(actions.Reset())


class Student:
    """Presses what is on the page, and looks at the arm."""

    def __init__(self, page: CalibratePage, device: DeviceControl) -> None:
        self.page, self.device = page, device
        self.learned: dict[int, float] = {}

    def find(self, kind: type[QWidget], name: str) -> QWidget:
        found = self.page.findChild(kind, name)
        assert found is not None, name
        return found

    def press(self, name: str) -> None:
        button = self.find(QAbstractButton, name)
        assert button.isVisibleTo(self.page), name
        assert button.isEnabled(), name
        button.click()

    def text(self, name: str) -> str:
        return self.find(QLabel, name).text()

    @property
    def pulse(self) -> QSpinBox:
        return self.find(QSpinBox, "calibrate_pulse")

    def later(self) -> None:
        """Until the window looks again."""
        self.device.driver.pass_time(LOOK)
        self.device.poll()

    def wait_until(self, holds: Callable[[], bool]) -> None:
        for _ in range(LONG):
            if holds():
                return
            self.later()
        raise AssertionError(self.device.state)

    def wait(self, holds: Callable[[DriverState], bool]) -> None:
        self.wait_until(lambda: holds(self.device.state))

    def connect(self, options: str = "?seed=3", language: str = "ssc32") -> None:
        self.device.connect_to(f"al5b://{options}", baud=115200, language=language)
        self.wait(lambda state: state.phase == "asleep")

    def wake(self) -> None:
        self.press("calibrate_wake_all")
        self.wait(lambda state: state.phase == "ready" and all(state.awake) and state.gripper_awake)

    def choose(self, name: str) -> None:
        box = self.find(QComboBox, "calibrate_joint")
        row = next(row for row in range(box.count()) if name in box.itemText(row))
        box.setCurrentIndex(row)
        box.activated.emit(row)

    @property
    def seen(self) -> np.ndarray:
        """The joints and the opening, as one sees them."""
        arm = self.device.virtual
        assert arm is not None
        return np.append(arm.true_q, arm.true_opening)

    def see(self) -> np.ndarray:
        """The same, once the arm stands."""
        looks = [self.seen]
        while self.device.state.busy or len(looks) < LOOKS or np.ptp(looks[-LOOKS:], axis=0).max() > 1e-4:
            self.later()
            looks.append(self.seen)
        return looks[-1]

    def nudge(self, by_us: float) -> None:
        self.pulse.setValue(self.pulse.value() + round(by_us))

    def what_a_nudge_does(self, axis: int, clear: float) -> float:
        """How far 1 µs moves the axis: nudge inward until one sees it."""
        places = [self.see()[axis]]
        inward = 100 if self.pulse.value() < 1500 else -100
        for _ in range(TURNS):
            self.nudge(inward)
            places.append(self.see()[axis])
            if np.all(np.abs(np.diff(places[-3:])) > clear) and len(places) > 2:  # the first may begin beyond an end
                return float((places[-1] - places[-2]) / inward)
        raise AssertionError((axis, self.pulse.value(), self.text("calibrate_problem")))

    def nudge_until(self, axis: int, value: float, clear: float) -> None:
        """Come from one side until it looks right: past an end nothing moves."""
        if axis not in self.learned:
            self.learned[axis] = self.what_a_nudge_does(axis, clear)
        for _ in range(TURNS):
            off = value - self.see()[axis]
            if abs(off) < CLOSE:
                return
            by_us = 0.93 * off / self.learned[axis]
            self.nudge(by_us if abs(by_us) > 1.0 else np.sign(by_us))
        raise AssertionError((axis, value, self.see()[axis]))

    def mark_pose(self) -> None:
        step = self.page._wizard.step
        if step.stage == "first pose":
            self.press("calibrate_near")
        self.nudge_until(step.joint, step.value, np.radians(4.0))
        self.press("calibrate_mark")
        assert not self.text("calibrate_problem")


@pytest.fixture
def device(session_with, preferences) -> Iterator[DeviceControl]:
    session = session_with("al5b")
    control = DeviceControl(session, MotionControl(session, preferences), preferences)
    yield control
    control.close()


@pytest.fixture
def student(device, preferences, shown, monkeypatch) -> Student:
    monkeypatch.setattr(io_thread, "ArmDriver", TimedDriver)
    page = shown(CalibratePage(device._session, preferences, StageStub(), device))
    page.set_seen(True)
    return Student(page, device)


def worst(robot: Robot, servo: Servo, hidden: Servo, joint: int) -> float:
    """How far the joint stands from where it should [°], at worst over what it can reach."""
    q = np.linspace(*robot.limits[joint], 9)
    pulses = servo.zero_us + servo.gain * q
    return float(np.degrees(np.abs((pulses - hidden.zero_us) / hidden.gain - q).max()))


def test_two_marks_a_joint_find_the_hidden_servos_of_an_arm(student: Student) -> None:
    student.connect()
    student.wake()
    robot, arm = student.device._session.robot, student.device.virtual
    for _ in range(robot.dof):
        student.mark_pose()
        student.mark_pose()
    for opening in (1.0, 0.0):
        student.nudge_until(robot.dof, opening, 0.04)
        student.press("calibrate_mark")
    assert "the other way round" in student.text("calibrate_remarks")
    student.press("calibrate_take")
    robot = student.device._session.robot
    assert [servo.sign for servo in robot.servos] == [servo.sign for servo in arm.servos]
    errors = [worst(robot, *pair, joint) for joint, pair in enumerate(zip(robot.servos, arm.servos, strict=True))]
    assert max(errors) < 1.0, errors
    assert robot.gripper_servo.open_us == pytest.approx(arm.gripper_servo.open_us, abs=25.0)
    assert robot.gripper_servo.closed_us == pytest.approx(arm.gripper_servo.closed_us, abs=25.0)
    assert all(servo.source.startswith("calibrated on 2") and not servo.assumed for servo in robot.servos)
    assert student.device.driver.robot.servos == robot.servos


def test_an_arm_whose_angles_can_be_seen_calibrates_itself(student: Student) -> None:
    student.connect()
    student.wake()
    robot, arm = student.device._session.robot, student.device.virtual
    began, said = student.device.driver._now, sweep_seconds(student.page._wizard)
    assert re.search(r"It takes about \d+\xa0(s|min)\.", student.text("calibrate_automatic_about"))
    student.press("calibrate_automatic")
    student.wait_until(lambda: student.text("calibrate_automatic_ending").startswith("All joints have been swept"))
    took = student.device.driver._now - began
    assert 0.7 < took / said < 1.4, (took, said)
    found = [result for result in student.page._wizard.results if result.joint is not None]
    errors = {result.name: worst(robot, result.new, arm.servos[result.joint], result.joint) for result in found}
    assert set(errors) == set(robot.joint_names)
    assert max(errors.values()) < 1.0, errors
    assert student.text("calibrate_title").endswith("Gripper: open")


def test_a_sweep_can_be_cancelled_and_what_it_has_found_stays(student: Student) -> None:
    student.connect()
    student.wake()
    student.choose("elbow")
    student.press("calibrate_automatic")
    student.wait_until(lambda: len(student.page._wizard.results) == 1)
    student.press("calibrate_automatic_cancel")
    student.see()
    assert [result.name for result in student.page._wizard.results] == ["elbow"]
    assert "stays" in student.text("calibrate_automatic_ending")


def test_a_stop_ends_the_sweep_and_keeps_the_marks(student: Student) -> None:
    student.connect()
    student.wake()
    student.press("calibrate_mark")
    student.press("calibrate_automatic")
    student.device.stop("The stop button was pressed.")
    assert "stopped" in student.text("calibrate_automatic_ending")
    student.wait_until(lambda: _reset(student))
    assert len(student.page._wizard.marks) == 1


def _reset(student: Student) -> bool:
    student.later()
    student.press("calibrate_reset")
    return student.device.state.phase == "ready"


def test_nudges_add_up_and_nothing_else_moves(qtbot, student: Student) -> None:
    student.connect()
    assert not np.isfinite(student.device.virtual.commanded_pulses).any()
    student.wake()
    before = student.device.virtual.commanded_pulses
    start = student.pulse.value()
    for name in ("calibrate_plus_10", "calibrate_plus_10", "calibrate_minus_1"):
        student.press(name)
    qtbot.keyClick(student.find(QAbstractButton, "calibrate_plus_1"), Qt.Key.Key_Left)
    qtbot.keyClick(student.find(QAbstractButton, "calibrate_plus_1"), Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    student.see()
    changed = student.device.virtual.commanded_pulses - before
    assert student.pulse.value() == start + 28
    assert changed[5] == 28.0
    assert np.count_nonzero(np.nan_to_num(changed)) == 1


def test_a_mark_is_refused_while_the_arm_moves_and_undone_when_asked(student: Student) -> None:
    student.connect()
    student.wake()
    first = student.text("calibrate_title")
    student.pulse.setValue(student.pulse.value() + 100)
    student.later()
    assert not student.find(QAbstractButton, "calibrate_mark").isEnabled()
    student.page._on_mark()  # as where the window has not seen it move yet
    assert "still moving" in student.text("calibrate_problem")
    student.see()
    student.press("calibrate_mark")
    assert student.text("calibrate_title") != first
    student.press("calibrate_undo")
    assert student.text("calibrate_title") == first


def test_steps_are_counted_within_a_joint_and_ends_are_asked_for_only_when_wanted(student: Student) -> None:
    student.connect()
    student.wake()
    assert student.text("calibrate_where") == "Joint 1 of 6, step 1 of 2"
    assert "translucent hand" in student.text("calibrate_virtual")
    ends = student.find(QCheckBox, "calibrate_ends")
    assert not ends.isChecked()
    ends.click()
    assert student.text("calibrate_where") == "Joint 1 of 6, step 1 of 4"
    student.mark_pose()
    student.mark_pose()
    assert student.text("calibrate_where") == "Joint 1 of 6, step 3 of 4"
    assert not student.find(QLabel, "calibrate_virtual").isVisibleTo(student.page)
    ends.click()
    assert student.text("calibrate_where") == "Joint 2 of 6, step 1 of 2"
    student.choose("elbow")
    assert student.text("calibrate_title") == "Elbow: first pose"


def test_undo_gives_the_driver_its_old_calibration_back_and_keeps_the_connection(student: Student) -> None:
    student.connect()
    session, old = student.device._session, load_robot("al5b").gripper_servo
    student.press("calibrate_polarity")
    assert student.device.driver.robot.gripper_servo.open_us == old.closed_us
    session.undo_stack.undo()
    assert student.device.state is not None
    assert student.device.driver.robot.gripper_servo == old
    assert session.robot.gripper_servo == old


def test_without_an_arm_the_page_teaches_and_its_numbers_can_be_typed(student: Student) -> None:
    session = student.device._session
    assert "nudge a joint until the arm stands like the picture" in student.text("calibrate_about")
    student.press("calibrate_swap")
    assert (session.robot.servos[4].channel, session.robot.gripper_servo.channel) == (4, 5)
    table = student.find(QTableView, "calibrate_table").model()
    assert table.setData(table.index(2, 4), "9,8")
    assert table.setData(table.index(2, 2), "-")
    assert session.robot.servos[2].us_per_rad == pytest.approx(9.8 * 180.0 / np.pi)
    assert session.robot.servos[2].sign == -1
    assert "Elbow: typed in on" in student.text("calibrate_origin")
    table.setData(table.index(2, 1), "3")
    assert session.sentences[-1][1] == "error"
    assert session.robot.servos[2].channel == 2
    session.undo_stack.setIndex(0)
    assert session.robot.servos == load_robot("al5b").servos


def test_an_arm_without_servos_and_a_bridge_have_nothing_to_calibrate(student: Student, session_with) -> None:
    student.device.connect_to("al5b://?language=bridge", baud=115200, language="bridge")
    student.wait(lambda state: state.connected)
    assert "takes angles, not pulses" in student.text("calibrate_about")
    student.device.disconnect_device()
    late = student.page._wizard
    student.device._session.use_robot(load_robot("ur5e"))
    assert "has no servos" in student.text("calibrate_about")
    student.page.automatic.sweep.advanced.emit(late)
    assert student.page._wizard is None, "a sweep that ends has one more thing to say, of the arm before"


def test_potentiometers_inside_servos_are_not_taken_for_angles(student: Student) -> None:
    student.connect("?seed=3&potentiometers=1")
    student.wake()
    student.wait(lambda state: state.measured_kind == "potentiometers")
    assert "the pulse at which a servo stands, not the angle" in student.text("calibrate_automatic_about")
    assert not student.find(QAbstractButton, "calibrate_automatic").isVisibleTo(student.page)


def test_the_robot_file_keeps_a_calibration(student: Student, monkeypatch, tmp_path) -> None:
    session = student.device._session
    calibrated = tuple(
        replace(servo, zero_us=servo.zero_us - 7.0, source="calibrated") for servo in session.robot.servos
    )
    gripper = GripperServo(4, 2200.0, 800.0)
    student.device.use_servos(calibrated, gripper, "Take the calibration")
    monkeypatch.setattr(device_calibrate, "ask_where_to_save", lambda *_: tmp_path / "desk.toml")
    student.page.results.save.click()
    kept = load_robot(tmp_path / "desk.toml")
    assert [servo.zero_us for servo in kept.servos] == [servo.zero_us for servo in calibrated]
    assert kept.gripper_servo.open_us == 2200.0
