"""The Measured page: only the motion itself counts, and what a controller reports is not called a measurement."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from rvsim.experiment import Experiment, LineTask
from rvsim.files import load_robot
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.device_measured import MeasuredPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.motion import joint_move
from rvsim.robot import Robot
from rvsim.scene.palette import LIGHT

LONG_MS = 30_000
FAR = np.array([0.1, 0.0, 0.0, 0.0, 0.0])


class _Stage:
    palette = LIGHT

    def set_layer(self, _name: str, _items: object) -> None: ...


def _experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask((0.11, 0.0, 0.13), (0.23, 0.0, 0.33)))


@pytest.fixture
def page(qtbot: QtBot, quick_time: None) -> Iterator[MeasuredPage]:
    """After a motion of the virtual arm, to which it had to go first."""
    preferences = Preferences()
    session = Session(_experiment(load_robot("al5b")), _experiment)
    device = DeviceControl(session, MotionControl(session, preferences), preferences)

    def until(phase: str, *, awake: bool = False) -> None:
        def there() -> bool:
            device.poll()
            state = device.state
            if state is None or state.phase != phase:
                return False
            return not awake or (all(state.awake) and state.gripper_awake)

        qtbot.waitUntil(there, timeout=LONG_MS)

    device.connect_to("al5b://", baud=115200)
    until("asleep")
    device.wake_all()
    until("ready", awake=True)
    made = MeasuredPage(session, preferences, _Stage(), device)
    qtbot.addWidget(made)
    made.show()
    made.set_seen(True)
    device.motion.load(joint_move(session.robot, session.q + FAR, session.q + 3.0 * FAR), "A move")
    device.run_motion()
    until("running")
    until("ready")
    made.set_seen(True)
    yield made
    device.close()


def test_reported_pulses_are_called_so_and_the_truth_of_the_virtual_arm_is_told(page: MeasuredPage) -> None:
    assert page.summary.text().startswith("The controller reported pulses")
    assert "that is no measurement" in page.summary.text()
    assert "Really the virtual arm’s tool" in page.summary.text()
    assert "stopped" not in page.summary.text()
    assert "A saved session does not hold this run" in page.keeping.text()
    heads = [page.model.headerData(i, Qt.Orientation.Horizontal) for i in range(page.model.columnCount())]
    assert heads == ["Deviation, RMS", "Sent", "Reported", "Really"]
    assert "measured" not in page.legend.text()
    assert [line.name for line in page.curves.drawing.lines][:4] == [
        "x wanted", "x sent", "x reported", "x really (virtual arm)",
    ]  # fmt: skip
    _check_that_only_the_motion_itself_counts(page)


def _check_that_only_the_motion_itself_counts(page: MeasuredPage) -> None:
    recording, part = page._recording, page._part
    assert recording is not None
    assert part is not None
    assert recording.t[0] < 0.0 <= part.t[0]
    assert part.t[-1] <= part.planned == page._device.motion.player.trajectory.duration
    assert float(np.nanmax(part.joint_errors("true").max)) < 0.2
    assert "virtual arm" in page._device.run_words
    assert "Faults that were switched on: none." in page._device.run_words
