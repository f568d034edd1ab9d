"""Let a monkey loose in the real window, off-screen: clicks, keys, drags, junk in each box, faults, a full disk.

    python tests/soak/soak_window.py [--events 50000] [--life 20000] [--seed 0] [--switches 1000] [--pairs 1]
                                      [--language ar]
    python tests/soak/soak_window.py --replay JOURNAL --seed SEED

Laws: no exception in any thread; no warning from Qt; the event loop comes round within a second of computing; memory
and the number of objects stay; a window that is closed in the middle of its work leaves no thread. A life is one
window; its seed alone says what is done to it. On a finding it prints the seed, the last deeds and where it was, names
the journal for --replay, and leaves with 1. tests/gui/test_monkey.py runs a slice.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from monkey import Journal, Life, read_journal
from monkey_sight import Deed
from monkey_watch import Size, Watch, size_of
from monkey_world import World, temporary_world
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication

from rvsim.cli.window import leave
from rvsim.gui.app import make_application
from rvsim.gui.languages import wear_language
from rvsim.gui.preferences import Preferences
from rvsim.language import LANGUAGES

# Pictures of texts and formulas are kept up to a number, which is reached after some 8,000 events.
WARM = 7500  # events, before which a life's size does not count
GROWTH_MB = 100.0  # that a life may grow by after them
MEASURED = 2500  # events from one measuring to the next
SWITCHES_MB = 50.0  # that a thousand robot switches may grow by after the first fifth
OBJECTS, WINDOWS = 1.05, 1.6  # times as many, at most; menus are windows too, and a dialog may bring fifty


class Ledger:
    """What all lives came to."""

    def __init__(self) -> None:
        self.events = 0
        self.counts: Counter[str] = Counter()
        self.slowest: list[float] = []

    def add(self, life: Life, watch: Watch) -> None:
        """One life more."""
        self.events += life.done
        self.counts += life.journal.counts
        print(f"seed {life.seed}: {life.done} events", *(f"{at}: {size}" for at, size in life.sizes), sep="; ")
        for name, share in (("p50", 0.5), ("p99", 0.99), ("slowest", 1.0)):
            turn = watch.percentile(share)
            print(f"    {name} turn: {1e3 * turn.thread:.0f} ms of computing, {1e3 * turn.wall:.0f} ms by the clock")
        sys.stdout.flush()


def judge_growth(sizes: list[Size], megabytes: float, watch: Watch) -> None:
    """Flat within the bounds from the first size to the last."""
    if len(sizes) < 2:
        return
    first, last = sizes[0], sizes[-1]
    if last.megabytes - first.megabytes > megabytes:
        watch.find(f"memory grew: {'; '.join(map(str, sizes))}")
    # Menus and lists that are built for a while come and go: what piles up, stays in all later sizes.
    objects, windows = min(size.objects for size in sizes[1:]), min(size.windows for size in sizes[1:])
    if objects > OBJECTS * first.objects + 50 or windows > WINDOWS * first.windows:
        watch.find(f"objects pile up: {'; '.join(map(str, sizes))}")


def told(watch: Watch, journal: Journal, seed: int, where: Path) -> bool:
    """Print what was found, if anything."""
    for finding in watch.findings:
        print(f"\n=== seed {seed} ===\n{finding}")
    if watch.findings:
        print("The last deeds:", *journal.last, sep="\n  ")
        print(f"Again: --seed {seed}, or --replay {where} --seed {seed}", flush=True)
    return bool(watch.findings)


def one_life(seed: int, options: argparse.Namespace, ledger: Ledger, deeds: tuple[Deed, ...] = ()) -> bool:
    """Whether a window lived and died in peace."""
    options.journals.mkdir(parents=True, exist_ok=True)
    where = options.journals / f"rvsim-monkey-{seed}.jsonl"
    with temporary_world() as world, Watch() as watch, open(where, "w", encoding="utf-8") as file:
        life = Life(seed, len(deeds) or options.life, world, watch, Journal(file), deeds, MEASURED)
        life.live()
        judge_growth([size for at, size in life.sizes if at >= WARM], GROWTH_MB, watch)
    ledger.add(life, watch)
    return not told(watch, life.journal, seed, where)


def switches(count: int, seed: int) -> bool:
    """Whether that many robot switches leave the window as large as it was."""
    dice, sizes, names = random.Random(seed), list[Size](), Counter[str]()
    with temporary_world() as world, Watch() as watch:
        life = Life(seed, 0, world, watch, Journal())
        life.window.show()
        for number in range(1, count + 1):
            if watch.findings:
                break
            _switch(life, dice, names)
            watch.turn(0.0, f"robot switch {number} to {life.window.session.robot.name}")
            if number % (count // 5) == 0:
                life.window.session.undo_stack.clear()
                sizes.append(size_of(life.window))
                watch.rest()
        judge_growth(sizes, SWITCHES_MB, watch)
        life.die()
    print(f"{sum(names.values())} robot switches: {dict(names)}")
    print(*sizes, f"slowest turn {1e3 * watch.percentile(1.0).thread:.0f} ms", sep="\n    ", flush=True)
    return not told(watch, life.journal, seed, Path("none"))


def _switch(life: Life, dice: random.Random, names: Counter[str]) -> None:
    window = life.window
    if dice.random() < 0.2:
        life.do(life.choices.named("page"))
    if dice.random() < 0.1:
        dice.choice((window.tracker.track_line, window.tracker.track_trajectory))()
    life.do(life.choices.named("robot"))
    names[window.session.robot.name] += 1
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()


def pair(seed: int, options: argparse.Namespace) -> bool:
    """Whether two programs at once, with the same settings and user's folder, live in peace."""
    with tempfile.TemporaryDirectory(prefix="rvsim-pair-", ignore_cleanup_errors=True) as folder:
        command = [sys.executable, __file__, "--together", folder, "--life", str(options.life)]
        both = [subprocess.Popen([*command, "--seed", str(number)]) for number in (seed, seed + 1)]
        return max([process.wait() for process in both]) == 0


