"""Screens: whether there is one, and a virtual one for tests and measurements on Linux."""

from __future__ import annotations

import os
import select
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from dev_system import SetupError


def has_screen(environment: Mapping[str, str], platform: str = sys.platform) -> bool:
    """Whether a window can be seen: only Linux has sessions without a screen that can be told apart."""
    return platform != "linux" or bool(environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))


@contextmanager
def virtual_screen() -> Iterator[dict[str, str]]:
    """A virtual X server on a display of its own choice; yields the variables that make Qt draw there."""
    ours, theirs = os.pipe()
    command = ["Xvfb", "-displayfd", str(theirs), "-screen", "0", "1280x900x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=(theirs,), stderr=subprocess.DEVNULL)
    os.close(theirs)
    try:
        display = f":{_display_number(ours)}"
        yield {"DISPLAY": display, "WAYLAND_DISPLAY": "", "QT_QPA_PLATFORM": "xcb", "LIBGL_ALWAYS_SOFTWARE": "1"}
    finally:
        os.close(ours)
        server.terminate()
        server.wait()


def _display_number(pipe: int, patience: float = 30.0) -> str:
    """What the server writes once it is ready; a server that ends or says nothing in time is an error."""
    text = b""
    while not text.endswith(b"\n"):
        ready, _, _ = select.select([pipe], [], [], patience)
        piece = os.read(pipe, 16) if ready else b""
        if not piece:
            raise SetupError("The virtual screen did not start. To see why, type:  Xvfb -displayfd 1")
        text += piece
    return text.decode().strip()
