"""What comes of a check, and how a check says that it cannot be made or that something is wrong."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Literal, NamedTuple

Verdict = Literal["ok", "skipped", "FAILED"]
Check = Callable[[], str]


class Outcome(NamedTuple):
    """What came of a check: `words` says what was found, why it was left out, or what is wrong."""

    check: str
    verdict: Verdict
    words: str
    seconds: float


class SkippedError(Exception):
    """This computer has not what the check needs; rvsim does without it."""


class WrongError(Exception):
    """A check has found something wrong, and says what."""


def expect(holds: object, otherwise: str) -> None:
    """Raise `WrongError` unless it holds; unlike an assertion, always."""
    if not holds:
        raise WrongError(otherwise)


def outcome_of(name: str, check: Check) -> Outcome:
    """Make a check, whatever happens."""
    began = time.perf_counter()
    verdict: Verdict = "ok"
    try:
        words = check()
    except SkippedError as reason:
        verdict, words = "skipped", str(reason)
    except WrongError as problem:
        verdict, words = "FAILED", str(problem)
    except Exception as problem:  # whatever it is: the other checks are made all the same
        verdict, words = "FAILED", f"{type(problem).__name__}: {problem}"
    return Outcome(name, verdict, words, time.perf_counter() - began)
