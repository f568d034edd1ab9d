"""Starts the window: application, log, preferences, session. `build_window()` makes one in a running application."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEventLoop, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QIcon
from PySide6.QtWidgets import QApplication

from rvsim.errors import RvsimError
from rvsim.files import user_folder
from rvsim.gui.crash import CrashReporter, start_log
from rvsim.gui.main_window import MainWindow
from rvsim.gui.picture import save_image
from rvsim.gui.preferences import Preferences
from rvsim.gui.renderers.choose import choose_renderer
from rvsim.gui.renderers.opengl_context import prepare_opengl, probe_opengl
from rvsim.gui.robot_library import RobotLibrary
from rvsim.gui.session import Session
from rvsim.gui.theme import load_fonts, wear_theme
from rvsim.lab.lines import default_experiment
from rvsim.resources import resource


def build_window(preferences: Preferences | None = None, *, robot: str = "", renderer: str = "") -> MainWindow:
    """A main window inside the running QApplication, not shown yet.

    Args:
        preferences: the user's; None reads them from the user folder.
        robot: the arm to begin with; "" for the one last used.
        renderer: "auto", "gl" or "painter"; "" for what the preferences say.
    """
    wishes = preferences if preferences is not None else user_preferences()
    library = RobotLibrary()
    name = robot or wishes["robot"]
    first = library[name] if name in library else library["rv-m1"]
    session = Session(default_experiment(first), default_experiment)
    choice = choose_renderer(renderer or wishes["renderer"], QGuiApplication.platformName(), probe_opengl)
    wear_theme(wishes)  # before there are widgets: dressing them one by one is slower
    window = MainWindow(session, wishes, library, choice)
    window.say_welcome()
    return window


def user_preferences() -> Preferences:
    """The user's preferences, kept in the user folder."""
    return Preferences(user_folder() / "settings.ini")


def make_application(arguments: list[str]) -> QApplication:
    """The application, with what must be said before it exists."""
    prepare_opengl()
    QGuiApplication.setHighDpiScaleFactorRoundingPolicy(Qt.HighDpiScaleFactorRoundingPolicy.PassThrough)
    QCoreApplication.setApplicationName("rvsim")
    app = QApplication(arguments)
    app.setWindowIcon(QIcon(str(resource("icons", "rvsim.svg"))))
    load_fonts()
    return app


def main(options: argparse.Namespace) -> int:
    """Open the window, or with `options.screenshot` draw it, save it and leave."""
    sys.setswitchinterval(0.001)  # a busy worker must not make the window hiccup
    app = make_application(["rvsim"])
    reporter = CrashReporter(start_log(user_folder() / "log"))
    reporter.install()
    preferences = Preferences() if options.screenshot else user_preferences()
    if options.theme:
        preferences.set("theme", options.theme)
    window = build_window(preferences, robot=options.robot or "", renderer=options.renderer or "")
    reporter.parent_widget = lambda: window
    if options.screenshot:
        return _screenshot(window, options)
    available = window.screen().availableGeometry()
    if window.width() > available.width() or window.height() > available.height():
        window.resize(available.size() * 0.95)
    window.show()
    return app.exec()


def _screenshot(window: MainWindow, options: argparse.Namespace) -> int:
    """Set the window up as asked, let it paint, save it."""
    width, height = options.size or (1366, 768)
    window.resize(width, height)
    window.show()
    _settle(200)
    _STATES.get(options.state, _show_path)(window, options.state)
    _settle(300)
    try:
        save_image(window.picture(), Path(options.screenshot))
    except (RvsimError, OSError) as problem:
        print(problem, file=sys.stderr)
        return 2
    print(options.screenshot)
    return 0


def _show_home(window: MainWindow, _state: str) -> None:
    window.joints.go_home()


def _show_line(window: MainWindow, _state: str) -> None:
    window.tracker.track_line()
    window.motion.seek(0.75 * window.motion.player.duration)
    window.motion.pause()


def _show_path(window: MainWindow, state: str) -> None:
    from dataclasses import replace

    from rvsim.experiment import TrajectoryTask

    experiment = window.session.experiment
    window.session.edit("Trajectory", replace(experiment, trajectory=TrajectoryTask(state)))
    window.tracker.track_trajectory()
    window.motion.seek(0.8 * window.motion.player.duration)
    window.motion.pause()


_STATES = {"": _show_home, "home": _show_home, "line": _show_line}


def _settle(milliseconds: int) -> None:
    """Let the window live for a while."""
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()
