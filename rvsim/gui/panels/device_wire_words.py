"""What a line of the wire says, in words, with the joints' own names."""

from __future__ import annotations

import math
from collections.abc import Callable

from rvsim.device.bridge.words import frame_in_words
from rvsim.device.ssc32.board_side import parse_line
from rvsim.device.ssc32.commands import Query
from rvsim.device.ssc32.words import reply_in_words, sent_in_words
from rvsim.device.words import with_capital
from rvsim.gui.panels.device_wire_lines import Language, Line
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

_MOST_KEPT = 20_000  # texts; the same questions and answers come again and again
_QUESTION_MARKS = "?؟"
_CUT = tr_later("Cut off before its end: the controller does nothing with it.")

Key = tuple[str, bytes, bytes | None, bool, frozenset[int]]


class Words:
    """Says lines in words, and remembers what it has said."""

    def __init__(self, language: Language, robot: Robot) -> None:
        self.language: Language = language
        self.robot, self.names = robot, channel_names(robot)
        self._kept: dict[Key, str] = {}

    def of(self, line: Line) -> str:
        """One sentence, perhaps a long one."""
        key = (line.entry.direction, line.entry.data, line.question, line.whole, line.wakes)
        if key not in self._kept:
            if len(self._kept) >= _MOST_KEPT:
                self._kept.clear()
            self._kept[key] = _SAYERS[self.language](self, line)
        return self._kept[key]

    def told(self, line: Line) -> str:
        """The same, with how long an answer took."""
        if math.isnan(line.latency):
            return self.of(line)
        return f"{self.of(line)} " + tr("Answered after {time}.", time=milliseconds(line.latency))


def channel_names(robot: Robot) -> dict[int, str]:
    """The joints' names by channel, and the gripper's."""
    names = {servo.channel: joint.name for servo, joint in zip(robot.servos, robot.joints, strict=False)}
    if robot.gripper_servo is not None:
        names[robot.gripper_servo.channel] = "gripper"
    return names


def milliseconds(seconds: float) -> str:
    """Whole ones; number and unit stay together."""
    return f"{seconds * 1e3:.0f}\u00a0ms"


def sentence(text: str) -> str:
    """With a capital at its beginning and a stop at its end, unless it asks."""
    asks = any(mark in text for mark in _QUESTION_MARKS)
    return with_capital(text if text.endswith(".") or asks else f"{text}.")


def what_it_would_do(typed: str, robot: Robot) -> str:
    """What an SSC-32 would make of a typed line; `\\r` and `\\x1b` in it, as the log shows them, are CR and ESC."""
    plain = typed.replace(r"\r", "\r").replace(r"\x1b", "\x1b")
    return sentence(sent_in_words(plain.encode("utf-8", "replace"), channel_names(robot)))


def _ssc32(words: Words, line: Line) -> str:
    data, question = line.entry.data, line.question
    if line.sent:
        return sentence(sent_in_words(data, words.names, line.wakes)) if line.whole else tr(_CUT)
    query = parse_line(question.removesuffix(b"\r").rpartition(b"\x1b")[2]) if question else None
    return sentence(reply_in_words(query if isinstance(query, Query) else None, data, words.names))


def _bridge(words: Words, line: Line) -> str:
    return sentence(frame_in_words(line.entry.data, words.robot))


_SAYERS: dict[Language, Callable[[Words, Line], str]] = {"ssc32": _ssc32, "bridge": _bridge}
