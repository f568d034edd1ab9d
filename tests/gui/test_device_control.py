"""The window's arm on the wire: what it must not do when arms, limits and motions change while it is connected."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from rvsim.device.driver.state import DriverState
from rvsim.device.virtual.faults import Fault
from rvsim.device.wire_log import WireLog
from rvsim.experiment import Experiment, LineTask
from rvsim.files import load_robot
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.user_robot import saved
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.motion import joint_move
from rvsim.robot import Robot
from rvsim.robot.servos import within_servos

LONG_MS = 30_000
SHOULDER = 1


def _experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask((0.11, 0.0, 0.13), (0.23, 0.0, 0.33)))


class Desk:
    """A session, the device of its window, and all that was said."""

    def __init__(self, qtbot: QtBot) -> None:
        preferences = Preferences()
        self.qtbot, self.session = qtbot, Session(_experiment(load_robot("al5b")), _experiment)
        self.device = DeviceControl(self.session, MotionControl(self.session, preferences), preferences)
        self.said: list[str] = []
        self.session.said.connect(lambda text, _: self.said.append(text))

    def wait(self, holds: Callable[[DriverState], bool]) -> None:
        def reached() -> bool:
            self.device.poll()
            return self.device.state is not None and holds(self.device.state)

        self.qtbot.waitUntil(reached, timeout=LONG_MS)

    def connect(self, url: str = "al5b://") -> None:
        self.device.connect_to(url, baud=115200)
        self.wait(lambda state: state.phase == "asleep")

    def wake(self) -> None:
        self.device.wake_all()
        self.wait(lambda state: state.phase == "ready" and all(state.awake) and state.gripper_awake)

    @property
    def log(self) -> WireLog:
        assert self.device.driver is not None
        return self.device.driver.log


@pytest.fixture
def desk(qtbot: QtBot, quick_time: None) -> Iterator[Desk]:
    made = Desk(qtbot)
    yield made
    made.device.close()


def moves(log: WireLog) -> list[bytes]:
    return [entry.data for entry in log.since(0)[1] if entry.data.startswith(b"#")]


def test_joints_that_were_still_to_wake_do_not_wake_on_the_next_arm(desk: Desk) -> None:
    desk.connect()
    desk.device.wake_all()
    desk.connect()
    before = desk.log.count
    desk.wait(lambda _: desk.log.count > before + 4)  # it has been asked twice how it is
    assert desk.device.state is not None
    assert desk.device.state.phase == "asleep"
    assert moves(desk.log) == []


def test_another_size_of_arm_lets_go_of_the_device_though_its_servos_are_the_same(desk: Desk) -> None:
    desk.connect()
    other = load_robot("al5d")
    left: list[Robot] = []
    desk.device.left.connect(left.append)
    assert other.servos == desk.session.robot.servos
    desk.session.use_robot(other)
    assert desk.device.state is None
    np.testing.assert_array_equal(desk.session.robot.limits, other.limits)
    np.testing.assert_array_equal(left[0].limits, load_robot("al5b").limits)


def test_undo_does_not_take_the_servos_limits_away_while_an_arm_is_connected(desk: Desk) -> None:
    wide = desk.session.robot
    desk.connect()
    held = within_servos(wide).limits
    desk.session.move_to(desk.session.q + 0.05, "there")
    for _ in range(3):
        desk.session.undo_stack.undo()
        desk.qtbot.waitUntil(lambda: np.array_equal(desk.session.robot.limits, held), timeout=LONG_MS)
    assert desk.session.undo_stack.canRedo()
    desk.device.disconnect_device()
    np.testing.assert_array_equal(desk.session.robot.limits, wide.limits)


def edited(robot: Robot) -> Robot:
    return robot.with_joint(SHOULDER, lower=0.4, home=1.2)


def test_limits_that_a_person_sets_while_an_arm_is_connected_stay(desk: Desk) -> None:
    wide = desk.session.robot
    desk.connect()
    desk.session.edit("Limits", desk.session.experiment.with_robot(edited(desk.session.robot)))
    desk.device.disconnect_device()
    np.testing.assert_array_equal(desk.session.robot.limits, edited(wide).limits)
    np.testing.assert_array_equal(desk.session.robot.home, edited(wide).home)


def test_a_home_that_the_servos_cannot_reach_is_there_again_afterwards(desk: Desk) -> None:
    servos = list(desk.session.robot.servos)
    servos[SHOULDER] = replace(servos[SHOULDER], min_us=1600.0, max_us=1700.0)
    odd = replace(desk.session.robot, servos=tuple(servos))
    desk.session.edit("Servos", desk.session.experiment.with_robot(odd))
    desk.connect()
    assert not np.array_equal(desk.session.robot.home, odd.home)
    desk.device.disconnect_device()
    np.testing.assert_array_equal(desk.session.robot.home, odd.home)


def test_the_way_to_the_start_of_a_motion_is_checked_too(desk: Desk) -> None:
    robot = desk.session.robot
    here, start = np.radians([0.0, 60.0, -100.0, -90.0, 0.0]), np.radians([0.0, 60.0, -125.0, 45.0, 0.0])
    desk.session.move_to(here, "there")
    desk.connect()
    desk.wake()
    desk.device.motion.load(joint_move(robot, start, start + 0.02), "Beyond the table")
    desk.device.run_motion()
    assert "On the way to its start: at" in desk.said[-1]
    assert "touch the table" in desk.said[-1]


def test_an_arm_that_cannot_go_to_the_pose_is_not_followed_with(desk: Desk) -> None:
    desk.connect()
    assert not desk.device.send_pose()
    desk.wake()
    beyond = desk.session.q + np.array([0.0, 0.0, 0.0, 0.0, 1.5])
    desk.session.edit("Ignore the limits", desk.session.experiment.at(beyond))
    desk.device.set_live(True)
    assert not desk.device.live
    assert "arm and servos stop at" in desk.said[-1]


def test_an_arm_that_follows_no_longer_stays_where_it_is(desk: Desk) -> None:
    desk.connect()
    desk.wake()
    desk.device.set_live(True)
    there = desk.session.q + np.array([0.8, 0.0, 0.0, 0.0, 0.0])
    desk.session.move_to(there, "There")
    desk.wait(lambda state: state.phase == "streaming")
    desk.device.poll()
    desk.device.set_live(False)
    desk.wait(lambda state: state.phase == "ready")
    assert desk.device.state is not None
    assert abs(desk.device.state.commanded_q[0] - there[0]) > 0.1


def test_a_stop_that_cannot_reach_the_arm_is_told(desk: Desk) -> None:
    desk.connect()
    arm = desk.device.virtual
    assert arm is not None
    arm.faults = arm.faults.switched(Fault.PORT_VANISHES)
    desk.wait(lambda state: state.phase == "lost")
    desk.device.stop("Esc was pressed.")
    assert desk.said[-1].startswith("The stop does not reach the arm: cut its power.")


def test_a_motion_of_another_arm_is_refused_with_a_sentence(desk: Desk) -> None:
    desk.connect()
    desk.wake()
    other = load_robot("ur5e")
    desk.device.motion.load(joint_move(other, other.home, other.home + 0.1), "Another arm's")
    desk.device.run_motion()
    assert any("joints" in text for text in desk.said)


def test_neither_a_pose_nor_the_live_window_takes_the_arm_into_the_table(desk: Desk) -> None:
    desk.connect()
    desk.wake()
    low = np.radians([0.0, 10.0, -50.0, 0.0, 0.0])
    desk.session.move_to(low, "Low")
    assert not desk.device.send_pose()
    assert desk.said[-1].startswith("Not sent: ")
    assert "the table" in desk.said[-1]
    desk.session.move_to(desk.session.robot.home, "Home")
    desk.device.set_live(True)
    desk.session.move_to(low, "Low")
    assert desk.said[-1] == "The arm waits: there it would touch the table."
    desk.device.poll()
    assert desk.device.state is not None
    np.testing.assert_allclose(desk.device.state.commanded_q, desk.session.robot.home, atol=1e-2)


def test_files_get_the_limits_of_the_arm_alone(desk: Desk, tmp_path: Path) -> None:
    own = desk.session.robot
    desk.connect()
    assert desk.session.robot.limits[SHOULDER, 1] < own.limits[SHOULDER, 1]
    assert saved(desk.session, tmp_path / "mine.toml")[0]
    np.testing.assert_allclose(load_robot(tmp_path / "mine.toml").limits, own.limits)
    np.testing.assert_array_equal(desk.session.at_rest.robot.limits, own.limits)
    assert desk.session.robot.limits[SHOULDER, 1] < own.limits[SHOULDER, 1], "the narrow ones still count"
    desk.session.use_robot(load_robot("rv-m1"))
    np.testing.assert_array_equal(desk.session.left[0].robot.limits, own.limits)


def test_it_says_what_the_servos_narrow_and_that_they_do_not_reach_further(desk: Desk) -> None:
    own = desk.session.robot
    desk.connect()
    (told,) = [text for text in desk.said if "servos set the limits" in text]
    assert "shoulder 0.0° to 168.0° instead of " in told
    beyond = np.array(desk.session.q)
    beyond[SHOULDER] = own.limits[SHOULDER, 1]
    assert not desk.session.move_to(beyond, "Go")
    assert desk.said[-1] == "Not moved: the connected arm’s servos do not reach that (shoulder)."
