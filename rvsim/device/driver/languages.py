"""The languages that the driver speaks, by name."""

from __future__ import annotations

from typing import Literal

from rvsim.device.driver.bridge_language import BridgeLanguage
from rvsim.device.driver.language import ArmLanguage
from rvsim.device.driver.ssc32_language import Ssc32Language
from rvsim.errors import RobotDefinitionError
from rvsim.language import tr
from rvsim.robot import Robot

LanguageName = Literal["ssc32", "bridge"]


def language_of(name: LanguageName, robot: Robot, *, potentiometers: bool = False) -> ArmLanguage:
    """The language of that name for an arm.

    Raises:
        RobotDefinitionError: the arm has no servos, or a joint has no value that both arm and servo allow.
    """
    if not robot.servos:
        raise RobotDefinitionError(robot.name, tr("it has no [[servo]] tables, so nothing can be sent to its joints."))
    if name == "bridge":
        return BridgeLanguage(robot)
    return Ssc32Language(robot, potentiometers=potentiometers)
