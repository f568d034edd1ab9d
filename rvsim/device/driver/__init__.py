"""The driver: one object that talks to an arm on a wire, whichever language it speaks.

Names are imported when they are asked for: a window wants to know what a state is at every start, and a port seldom.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rvsim.device.driver.actions import Axis, Playable, Refusal
    from rvsim.device.driver.core import DriverCore
    from rvsim.device.driver.io_thread import ArmDriver
    from rvsim.device.driver.languages import LanguageName
    from rvsim.device.driver.ports import VIRTUAL, PortChoice, available_ports
    from rvsim.device.driver.state import MEASURED_WORDS, DriverState, MeasuredKind, Phase

_MODULES = {
    "actions": ("Axis", "Playable", "Refusal"),
    "core": ("DriverCore",),
    "io_thread": ("ArmDriver",),
    "languages": ("LanguageName",),
    "ports": ("VIRTUAL", "PortChoice", "available_ports"),
    "state": ("MEASURED_WORDS", "DriverState", "MeasuredKind", "Phase"),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}

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


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
