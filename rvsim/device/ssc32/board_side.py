"""The board's side of the SSC-32's language: lines to commands, and answers to bytes.

A line is of one kind, or nothing: what the board does not understand it drops without a word, and a group with one
malformed part moves nothing. Sources: Lynxmotion, "SSC-32 User Guide" and "SSC-32U User Guide", and the vendor's forum
for what they leave out (pulses outside 500…2500 µs, decimals, bytes above 127).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from typing import NamedTuple

from rvsim.device.ssc32 import ranges
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
from rvsim.device.ssc32.lines import CR, LONGEST_LINE, next_line
from rvsim.language import tr, tr_later

_STEP = 4096  # bytes taken at once: cutting lines off the front of a longer buffer would cost its length each time
_HIGH = bytes(range(0x80, 0x100))
_BLANKS = b" \t\n\r"
_TEXT = re.compile(rb"[ \t\n\r]*SSCAT ?(.*)", re.IGNORECASE | re.DOTALL)
_CONTROL = bytes((*range(0x20), 0x7F))


class Dropped(NamedTuple):
    """A line that the board drops, and why: a sentence's end, for people. The board itself says nothing."""

    reason: str


def parse_line(line: bytes) -> Command | None:
    """The command of a line without its CR; None where the line is empty or the board drops it silently."""
    command = read_line(line)
    return None if isinstance(command, Dropped) else command


def read_line(line: bytes) -> Command | Dropped | None:
    """As `parse_line`, but with the reason why a line is dropped; None where it is empty."""
    if len(line) > LONGEST_LINE:
        return Dropped(tr("the line is longer than {longest} bytes", longest=LONGEST_LINE))
    line = line.translate(None, _HIGH)
    if text := _TEXT.fullmatch(line):  # the only line whose blanks and small letters count
        return AppendStartup(text[1].translate(None, _CONTROL).decode("ascii")[: ranges.LONGEST_STARTUP])
    letters = line.translate(None, _BLANKS).decode("ascii").upper()
    return _read(letters) if letters else None


def _read(letters: str) -> Command | Dropped:
    for pattern, build in _KINDS:
        if match := pattern.fullmatch(letters):
            return build(match)
    return Dropped(tr("it is no line of this language, or mixes several kinds of commands"))


class _OutsideError(Exception):
    """A number is outside its range; never leaves this module."""


def _number(digits: str, reason: str, ends: tuple[int, int]) -> int:
    """A number in a range; else the line is dropped for a reason out of those below."""
    value = int(digits)
    if not ranges.within(value, ends):
        raise _OutsideError(tr(reason, number=value, least=ends[0], most=ends[1]))
    return value


_NO_CHANNEL = tr_later("the channel {number} is not in {least} to {most}")
_NO_TIME = tr_later("the time [ms] {number} is not in {least} to {most}")
_NO_PULSE = tr_later("the pulse [µs] {number} is not in {least} to {most}")
_NO_SPEED = tr_later("the speed [µs/s] {number} is not in {least} to {most}")
_NO_OFFSET = tr_later("the offset [µs] {number} is not in {least} to {most}")
_NO_BANK = tr_later("the bank {number} is not in {least} to {most}")
_NO_BYTE = tr_later("the number of eight pins {number} is not in {least} to {most}")
_NO_REGISTER = tr_later("the register {number} is not in {least} to {most}")
_NO_REGISTER_VALUE = tr_later("the value of the register {number} is not in {least} to {most}")
_NO_COUNT = tr_later("the number of characters {number} is not in {least} to {most}")


def _channel(digits: str) -> int:
    return _number(digits, _NO_CHANNEL, ranges.CHANNEL_RANGE)


_SERVO = re.compile(r"#(\d+)P(\d+)(\.\d*)?((?:[ST]\d+(?:\.\d*)?)*)")
_LIMIT = re.compile(r"([ST])(\d+)")


def _move(match: re.Match[str]) -> Move:
    servos: list[ServoMove] = []
    time_ms: int | None = None
    for channel, pulse, fraction, rest in _SERVO.findall(match[0]):
        limits = dict(_LIMIT.findall(rest))  # of several the last one counts, as T of the whole line does
        # The board ignores a fraction, and then the S behind it too.
        speed = _speed(limits["S"]) if "S" in limits and not fraction else None
        servos.append(ServoMove(_channel(channel), _pulse(pulse), speed))
        time_ms = _number(limits["T"], _NO_TIME, ranges.TIME_RANGE) if "T" in limits else time_ms
    return Move(tuple(servos), time_ms)


def _pulse(digits: str) -> int:
    value = _number(digits, _NO_PULSE, (0, ranges.LARGEST_PULSE_NUMBER))
    return value and min(max(value, ranges.PULSE_RANGE[0]), ranges.PULSE_RANGE[1])


def _speed(digits: str) -> int | None:
    """[µs/s]; 0 limits nothing."""
    return _number(digits, _NO_SPEED, (0, ranges.SPEED_RANGE[1])) or None


def _offsets(match: re.Match[str]) -> SetOffsets:
    pairs = re.findall(r"#(\d+)PO([+-]?\d+)", match[0])
    return SetOffsets(tuple((_channel(c), _number(v, _NO_OFFSET, ranges.OFFSET_RANGE)) for c, v in pairs))


