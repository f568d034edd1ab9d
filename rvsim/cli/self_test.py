"""`rvsim self-test`: whether this copy of rvsim works on this computer."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from rvsim.cli.arguments import Command
from rvsim.cli.outcome import DONE, FAILED
from rvsim.cli.output import print_result

if TYPE_CHECKING:
    from rvsim.self_test import Outcome


def _add_options(parser: argparse.ArgumentParser) -> None:
    # How the test starts itself once more for a screen, and how a bundle's start is timed.
    parser.add_argument("--report", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--launched", type=float, help=argparse.SUPPRESS)


def _self_test(options: argparse.Namespace) -> int:
    from rvsim.self_test import check_screen, self_test, time_start

    if options.report is not None and options.launched is not None:
        return time_start(options.report, options.launched)
    if options.report is not None:
        return check_screen(options.report)
    outcomes = self_test((lambda _: None) if options.json else _print_line)
    failed = sum(outcome.verdict == "FAILED" for outcome in outcomes)
    record = {"passed": failed == 0, "checks": [outcome._asdict() for outcome in outcomes]}
    print_result(options, record, _summary(len(outcomes), failed, sum(outcome.seconds for outcome in outcomes)))
    return FAILED if failed else DONE


def _print_line(outcome: Outcome) -> None:
    print(f"{outcome.verdict:8}{outcome.check:30} {outcome.seconds:5.2f} s  {outcome.words}", flush=True)


def _summary(checks: int, failed: int, seconds: float) -> str:
    verdict = f"{failed} FAILED" if failed else "all is well"
    return f"{checks} checks in {seconds:.1f} s: {verdict}."


COMMANDS = (Command("self-test", _self_test, "check that this copy of rvsim works on this computer", _add_options),)
