"""What the numbers of the language may be. Both sides share them: the host refuses the rest, the board drops it."""

from __future__ import annotations

from rvsim.robot.servo import CHANNELS

CHANNEL_RANGE = (0, CHANNELS - 1)
PULSE_RANGE = (500, 2500)  # µs; 0 switches a servo off
# The board holds shorter and longer pulses at these ends, up to here; what is beyond is no pulse.
LARGEST_PULSE_NUMBER = 3000
SPEED_RANGE = (1, 65535)  # µs/s
TIME_RANGE = (0, 65535)  # ms
OFFSET_RANGE = (-100, 100)  # µs
BANK_RANGE = (0, 3)
BYTE_RANGE = (0, 255)
REGISTER_RANGE = (0, 255)
REGISTER_VALUE_RANGE = (-32768, 65535)
LONGEST_STARTUP = 100  # characters
DELETE_RANGE = (0, 255)
DIGITAL_INPUTS = "ABCDEF"
MOST_DIGITAL_INPUTS = 8  # in one line
ANALOG_INPUTS = "ABCDEFGH"


def within(value: int, ends: tuple[int, int]) -> bool:
    """Whether a number lies in a range, its ends included."""
    return ends[0] <= value <= ends[1]
