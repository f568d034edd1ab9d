"""How buttons are shared out among rows, so that every word is whole."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, pairwise


def rows_of(widths: Sequence[int], gap: int, room: int) -> tuple[int, ...]:
    """How many of them stand in each row: as few rows as fit, and these filled alike, the first ones rather more.

    Args:
        widths: what each needs [pixels]; a handful, for all ways of sharing are tried.
        gap: between two in a row [pixels].
        room: how wide a row may be [pixels]; what is wider alone gets a row of its own.
    """
    for rows in range(1, len(widths)):
        splits = [list(pairwise((0, *cuts, len(widths)))) for cuts in combinations(range(1, len(widths)), rows - 1)]
        fitting = [
            [end - begin for begin, end in split]
            for split in splits
            if all(sum(widths[begin:end]) + gap * (end - begin - 1) <= room for begin, end in split)
        ]
        if fitting:
            return tuple(min(fitting, key=lambda counts: (max(counts) - min(counts), [-count for count in counts])))
    return (1,) * len(widths)
