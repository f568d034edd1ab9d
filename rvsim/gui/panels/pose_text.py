"""A whole pose in one line, as books and other programs print it: which text is one, and what its values are."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import zip_longest

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate_in

_LONGEST = 2000  # characters: no pose is longer, and a clipboard may hold a whole book
_BETWEEN = re.compile(r"\s*;\s*|,\s+|\s+")


def pose_values(text: str, units: Sequence[str]) -> tuple[float, ...]:
    """The two or more numbers of a text, each in the unit of its joint; none where it is not a list of numbers.

    They are separated by semicolons, blanks, tabs, or commas. A single comma between digits is a decimal comma: "60,5"
    is one number, "1,5; 2,5" are two.
    """
    if len(text) > _LONGEST:
        return ()
    bare = text.strip().strip("()[]{}").strip()
    spaced = _BETWEEN.split(bare)
    parts = bare.split(",") if len(spaced) == 1 and bare.count(",") > 1 else spaced
    if len(parts) < 2:
        return ()
    try:
        return tuple(evaluate_in(unit, part) for part, unit in zip_longest(parts, units[: len(parts)], fillvalue=""))
    except ExpressionError:
        return ()
