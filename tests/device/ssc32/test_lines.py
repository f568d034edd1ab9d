"""Lines: only CR ends one, ESC discards what precedes it, and whatever comes the buffer stays small."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.ssc32.lines import LONGEST_LINE, next_line


@pytest.mark.parametrize(
    ("buffer", "expected"),
    [
        (b"", (0, None)),
        (b"#5P1500", (0, None)),
        (b"#5P1500\rQ\r", (8, b"#5P1500")),
        (b"\r", (1, b"")),
        (b"\nQ\r", (3, b"\nQ")),
        (b"#5P15\x1bQ\r", (8, b"Q")),
        (b"#5P15\x1b", (6, None)),
        (b"\x1b\x1bQ", (2, None)),
        (b"x" * LONGEST_LINE + b"\r", (LONGEST_LINE + 1, b"x" * LONGEST_LINE)),
        (b"x" * (LONGEST_LINE + 1) + b"\r", (LONGEST_LINE + 2, None)),
        (b"x" * (LONGEST_LINE + 10), (9, None)),
    ],
)
def test_a_line_ends_at_cr_and_nowhere_else(buffer: bytes, expected: tuple[int, bytes | None]) -> None:
    assert next_line(buffer) == expected


@given(st.binary(max_size=40), st.binary(max_size=40))
def test_esc_in_a_line_leaves_only_what_follows_it(before: bytes, after: bytes) -> None:
    before, after = before.replace(b"\r", b""), after.replace(b"\r", b"").replace(b"\x1b", b"")

    assert next_line(before + b"\x1b" + after + b"\r") == (len(before) + len(after) + 2, after)
