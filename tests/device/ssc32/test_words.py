"""What goes over the wire, in words that say what the arm will do."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.ssc32.commands import (
    Query,
    QueryMoving,
    QueryPulses,
    QueryVersion,
    ReadAnalog,
    ReadDigital,
    ReadRegister,
    RestoreRegisters,
    ShowStartup,
)
from rvsim.device.ssc32.words import reply_in_words, sent_in_words

NAMES = {1: "shoulder", 2: "elbow"}

SENT = {
    b"#1P1500#2P1600T700\r": "shoulder to 1500 µs and elbow to 1600 µs, together in 700 ms",
    b"#1P1500T700\r": "shoulder to 1500 µs in 700 ms",
    b"#1P1500\r": "shoulder to 1500 µs at full speed",
    b"#1P1500T0\r": "shoulder to 1500 µs at full speed",
    b"#1P1500S500\r": "shoulder to 1500 µs at no more than 500 µs/s",
    b"#1P1500S500#2P1600T2000\r": "shoulder to 1500 µs at no more than 500 µs/s and elbow to 1600 µs, "
    "together in at least 2000 ms",
    b"#1P1500#2P1600#5P0\r": "shoulder to 1500 µs, elbow to 1600 µs and servo 5 off (limp), together at full speed",
    b"#1P0\r": "shoulder off (limp)",
    b"#1P300T700\r": "shoulder to 500 µs in 700 ms",
    b"#1PO-20\r": "shift all pulses of shoulder by -20 µs, until the power goes",
    b"#3H#4L\r": "pin 3 high (5 V) and pin 4 low (0 V)",
    b"#3:123\r": "pins 24 to 31 to the bits of 123 (01111011, the last is pin 24)",
    b"Q\r": "is any move still under way?",
    b"QP1QP9\r": "which pulse does the board send to shoulder and servo 9?",
    b"ABCL\r": "is A, B and C high or low? (C: or has been low since the last time)",
    b"VAVB\r": "what is the voltage of A and B?",
    b"VER\r": "what are you? (the board and its version)",
    b"R4\r": "what is in register 4?",
    b"R4=960\r": "register 4 becomes 960 when the power comes again",
    b"RDFLT\r": "all registers as they left the factory",
    b"SS\r": "what is the startup text?",
    b"SSCAT Q;\r": "add “Q;” to the startup text",
    b"SSDEL 3\r": "delete the last 3 characters of the startup text",
    b"STOP1\rSTOP2\r": "shoulder stops where it is; elbow stops where it is",
    b"\r": "an empty line: nothing happens",
    b"#1P15\x1b": "ESC: the unfinished line is discarded, what moves goes on",
    b"#1P15\x1bQ\r": "is any move still under way?",
    b"#33P1500\r": "the board drops this line: the channel 33 is not in 0 to 31",
    b"hello\r": "the board drops this line: it is no line of this language, or mixes several kinds of commands",
}


@pytest.mark.parametrize("line", SENT, ids=repr)
def test_a_line_says_what_the_board_makes_of_it(line: bytes) -> None:
    assert sent_in_words(line, NAMES) == SENT[line]


ANSWERS: list[tuple[Query | None, bytes, str]] = [
    (QueryMoving(), b"+", "a move is still under way"),
    (QueryMoving(), b".", "all moves are finished"),
    (QueryMoving(), b".x", "all moves are finished; besides, bytes that nobody asked for"),
    (QueryMoving(), b"x", "no whole answer to what had been asked"),
    (
        QueryPulses((1, 9)),
        b"\x96\x00",
        "the board sends to shoulder 1500 µs and servo 9 no pulse (commanded, not measured)",
    ),
    (ReadDigital(((0, False), (1, True))), b"10", "A high and B low, or has been"),
    (ReadDigital(((0, False), (1, True))), b"01", "A low and B always high since the last time"),
    (ReadAnalog((0,)), b"\x80", "A 2.50 V"),
    (QueryVersion(), b"SSC32-V2.04GP\r", "the board calls itself SSC32-V2.04GP"),
    (ReadRegister(4), b"960\r", "register 4 holds 960"),
    (RestoreRegisters(), b"OK\r", "the registers are as they left the factory"),
    (ShowStartup(), b'"Q;"\r', "the startup text is “Q;”"),
    (ShowStartup(), b'""\r', "there is no startup text"),
    (None, b"+", "nothing had been asked"),
]


@pytest.mark.parametrize(("query", "data", "words"), ANSWERS, ids=lambda value: repr(value)[:40])
def test_an_answer_says_what_it_answers(query: Query | None, data: bytes, words: str) -> None:
    assert reply_in_words(query, data, NAMES) == words


@given(st.binary(max_size=300), st.sampled_from([query for query, _, _ in ANSWERS]))
def test_any_bytes_have_words(data: bytes, query: Query | None) -> None:
    assert sent_in_words(data)
    assert reply_in_words(query, data)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (b"#1P1500T700\r", "wakes the shoulder: it jumps to 1500 µs, T is ignored"),
        (b"#1P1500\r", "wakes the shoulder: it jumps to 1500 µs"),
        (b"#1P1500#7P1600S100T700\r", "wakes the shoulder and servo 7: they jump to 1500 and 1600 µs, "
        "T and S are ignored"),
        (b"#1P1500#2P1600T700\r", "wakes the shoulder: it jumps to 1500 µs, T is ignored; elbow to 1600 µs in 700 ms"),
        (b"#1P0\r", "shoulder off (limp)"),
    ],
)  # fmt: skip
def test_the_first_move_of_a_channel_is_a_jump(line: bytes, words: str) -> None:
    assert sent_in_words(line, NAMES, {1, 7}) == words
