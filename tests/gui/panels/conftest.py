"""What every panel's test needs: a session with an arm, preferences that are stored nowhere, and the panel on show."""

from collections.abc import Callable

import pytest
from PySide6.QtWidgets import QWidget

from rvsim.experiment import Experiment, LineTask
from rvsim.files import load_robot
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.robot import Robot


def _experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask((0.11, 0.0, 0.13), (0.23, 0.0, 0.33)))


@pytest.fixture
def preferences(qapp) -> Preferences:
    return Preferences()


@pytest.fixture
def session_with(qapp) -> Callable[[str], Session]:
    """A session with that arm at home; `said` collects what it says."""

    def make(name: str) -> Session:
        session = Session(_experiment(load_robot(name)), _experiment)
        session.sentences = []
        session.said.connect(lambda text, level: session.sentences.append((text, level)))
        return session

    return make


@pytest.fixture
def shown(qtbot) -> Callable[[QWidget], QWidget]:
    """Show a panel as its dock would."""

    def show(panel: QWidget) -> QWidget:
        qtbot.addWidget(panel)
        panel.resize(360, 640)
        panel.show()
        return panel

    return show
