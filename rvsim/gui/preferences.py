"""How this user likes to see things: a table of settings, kept in an ini file that may be missing or broken."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from PySide6.QtCore import QByteArray, QObject, QSettings, Signal

from rvsim.language import LANGUAGES


class Setting(NamedTuple):
    """One setting: its default, and the values it may have (none: any of the default's type)."""

    default: Any
    choices: tuple[Any, ...] = ()


SETTINGS: dict[str, Setting] = {
    "language": Setting("", ("", *LANGUAGES)),  # "": that of the system
    "theme": Setting("light", ("light", "dark")),
    "angle_unit": Setting("deg", ("deg", "rad")),
    "length_unit": Setting("mm", ("mm", "m")),
    "extra_decimals": Setting(0, (0, 1, 2, 3, 4)),
    "orientation": Setting("rpy", ("rpy", "zyz", "quaternion", "axis_angle", "matrix")),
    "look": Setting("solid", ("stick", "solid", "both")),
    "show_frames": Setting(False),
    "show_labels": Setting(True),
    "show_floor": Setting(True),
    "show_trail": Setting(True),
    "orthographic": Setting(False),
    "animated": Setting(True),
    "live": Setting(True),
    "arm_follows": Setting(True),
    "all_ghosts": Setting(True),
    "branch_order": Setting("within limits, least motion, largest margin"),
    "presentation": Setting(False),
    "show_plots": Setting(False),
    "plots": Setting("q,qd,deviation"),
    "renderer": Setting("auto", ("auto", "gl", "painter")),
    "robot": Setting("rv-m1"),
    "student": Setting(""),
    "recent": Setting(""),  # session files, one a line, the last used one first
    "tour_seen": Setting(False),
    "speed": Setting(1.0, (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0)),
}


class Preferences(QObject):
    """The settings in force; `changed(name)` tells when one of them gets another value."""

    changed = Signal(str)

    def __init__(self, file: Path | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store = QSettings(str(file), QSettings.Format.IniFormat) if file else None
        self._values: dict[str, Any] = {name: self._stored(name) for name in SETTINGS}

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def set(self, name: str, value: Any) -> None:
        """Change one setting; an unknown name or a value outside its choices is a programming error."""
        setting = SETTINGS[name]
        if setting.choices and value not in setting.choices:
            raise ValueError(f"{name} is one of {setting.choices}, not {value!r}")
        if value == self._values[name]:
            return
        self._values[name] = value
        if self._store is not None:
            self._store.setValue(f"preferences/{name}", value)
        self.changed.emit(name)

    def successor(self) -> Preferences:
        """The same for the window that takes the place of the one that listens to this; kept in the same file."""
        new = Preferences()
        new._store, new._values = self._store, dict(self._values)
        return new

    def window_state(self, key: str) -> QByteArray:
        """What `keep_window_state` kept under that key, or nothing."""
        stored = self._store.value(f"window/{key}") if self._store is not None else None
        return stored if isinstance(stored, QByteArray) else QByteArray()

    def keep_window_state(self, key: str, state: QByteArray) -> None:
        """Remember a window's geometry or dock layout."""
        if self._store is not None:
            self._store.setValue(f"window/{key}", state)

    def write(self) -> None:
        """Have everything on the disk now: a program that ends at once does not wait for it."""
        if self._store is not None:
            self._store.sync()

    def _stored(self, name: str) -> Any:
        """The stored value if it is one that the setting may have; else the default: a broken file stops nobody."""
        default, choices = SETTINGS[name]
        if self._store is None:
            return default
        raw = self._store.value(f"preferences/{name}", default)
        try:
            value = raw in (True, "true", "True", "1") if isinstance(default, bool) else type(default)(raw)
        except (TypeError, ValueError):
            return default
        return value if not choices or value in choices else default
