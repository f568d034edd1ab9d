"""What every panel's test needs: a session with an arm, preferences that are stored nowhere, and the panel on show."""

from collections.abc import Callable

import pytest
from numpy.typing import ArrayLike
from PySide6.QtWidgets import QWidget

from rvsim.experiment import Experiment, LineTask
from rvsim.files import load_robot
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.robot import Robot
from rvsim.scene.palette import LIGHT
from rvsim.scene.primitives import Item


def _experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask((0.11, 0.0, 0.13), (0.23, 0.0, 0.33)))


class StageStub:
    """Keeps what a page of the inspector draws."""

    palette = LIGHT

    def __init__(self) -> None:
        self.layers: dict[str, tuple[Item, ...]] = {}

    def set_layer(self, name: str, items: tuple[Item, ...]) -> None:
        self.layers[name] = items


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


@pytest.fixture
def inspecting(session_with, preferences, shown) -> Callable[..., InspectPage]:
    """A page of the inspector in front, with that arm, in that pose; `_stage.layers` has what it draws."""

    def make(kind: type[InspectPage], name: str, q: ArrayLike | None = None) -> InspectPage:
        session = session_with(name)
        if q is not None:
            session.move_to(q, "Plot")
        page = shown(kind(session, preferences, StageStub()))
        page.set_seen(True)
        return page

    return make
