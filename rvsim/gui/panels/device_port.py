"""Which port, how fast, in which language, and the button that connects."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QSizePolicy, QVBoxLayout, QWidget

from rvsim.device.driver.addresses import OTHER_VIRTUAL
from rvsim.device.driver.ports import PortChoice, available_ports
from rvsim.experiment import DeviceSettings
from rvsim.gui.device_words import LANGUAGE_WORDS, baud_words
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, combo, form, select
from rvsim.language import left_to_right, tr

_TYPED = ""
_BAUDS = (9600, 38400, 115200, 2400)


class PortSection(QWidget):
    """Emits `connect_wanted(url, baud, language)`, `disconnect_wanted()`, and `edited()` when something is chosen."""

    connect_wanted = Signal(str, int, str)
    edited = Signal()
    disconnect_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.port = combo("device_port", tr("Port"))
        self.address = QLineEdit()
        self.address.setObjectName("device_address")
        self.address.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.address.setAccessibleName(tr("Address"))
        self.address.setPlaceholderText(
            tr("{example} or {other}", example="socket://192.168.1.5:4001", other="rfc2217://…")
        )
        self.address.setToolTip(
            tr(
                "Anything that pySerial can open: {examples}",
                examples="socket://, rfc2217://, /dev/…, COM…, al5b://?seed=2",
            )
        )
        self.detail = QLabel()
        self.detail.setWordWrap(True)
        self.detail.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        set_role(self.detail, role="muted")
        self.rescan = button("device_rescan", "↻", tr("Look for ports again"), self.scan)
        self.rescan.setFixedWidth(34)
        self.baud = combo("device_baud", tr("Speed of the wire"), {str(rate): baud_words(rate) for rate in _BAUDS})
        self.language = combo("device_language", tr("Language of the controller"), LANGUAGE_WORDS)
        self.connect_button = button(
            "device_connect_button", tr("Connect"), tr("Open the port. Nothing moves"), self._on_button, primary=True
        )
        self._choices: Sequence[PortChoice] = ()
        self._connected = self._lost = False
        self.port.currentIndexChanged.connect(lambda _: self._show_choice())
        for box in (self.port, self.baud, self.language):
            box.setMinimumContentsLength(5)  # or large German letters need more than a small screen has
            box.currentIndexChanged.connect(lambda _: self.edited.emit())
        self.address.textChanged.connect(lambda _: self.edited.emit())
        self._lay_out()
        self.scan()

    def _lay_out(self) -> None:
        ports = QHBoxLayout()
        ports.setSpacing(6)
        ports.addWidget(self.port, 1)
        ports.addWidget(self.rescan)
        rows = form()
        rows.setContentsMargins(0, 0, 0, 0)
        rows.addRow(tr("Port"), ports)
        rows.addRow(tr("Address"), self.address)
        self._address_label = rows.labelForField(self.address)
        self._rows = QWidget()
        self._rows.setLayout(rows)
        rows.addRow(tr("Speed"), self.baud)
        rows.addRow(tr("Language"), self.language)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addWidget(self._rows)
        column.addWidget(self.detail)
        column.addWidget(self.connect_button)

    @property
    def url(self) -> str:
        """What is to be opened."""
        chosen = str(self.port.currentData() or _TYPED)
        return chosen if chosen != _TYPED else self.address.text().strip()

    @property
    def settings(self) -> DeviceSettings:
        """What is chosen."""
        language: Any = self.language.currentData()
        return DeviceSettings(self.url, int(self.baud.currentData()), language)

    def show_settings(self, settings: DeviceSettings) -> None:
        """Choose these; a port that is not here is written as an address. Nothing is opened."""
        here = self.port.findData(settings.url) if settings.url else 0
        if here < 0:
            self.address.setText(settings.url)
        self.port.setCurrentIndex(here if here >= 0 else self.port.findData(_TYPED))
        if self.baud.findData(str(settings.baud)) < 0:
            self.baud.addItem(baud_words(settings.baud), str(settings.baud))
        select(self.baud, str(settings.baud))
        select(self.language, settings.language)

    def scan(self) -> None:
        """List the ports that there are now; the one that was chosen stays if it is still there."""
        before = self.port.currentData()
        first, *others = available_ports()
        self._choices = (first, *OTHER_VIRTUAL, *others)
        self.port.blockSignals(True)
        self.port.clear()
        for choice in self._choices:
            self.port.addItem(_title(choice), choice.url)
        self.port.addItem(tr("Another address …"), _TYPED)
        self.port.setCurrentIndex(max(self.port.findData(before), 0) if before is not None else 0)
        self.port.blockSignals(False)
        self._show_choice()

    def show_connected(self, connected: bool, lost: bool) -> None:
        """What the button does next."""
        if (connected, lost) == (self._connected, self._lost):
            return
        self._lost = lost
        self._connected = connected
        text = tr("Connect again") if lost else tr("Disconnect") if connected else tr("Connect")
        tip = (
            tr("Close the port; the arm holds where it is")
            if connected and not lost
            else tr("Open the port. Nothing moves")
        )
        self.connect_button.setText(text)
        self.connect_button.setToolTip(tip)
        self._rows.setVisible(not connected)  # an open port cannot be changed, and the room is needed
        set_role(self.connect_button, primary=not connected or lost)
        self._show_choice()

    def _show_choice(self) -> None:
        typed = self.port.currentData() == _TYPED
        for widget in (self.address, self._address_label):
            widget.setVisible(typed)
        detail = next((choice.detail for choice in self._choices if choice.url == self.port.currentData()), "")
        self.detail.setText(tr(detail) if detail else "")
        self.detail.setVisible(bool(detail) and not self._connected)

    def _on_button(self) -> None:
        if self._connected and not self._lost:
            self.disconnect_wanted.emit()
        else:
            self.connect_wanted.emit(self.url, int(self.baud.currentData()), str(self.language.currentData()))


def _title(choice: PortChoice) -> str:
    """That of a virtual arm is said, a port's own is its name."""
    return left_to_right(choice.title) if choice.title == choice.url else tr(choice.title)
