"""Words for the wire log: each message says what it does, with the arm's own names and units."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.bridge.messages import (
    Axes,
    Encoders,
    Error,
    Identity,
    Message,
    Period,
    Problem,
    SetPoints,
    Status,
    Wake,
    encode,
)
from rvsim.device.bridge.words import frame_in_words
from rvsim.files import load_robot


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (
            SetPoints((None, 9000, -4550, None, None, 2500), 700),
            "shoulder to 90.00°, elbow to −45.50°, gripper to 25.00 % open, together in 700 ms",
        ),
        (SetPoints((100, None, None, None, None, None), 20), "base to 1.00° in 20 ms"),
        (Wake(1, None, 0), "wake shoulder where it is"),
        (Period(0), "report no more"),
        (Identity(1, 5, True, "desk"), "I am “desk”, 5 joints and a gripper, version 1 of the protocol"),
        (
            Encoders(250, Status(moving=True), (10, None)),
            "measured at 250 ms: base 0.10°, shoulder has no encoder (moving)",
        ),
        (
            Axes(Status(stalled=True), (5, None), (True, False), (False, False)),
            "told: base 0.05° (does not follow), shoulder asleep (not following)",
        ),
        (Error(Problem.ASLEEP, 2), "not done: elbow: an axis is asleep: wake it first"),
        (Status(), "done (at rest)"),
    ],
)
def test_each_message_in_words(message: Message, words: str) -> None:
    assert frame_in_words(encode(message, 12), load_robot("al5b")) == f"12: {words}"


def test_an_unknown_arm_has_numbers() -> None:
    assert frame_in_words(encode(SetPoints((None, 150), 5), 0)) == "0: axis 1 to 1.50 in 5 ms"


def test_several_frames_pieces_and_noise_are_told_apart() -> None:
    stop = bytes.fromhex("7e00060500ff")
    assert frame_in_words(b"??" + encode(Status(), 1) + stop + b"\x7e\x01") == (
        "no frame: bytes outside of a frame; 1: done (at rest); no frame: a wrong CRC; a piece of a frame"
    )


@given(st.binary(max_size=80))
def test_any_bytes_can_be_put_into_words(data: bytes) -> None:
    assert isinstance(frame_in_words(data, load_robot("al5b")), str)
    assert bool(frame_in_words(data)) == bool(data)
