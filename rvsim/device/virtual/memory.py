"""What an SSC-32 keeps without power: its registers and its startup text.

Source: Lynxmotion, "SSC-32U User Guide", registers and startup strings. What they say acts when the power comes.
"""

from __future__ import annotations

from rvsim.robot.servo import CHANNELS

LONGEST_STARTUP = 100  # characters
ENABLE, TRANSMIT_DELAY, TRANSMIT_PACING, BAUD = 0, 1, 2, 4
OFFSETS, WIDTHS = 32, 64  # the first of 32 registers each
RUN_STARTUP, USE_OFFSETS, USE_WIDTHS, USE_NOTHING = 1, 4, 8, 1 << 15  # bits of ENABLE
LAST_REGISTER = 255
_FACTORY = {TRANSMIT_DELAY: 600, TRANSMIT_PACING: 70, BAUD: 960}  # [µs], [µs], baud / 10


class Memory:
    """Numbers and a text that survive."""

    def __init__(self) -> None:
        self._registers = dict(_FACTORY)
        self.startup = ""

    def read(self, register: int) -> int:
        """The number in a register; 0 where nothing was written."""
        return self._registers.get(register, 0)

    def write(self, register: int, value: int) -> None:
        """Keep a number; there are 256 registers, others are not there."""
        if register <= LAST_REGISTER:
            self._registers[register] = value

    def restore(self) -> None:
        """The factory's numbers; the startup text stays."""
        self._registers = dict(_FACTORY)

    def append_startup(self, text: str) -> None:
        """More at the end; what is beyond 100 characters is ignored."""
        self.startup = (self.startup + text)[:LONGEST_STARTUP]

    def delete_startup(self, count: int) -> None:
        """So many characters off the end."""
        self.startup = self.startup[: max(len(self.startup) - count, 0)]

    def enabled(self, bit: int) -> bool:
        """Whether a bit of the enable register is on, and the register not switched off as a whole."""
        bits = self.read(ENABLE)
        return bool(bits & bit) and not bits & USE_NOTHING

    @property
    def baud(self) -> int:
        """The speed that it will have when the power comes [bit/s]."""
        return self.read(BAUD) * 10

    def first_offsets(self) -> list[tuple[int, int]]:
        """(channel, µs) that are to be added from the start."""
        return self._pairs(OFFSETS, USE_OFFSETS)

    def first_pulses(self) -> list[tuple[int, int]]:
        """(channel, µs) that servos get when the power comes."""
        return self._pairs(WIDTHS, USE_WIDTHS)

    def first_lines(self) -> list[str]:
        """The lines of the startup text that are to be executed, in order."""
        lines = self.startup.split(";")[:-1]  # each ends with a semicolon, the last one too
        return lines if self.enabled(RUN_STARTUP) else []

    def _pairs(self, first: int, bit: int) -> list[tuple[int, int]]:
        if not self.enabled(bit):
            return []
        pairs = ((channel, self.read(first + channel)) for channel in range(CHANNELS))
        return [pair for pair in pairs if pair[1]]
