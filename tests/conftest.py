"""What every test shares: deterministic hypothesis, one OpenGL context family, settings that never touch the user's."""

from __future__ import annotations

import json
import os
import runpy
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(
    "rvsim", derandomize=True, deadline=None, max_examples=50, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("rvsim")
# Where nothing else is said, widgets are tested without a screen.
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")


@pytest.fixture(scope="session")
def qapp_args() -> list[str]:
    # Contexts must share before the application exists, or a second OpenGL view stays blank (also in the app itself).
    from PySide6.QtCore import QCoreApplication, Qt

    QCoreApplication.setAttribute(Qt.ApplicationAttribute.AA_ShareOpenGLContexts)
    return ["rvsim-tests"]


@pytest.fixture(autouse=True)
def _own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Settings, logs and robot files go to a folder of this test, never to the user's."""
    monkeypatch.setenv("RVSIM_USER_FOLDER", str(tmp_path / "rvsim-user"))


@pytest.fixture
def quick_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The seconds of arms on a wire are shorter; whoever uses it closes its arms before it ends."""
    quick = runpy.run_path(str(Path(__file__).with_name("quick_time.py")))
    for reader in quick["READERS"]:
        monkeypatch.setattr(reader, "clock", quick["QuickTime"]())


@pytest.fixture(scope="session")
def oracle() -> dict[str, Any]:
    """Reference poses, Jacobians, branches and torques, made by code independent of this project."""
    loaded: dict[str, Any] = json.loads((Path(__file__).parent / "oracles" / "oracle.json").read_text(encoding="utf-8"))
    return loaded


@pytest.fixture(autouse=True)
def _no_widgets_left() -> Iterator[None]:
    """Widgets that a test has closed go before the next one begins: styling dead windows takes seconds."""
    yield
    if "PySide6.QtWidgets" in sys.modules:
        from PySide6.QtCore import QCoreApplication, QEvent
        from PySide6.QtGui import QUndoStack
        from PySide6.QtWidgets import QApplication
        from shiboken6 import getAllValidWrappers

        for stack in [known for known in getAllValidWrappers() if isinstance(known, QUndoStack)]:
            blocked = stack.blockSignals(True)  # as rubbish they would be dangerous: see Session.end
            stack.clear()
            stack.blockSignals(blocked)
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        app = QApplication.instance()
        if isinstance(app, QApplication) and app.styleSheet():
            app.setProperty("theme", None)
            app.setStyleSheet("")  # under it the next window would be dressed piece by piece, which takes twice as long
