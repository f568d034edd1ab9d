"""How a job that lasts is ended: each signal that asks for it takes the way of Ctrl-C."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress

_ENDINGS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")  # those that this system has


@contextmanager
def ending_signals_interrupt() -> Iterator[None]:
    """Raise KeyboardInterrupt at each, also where a shell has told a background job to take no notice of Ctrl-C."""
    numbers = [getattr(signal, name) for name in _ENDINGS if hasattr(signal, name)]
    former = {}
    with suppress(ValueError):  # not in the main thread: signals do not come here
        former = {number: signal.signal(number, signal.default_int_handler) for number in numbers}
    try:
        yield
    finally:
        for number, handler in former.items():
            signal.signal(number, handler)
