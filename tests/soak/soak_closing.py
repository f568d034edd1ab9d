"""Close the window in the middle of each work there is: each action of the menus, each button of the pages.

    python tests/soak/soak_closing.py [--seed 0] [--only WORDS ...]

Laws: no exception in any thread; no warning from Qt; closing takes less than a second; nothing of it is seen any more,
no thread lives on, no half made file and no safety copy is left. tests/gui/test_closing.py does a few of them.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import random
import sys

from monkey_closing import Closing, all_works
from monkey_watch import Watch
from monkey_world import temporary_world

from rvsim.gui.app import make_application

DELAYS = 0.0, 0.05, 0.15, 0.4  # [s] from the work's begin to the end


def main() -> int:
    """All of them, each once."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="*", default=[""], help="works with one of these words in their names")
    options = parser.parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    faulthandler.enable()
    app = make_application(["rvsim-soak"])
    app.setQuitOnLastWindowClosed(False)
    took: list[tuple[float, str]] = []
    sound = True
    with temporary_world() as world:
        for work in [work for work in all_works() if any(words in work for words in options.only)]:
            world.dice = random.Random(f"{options.seed} {work}")
            with Watch() as watch:
                closing = Closing(work, world.dice.choice(DELAYS), world, watch)
                closing.run()
            took.append((closing.took, work))
            sound = sound and not watch.findings
            print(*watch.findings, sep="\n", end="\n" * bool(watch.findings), flush=True)
    longest, slowest = max(took)
    print(f"{len(took)} closings, the longest took {1e3 * longest:.0f} ms: {slowest}")
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
