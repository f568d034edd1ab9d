"""The virtual arms that outlive the ports through which they are reached, by name, in this process."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from rvsim.device.link.options import ArmOptions, new_arm
from rvsim.errors import DeviceError
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.device.virtual.arm import VirtualArm


@dataclass
class _Kept:
    arm: VirtualArm
    options: ArmOptions
    open: bool = True
    closed_at: float = 0.0


_boards: dict[str, _Kept] = {}
_lock = threading.Lock()


def take_board(url: str, options: ArmOptions, now: float) -> tuple[VirtualArm, float]:
    """The arm of an address, and the time since when nobody has told it the time [s].

    Raises:
        DeviceError: its port is open already, or the name belongs to an arm with other options.
    """
    if not options.board:
        return new_arm(options), now
    with _lock:
        described = replace(options, board_baud=None)  # a button on the board; the rest makes another arm
        kept = _boards.get(options.board)
        if kept is None:
            kept = _boards[options.board] = _Kept(new_arm(options), described, closed_at=now)
        elif kept.options != described:
            raise DeviceError(
                url,
                tr("the board “{board}” is another arm", board=options.board),
                tr("Give this one another {option}.", option="board=NAME"),
            )
        elif kept.open:
            raise DeviceError(
                url, tr("this port is open already"), tr("Close it there first; two programs garble each other.")
            )
        kept.open = True
        return kept.arm, kept.closed_at


def leave_board(options: ArmOptions, now: float) -> None:
    """Its port is closed at a time [s]; a board with a name is kept."""
    with _lock:
        if options.board in _boards:
            _boards[options.board].open, _boards[options.board].closed_at = False, now
