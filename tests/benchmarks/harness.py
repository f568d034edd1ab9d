"""A fair race: both sides must agree before they are timed, run in turn, and count only their own processor time.

Run as a script it prints the machine and the versions. A benchmark is a script `bench_NAME.py` beside this file that
prints its own rows; `packaging/dev.py bench NAME` gives it one core, one thread and an environment with the peers.
"""

from __future__ import annotations

import gc
import platform
import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

REPEATS = 9
SHORTEST_SAMPLE = 0.05  # [s]; a call that is quicker is repeated until a sample lasts this long
PACKAGES = ("rvsim", "numpy", "scipy", "roboticstoolbox-python", "spatialmath-python", "pin", "eaik", "ur-analytic-ik")

Call = Callable[[], Any]


class Side(NamedTuple):
    """One runner: its name, and a call that computes the answer as a numpy array."""

    name: str
    call: Call


class Race(NamedTuple):
    """What came out: seconds an item for each side (the median of the samples), and how often ours is faster."""

    work: str
    peer: str
    ours: float
    theirs: float
    ratio: float
    lowest: float
    highest: float
    aim: float | None


def race(work: str, ours: Side, peer: Side, items: int, *, aim: float | None = None, tolerance: float = 1e-9) -> Race:
    """Time both sides on the same work of so many items, one sample of each in turn; `aim` is the ratio wished for.

    Raises:
        ValueError: the answers differ by more than the tolerance; then there is nothing to compare.
    """
    _agree(work, ours, peer, tolerance)
    calls = {side: _calls_for_a_sample(side.call) for side in (ours, peer)}
    samples: dict[Side, list[float]] = {ours: [], peer: []}
    with _no_garbage_collection():
        for _ in range(REPEATS):
            for side in (ours, peer):
                samples[side].append(_sample(side.call, calls[side]) / (calls[side] * items))
    ratios = [theirs / own for own, theirs in zip(samples[ours], samples[peer], strict=True)]
    own, theirs = (statistics.median(samples[side]) for side in (ours, peer))
    return Race(work, peer.name, own, theirs, theirs / own, min(ratios), max(ratios), aim)


def _agree(work: str, ours: Side, peer: Side, tolerance: float) -> None:
    difference = float(np.max(np.abs(np.asarray(ours.call()) - np.asarray(peer.call()))))
    if not difference <= tolerance:
        raise ValueError(f"{work}: {ours.name} and {peer.name} differ by {difference:.3g}, so they are not timed")


def _calls_for_a_sample(call: Call) -> int:
    """How many calls last long enough to be measured; finding out is the warm-up too."""
    calls = 1
    while (lasted := _sample(call, calls)) < SHORTEST_SAMPLE:
        calls = max(2 * calls, int(calls * SHORTEST_SAMPLE / max(lasted, 1e-6)))
    return calls


def _sample(call: Call, calls: int) -> float:
    start = time.process_time()
    for _ in range(calls):
        call()
    return time.process_time() - start


@contextmanager
def _no_garbage_collection() -> Iterator[None]:
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def duration(seconds: float) -> str:
    """A time with a fitting unit and three digits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def print_races(title: str, races: Iterable[Race]) -> None:
    """The table of ratios; the range is that of the pairs of samples."""
    print_table(
        title, ("work, an item", "rvsim", "peer", "peer's time", "times faster", "range", "aim"), map(_row, races)
    )


def _row(r: Race) -> tuple[str, ...]:
    spread = f"{r.lowest:.1f} … {r.highest:.1f}"
    aim = "" if r.aim is None else f"≥ {r.aim:g} {'reached' if r.ratio >= r.aim else 'MISSED'}"
    return r.work, duration(r.ours), r.peer, duration(r.theirs), f"{r.ratio:.1f}", spread, aim


def print_table(title: str, head: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Any table, its columns aligned."""
    table = [tuple(head), *(tuple(row) for row in rows)]
    widths = [max(len(row[column]) for row in table) for column in range(len(head))]
    print(f"\n{title}")
    for row in table:
        print("  " + "   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())


def machine() -> list[str]:
    """Whose numbers these are: processor, system, versions, and the kernel that the linear algebra runs."""
    versions = ", ".join(f"{name} {_version(name)}" for name in PACKAGES)
    return [
        f"{_processor()}, {platform.system()} {platform.machine()}, Python {platform.python_version()}",
        versions,
        _linear_algebra(),
        f"processor time, one core, one thread, median of {REPEATS} samples after a warm-up, both sides in turn",
    ]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "is not installed"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"


def _linear_algebra() -> str:
    from threadpoolctl import threadpool_info

    found = [
        f"{entry['internal_api']} {entry['version']} {entry.get('architecture', '')} threads {entry['num_threads']}"
        for entry in threadpool_info()
    ]
    return "; ".join(found) or "no threaded linear algebra"


if __name__ == "__main__":
    print("\n".join(machine()))
