"""What somebody who helps from afar wants to know: versions and renderer."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

import rvsim

_PARTS = ("PySide6-Essentials", "pyqtgraph", "PyOpenGL", "numpy", "scipy", "pyserial")


def diagnostics(renderer: str) -> str:
    """One line a fact."""
    lines = [f"rvsim {rvsim.__version__}", f"Python {platform.python_version()} on {platform.platform(terse=True)}"]
    lines += [f"{part} {_version(part)}" for part in _PARTS]
    return "\n".join([*lines, f"renderer: {renderer}"])


def _version(part: str) -> str:
    try:
        return version(part)
    except PackageNotFoundError:  # in a bundle without metadata
        return "(in the bundle)"
