"""The driver: one object that talks to an arm on a wire, whichever language it speaks."""

from rvsim.device.driver.actions import Axis, Playable, Refusal
from rvsim.device.driver.core import DriverCore
from rvsim.device.driver.io_thread import ArmDriver
from rvsim.device.driver.languages import LanguageName
from rvsim.device.driver.ports import VIRTUAL, PortChoice, available_ports
from rvsim.device.driver.state import MEASURED_WORDS, DriverState, MeasuredKind, Phase

__all__ = [
    "MEASURED_WORDS",
    "VIRTUAL",
    "ArmDriver",
    "Axis",
    "DriverCore",
    "DriverState",
    "LanguageName",
    "MeasuredKind",
    "Phase",
    "Playable",
    "PortChoice",
    "Refusal",
    "available_ports",
]
