"""What the operating system must bring: which libraries are missing, and the line that installs them."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple


class SetupError(Exception):
    """The set-up cannot go on; the message is a sentence for the person who typed the command."""


class Need(NamedTuple):
    """Something that must be there: a library (`….so.N`), a program or a Python module, and the package it comes in."""

    name: str
    package: str


# What PySide6 and OpenGL load on Linux even without a screen.
QT = (
    Need("libEGL.so.1", "libegl1"),
    Need("libGL.so.1", "libgl1"),
    Need("libglib-2.0.so.0", "libglib2.0-0"),
    Need("libxkbcommon.so.0", "libxkbcommon0"),
    Need("libdbus-1.so.3", "libdbus-1-3"),
    Need("libfontconfig.so.1", "libfontconfig1"),
)
# What Qt loads besides to open a window on an X server.
X11 = (
    Need("libxcb-cursor.so.0", "libxcb-cursor0"),
    Need("libxcb-icccm.so.4", "libxcb-icccm4"),
    Need("libxcb-image.so.0", "libxcb-image0"),
    Need("libxcb-keysyms.so.1", "libxcb-keysyms1"),
    Need("libxcb-render-util.so.0", "libxcb-render-util0"),
    Need("libxcb-shape.so.0", "libxcb-shape0"),
    Need("libxcb-xkb.so.1", "libxcb-xkb1"),
    Need("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
)
WAYLAND = (
    Need("libwayland-client.so.0", "libwayland-client0"),
    Need("libwayland-cursor.so.0", "libwayland-cursor0"),
    Need("libwayland-egl.so.1", "libwayland-egl1"),
)
VIRTUAL_SCREEN = (*X11, Need("Xvfb", "xvfb"))
# A Debian Python comes without the module that puts pip into a new environment.
VENV = (Need("ensurepip", f"python{sys.version_info[0]}.{sys.version_info[1]}-venv"),)

# The first release of each system whose glib package has the new name (64-bit time); older ones have the old name.
_RENAMED_GLIB_SINCE = {"debian": 13.0, "ubuntu": 24.04}


def is_present(need: Need) -> bool:
    """Whether it is there, found out by loading or looking it up, not by asking a package manager."""
    if ".so" in need.name:
        return _loads(need.name)
    if need.name == "ensurepip":
        return importlib.util.find_spec(need.name) is not None
    return shutil.which(need.name) is not None


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def window_needs(environment: Mapping[str, str]) -> tuple[Need, ...]:
    """What Qt loads to open a window on the screen that this environment names; nothing when it names none."""
    if environment.get("DISPLAY"):
        return X11
    return WAYLAND if environment.get("WAYLAND_DISPLAY") else ()


def release(text: str) -> dict[str, str]:
    """The fields of an os-release file."""
    pairs = (line.partition("=") for line in text.splitlines() if "=" in line)
    return {key.strip(): value.strip().strip("\"'") for key, _, value in pairs}


def apt_packages(missing: Iterable[Need], system: Mapping[str, str]) -> list[str]:
    """The Debian or Ubuntu packages that bring what is missing, by the names they have in this release."""
    packages = [need.package for need in missing]
    if _has_renamed_glib(system):
        packages = ["libglib2.0-0t64" if name == "libglib2.0-0" else name for name in packages]
    return packages


def _has_renamed_glib(system: Mapping[str, str]) -> bool:
    since = _RENAMED_GLIB_SINCE.get(system.get("ID", ""))
    if since is None:
        return False  # the new package also answers to the old name, which is right for every derivative
    try:
        return float(system["VERSION_ID"]) >= since
    except (KeyError, ValueError):
        return True  # testing and unstable have no number, and are newer than any release


def apt_line(packages: Iterable[str]) -> str:
    """The one line to type for somebody who is not root; a fresh system has no package lists yet, or old ones."""
    return "sudo apt-get update && sudo apt-get install --no-install-recommends " + " ".join(packages)


def provide(needs: Iterable[Need]) -> None:
    """See to it that everything is there: install it as root with apt, otherwise say what to type and give up."""
    if sys.platform != "linux":
        return  # the wheels bring everything there
    missing = [need for need in needs if not is_present(need)]
    if not missing:
        return
    if shutil.which("apt-get") is None:
        raise SetupError(_words(missing))
    packages = apt_packages(missing, _this_release())
    if os.geteuid() != 0:
        raise SetupError(f"Some system packages are missing. Type this line, then try again:\n  {apt_line(packages)}")
    _install(packages)
    still = [need for need in missing if not is_present(need)]
    if still:
        raise SetupError(f"After installing {' '.join(packages)}, still missing: {_names(still)}.")


def _words(missing: list[Need]) -> str:
    return f"Your system lacks {_names(missing)}. Install them with its package manager, then try again."


def _names(needs: list[Need]) -> str:
    return ", ".join(need.name for need in needs)


def _this_release() -> dict[str, str]:
    try:
        return release(Path("/etc/os-release").read_text(encoding="utf-8"))
    except OSError:
        return {}


def _install(packages: list[str]) -> None:
    print("Installing system packages:", " ".join(packages), flush=True)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    install = ["apt-get", "install", "-y", "-q", "--no-install-recommends", *packages]
    subprocess.call(["apt-get", "update", "-q"], env=environment)  # a stale list may do; the next line tells
    if subprocess.call(install, env=environment) != 0:
        raise SetupError(f"apt-get could not install {' '.join(packages)}; its own words are above.")
    importlib.invalidate_caches()
