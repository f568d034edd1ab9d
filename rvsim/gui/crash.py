"""When something goes wrong that nobody foresaw: a plain sentence, the details for those who want them, and a log file.

The window lives on. Exceptions reach this module from slots, virtual overrides and worker threads alike.
"""

from __future__ import annotations

import faulthandler
import logging
import sys
import threading
import traceback
from collections.abc import Callable
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QMessageLogContext, QObject, Qt, QtMsgType, Signal, qInstallMessageHandler
from PySide6.QtWidgets import QMessageBox, QWidget
from shiboken6 import isValid

from rvsim.errors import RvsimError
from rvsim.language import tr, trn

_LOG = logging.getLogger("rvsim")
_QT_LEVELS = {
    QtMsgType.QtDebugMsg: logging.DEBUG,
    QtMsgType.QtInfoMsg: logging.INFO,
    QtMsgType.QtWarningMsg: logging.WARNING,
    QtMsgType.QtCriticalMsg: logging.ERROR,
    QtMsgType.QtFatalMsg: logging.CRITICAL,
}


def start_log(folder: Path) -> Path | None:
    """Write the log to folder/rvsim.log (1 MB, three old ones kept); None when nothing can be written there."""
    _LOG.setLevel(logging.INFO)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "rvsim.log"
        handler = RotatingFileHandler(file, maxBytes=1_000_000, backupCount=3, encoding="utf-8")
    except OSError:
        return None
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    _LOG.addHandler(handler)
    return file


class CrashReporter(QObject):
    """Catches what nobody caught, logs it, and tells the user once: further ones are counted while that is open."""

    _caught = Signal(str, str)  # sentence, details; a signal, because the exception may come from any thread

    def __init__(self, log_file: Path | None) -> None:
        super().__init__()
        self._log_file = log_file
        self._dialog: QMessageBox | None = None
        self._more = 0
        self.parent_widget: Callable[[], QWidget | None] = lambda: None
        self._caught.connect(self._show, Qt.ConnectionType.QueuedConnection)

    @property
    def dialog(self) -> QMessageBox | None:
        """The dialog that tells of it, while it is open."""
        return self._dialog

    def install(self) -> None:
        """Take over from now on."""
        sys.excepthook = self.report
        threading.excepthook = lambda args: self.report(
            args.exc_type, args.exc_value or args.exc_type(), args.exc_traceback
        )
        qInstallMessageHandler(_log_qt_message)
        if sys.stderr is not None:  # a windowed bundle has none
            faulthandler.enable()

    def report(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        """Log an exception and tell the user."""
        if issubclass(kind, KeyboardInterrupt):
            sys.exit(130)
        details = "".join(traceback.format_exception(kind, error, trace))
        _LOG.error("uncaught: %s", details)
        if isValid(self):  # at the end of the program there is nobody left to tell
            self._caught.emit(self._sentence(kind, error), details)

    def _sentence(self, kind: type[BaseException], error: BaseException) -> str:
        if isinstance(error, RvsimError):
            return str(error)
        sentences = tr(
            "Something went wrong inside rvsim ({kind}), and the last action may not have been carried out. "
            "Your work is still here and you can go on.",
            kind=kind.__name__,
        )
        return (
            f"{sentences} {tr('It is written down in {file}.', file=self._log_file)}" if self._log_file else sentences
        )

    def _show(self, sentence: str, details: str) -> None:
        if self._dialog is not None:
            self._more += 1
            self._dialog.setInformativeText(
                trn("It has happened {n} time meanwhile.", "It has happened {n} times meanwhile.", self._more + 1)
            )
            return
        self._more = 0
        dialog = QMessageBox(QMessageBox.Icon.Warning, "rvsim", sentence, parent=self.parent_widget())
        dialog.setObjectName("error_dialog")
        dialog.setDetailedText(details)
        dialog.addButton(tr("Go on"), QMessageBox.ButtonRole.AcceptRole)
        dialog.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.finished.connect(self._closed)
        self._dialog = dialog
        dialog.open()

    def _closed(self) -> None:
        self._dialog = None


def _log_qt_message(kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
    _LOG.log(_QT_LEVELS.get(kind, logging.WARNING), "Qt: %s", text)
