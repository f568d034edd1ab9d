"""The specification in resources/help is true: its example is what the board does, its tables are the codec's."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
import pytest

from rvsim.device.bridge.board import BridgeBoard
from rvsim.device.bridge.frames import Problem
from rvsim.device.bridge.messages import Status
from rvsim.device.bridge.words import PROBLEM_WORDS, frame_in_words
from rvsim.files import load_robot
from rvsim.resources import resource

TEXT = resource("help", "encoder-bridge.md").read_text(encoding="utf-8")


class Row(NamedTuple):
    ms: int
    sender: str
    data: bytes
    words: str


ROWS = [
    Row(int(ms), sender, bytes.fromhex(data), words)
    for ms, sender, data, words in re.findall(r"^\| (\d+) \| (host|board) \| `([0-9A-F ]+)` \| (.+) \|$", TEXT, re.M)
]


def test_the_example_is_answered_byte_for_byte() -> None:
    robot = load_robot("al5b")
    measured = np.radians([0.0, 80.5, -90.0, 0.0, -1.25])
    board = BridgeBoard(robot, robot.servos, robot.gripper_servo, lambda: measured)
    now = 0
    for asked, answered in zip(ROWS[::2], ROWS[1::2], strict=True):
        assert (asked.sender, answered.sender, asked.ms) == ("host", "board", answered.ms)
        board.process((asked.ms - now) / 1e3)
        now = asked.ms
        board.write(asked.data)
        assert board.read().hex(" ") == answered.data.hex(" "), asked.words


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.ms} {row.sender}")
def test_the_example_says_what_the_words_say(row: Row) -> None:
    assert frame_in_words(row.data, load_robot("al5b")) == row.words


def test_the_example_shows_an_escaped_byte_and_the_errors_that_matter() -> None:
    assert any(b"\x7d\x5e" in row.data for row in ROWS)
    for problem in (Problem.CRC, Problem.SEQUENCE, Problem.ASLEEP, Problem.STOPPED):
        assert any(PROBLEM_WORDS[problem] in row.words for row in ROWS)


def test_every_problem_and_every_bit_of_the_status_is_listed() -> None:
    for problem in Problem:
        assert re.search(rf"^\| {problem.value} \| ", TEXT, re.M)
    for bit, name in enumerate(Status._fields):
        assert f"| {bit} | {name} | " in TEXT
