"""What somebody who helps from afar wants to know: versions, screen and renderer."""

from __future__ import annotations

import platform
import sys
from importlib.metadata import PackageNotFoundError, version

from PySide6.QtCore import qVersion
from PySide6.QtGui import QGuiApplication

import rvsim

PARTS = (
    "PySide6-Essentials", "numpy", "pyqtgraph", "PyOpenGL", "pyserial", "ziamath", "ruckig", "pillow",
    "simpleeval", "platformdirs",
)  # fmt: skip


def diagnostics(renderer: str) -> str:
    """One line a fact; nothing about the person, and no folder's name."""
    lines = [f"rvsim {rvsim.__version__}{' (bundle)' if getattr(sys, 'frozen', False) else ''}"]
    lines += [f"Python {platform.python_version()} on {platform.platform(terse=True)} ({platform.machine()})"]
    lines += [f"Qt {qVersion()}, platform {QGuiApplication.platformName()}"]
    lines += [f"{part} {_version(part)}" for part in PARTS]
    return "\n".join([*lines, *_screens(), f"renderer: {renderer}"])


def _screens() -> list[str]:
    sizes = [(screen.size(), screen.devicePixelRatio()) for screen in QGuiApplication.screens()]
    return [f"screen {size.width()} × {size.height()}, {ratio:g} pixels a unit" for size, ratio in sizes]


def _version(part: str) -> str:
    try:
        return version(part)
    except PackageNotFoundError:  # in a bundle without metadata
        return "(in the bundle)"
