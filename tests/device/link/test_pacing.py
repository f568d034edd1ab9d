"""Bytes take ten bits each, both ways; however time is cut into pieces, the same arrives at the same time."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.link.line import Receiver, bit_time
from rvsim.device.link.pacing import PacedArm
from rvsim.device.virtual.clock import NANO
from rvsim.errors import SettingError

SIX_SERVOS = b"#0P1500#1P1500#2P1500#3P1500#4P1500#5P1500T20\r"


class EchoArm:
    """Answers a line with itself; knows to the nanosecond when what arrived."""

    def __init__(self) -> None:
        self.now, self.heard, self.line, self.answer = 0, [(0, b"")][:0], b"", b""

    def write(self, data: bytes) -> None:
        self.heard.append((self.now, data))
        self.line += data
        if data.endswith(b"\r"):
            self.answer, self.line = self.answer + self.line, b""

    def process(self, dt: float) -> None:
        self.now += round(dt * NANO)

    def read(self) -> bytes:
        answer, self.answer = self.answer, b""
        return answer

    @property
    def text(self) -> bytes:
        return b"".join(data for _, data in self.heard)


@pytest.mark.parametrize("baud", [2400, 9600, 38400, 115200])
def test_a_byte_takes_ten_bits(baud: int) -> None:
    wire = PacedArm(arm := EchoArm(), baud)
    wire.send(SIX_SERVOS)
    wire.process(1.0)
    byte = round(10 * NANO / baud)
    assert arm.heard == [((index + 1) * byte, bytes((value,))) for index, value in enumerate(SIX_SERVOS)]


def test_a_line_for_six_servos_at_9600_baud_takes_48_ms_and_its_answer_as_long_again() -> None:
    wire = PacedArm(arm := EchoArm(), 9600)
    wire.send(SIX_SERVOS)
    wire.process(0.0480)
    assert wire.out_waiting == 0
    assert arm.text == SIX_SERVOS
    wire.process(0.0470)
    assert wire.in_waiting == len(SIX_SERVOS) - 1
    wire.process(0.0030)
    assert wire.receive(5) + wire.receive() == SIX_SERVOS


cuts = st.lists(st.floats(0.0, 0.3), min_size=1, max_size=8)
rates = st.sampled_from([2400, 9600, 38400, 115200])


@given(
    lines=st.lists(st.tuples(st.integers(0, 40), st.binary(max_size=30)), max_size=5),
    cuts=cuts,
    rates=st.tuples(rates, rates),
)
def test_time_in_pieces_is_the_same_time(
    lines: list[tuple[int, bytes]], cuts: list[float], rates: tuple[int, int]
) -> None:
    def run(pieces: list[float]) -> tuple[list[tuple[int, bytes]], bytes]:
        wire = PacedArm(arm := EchoArm(), rates[0], board_baud=rates[1])
        for wait, line in lines:
            wire.process(wait / 4)
            wire.send(line + b"\r")
            for piece in pieces:
                wire.process(piece)
        return arm.heard, wire.receive()

    nanos = [round(cut * NANO) / NANO for cut in cuts]
    assert run(nanos) == run([round(sum(cut * NANO for cut in nanos)) / NANO])


def test_what_is_cancelled_does_not_arrive_but_for_the_byte_under_way() -> None:
    wire = PacedArm(arm := EchoArm(), 9600)
    wire.send(SIX_SERVOS)
    wire.process(0.0105)
    wire.cancel_output()
    wire.send(b"STOP0\r")
    wire.process(0.1)
    assert arm.text == SIX_SERVOS[:11] + b"STOP0\r"


def test_at_another_rate_than_the_boards_both_hear_garbage_until_the_rates_match() -> None:
    wire = PacedArm(arm := EchoArm(), 115200, board_baud=9600)
    assert not wire.matches
    for _ in range(4):
        wire.send(SIX_SERVOS)
        wire.process(0.2)
    assert arm.text
    assert b"#" not in arm.text
    arm.write(b"VER\r")
    wire.process(0.2)
    assert wire.receive() not in (b"", b"VER\r")
    wire.baud = 9600
    arm.line = b""
    wire.send(b"Q\r")
    wire.process(0.2)
    assert wire.receive() == b"Q\r"


def test_the_board_goes_with_our_rate_where_none_is_its_own() -> None:
    wire = PacedArm(EchoArm(), 9600)
    wire.baud = 38400
    wire.send(b"Q\r")
    wire.process(0.2)
    assert wire.matches
    assert wire.receive() == b"Q\r"


@given(data=st.binary(min_size=1, max_size=40), off=st.floats(0.97, 1.03), gap=st.integers(0, 3))
def test_a_receiver_within_three_percent_hears_what_was_sent(data: bytes, off: float, gap: int) -> None:
    bit = bit_time(9600)
    receiver = Receiver(bit, bit * off)
    for index, byte in enumerate(data):
        receiver.see(round(index * (10 + gap) * bit), byte)
    assert receiver.heard(NANO) == data


def test_a_rate_must_be_a_rate() -> None:
    with pytest.raises(SettingError, match="baud must be 1 or more"):
        PacedArm(EchoArm(), 0)
