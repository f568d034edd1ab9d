"""`rvsim --screenshot`: sets the window up as asked, lets it paint, saves it. So the README's pictures are made."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer

from rvsim.errors import DeviceError, RvsimError, UnknownNameError
from rvsim.experiment import TrajectoryTask
from rvsim.gui.main_window import MainWindow
from rvsim.gui.picture import save_image
from rvsim.lab.lines import line_presets
from rvsim.lab.named_paths import path_names
from rvsim.language import tr

_SIZE = (1366, 768)
_STATES = ("home", "line", "line-source", "arm")
_VIRTUAL = "al5b://?potentiometers=1"
_LONGEST_MS = 60_000


def save_screenshot(window: MainWindow, options: argparse.Namespace) -> int:
    """Show `options.state` and `options.panel`, and save the window as `options.screenshot`; the exit status."""
    window.preferences.set("animated", False)
    window.resize(*(options.size or _SIZE))
    window.show()
    _settle(200)
    try:
        _set_up(window, options.state)
        window.docks.show_panel(options.panel)
        _settle(300)
        save_image(window.picture(), Path(options.screenshot))
    except (RvsimError, OSError) as problem:
        print(f"rvsim: {problem}", file=sys.stderr)
        return 2
    finally:
        window.rest()
    print(options.screenshot)
    return 0


def _set_up(window: MainWindow, state: str) -> None:
    if state == "home":
        return
    experiment = window.session.experiment
    if state == "arm":
        _run_on_virtual_arm(window)
        return
    if state in ("line", "line-source"):
        presets = line_presets(window.session.robot)
        line = presets[-1 if state == "line-source" else 0].task()
        window.session.edit(tr("Line"), replace(experiment, line=line))
        window.tracker.track_line()
    else:
        known = path_names(window.session.robot)
        if state not in known:
            raise UnknownNameError(tr("state"), state, (*_STATES, *known))
        window.session.edit(tr("Trajectory"), replace(experiment, trajectory=TrajectoryTask(state)))
        window.tracker.track_trajectory()
    while window.tracker.busy:
        _settle(20)
    window.motion.seek(0.8 * window.motion.player.duration)
    window.motion.pause()


def _run_on_virtual_arm(window: MainWindow) -> None:
    """Track the offered line, and let a virtual arm do it."""
    device = window.device
    window.tracker.track_line()
    window.motion.pause()
    device.connect_to(_VIRTUAL, baud=115200)
    _wait(lambda: device.state is not None and device.state.phase == "asleep")
    device.wake_all()
    _wait(lambda: device.state is not None and device.state.gripper_awake and device.state.phase == "ready")
    device.run_motion()
    _wait(lambda: device.state is not None and device.state.phase == "running")
    _wait(lambda: device.state is None or device.state.phase != "running")
    _settle(1200)  # what is measured arrives after what was sent


def _wait(holds: Callable[[], bool]) -> None:
    """Let the window live until that holds."""
    for _ in range(_LONGEST_MS // 20):
        if holds():
            return
        _settle(20)
    raise DeviceError(_VIRTUAL, tr("the virtual arm did not do what it was told"), tr("Try again."))


def _settle(milliseconds: int) -> None:
    """Let the window live for a while."""
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()
