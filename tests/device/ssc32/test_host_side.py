"""The host's side: what it writes the board reads back, and answers are read whatever comes between them."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.ssc32.board_side import parse_line
from rvsim.device.ssc32.commands import (
    AppendStartup,
    Command,
    DeleteStartup,
    Move,
    Query,
    QueryMoving,
    QueryPulses,
    QueryVersion,
    ReadAnalog,
    ReadDigital,
    ReadRegister,
    RestoreRegisters,
    ServoMove,
    SetByte,
    SetLevels,
    SetOffsets,
    ShowStartup,
    Stop,
    WriteRegister,
)
from rvsim.device.ssc32.host_side import Reply, ReplyDecoder, encode
from rvsim.device.ssc32.lines import CR, LONGEST_LINE
from rvsim.device.ssc32.replies import MOST_STRAY
from rvsim.errors import SettingError

CHANNELS = st.integers(0, 31)
PULSES = st.just(0) | st.integers(500, 2500)
SERVOS = st.builds(ServoMove, CHANNELS, PULSES, st.none() | st.integers(1, 65535))


def _tuples(items: st.SearchStrategy[Any], most: int = 32) -> st.SearchStrategy[tuple[Any, ...]]:
    return st.lists(items, min_size=1, max_size=most).map(tuple)


QUERIES: st.SearchStrategy[Query] = st.one_of(
    st.just(QueryMoving()),
    st.builds(QueryPulses, _tuples(CHANNELS)),
    st.builds(ReadDigital, _tuples(st.tuples(st.integers(0, 5), st.booleans()), 8)),
    st.builds(ReadAnalog, _tuples(st.integers(0, 7), 8)),
    st.just(QueryVersion()),
    st.builds(ReadRegister, st.integers(0, 255)),
    st.just(RestoreRegisters()),
    st.just(ShowStartup()),
)
COMMANDS: st.SearchStrategy[Command] = st.one_of(
    st.builds(Move, _tuples(SERVOS), st.none() | st.integers(0, 65535)),
    st.builds(SetOffsets, _tuples(st.tuples(CHANNELS, st.integers(-100, 100)))),
    st.builds(SetLevels, _tuples(st.tuples(CHANNELS, st.booleans()))),
    st.builds(SetByte, st.integers(0, 3), st.integers(0, 255)),
    st.builds(Stop, CHANNELS),
    st.builds(WriteRegister, st.integers(0, 255), st.integers(-32768, 65535)),
    st.builds(AppendStartup, st.text(st.characters(min_codepoint=0x20, max_codepoint=0x7E), max_size=100)),
    st.builds(DeleteStartup, st.integers(0, 255)),
    QUERIES,
)


@given(COMMANDS)
def test_the_board_reads_back_what_the_host_writes(command: Command) -> None:
    line = encode(command)

    assert line.endswith(CR)
    assert line.count(CR) == 1
    assert len(line) <= LONGEST_LINE
    assert parse_line(line[:-1]) == command


@pytest.mark.parametrize(
    "command",
    [
        Move(()),
        Move((ServoMove(32, 1500),)),
        Move((ServoMove(5, 499),)),
        Move((ServoMove(5, 2501),)),
        Move((ServoMove(5, -1),)),
        Move((ServoMove(5, 1500, 0),)),
        Move((ServoMove(5, 1500),), 65536),
        SetOffsets(((5, 101),)),
        SetLevels(()),
        SetByte(4, 0),
        QueryPulses(()),
        ReadDigital(((6, False),)),
        ReadDigital(((0, False),) * 9),
        ReadAnalog((8,)),
        Stop(-1),
        WriteRegister(256, 0),
        AppendStartup("µ"),
        AppendStartup("Q\rSTOP5"),
        AppendStartup("x" * 101),
        DeleteStartup(256),
    ],
    ids=str,
)
def test_what_the_language_does_not_allow_is_refused_and_never_sent(command: Command) -> None:
    with pytest.raises(SettingError):
        encode(command)


@given(st.lists(QUERIES, max_size=5), st.binary(max_size=400), st.lists(st.integers(1, 50), max_size=10))
def test_answers_do_not_depend_on_the_chunks_they_come_in(queries: list[Query], data: bytes, sizes: list[int]) -> None:
    whole, pieces = ReplyDecoder(), ReplyDecoder()
    for query in queries:
        whole.expect(query)
        pieces.expect(query)

    replies: list[Reply] = []
    rest = data
    for size in [*sizes, len(data) + 1]:
        replies.extend(pieces.feed(rest[:size]))
        rest = rest[size:]

    assert whole.feed(data) == tuple(replies)
    assert [reply.query for reply in replies] == queries[: len(replies)]
    assert whole.pending == pieces.pending == len(queries) - len(replies)
    assert whole.take_stray() == pieces.take_stray()


STRAYS: dict[str, tuple[Query, bytes, tuple[object, ...], bytes]] = {
    "noise before Q's answer": (QueryMoving(), b"\xff\x00+", (True,), b"\xff\x00"),
    "an answer twice": (QueryMoving(), b"..", (False,), b"."),
    "Q's answer is no pulse": (QueryPulses((5,)), b".+\x96", ((1500,),), b".+"),
    "pulses that no servo has": (QueryPulses((5, 6)), b"\x0b\x96\x27\xfa", ((1500, 2500),), b"\x0b\x27"),
    "the offset of old firmware": (QueryPulses((5, 6)), b"\x28\x0a", ((400, 0),), b""),
    "half an answer": (QueryPulses((5, 6)), b"\x96", (), b""),
    "a text of another kind": (ReadRegister(4), b"SSC32-V2.04GP\r960\r", (960,), b"SSC32-V2.04GP\r"),
    "an empty version": (QueryVersion(), b"\rSSC32\r", ("SSC32",), b"\r"),
    "garbage within a version": (QueryVersion(), b"SS\x80C32\r", ("SSC32",), b"\x80"),
}


@pytest.mark.parametrize("name", STRAYS)
def test_bytes_that_cannot_be_the_answer_are_stray_and_the_query_stays_open(name: str) -> None:
    query, data, values, stray = STRAYS[name]
    decoder = ReplyDecoder()
    decoder.expect(query)

    assert tuple(reply.value for reply in decoder.feed(data)) == values
    assert decoder.take_stray() == stray
    assert decoder.pending == 1 - len(values)


def test_what_nobody_asked_for_is_stray_and_bounded() -> None:
    decoder = ReplyDecoder()

    assert decoder.feed(b"SSC32\r") == ()
    assert decoder.take_stray() == b"SSC32\r"
    decoder.feed(b"x" * 5000)
    assert decoder.take_stray() == b"x" * MOST_STRAY
    assert decoder.take_stray() == b""


def test_a_text_without_an_end_is_given_up() -> None:
    decoder = ReplyDecoder()
    decoder.expect(QueryVersion())

    assert decoder.feed(b"x" * 257 + b"SSC32\r") == (Reply(QueryVersion(), "SSC32"),)


def test_after_forgetting_the_next_answer_belongs_to_the_next_query() -> None:
    decoder = ReplyDecoder()
    decoder.expect(QueryPulses((0, 1)))
    decoder.feed(b"\x96")
    decoder.forget()
    decoder.expect(QueryMoving())

    assert decoder.feed(b"+") == (Reply(QueryMoving(), True),)
    assert decoder.take_stray() == b"\x96"
