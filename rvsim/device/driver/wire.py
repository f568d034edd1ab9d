"""A language on a slow wire: one line after the other, one question at a time, and what is urgent before all."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Literal, TypeAlias

from rvsim.device.driver.language import ArmLanguage, Event
from rvsim.device.driver.outbox import Outbox
from rvsim.device.driver.questions import Questions

Log: TypeAlias = Callable[[float, Literal["→", "←"], bytes], None]
_LONGEST_ANSWER = 256  # bytes that are put together for the log


def no_log(_time: float, _direction: Literal["→", "←"], _data: bytes) -> None:
    """For those who keep none."""


class Wire:
    """Times are those that it is told.

    Args:
        language: what is spoken.
        baud: [bit/s].
        log: told of whole lines when they have been handed out, of pieces that were cut, and of answers.
    """

    def __init__(self, language: ArmLanguage, baud: int, log: Log = no_log) -> None:
        self.language, self._log = language, log
        self._said, self._heard = bytearray(), bytearray()
        self.now = 0.0
        self._outbox, self._baud = Outbox(baud), baud
        self.questions = Questions()
        self._urgent = b""
        self._rest: deque[bytes] = deque()
        self.received = 0
        self.cut_until = 0.0

    @property
    def sent(self) -> int:
        """Bytes so far."""
        return self._outbox.sent

    def seconds(self, count: int) -> float:
        """How long so many bytes take [s]."""
        return self._outbox.seconds(count)

    def hear(self, now: float, received: bytes) -> tuple[Event, ...]:
        """Time passes, and the board says something."""
        self.now = max(now, self.now)
        if not received:
            return ()
        self.received += len(received)
        self.questions.hear(self.now)
        owed = self.language.pending
        events = self.language.feed(received)
        self._heard += received
        if owed and not self.language.pending:
            self.questions.answer(self.now)
        if not self.language.pending or len(self._heard) > _LONGEST_ANSWER:
            self._log_heard()
        return events

    def missed(self) -> bool:
        """Whether an answer has just been given up."""
        if not self.questions.missed(self.now):
            return False
        self.language.forget()
        self._log_heard()
        return True

    @property
    def free(self) -> bool:
        """Whether the next line may be said."""
        return not self._urgent and self._outbox.free(self.now)

    def say(self, line: bytes) -> float:
        """A line, and when it will have arrived [s]."""
        self._outbox.put(line, self.now)
        return self._outbox.until

    def say_rest(self) -> bool:
        """The next of the lines that follow something urgent; whether there was one."""
        if self._rest:
            self.cut_until = self.say(self._rest.popleft())
            return True
        return False

    def ask(self, line: bytes) -> None:
        """A question."""
        self.questions.ask(self.now, self.say(line))

    def follow(self, line: bytes) -> None:
        """A line that goes before all others but what is urgent; may be empty."""
        if line:
            self._rest.append(line)

    def ignore(self) -> None:
        """What was asked is not awaited any more."""
        self.language.forget()
        self.questions.drop()
        self._log_heard()

    def cut(self, lines: tuple[bytes, ...]) -> None:
        """Throw away what waits; the first line is urgent, the others follow. What was asked is not awaited."""
        self._outbox.clear(self.now)
        self._log_said()
        self.ignore()
        self._urgent, self._rest = lines[0], deque(lines[1:])
        self.cut_until = self.now + self.seconds(sum(map(len, lines)))

    def urgent(self) -> bytes | None:
        """What is to be written at once, after all that waits in the system's buffers has been thrown away."""
        if not self._urgent:
            return None
        self._outbox.put(self._urgent, self.now)
        self._urgent = b""
        self._said += (piece := self._outbox.take_all(self.now))
        self._log_said()
        return piece

    @property
    def has_urgent(self) -> bool:
        """Whether `urgent` has something."""
        return bool(self._urgent)

    def take(self) -> bytes:
        """What to write now."""
        self._said += (piece := self._outbox.take(self.now))
        if self._outbox.empty:
            self._log_said()
        return piece

    def _log_said(self) -> None:
        for line in self.language.lines(bytes(self._said)):
            self._log(self.now, "→", line)
        self._said.clear()

    def _log_heard(self) -> None:
        if self._heard:
            self._log(self.now, "←", bytes(self._heard))
        self._heard.clear()
