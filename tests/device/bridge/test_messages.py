"""Messages: each comes back as it was sent, and arbitrary payloads are messages or problems, never exceptions."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.bridge.axes import places_of, values_of
from rvsim.device.bridge.frames import BadFrame, Frame, FrameDecoder, Problem, frame_bytes
from rvsim.device.bridge.host_side import BridgeDecoder, BridgeEncoder
from rvsim.device.bridge.messages import (
    LARGEST,
    MOST_AXES,
    Axes,
    BoardMessage,
    Clear,
    Encoders,
    Error,
    HostMessage,
    Identify,
    Identity,
    Limp,
    Message,
    Period,
    Poll,
    PollAxes,
    SetPoints,
    Status,
    Stop,
    Wake,
    decode,
    encode,
)
from rvsim.errors import SettingError
from rvsim.files import load_robot

PLACE = st.none() | st.integers(-LARGEST, LARGEST)
PLACES = st.lists(PLACE, max_size=MOST_AXES).map(tuple)
MILLISECONDS = st.integers(0, 0xFFFF)
AXIS = st.integers(0, MOST_AXES - 1)
STATUS = st.builds(Status, *[st.booleans()] * len(Status._fields))
NAME = st.text(st.characters(min_codepoint=0x20, max_codepoint=0x7E), max_size=32)


@st.composite
def axes(draw: st.DrawFn) -> Axes:
    places = draw(PLACES)
    flags = st.tuples(*[st.booleans()] * len(places))
    return Axes(draw(STATUS), places, draw(flags), draw(flags))


HOST: tuple[st.SearchStrategy[Message], ...] = (
    st.builds(Identify),
    st.builds(Poll),
    st.builds(PollAxes),
    st.builds(SetPoints, PLACES, MILLISECONDS),
    st.builds(Stop),
    st.builds(Clear),
    st.builds(Wake, AXIS, PLACE, MILLISECONDS),
    st.builds(Limp, AXIS),
    st.builds(Period, MILLISECONDS),
)
BOARD: tuple[st.SearchStrategy[Message], ...] = (
    STATUS,
    st.builds(Identity, st.integers(0, 255), st.integers(0, MOST_AXES), st.booleans(), NAME),
    st.builds(Encoders, st.integers(0, 2**32 - 1), STATUS, PLACES),
    axes(),
    st.builds(Error, st.sampled_from(Problem), st.none() | AXIS),
)


def test_there_is_a_strategy_for_each_message() -> None:
    assert len(HOST) == len(get_args(HostMessage))
    assert len(BOARD) == len(get_args(BoardMessage))


@given(st.one_of(*HOST, *BOARD), st.integers(0, 1000))
def test_each_message_comes_back(message: Message, sequence: int) -> None:
    (frame,) = FrameDecoder().feed(encode(message, sequence))
    assert isinstance(frame, Frame)
    assert frame.sequence == sequence % 256
    assert decode(frame) == message
    assert type(decode(frame)) is type(message)


@given(st.integers(0, 255), st.binary(max_size=64))
def test_any_payload_is_the_only_bytes_of_its_message_or_a_problem(kind: int, payload: bytes) -> None:
    frame = Frame(7, kind, payload)
    message = decode(frame)
    if not isinstance(message, Problem):
        assert encode(message, 7) == frame_bytes(frame)


@pytest.mark.parametrize(
    ("frame", "problem"),
    [
        (Frame(0, 0x42, b""), Problem.TYPE),
        (Frame(0, 0x05, b"!"), Problem.LENGTH),
        (Frame(0, 0x04, b"\0"), Problem.LENGTH),
        (Frame(0, 0x04, b"\0\0\0"), Problem.LENGTH),
        (Frame(0, 0x08, b"\x10"), Problem.VALUE),
        (Frame(0, 0x84, b"\x40"), Problem.VALUE),
        (Frame(0, 0x85, b"\x63\xff"), Problem.VALUE),
        (Frame(0, 0x81, b"\1\5\1\xc3\xa9"), Problem.VALUE),
    ],
)
def test_what_does_not_fit_is_named(frame: Frame, problem: Problem) -> None:
    assert decode(frame) is problem


def test_numbers_that_the_wire_cannot_carry_are_refused() -> None:
    for make in (
        lambda: SetPoints((LARGEST + 1,), 10),
        lambda: SetPoints((0,) * 17, 10),
        lambda: SetPoints((), 70_000),
        lambda: Limp(-1),
        lambda: Identity(1, 5, True, "née"),
        lambda: Axes(Status(), (1, 2), (True,), (True, False)),
    ):
        with pytest.raises(SettingError):
            make()


def test_the_host_numbers_its_frames_and_wraps_round() -> None:
    encoder, frames = BridgeEncoder(), FrameDecoder()
    sent = [frames.feed(encoder.encode(Poll()))[0].sequence for _ in range(300)]
    assert sent == [number % 256 for number in range(300)]


def test_the_host_hears_no_hosts() -> None:
    decoder = BridgeDecoder()
    assert decoder.feed(encode(Stop(), 9)) == (BadFrame(Problem.TYPE, 9),)
    assert decoder.feed(encode(Status(), 9) + b"?") == (Status(), BadFrame(Problem.NOISE))


@given(st.lists(st.floats(-3.0, 3.0) | st.just(float("nan")), min_size=6, max_size=6))
def test_values_come_back_within_half_a_hundredth(values: list[float]) -> None:
    robot = load_robot("al5b")
    back = values_of(robot, places_of(robot, values))
    step = np.append(np.radians(np.full(5, 0.005)), 0.00005)
    assert np.array_equal(np.isnan(back), np.isnan(values))
    assert np.all((np.abs(back - values) <= step * (1 + 1e-9)) | np.isnan(back))
