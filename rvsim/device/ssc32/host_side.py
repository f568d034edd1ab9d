"""The host's side of the SSC-32's language: commands to lines, and (from replies.py) bytes to answers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

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
from rvsim.device.ssc32.lines import CR
from rvsim.device.ssc32.replies import Reply, ReplyDecoder
from rvsim.errors import SettingError
from rvsim.language import tr

__all__ = ["Reply", "ReplyDecoder", "encode"]


def encode(command: Command) -> bytes:
    """The line of a command, with its CR.

    Raises:
        SettingError: a number that the language does not allow. Pulses are not clamped here: who asks for a pulse
            that is none is told so, the servo does not go somewhere else instead.
    """
    return _WRITERS[type(command)](command).encode("ascii") + CR


def _number(value: int, what: str, ends: tuple[int, int]) -> str:
    if not ranges.within(value, ends):
        raise SettingError(what, value, tr("from {least} to {most}", least=ends[0], most=ends[1]))
    return f"{value:d}"


def _channel(value: int) -> str:
    return _number(value, "channel", ranges.CHANNEL_RANGE)


def _some(parts: Iterable[str]) -> str:
    text = "".join(parts)
    if not text:
        raise SettingError("command", "empty", tr("about one channel or more"))
    return text


def _move(command: Move) -> str:
    time = "" if command.time_ms is None else "T" + _number(command.time_ms, "time_ms", ranges.TIME_RANGE)
    return _some(map(_servo, command.servos)) + time


def _servo(servo: ServoMove) -> str:
    pulse = "0" if servo.pulse_us == 0 else _number(servo.pulse_us, "pulse_us", ranges.PULSE_RANGE)
    speed = "" if servo.speed is None else "S" + _number(servo.speed, "speed", ranges.SPEED_RANGE)
    return f"#{_channel(servo.channel)}P{pulse}{speed}"


def _offsets(command: SetOffsets) -> str:
    return _some(f"#{_channel(c)}PO{_number(us, 'offset_us', ranges.OFFSET_RANGE)}" for c, us in command.offsets)


def _levels(command: SetLevels) -> str:
    return _some(f"#{_channel(channel)}{'H' if high else 'L'}" for channel, high in command.levels)


def _byte(command: SetByte) -> str:
    return f"#{_number(command.bank, 'bank', ranges.BANK_RANGE)}:{_number(command.value, 'value', ranges.BYTE_RANGE)}"


def _digital(command: ReadDigital) -> str:
    _number(len(command.inputs), "number of inputs", (1, ranges.MOST_DIGITAL_INPUTS))
    return "".join(_pin(ranges.DIGITAL_INPUTS, pin) + "L" * latched for pin, latched in command.inputs)


def _analog(command: ReadAnalog) -> str:
    return _some("V" + _pin(ranges.ANALOG_INPUTS, pin) for pin in command.inputs)


def _pin(names: str, pin: int) -> str:
    _number(pin, "input", (0, len(names) - 1))
    return names[pin]


def _register(value: int) -> str:
    return "R" + _number(value, "register", ranges.REGISTER_RANGE)


def _write_register(command: WriteRegister) -> str:
    return f"{_register(command.register)}={_number(command.value, 'value', ranges.REGISTER_VALUE_RANGE)}"


def _append(command: AppendStartup) -> str:
    if not (command.text.isascii() and (command.text + " ").isprintable()):
        raise SettingError("text", command.text, tr("of printable ASCII characters"))
    _number(len(command.text), "length of the text", (0, ranges.LONGEST_STARTUP))
    return f"SSCAT {command.text}"


_WRITERS: dict[type[Any], Callable[[Any], str]] = {
    Move: _move,
    SetOffsets: _offsets,
    SetLevels: _levels,
    SetByte: _byte,
    QueryMoving: lambda _: "Q",
    QueryPulses: lambda command: _some("QP" + _channel(channel) for channel in command.channels),
    ReadDigital: _digital,
    ReadAnalog: _analog,
    QueryVersion: lambda _: "VER",
    Stop: lambda command: "STOP" + _channel(command.channel),
    ReadRegister: lambda command: _register(command.register),
    WriteRegister: _write_register,
    RestoreRegisters: lambda _: "RDFLT",
    ShowStartup: lambda _: "SS",
    AppendStartup: _append,
    DeleteStartup: lambda command: "SSDEL " + _number(command.count, "count", ranges.DELETE_RANGE),
}
