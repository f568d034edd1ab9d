"""Frames: what goes in comes out, however it is cut up, and nothing that was spoilt does."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.bridge.frames import (
    ESCAPE,
    LONGEST_PAYLOAD,
    START,
    BadFrame,
    Found,
    Frame,
    FrameDecoder,
    Problem,
    crc16,
    frame_bytes,
)

NUMBERS = st.integers(0, 255)
AWKWARD = st.sampled_from((START, ESCAPE, START ^ 0x20, ESCAPE ^ 0x20)) | NUMBERS
PAYLOADS = st.lists(AWKWARD, max_size=LONGEST_PAYLOAD).map(bytes)
FRAMES = st.builds(Frame, NUMBERS, NUMBERS, PAYLOADS)
NOISE = st.lists(AWKWARD, max_size=200).map(bytes)
GOOD = frame_bytes(Frame(3, 2, b"~}ab"))


def found_in(*pieces: bytes) -> list[Found]:
    decoder = FrameDecoder()
    return [found for piece in pieces for found in decoder.feed(piece)]


def cut_up(data: bytes, cuts: list[int]) -> list[bytes]:
    places = sorted({min(cut, len(data)) for cut in cuts} | {0, len(data)})
    return [data[start:end] for start, end in pairwise(places)]


def test_the_crc_has_the_check_value_of_its_kind() -> None:
    assert crc16(b"123456789") == 0x29B1


@given(st.lists(FRAMES, max_size=5), st.lists(st.integers(0, 400), max_size=20))
def test_frames_come_back_however_they_are_cut_up(frames: list[Frame], cuts: list[int]) -> None:
    data = b"".join(map(frame_bytes, frames))
    assert found_in(*cut_up(data, cuts)) == frames


@given(FRAMES)
def test_the_start_byte_stands_at_the_start_only(frame: Frame) -> None:
    assert frame_bytes(frame).count(START) == 1


@given(NOISE, st.lists(st.integers(0, 200), max_size=20))
def test_arbitrary_bytes_mean_the_same_however_they_are_cut_up(data: bytes, cuts: list[int]) -> None:
    assert found_in(*cut_up(data, cuts)) == found_in(data)


@given(NOISE, FRAMES)
def test_a_frame_is_found_after_whatever_came_before(noise: bytes, frame: Frame) -> None:
    assert found_in(noise, frame_bytes(frame))[-1] == frame


@given(FRAMES, st.data())
def test_one_wrong_bit_makes_a_frame_bad(frame: Frame, data: st.DataObject) -> None:
    spoilt = bytearray(frame_bytes(frame))
    spoilt[data.draw(st.integers(0, len(spoilt) - 1))] ^= 1 << data.draw(st.integers(0, 7))
    found = found_in(bytes(spoilt), bytes((START,)))
    assert found
    assert all(isinstance(item, BadFrame) for item in found)


def test_what_is_wrong_is_named_once() -> None:
    cases = {
        b"noise": [BadFrame(Problem.NOISE)],
        GOOD[:-3] + GOOD: [BadFrame(Problem.CUT, 3), Frame(3, 2, b"~}ab")],
        b"\x7e\x01\x05\x7d\x41\x00": [BadFrame(Problem.ESCAPE, 5)],
        b"\x7e\x41\x05rest": [BadFrame(Problem.LENGTH)],
        GOOD[:-1] + b"\x00rest": [BadFrame(Problem.CRC, 3)],
        b"\x7e\x7e\x7e" + GOOD: [Frame(3, 2, b"~}ab")],
    }
    for data, expected in cases.items():
        assert found_in(data) == expected, data
        assert found_in(*cut_up(data, list(range(len(data))))) == expected, data


def test_a_stop_is_seen_behind_a_length_that_is_wrong() -> None:
    stop = frame_bytes(Frame(1, 5, b""))
    assert found_in(b"\x7e\x40\x00\x04\x00\x00" + stop) == [BadFrame(Problem.CUT, 0), Frame(1, 5, b"")]


def test_endless_noise_is_not_kept() -> None:
    decoder = FrameDecoder()
    assert decoder.feed(b"\x55" * 100_000) == (BadFrame(Problem.NOISE),)
    assert not decoder.unfinished
