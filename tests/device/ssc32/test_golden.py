"""Golden wire traces: what both sides say, byte for byte, is what stands in tests/device/golden.

The dialogues are the examples of Lynxmotion's manuals of the SSC-32 and SSC-32U, and how an AL5B is woken and stopped.
In a trace "→" is what the host sends, "←" what the board answers, and "=" another spelling of the line before it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rvsim.device.ssc32 import board_side
from rvsim.device.ssc32.board_side import BoardDecoder
from rvsim.device.ssc32.commands import (
    AppendStartup,
    Command,
    DeleteStartup,
    Move,
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
from rvsim.device.ssc32.host_side import ReplyDecoder, encode
from rvsim.device.ssc32.replies import Value
from rvsim.device.wire_log import printable

GOLDEN = Path(__file__).parents[1] / "golden"
Dialogue = list[tuple[Command, Value | None]]

DIALOGUES: dict[str, Dialogue] = {
    "moves": [
        (Move((ServoMove(5, 1500, 750),)), None),
        (Move((ServoMove(3, 1600),), 1000), None),
        (Move((ServoMove(5, 1600), ServoMove(10, 750)), 2500), None),
        (Move((ServoMove(5, 1600), ServoMove(17, 750, 500), ServoMove(2, 2250)), 2000), None),
        (QueryMoving(), True),
        (QueryMoving(), False),
        (QueryPulses((5,)), (1500,)),
        (QueryPulses((0, 1, 31)), (500, 0, 2500)),
        (Stop(0), None),
        (Stop(31), None),
        (Move((ServoMove(0, 0),)), None),
        (SetOffsets(((5, 1), (6, -20), (7, 100), (8, -100))), None),
    ],
    "pins": [
        (SetLevels(((3, True), (4, False))), None),
        (SetByte(3, 123), None),
        (ReadDigital(((0, False), (1, False), (2, False), (3, True))), (True, False, True, False)),
        (ReadAnalog((0, 1)), (102 * 5 / 256, 179 * 5 / 256)),
        (ReadAnalog(tuple(range(8))), tuple(byte * 5 / 256 for byte in (0, 1, 10, 13, 27, 128, 254, 255))),
    ],
    "registers": [
        (QueryVersion(), "SSC32-V2.04GP"),
        (WriteRegister(0, 1023), None),
        (ReadRegister(0), 1023),
        (WriteRegister(32, -50), None),
        (ReadRegister(32), -50),
        (RestoreRegisters(), "OK"),
        (AppendStartup("#0P1000#1P2000T3000;"), None),
        (AppendStartup("PL0 SQ5 SM50;"), None),
        (ShowStartup(), "#0P1000#1P2000T3000;PL0 SQ5 SM50;"),
        (DeleteStartup(5), None),
        (DeleteStartup(255), None),
        (ShowStartup(), ""),
    ],
    "al5b": [
        (QueryVersion(), "SSC32-V2.04GP"),
        (QueryMoving(), False),
        (QueryPulses(tuple(range(6))), (0,) * 6),
        *(((Move((ServoMove(channel, 1500),))), None) for channel in range(6)),
        (QueryPulses(tuple(range(6))), (1500,) * 6),
        (Move(tuple(ServoMove(c, p) for c, p in enumerate((1563, 1437, 1600, 1400, 1500, 1516))), 700), None),
        (QueryMoving(), True),
        (QueryPulses(tuple(range(6))), (1530, 1460, 1550, 1450, 1500, 1500)),
        *((Stop(channel), None) for channel in range(6)),
        (QueryMoving(), True),
    ],
}


def _answer(command: Command, value: Value) -> bytes:
    match command, value:
        case QueryMoving(), bool():
            return board_side.moving_reply(value)
        case QueryPulses(), tuple():
            return board_side.pulses_reply(value)
        case ReadDigital(), tuple():
            return board_side.digital_reply(bool(level) for level in value)
        case ReadAnalog(), tuple():
            return board_side.analog_reply(value)
        case ShowStartup(), str():
            return board_side.text_reply(f'"{value}"')
        case _:
            return board_side.text_reply(str(value))


def _trace(dialogue: Dialogue) -> Iterator[str]:
    for command, value in dialogue:
        yield f"→ {printable(encode(command))}"
        if value is not None:
            yield f"← {printable(_answer(command, value))}"


def _golden(name: str) -> list[tuple[str, bytes]]:
    lines = (GOLDEN / f"{name}.txt").read_text(encoding="utf-8").splitlines()
    return [(line[0], line[2:].encode("ascii").decode("unicode_escape").encode("latin-1")) for line in lines]


def _bytes(name: str, mark: str) -> bytes:
    return b"".join(data for found, data in _golden(name) if found == mark)


@pytest.mark.parametrize("name", DIALOGUES)
def test_both_sides_write_the_golden_bytes(name: str) -> None:
    assert "\n".join(_trace(DIALOGUES[name])) + "\n" == (GOLDEN / f"{name}.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", DIALOGUES)
def test_the_board_reads_the_golden_bytes(name: str) -> None:
    assert BoardDecoder().feed(_bytes(name, "→")) == tuple(command for command, _ in DIALOGUES[name])


@pytest.mark.parametrize("name", DIALOGUES)
def test_the_host_reads_the_golden_answers(name: str) -> None:
    asked = [(command, value) for command, value in DIALOGUES[name] if value is not None]
    decoder = ReplyDecoder()
    for query, _ in asked:
        decoder.expect(query)  # type: ignore[arg-type]  # only queries have answers

    replies = decoder.feed(_bytes(name, "←"))

    assert [(reply.query, reply.value) for reply in replies] == asked
    assert (decoder.pending, decoder.take_stray()) == (0, b"")


def test_lines_as_the_manuals_print_them_mean_the_same_as_ours() -> None:
    lines = _golden("as_printed")

    for (_, printed), (_, ours) in zip(lines[::2], lines[1::2], strict=True):
        (command,) = BoardDecoder().feed(printed)
        assert encode(command) == ours
