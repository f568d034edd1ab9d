"""What goes wrong on a real wire, a real board and real servos, as values that can be switched while it runs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

from rvsim.language import tr_later


class Fault(StrEnum):
    """One thing that goes wrong; `FAULT_WORDS` says what it does."""

    NO_REPLY = tr_later("no reply")
    LATE_REPLY = tr_later("late reply")
    SPLIT_REPLY = tr_later("reply split")
    DUPLICATED_REPLY = tr_later("reply duplicated")
    CORRUPTED_REPLY = tr_later("reply corrupted")
    WRONG_BAUD = tr_later("wrong baud")
    STUCK_MOVING = tr_later("stuck “moving”")
    BROWN_OUT = tr_later("brown-out now")
    BROWN_OUT_IN_MOVE = tr_later("brown-out in mid-move")
    STALLED_SERVO = tr_later("stalled servo")
    SAGGING_SERVO = tr_later("sagging servo")
    SATURATED_BUFFER = tr_later("saturated buffer")
    PORT_VANISHES = tr_later("port vanishes")
    QP_WITH_OFFSET = tr_later("QP with offset")
    FIRST_ANALOG = tr_later("invalid first analog read")


FAULT_WORDS: dict[Fault, str] = {
    Fault.NO_REPLY: tr_later("The board does what it is told but answers nothing."),
    Fault.LATE_REPLY: tr_later("Every answer comes 0.6 s late."),
    Fault.SPLIT_REPLY: tr_later("Answers come in single bytes, 15 ms apart."),
    Fault.DUPLICATED_REPLY: tr_later("Every answer comes twice."),
    Fault.CORRUPTED_REPLY: tr_later("One answered byte in four has a wrong bit."),
    Fault.WRONG_BAUD: tr_later(
        "Host and board speak at different speeds: both read garbage, and nothing is acted upon."
    ),
    Fault.STUCK_MOVING: tr_later("The board says for ever that a move is under way."),
    Fault.BROWN_OUT: tr_later(
        "When switched on, the supply breaks down for 0.4 s: the board starts again and has forgotten "
        "all positions; servos go limp."
    ),
    Fault.BROWN_OUT_IN_MOVE: tr_later(
        "Each move, or row of set-points, that has lasted 0.2 s breaks the supply down for "
        "0.4 s: the board forgets all positions, servos go limp."
    ),
    Fault.STALLED_SERVO: tr_later("A servo is jammed: whatever its pulse, its joint stays where it is."),
    Fault.SAGGING_SERVO: tr_later("A servo is weak: its joint sags six times as far under its load."),
    Fault.SATURATED_BUFFER: tr_later(
        "The board empties its buffer of 64 bytes at 250 bytes/s only: what does not fit is lost."
    ),
    Fault.PORT_VANISHES: tr_later("The port is gone, as if the plug were pulled; the board keeps its last pulses."),
    Fault.QP_WITH_OFFSET: tr_later("Old firmware: QP answers the pulse with the channel's offset (PO) added."),
    Fault.FIRST_ANALOG: tr_later(
        "An analog input that has not been read for 0.5 s answers a wrong byte first, not only once after power-up."
    ),
}

LATENESS = 0.6  # [s]
SPLIT_PAUSE = 0.015  # [s]
CORRUPTED_SHARE = 0.25
DARKNESS = 0.4  # [s] how long a brown-out lasts
DARK_AFTER = 0.2  # [s] of a move
SAG_FACTOR = 6.0
BUFFER_BYTES, BUFFER_RATE = 64, 250.0  # bytes, bytes/s
ANALOG_PAUSE = 0.5  # [s]


@dataclass(frozen=True)
class Faults:
    """Which faults are on.

    Args:
        on: those that are.
        seed: of what is random in them.
        stalled, sagging: the servos that STALLED_SERVO and SAGGING_SERVO mean: joints from 0; the gripper comes last.
    """

    on: frozenset[Fault] = frozenset()
    seed: int = 0
    stalled: tuple[int, ...] = (1,)
    sagging: tuple[int, ...] = (1,)

    def __contains__(self, fault: Fault) -> bool:
        return fault in self.on

    def servos(self, fault: Fault, count: int) -> list[int]:
        """Which of so many servos a fault means; none where it is off."""
        meant = {Fault.STALLED_SERVO: self.stalled, Fault.SAGGING_SERVO: self.sagging}.get(fault, ())
        return [servo for servo in meant if 0 <= servo < count] if fault in self.on else []

    def switched(self, fault: Fault, on: bool = True) -> Faults:
        """A copy in which one fault is on, or off."""
        return replace(self, on=self.on | {fault} if on else self.on - {fault})


NO_FAULTS = Faults()
