"""The tool card keeps its size while the arm moves, and does not flip between −180° and 180°."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from rvsim.experiment import Experiment, LineTask
from rvsim.files import load_robot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, half_turn_up
from rvsim.gui.session import Session
from rvsim.gui.tool_card import ToolCard
from rvsim.robot import Robot


def _experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask(np.array([0.11, 0.0, 0.13]), np.array([0.23, 0.0, 0.33])))


@pytest.mark.parametrize("unit", ["deg", "rad"])
def test_half_a_turn_is_shown_upwards_whichever_way_it_was_rounded(qapp: object, unit: str) -> None:
    preferences = Preferences()
    preferences.set("angle_unit", unit)
    shown = display("angle", preferences)
    for angle in (-math.pi, -math.pi + 1e-9, math.pi):
        assert half_turn_up(angle, shown) == pytest.approx(math.pi, abs=1e-8)
    for angle in (-3.1, 0.0, 3.1):
        assert half_turn_up(angle, shown) == angle


def test_the_card_keeps_its_size_while_the_arm_moves(qtbot: QtBot) -> None:
    session, stage = Session(_experiment(load_robot("rv-m1")), _experiment), QWidget()
    qtbot.addWidget(stage)
    card = ToolCard(session, Preferences(), stage)
    size = card.size()
    lower, upper = session.robot.limits.T
    for q in np.random.default_rng(3).uniform(lower, upper, (40, 5)):
        assert session.move_to(q, "Go")
        assert card.size() == size
        assert card.sizeHint() == size, "nothing is cut"
