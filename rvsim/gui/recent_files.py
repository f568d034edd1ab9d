"""The session files that were used last, and the menu of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QMenu, QWidget

from rvsim.gui.preferences import Preferences
from rvsim.language import tr

_MOST = 8


class RecentFiles:
    """At most eight, the last used one first, kept in the preferences."""

    def __init__(self, preferences: Preferences) -> None:
        self._preferences = preferences

    @property
    def files(self) -> tuple[Path, ...]:
        """Those that there were; some may be gone."""
        return tuple(Path(line) for line in self._preferences["recent"].splitlines() if line)

    def add(self, file: Path) -> None:
        """This one was used just now."""
        whole = file.absolute()
        if "\n" in str(whole) or "\r" in str(whole):
            return
        kept = (whole, *(other for other in self.files if other != whole))[:_MOST]
        self._preferences.set("recent", "\n".join(map(str, kept)))

    def menu(self, parent: QWidget, open_file: Callable[[Path], object]) -> QMenu:
        """A menu that is filled when it is about to be seen."""
        menu = QMenu(tr("Open recent"), parent)
        menu.setObjectName("recent_menu")
        menu.setToolTipsVisible(True)
        menu.aboutToShow.connect(lambda: self.fill(menu, open_file))
        return menu

    def fill(self, menu: QMenu, open_file: Callable[[Path], object]) -> None:
        """One entry a file; those that are gone are grey."""
        menu.clear()
        for number, file in enumerate(self.files, 1):
            there = _exists(file)
            name = file.name.replace("&", "&&")
            action = menu.addAction(
                f"&{number}  {name}"
                if there
                else tr("&{number}  {name} (not there any more)", number=number, name=name)
            )
            action.setToolTip(str(file))
            action.setEnabled(there)
            action.triggered.connect(lambda _=False, file=file: open_file(file))
        if not self.files:
            menu.addAction(tr("No session has been saved yet")).setEnabled(False)


def _exists(file: Path) -> bool:
    try:
        return file.is_file()
    except OSError:
        return False
