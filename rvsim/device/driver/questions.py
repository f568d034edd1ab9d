"""What the board owes us: one question at a time, patience, and silence before the next one."""

from __future__ import annotations

import math

# Boards answer within milliseconds, adapters within 20; a slow network or a sick board may need longer. Who has missed
# one answer is given less time for the next ones.
PATIENCE = (0.7, 0.25, 0.25)  # [s]
# An answer that comes twice, or late, must be over before the next question: answers carry no name.
QUIET, MOST_NOISE = 0.02, 0.3  # [s]; a line that is never quiet is asked nevertheless
OVERDUE = 0.15  # [s] a board that answers later may be starting again: nothing is sent to its servos meanwhile


class Questions:
    """Counts seconds; what is asked and what an answer looks like is the language's business."""

    def __init__(self) -> None:
        self._asked = self._arrived = self._heard = -math.inf
        self._open = False
        self.unanswered = 0
        self.latency = math.nan
        self.answered_at = -math.inf

    @property
    def asked_at(self) -> float:
        """When the last question was put on the wire [s]."""
        return self._asked

    @property
    def reached_at(self) -> float:
        """When the last question had arrived at the board [s]: that is the moment its answer is about."""
        return self._arrived

    @property
    def silent(self) -> bool:
        """Whether so many answers in a row are missing that nobody seems to be there."""
        return self.unanswered >= len(PATIENCE)

    def ask(self, now: float, arrives: float) -> None:
        """A question goes out; its last byte arrives at a time."""
        self._asked, self._arrived, self._open = now, arrives, True

    def hear(self, now: float) -> None:
        """Bytes came, whatever they are."""
        self._heard = now

    def answer(self, now: float) -> None:
        """The answer is whole."""
        self.latency = max(now - self._arrived, 0.0)
        self.unanswered, self._open, self.answered_at = 0, False, now

    def missed(self, now: float) -> bool:
        """Whether patience has ended just now."""
        patience = PATIENCE[min(self.unanswered, len(PATIENCE) - 1)]
        if not self._open or now <= self._arrived + patience:
            return False
        self._open = False
        self.unanswered += 1
        return True

    def drop(self) -> None:
        """The question was cut off on its way: nobody waits for its answer, and nobody is blamed."""
        self._open = False

    def overdue(self, now: float) -> bool:
        """Whether an answer should have come."""
        return self.unanswered > 0 or (self._open and now > self._arrived + OVERDUE)

    def may_ask(self, now: float, interval: float, quiet: bool) -> bool:
        """Whether it is time for the next question, so many seconds after the last one.

        Args:
            quiet: answers carry no name, so that the line must be silent first.
        """
        since = now - self._asked
        silent = not quiet or now >= self._heard + QUIET or since >= interval + MOST_NOISE
        return not self._open and since >= interval and silent
