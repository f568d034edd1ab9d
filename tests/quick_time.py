"""rvsim with arms whose seconds pass four times as fast, for the wire and the driver alike; also as a program.

Nothing in rvsim is told to be less careful: a wake still takes its second, but nobody has to wait for it that long.
"""

from __future__ import annotations

import sys
import threading

from rvsim.cli import main
from rvsim.device.driver import ArmDriver
from rvsim.device.link.real_time import WallClock
from rvsim.device.link.serve import Server
from rvsim.device.protocol_al5b import Serial

QUICKER = 4.0
READERS = (ArmDriver, Serial, Server)  # all must agree on what time it is


class QuickTime(WallClock):
    """Real time, quicker."""

    def now(self) -> float:
        return QUICKER * super().now()

    def wait(self, changed: threading.Condition | threading.Event, seconds: float) -> None:
        super().wait(changed, seconds / QUICKER)

    def sleep(self, seconds: float) -> None:
        super().sleep(seconds / QUICKER)


if __name__ == "__main__":
    for reader in READERS:
        reader.clock = QuickTime()
    sys.exit(main())
