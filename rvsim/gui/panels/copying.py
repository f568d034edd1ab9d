"""The Copy button of the read-outs: a menu of formats, each made when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from rvsim.gui.panels.shown import ReadOutPanel
from rvsim.gui.session import Session
from rvsim.language import tr


class CopyButton(QToolButton):
    """Offers to copy `what` as each of `formats`, name → maker of the text, and tells the session when it has.

    The formats' names are English; what is copied is for other programs, and stays English too.
    """

    def __init__(
        self,
        name: str,
        what: str,
        formats: Mapping[str, Callable[[], str]],
        session: Session,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._what, self._formats, self._session = what, dict(formats), session
        self.setObjectName(name)
        self.setText(tr("Copy ▾"))
        # The arrow is a part of the word: the style's own hangs in the corner.
        self.setStyleSheet("QToolButton::menu-indicator { image: none; width: 0; }")
        self.setAccessibleName(tr("Copy {what}", what=what))
        self.setToolTip(
            tr("Copy {what} in full precision as {formats}", what=what, formats=tr(", ").join(map(tr, formats)))
        )
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        for format_name in self._formats:
            action = menu.addAction(tr("As {format}", format=tr(format_name)))
            action.setObjectName(f"{name}_{format_name.lower()}")
            action.triggered.connect(lambda _checked=False, chosen=format_name: self.copy_as(chosen))
        self.setMenu(menu)

    def copy_as(self, format_name: str) -> None:
        """Put the text in that format on the clipboard: what is true now, though the panel may lie behind others."""
        around = self.parentWidget()
        while around is not None:
            if isinstance(around, ReadOutPanel):
                around.catch_up()
            around = around.parentWidget()
        QGuiApplication.clipboard().setText(self._formats[format_name]())
        self._session.say(tr("Copied {what} as {format}.", what=self._what, format=tr(format_name)))