def together(folder: Path, options: argparse.Namespace, ledger: Ledger) -> bool:
    """One of the two."""
    where = folder / f"journal-{options.seed}.jsonl"
    preferences = Preferences(folder / "settings.ini")
    with World(folder) as world, Watch() as watch, open(where, "w", encoding="utf-8") as file:
        life = Life(options.seed, options.life, world, watch, Journal(file), preferences=preferences)
        life.live()
    ledger.add(life, watch)
    return not told(watch, life.journal, options.seed, where)


def main() -> int:
    """Lives, robot switches, and two programs at once."""
    options = _options()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    faulthandler.enable()
    app = make_application(["rvsim-soak"])
    app.setQuitOnLastWindowClosed(False)
    wear_language(app, options.language)
    ledger, began = Ledger(), time.perf_counter()
    if options.together:
        return 0 if together(options.together, options, ledger) else 1
    if options.replay:
        deeds = tuple(read_journal(options.replay.read_text(encoding="utf-8").splitlines()))
        return 0 if one_life(options.seed, options, ledger, deeds) else 1
    sound: list[bool] = []
    while ledger.events < options.events:
        sound.append(one_life(options.seed + len(sound), options, ledger))
    sound += [pair(options.seed + 1000 * number, options) for number in range(1, options.pairs + 1)]
    sound += [switches(options.switches, options.seed)] if options.switches else []
    print(f"{ledger.events} events in {time.perf_counter() - began:.0f} s:", dict(ledger.counts.most_common()))
    print(f"{sound.count(False)} of {len(sound)} runs found something")
    return 0 if all(sound) else 1


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--events", type=int, default=50_000)
    parser.add_argument("--life", type=int, default=20_000, help="events in one window")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--switches", type=int, default=1000, help="robot switches")
    parser.add_argument("--pairs", type=int, default=1, help="how often two programs at once are tried")
    parser.add_argument("--language", choices=tuple(LANGUAGES), default="en", help="in which each window begins")
    parser.add_argument("--replay", type=Path, help="a journal, whose deeds are done again")
    parser.add_argument("--together", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--journals", type=Path, default=Path(tempfile.gettempdir()))
    return parser.parse_args()


if __name__ == "__main__":
    leave(main())  # as the program does
