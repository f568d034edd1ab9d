"""What goes into a bundle and what stays out, as tables; rvsim.spec applies them.

Left out is what rvsim never loads, and what the system must bring itself because the graphics driver, which comes from
the system, loads it too: of two versions in one process the older one would win, and the driver would not start.
"""

from __future__ import annotations

import re
import sys
from pathlib import PurePosixPath
from typing import NamedTuple

# Modules that are imported by a name which no analysis sees.
HIDDEN = (
    "OpenGL.platform.egl",
    "OpenGL.platform.glx",
    "OpenGL.arrays.ctypesarrays",
    "OpenGL.arrays.numpymodule",
    "rvsim.device.protocol_al5b",
    "serial.urlhandler.protocol_loop",
    "serial.urlhandler.protocol_rfc2217",
    "serial.urlhandler.protocol_socket",
)

# Parts of libraries that rvsim does not use, and what they would bring along.
EXCLUDED = (
    "PIL.AvifImagePlugin", "PIL._avif", "PIL._imagingcms", "PIL._imagingft", "PIL._imagingtk", "PIL.ImageTk",
    "PySide6.QtNetwork", "PySide6.QtQml", "PySide6.QtQuick", "PySide6.QtSql",
    "IPython", "OpenGL_accelerate", "cupy", "h5py", "matplotlib", "numba", "pytest", "scipy", "setuptools",
    "pkg_resources",
    "_curses", "_hashlib", "_sqlite3", "_ssl", "curses", "lib2to3", "pdb", "pydoc_data", "readline", "sqlite3", "ssl",
    "tkinter", "xmlrpc",
)  # fmt: skip

# Qt's plugins: folder → names (without "lib" and ending) that are kept. Folders that are not named stay out.
_PLUGINS = {
    "platforms": ("qxcb", "qwayland*", "qoffscreen", "qwindows", "qcocoa"),
    "platformthemes": ("qxdgdesktopportal",),
    "platforminputcontexts": ("*",),
    "xcbglintegrations": ("*",),
    "wayland-shell-integration": ("xdg-shell",),
    "wayland-decoration-client": ("*",),
    "wayland-graphics-integration-client": ("qt-plugin-wayland-egl",),
    "imageformats": ("qjpeg", "qsvg", "qwebp", "qgif", "qico"),
    "iconengines": ("qsvgicon",),
    "styles": ("*",),
}
_LANGUAGES = ("ar", "de", "en", "es", "fr", "it", "pt_BR", "ru", "tr", "zh_CN")  # of Qt's own dialogs

# Libraries that a Linux system with a desktop has, in the version that its graphics driver was built with.
_SYSTEM_LIBRARIES = (
    "libstdc++", "libgcc_s", "libX11", "libX11-xcb", "libXau", "libXdmcp", "libXext", "libXrender", "libxcb-glx",
    "libwayland-*", "libdrm", "libexpat", "libz", "libzstd", "libfontconfig", "libfreetype", "libbsd", "libmd",
    "libdbus-1", "libglib-2.0", "libgthread-2.0", "libpcre2-8", "libsystemd", "libcap", "libgcrypt", "libgpg-error",
    "liblz4", "libbrotli*", "libpng16",
)  # fmt: skip
# What only parts that stay out need: GTK's theme, Qt's network and its windows without a window system.
_UNUSED_LIBRARIES = (
    "libQt6Network", "libQt6EglFS*", "libQt6EglFs*", "libQt6Qml*", "libQt6Quick*", "libQt6Pdf*", "libQt6Sql*",
    "libQt6VirtualKeyboard",
    "libatk*", "libblkid", "libcairo*", "libcom_err", "libcrypto", "libdatrie", "libfribidi", "libgdk*", "libgio-2.0",
    "libgmodule*", "libgobject*", "libgraphite2", "libgssapi*", "libgtk*", "libharfbuzz*", "libjpeg", "libk5crypto",
    "libkeyutils", "libkrb5*", "libmount", "libpango*", "libpixman*", "libreadline", "libselinux", "libssl", "libthai",
    "libtinfo",
)  # fmt: skip


class Entry(NamedTuple):
    """A file of a bundle, as PyInstaller lists it: where it goes, where it is now, and what kind of file it is."""

    target: str
    source: str
    kind: str


def is_kept(target: str, platform: str = sys.platform) -> bool:
    """Whether the file that would go there (a path in the bundle, "/" or "\\\\" between its parts) is put in."""
    path = PurePosixPath(target.replace("\\", "/"))
    if "plugins" in path.parts and "PySide6" in path.parts:
        return _is_kept_plugin(path)
    if "translations" in path.parts and "PySide6" in path.parts:
        return path.stem in {f"qtbase_{language}" for language in _LANGUAGES}
    if path.parts[0].endswith(".dist-info"):
        return path.name == "METADATA"  # for the versions; the licences are told elsewhere
    return not (platform.startswith("linux") and _is_named(path, (*_SYSTEM_LIBRARIES, *_UNUSED_LIBRARIES)))


def is_pythons_own(target: str) -> bool:
    """Whether the file that would go there is Python's library, or a module of its standard library."""
    return target.startswith("libpython") or "/lib-dynload/" in target


def _is_kept_plugin(path: PurePosixPath) -> bool:
    folder = path.parts[path.parts.index("plugins") + 1]
    return any(PurePosixPath(_stem(path)).match(name) for name in _PLUGINS.get(folder, ()))


def _is_named(path: PurePosixPath, names: tuple[str, ...]) -> bool:
    """Wheels bring libraries of their own beside their modules, with a number in the name; those are never meant."""
    if ".so" not in path.name or re.search(r"-[0-9a-f]{8}\.", path.name):
        return False
    return any(PurePosixPath(path.name.partition(".so")[0]).match(name) for name in names)


def _stem(path: PurePosixPath) -> str:
    return path.name.partition(".so")[0].partition(".dll")[0].partition(".dylib")[0].removeprefix("lib")


def kept(entries: list[Entry]) -> list[Entry]:
    """Those that are put in."""
    return [entry for entry in entries if is_kept(entry[0])]
