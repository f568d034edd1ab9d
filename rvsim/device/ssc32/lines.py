"""Cutting a stream of bytes into lines. Only CR ends a line, ESC throws away what precedes it in its line."""

from __future__ import annotations

CR = b"\r"
ESC = b"\x1b"
LONGEST_LINE = 1024  # bytes without the CR; 32 servos with speeds and a time need 470


def next_line(buffer: bytes) -> tuple[int, bytes | None]:
    """Bytes to consume off the buffer's front, and the line that they held, without its CR.

    (0, None) means: feed me more. A positive count with None means that these bytes came to nothing (an ESC discarded
    them, or their line is too long): consume them and ask again.

    Nothing but the buffer is remembered: of a line that is too long enough is left to stay too long until its CR.
    """
    end = buffer.find(CR)
    if end < 0:
        return _unfinished(buffer), None
    line = buffer[buffer.rfind(ESC, 0, end) + 1 : end]
    return end + 1, line if len(line) <= LONGEST_LINE else None


def _unfinished(buffer: bytes) -> int:
    """How many bytes of a line without an end are of no use any more."""
    return max(buffer.rfind(ESC) + 1, len(buffer) - LONGEST_LINE - 1, 0)
