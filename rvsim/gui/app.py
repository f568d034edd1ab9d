"""Starts the window: application, log, preferences, session. `build_window()` makes one in a running application."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QMargins, Qt
from PySide6.QtGui import QGuiApplication, QIcon
from PySide6.QtWidgets import QApplication

from rvsim.files import user_folder
from rvsim.gui.crash import CrashReporter, start_log
from rvsim.gui.language_switch import WindowKeeper
from rvsim.gui.languages import system_language, wear_language
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.gui.recovery_dialog import offer_recovery
from rvsim.gui.renderers.choose import choose_renderer
from rvsim.gui.renderers.opengl_context import prepare_opengl, probe_opengl
from rvsim.gui.robot_library import RobotLibrary
from rvsim.gui.screenshot import save_screenshot
from rvsim.gui.session import Session
from rvsim.gui.theme import load_fonts, prepare_theme, wear_theme
from rvsim.lab.lines import default_experiment
from rvsim.resources import resource
from rvsim.robot import Robot

_FRAME = QMargins(8, 40, 8, 8)  # what a window manager puts around a window, at most


def build_window(preferences: Preferences | None = None, *, robot: str = "", renderer: str = "") -> MainWindow:
    """A main window inside the running QApplication, not shown yet.

    Args:
        preferences: the user's; None reads them from the user folder.
        robot: the arm to begin with, a name or a robot file; "" for the one last used.
        renderer: "auto", "gl" or "painter"; "" for what the preferences say.
    """
    wishes = preferences if preferences is not None else user_preferences()
    library = RobotLibrary()
    first = _first_robot(library, robot, wishes["robot"])
    session = Session(default_experiment(first), default_experiment)
    choice = choose_renderer(renderer or wishes["renderer"], QGuiApplication.platformName(), probe_opengl)
    prepare_theme(wishes)
    window = MainWindow(session, wishes, library, choice)
    wear_theme(wishes)
    window.dress_narrowest()
    window.say_welcome()
    return window


def _first_robot(library: RobotLibrary, asked: str, last: str) -> Robot:
    """The arm that was asked for, by name or file; else the one last used; else the RV-M1."""
    if asked and asked.lower() not in library:
        return library.open(Path(asked))
    name = asked.lower() or last
    return library[name] if name in library else library["rv-m1"]


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
    for name in ("theme", "look", "language"):
        if getattr(options, name):
            preferences.set(name, getattr(options, name))
    wear_language(app, preferences["language"] or ("en" if options.screenshot else system_language()))
    keeper = WindowKeeper(build_window(preferences, robot=options.robot or "", renderer=options.renderer or ""))
    reporter.parent_widget = lambda: keeper.window
    if options.screenshot:
        if options.open is not None:
            keeper.window.document.open(Path(options.open))
        return save_screenshot(keeper.window, options)
    _begin(keeper.window, options.open)
    status = app.exec()
    keeper.window.end()  # the system may end a program without closing its window
    keeper.window.preferences.write()
    return status


def _begin(window: MainWindow, file: str | None) -> None:
    """Show the window with what was asked for; who is here for the first time is offered a tour."""
    _open(window)
    _begin_document(window, file)
    if not window.preferences["tour_seen"]:
        from rvsim.gui.tour import offer_tour  # once in a lifetime: other starts need not pay for it

        offer_tour(window)


def _begin_document(window: MainWindow, file: str | None) -> None:
    """The session that was asked for; from now on nothing is lost. What a crash has left is offered."""
    window.document.begin()
    if file is not None:
        window.document.open(Path(file))
    offer_recovery(window.document, window)


def _open(window: MainWindow) -> None:
    """Show the window with all of it on the screen, its title bar and borders too."""
    available = window.screen().availableGeometry()
    room = available.size().shrunkBy(_FRAME)
    if window.width() <= room.width() and window.height() <= room.height():
        window.show()
        return
    window.resize(window.size().boundedTo(room))
    window.showMaximized()
