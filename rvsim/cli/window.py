"""`rvsim` without a command: the window, or a picture of it."""

from __future__ import annotations

import argparse
import logging
import os
import re
import sys
from contextlib import suppress
from typing import NoReturn

from rvsim.cli.arguments import output_file
from rvsim.cli.outcome import InputError
from rvsim.files import load_robot
from rvsim.files.session_file import load_session
from rvsim.language import LANGUAGES

_PANELS = (
    "path", "check", "program", "compare", "inverse", "how", "lab",
    "jacobian", "velocity", "singular", "forces", "dynamics", "workspace", "source",
    "tool", "matrices", "points", "dh", "device", "wire", "calibrate", "measured", "virtual",
)  # fmt: skip


def add_window_options(parser: argparse.ArgumentParser) -> None:
    """What a start of the window, or of a picture of it, may be told."""
    window = parser.add_argument_group("the window")
    window.add_argument(
        "--robot", metavar="ARM", help="the arm to begin with: a name that `rvsim robots` lists, or a robot file"
    )
    window.add_argument(
        "--open", metavar="FILE.rvsim", help="the session to open; rvsim FILE.rvsim alone means the same"
    )
    window.add_argument("--renderer", choices=("auto", "gl", "painter"), help="who draws the scene")
    window.add_argument("--theme", choices=("light", "dark"))
    window.add_argument(
        "--language", choices=tuple(LANGUAGES), help="of the window; else the one last chosen, or the system's"
    )
    window.add_argument("--screenshot", type=output_file, metavar="FILE.png", help="open, draw, save, leave")
    window.add_argument("--size", type=_size, metavar="1366x768", help="of the window")
    window.add_argument("--state", default="home", metavar="home|line|arm|PATH", help="what the screenshot shows")
    window.add_argument("--panel", choices=_PANELS, default="path", help="the panel that the screenshot shows")
    window.add_argument("--look", choices=("solid", "stick", "both"), help="how the arm is drawn")


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{2,5})[x×](\d{2,5})", text.strip())
    if match is None:
        raise argparse.ArgumentTypeError(f"“{text}” is no size; write it like 1366x768")
    return int(match[1]), int(match[2])


def open_window(options: argparse.Namespace) -> int:
    """Show the window until it is closed; its exit status."""
    if options.robot is not None:
        load_robot(options.robot)  # an unknown arm is told before anything opens
    if options.open is not None and options.screenshot is not None:
        load_session(options.open)  # for a picture; the window says by itself what is wrong with a file
    _require_display(options)
    from rvsim.gui.app import main as show_window

    return show_window(options)


def leave(status: int) -> NoReturn:
    """End the process with that exit status, without destroying a window that was open.

    Python would free its thousands of parts in no order, and Qt for Python 6.11 stumbles over that now and then: a
    program that crashes when all is saved and closed.
    """
    if "PySide6.QtWidgets" not in sys.modules:
        sys.exit(status)
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # nobody reads it any more
            if stream is not None:
                stream.flush()
    os._exit(status)


def _require_display(options: argparse.Namespace) -> None:
    """Qt aborts without a display; a picture needs none."""
    seen = any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"))
    if seen or not sys.platform.startswith("linux"):
        return
    if options.screenshot is None:
        raise InputError(
            "There is no display for a window. Without one: rvsim --screenshot FILE.png, rvsim track ARM …"
        )
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