def _levels(match: re.Match[str]) -> SetLevels:
    return SetLevels(tuple((_channel(c), level == "H") for c, level in re.findall(r"#(\d+)([HL])", match[0])))


def _byte(match: re.Match[str]) -> SetByte:
    return SetByte(_number(match[1], _NO_BANK, ranges.BANK_RANGE), _number(match[2], _NO_BYTE, ranges.BYTE_RANGE))


def _pulses(match: re.Match[str]) -> QueryPulses:
    return QueryPulses(tuple(_channel(digits) for digits in re.findall(r"\d+", match[0])))


def _digital(match: re.Match[str]) -> ReadDigital:
    inputs = re.findall("([A-F])(L?)", match[0])
    if len(inputs) > ranges.MOST_DIGITAL_INPUTS:
        raise _OutsideError(tr("more than {most} inputs in one line", most=ranges.MOST_DIGITAL_INPUTS))
    return ReadDigital(tuple((ranges.DIGITAL_INPUTS.index(name), bool(latched)) for name, latched in inputs))


def _analog(match: re.Match[str]) -> ReadAnalog:
    return ReadAnalog(tuple(ranges.ANALOG_INPUTS.index(name) for name in match[0][1::2]))


def _register(digits: str) -> int:
    return _number(digits, _NO_REGISTER, ranges.REGISTER_RANGE)


def _write_register(match: re.Match[str]) -> WriteRegister:
    return WriteRegister(_register(match[1]), _number(match[2], _NO_REGISTER_VALUE, ranges.REGISTER_VALUE_RANGE))


def _delete(match: re.Match[str]) -> DeleteStartup:
    return DeleteStartup(_number(match[1], _NO_COUNT, ranges.DELETE_RANGE))


def _checked(build: Callable[[re.Match[str]], Command]) -> Callable[[re.Match[str]], Command | Dropped]:
    def read(match: re.Match[str]) -> Command | Dropped:
        try:
            return build(match)
        except _OutsideError as outside:
            return Dropped(str(outside))

    return read


_KINDS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], Command | Dropped]], ...] = tuple(
    (re.compile(pattern), _checked(build))
    for pattern, build in (
        (rf"(?:{_SERVO.pattern})+", _move),
        (r"Q", lambda _: QueryMoving()),
        (r"(?:QP\d+)+", _pulses),
        (r"STOP(\d+)", lambda match: Stop(_channel(match[1]))),
        (r"(?:V[A-H])+", _analog),
        (r"(?:[A-F]L?)+", _digital),
        (r"VER", lambda _: QueryVersion()),
        (r"(?:#\d+PO[+-]?\d+)+", _offsets),
        (r"(?:#\d+[HL])+", _levels),
        (r"#(\d+):(\d+)", _byte),
        (r"R(\d+)", lambda match: ReadRegister(_register(match[1]))),
        (r"R(\d+)=([+-]?\d+)", _write_register),
        (r"RDFLT", lambda _: RestoreRegisters()),
        (r"SS", lambda _: ShowStartup()),
        (r"SSDEL(\d+)", _delete),
    )
)


class BoardDecoder:
    """Bytes as they come, in chunks of any size, to the commands of their lines."""

    def __init__(self) -> None:
        self._buffer = b""

    @property
    def waiting(self) -> int:
        """Bytes kept of a line that has not ended yet; at most one more than the longest line."""
        return len(self._buffer)

    def feed(self, data: bytes) -> tuple[Command, ...]:
        """The commands that these bytes complete, in order; lines that the board drops are left out."""
        commands: list[Command] = []
        for start in range(0, len(data), _STEP):
            self._buffer += data[start : start + _STEP]
            commands.extend(self._complete())
        return tuple(commands)

    def _complete(self) -> Iterable[Command]:
        while True:
            consumed, line = next_line(self._buffer)
            self._buffer = self._buffer[consumed:]
            if not consumed:
                return
            command = None if line is None else parse_line(line)
            if command is not None:
                yield command


def moving_reply(moving: bool) -> bytes:
    """To `Q`: "+" while some servo's move lasts, "." when all are finished."""
    return b"+" if moving else b"."


def pulses_reply(pulses_us: Iterable[float]) -> bytes:
    """To `QP`: one byte a channel, its pulse [µs] in whole steps of 10; 0 where there is none (0 or NaN)."""
    return bytes(0 if math.isnan(pulse) else int(min(max(pulse / 10.0, 0.0), 255.0)) for pulse in pulses_us)


def digital_reply(levels: Iterable[bool]) -> bytes:
    """To `A B CL`: "0" or "1" an input."""
    return b"".join(b"1" if level else b"0" for level in levels)


def analog_reply(volts: Iterable[float]) -> bytes:
    """To `VA VB`: one byte an input, V · 256 / 5, held within a byte."""
    return bytes(int(min(max(volt * 256.0 / 5.0, 0.0), 255.0)) for volt in volts)


def text_reply(text: str) -> bytes:
    """To `VER`, `R4`, `RDFLT`, and (in quotation marks) to `SS`: the text and CR; what is not ASCII becomes "?"."""
    return text.encode("ascii", "replace") + CR
