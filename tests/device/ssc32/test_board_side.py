"""The board's side: what real clients send, and what arbitrary bytes do to it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.ssc32.board_side import (
    BoardDecoder,
    Dropped,
    analog_reply,
    parse_line,
    pulses_reply,
    read_line,
    text_reply,
)
from rvsim.device.ssc32.commands import Command, Move, QueryMoving, QueryPulses, ServoMove, Stop
from rvsim.device.ssc32.host_side import encode
from rvsim.device.ssc32.lines import LONGEST_LINE

ZERO_WIDTH = "\u200b".encode()
FIVE = Move((ServoMove(5, 1500),))
ALL = Move(tuple(ServoMove(channel, 1500) for channel in range(32)), 100)
BOTH = Move((ServoMove(0, 1500), ServoMove(1, 1600)), 0)

# What is sent by programs in the field, and by people in a terminal.
ODDITIES: dict[str, tuple[bytes, tuple[Command, ...]]] = {
    "empty lines": (b"\r\r\r#5P1500\r\r", (FIVE,)),
    "CRLF": (b"#5P1500\r\nQ\r\n", (FIVE, QueryMoving())),
    "LF alone ends no line": (b"#5P1500\nQ\r", ()),
    "small letters": (
        b"#5p1500t700\rq\rqp5\rstop 5\r",
        (Move(FIVE.servos, 700), QueryMoving(), QueryPulses((5,)), Stop(5)),
    ),
    "blanks everywhere": (b"  \t # 5\tP 15 00 \r", (FIVE,)),
    "a lone #": (b"#\r#5P1500\r", (FIVE,)),
    "T0 after every servo": (b"#0P1500T0#1P1600T0\r", (BOTH,)),
    "T after every servo: the last counts": (b"#0P1500T900#1P1600T0\r", (BOTH,)),
    "unspaced queries": (b"QP0QP1\r", (QueryPulses((0, 1)),)),
    "ESC within a line": (b"#5P15\x1bQ\r", (QueryMoving(),)),
    "ESC instead of CR": (b"#5P1500\x1b#5P1500\r", (FIVE,)),
    "230 bytes for 32 servos": (b"".join(b"#%dP1500" % channel for channel in range(32)) + b"T100\r", (ALL,)),
    "decimals": (b"#5P1500.0\r#5P1500.99\r#5P1500.\r", (FIVE, FIVE, FIVE)),
    "decimals: the S behind them is ignored": (b"#5P1500.0S100.0T700\r", (Move(FIVE.servos, 700),)),
    "decimals of S and T": (b"#5P1500S100.5T700.9\r", (Move((ServoMove(5, 1500, 100),), 700),)),
    "channel 33": (b"#33P1500\r#32P1500\rQP32\rSTOP32\r", ()),
    "channel 33 among others: nothing moves": (b"#5P1500#33P1500T700\r", ()),
    "a zero-width letter": (b"#5" + ZERO_WIDTH + b"P15" + ZERO_WIDTH + b"00\r", (FIVE,)),
    "Q a thousand times": (b"Q\r" * 1000, (QueryMoving(),) * 1000),
    "T in the very first command": (b"#5P1500T700\r", (Move(FIVE.servos, 700),)),
    "leading zeros": (b"#05P01500\r", (FIVE,)),
    "S0 limits nothing": (b"#5P1500S0\r", (FIVE,)),
    "pulses that are too short": (b"#5P1\r#5P499\r", (Move((ServoMove(5, 500),)),) * 2),
    "pulses that are too long": (b"#5P2501\r#5P3000\r", (Move((ServoMove(5, 2500),)),) * 2),
    "pulses that are none": (b"#5P3001\r#5P-1500\r#5P\r#5\r#5P1e3\r", ()),
    "P0 is no short pulse": (b"#5P0\r", (Move((ServoMove(5, 0),)),)),
    "the longest time": (b"#5P1500T65535\r#5P1500T65536\r", (Move(FIVE.servos, 65535),)),
    "offsets beyond 100": (b"#5PO101\r#5PO-101\r", ()),
    "two kinds in a line": (b"#5P1500Q\r#5P1500#6H\rQQP5\r#5P1500VER\r", ()),
    "nine inputs": (b"ABCDEFABC\r", ()),
    "commands of the sequencer": (b"PL0 SQ5 SM50\rGOBOOT\rEER -0;1\r", ()),
    "a line that is too long": (b"#5P1500" * 200 + b"\r#5P1500\r", (FIVE,)),
    "a number that is too long": (b"#5P" + b"9" * 1000 + b"\r#5P1500\r", (FIVE,)),
    "a null byte": (b"\x00#5P1500\r", ()),
}


@pytest.mark.parametrize("name", ODDITIES)
def test_what_real_clients_send_is_survived_and_understood(name: str) -> None:
    sent, commands = ODDITIES[name]

    assert BoardDecoder().feed(sent) == commands


@pytest.mark.parametrize("name", ODDITIES)
def test_a_byte_at_a_time_means_the_same(name: str) -> None:
    sent, commands = ODDITIES[name]
    board = BoardDecoder()

    assert tuple(command for byte in sent for command in board.feed(bytes((byte,)))) == commands


# Bytes that make lines now and then, and any others.
STREAMS = st.lists(
    st.one_of(st.sampled_from([b"\r", b"\x1b", b"#", b"P", b"T", b"S", b"Q", b"QP", b"VER", b"STOP", b"5", b"1500"]))
    | st.binary(max_size=8)
    | st.sampled_from([b"x" * LONGEST_LINE, b"#5P1500T700\r"])
).map(b"".join)


@given(STREAMS, st.lists(st.integers(1, 2000), max_size=20))
def test_chunks_do_not_matter_and_the_buffer_stays_small(stream: bytes, sizes: list[int]) -> None:
    whole, board = BoardDecoder(), BoardDecoder()
    commands: list[Command] = []
    rest = stream
    for size in [*sizes, len(stream) + 1]:
        commands.extend(board.feed(rest[:size]))
        rest = rest[size:]
        assert board.waiting <= LONGEST_LINE + 1

    assert whole.feed(stream) == tuple(commands)
    assert whole.waiting == board.waiting


@given(STREAMS)
def test_any_bytes_are_a_command_or_nothing_and_a_command_says_itself_again(line: bytes) -> None:
    command = parse_line(line)

    assert command is None or parse_line(encode(command)[:-1]) == command


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"#33P1500", "the channel 33 is not in 0 to 31"),
        (b"#5P1500T70000", "the time [ms] 70000 is not in 0 to 65535"),
        (b"hello", "it is no line of this language, or mixes several kinds of commands"),
        (b"#" * (LONGEST_LINE + 1), "the line is longer than 1024 bytes"),
    ],
)
def test_why_a_line_is_dropped_can_be_said(line: bytes, reason: str) -> None:
    assert read_line(line) == Dropped(reason)
    assert parse_line(line) is None


def test_answers_are_held_within_their_bytes() -> None:
    assert pulses_reply((1509.9, math.nan, 0.0, -3.0, 9000.0)) == bytes((150, 0, 0, 0, 255))
    assert analog_reply((2.0, 3.5, 5.0, -1.0)) == bytes((102, 179, 255, 0))
    assert text_reply("µ") == b"?\r"
