"""Where an arm may be: the virtual one first, then the serial ports of this computer."""

from __future__ import annotations

from typing import NamedTuple

from rvsim.language import tr, tr_later


class PortChoice(NamedTuple):
    """One line of a list to choose from.

    Args:
        url: what pyserial opens.
        title: short.
        detail: what is known about it, or how to use it.
    """

    url: str
    title: str
    detail: str


VIRTUAL = PortChoice(
    "al5b://",
    tr_later("Virtual AL5B"),
    tr_later("Simulated in this program, with a controller that speaks as a real one."),
)


def available_ports() -> tuple[PortChoice, ...]:
    """The virtual arm, then what is plugged in, USB adapters first."""
    from serial.tools.list_ports import comports

    found = sorted(comports(), key=lambda port: (port.vid is None, port.device))
    return VIRTUAL, *(PortChoice(port.device, port.device, _detail(port.description, port.device)) for port in found)


def _detail(description: str | None, device: str) -> str:
    known = description not in (None, "", "n/a", device)
    return str(description) if known else tr("Serial port")
