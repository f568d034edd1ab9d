"""What goes over the wire, said in words: for people who look at the log of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import replace
from types import MappingProxyType
from typing import Any, TypeAlias

from rvsim.device.ssc32 import ranges
from rvsim.device.ssc32.board_side import Dropped, read_line
from rvsim.device.ssc32.commands import (
    AppendStartup,
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
from rvsim.device.ssc32.replies import ReplyDecoder
from rvsim.language import tr

Names: TypeAlias = Mapping[int, str]
NO_NAMES: Names = MappingProxyType({})


def sent_in_words(line: bytes, names: Names = NO_NAMES, asleep: Set[int] = frozenset()) -> str:
    """What the board makes of these bytes, one line or several, with or without CR.

    Args:
        line: as it was sent.
        names: of the servos, by channel; the others are called "servo 7".
        asleep: channels whose position the board does not know: they jump.
    """
    lines = line.removesuffix(b"\r").split(b"\r")
    return "; ".join(_line(one, names, asleep) for one in lines)


def _line(line: bytes, names: Names, asleep: Set[int]) -> str:
    _, esc, kept = line.rpartition(b"\x1b")
    if esc and not kept:
        return tr("ESC: the unfinished line is discarded, what moves goes on")
    command = read_line(kept)
    if command is None:
        return tr("an empty line: nothing happens")
    if isinstance(command, Dropped):
        return tr("the board drops this line: {reason}", reason=command.reason)
    if isinstance(command, Move):
        return _move(command, names, asleep)
    return _COMMANDS[type(command)](command, names)


def _listed(parts: Sequence[str]) -> str:
    """A, b and c."""
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts)


def _name(channel: int, names: Names) -> str:
    return names.get(channel, f"servo {channel}")


def _move(move: Move, names: Names, asleep: Set[int]) -> str:
    waking = tuple(servo for servo in move.servos if servo.pulse_us and servo.channel in asleep)
    rest = replace(move, servos=tuple(servo for servo in move.servos if servo not in waking))
    said = [_listed([_servo(servo, names) for servo in rest.servos]) + _duration(rest)] if rest.servos else []
    return "; ".join([*([_waking(waking, move.time_ms, names)] if waking else []), *said])


def _waking(servos: Sequence[ServoMove], time_ms: int | None, names: Names) -> str:
    """The board knows no position from which a first move could be slow."""
    known = _listed([f"{'the ' if servo.channel in names else ''}{_name(servo.channel, names)}" for servo in servos])
    aims = _listed([str(servo.pulse_us) for servo in servos])
    given = [*("T" for _ in range(time_ms is not None)), *("S" for _ in range(any(servo.speed for servo in servos)))]
    ignored = (
        tr(", {listed} {value} ignored", listed=_listed(given), value="are" if len(given) > 1 else "is")
        if given
        else ""
    )
    return tr(
        "wakes {known}: {value} to {aims} µs{ignored}",
        known=known,
        value=tr("they jump") if len(servos) > 1 else tr("it jumps"),
        aims=aims,
        ignored=ignored,
    )


def _servo(servo: ServoMove, names: Names) -> str:
    name = _name(servo.channel, names)
    if not servo.pulse_us:
        return tr("{name} off (limp)", name=name)
    speed = "" if servo.speed is None else tr(" at no more than {speed} µs/s", speed=servo.speed)
    return f"{name} to {servo.pulse_us} µs{speed}"


def _duration(move: Move) -> str:
    moving = [servo for servo in move.servos if servo.pulse_us]
    together = ", together" if len(moving) > 1 else ""
    return together + _pace(move.time_ms, any(servo.speed for servo in moving)) if moving else ""


def _pace(time_ms: int | None, limited: bool) -> str:
    if time_ms:
        return f" in {'at least ' if limited else ''}{time_ms} ms"
    return "" if limited else tr(" at full speed")


def _offsets(command: SetOffsets, names: Names) -> str:
    parts = [f"{_name(channel, names)} by {offset:+d} µs" for channel, offset in command.offsets]
    return tr("shift all pulses of {listed}, until the power goes", listed=_listed(parts))


def _levels(command: SetLevels, _: Names) -> str:
    return _listed(
        [
            tr("pin {channel} {value}", channel=channel, value="high (5 V)" if high else "low (0 V)")
            for channel, high in command.levels
        ]
    )


def _byte(command: SetByte, _: Names) -> str:
    first = 8 * command.bank
    return tr(
        "pins {first} to {first2} to the bits of {value} ({value:08b}, the last is pin {first})",
        first=first,
        first2=first + 7,
        value=command.value,
    )


def _digital(command: ReadDigital, _: Names) -> str:
    names = [ranges.DIGITAL_INPUTS[pin] for pin, _ in command.inputs]
    latched = [ranges.DIGITAL_INPUTS[pin] for pin, latched in command.inputs if latched]
    since = tr(" ({listed}: or has been low since the last time)", listed=_listed(latched)) if latched else ""
    return tr("is {listed} high or low?{since}", listed=_listed(names), since=since)


def _analog(command: ReadAnalog, _: Names) -> str:
    return tr("what is the voltage of {listed}?", listed=_listed([ranges.ANALOG_INPUTS[pin] for pin in command.inputs]))


def _pulses(command: QueryPulses, names: Names) -> str:
    return tr(
        "which pulse does the board send to {listed}?",
        listed=_listed([_name(channel, names) for channel in command.channels]),
    )


def _stop(command: Stop, names: Names) -> str:
    return tr("{name} stops where it is", name=_name(command.channel, names))


def _write_register(command: WriteRegister, _: Names) -> str:
    return tr(
        "register {register} becomes {value} when the power comes again", register=command.register, value=command.value
    )


_COMMANDS: dict[type[Any], Callable[[Any, Names], str]] = {
    SetOffsets: _offsets,
    SetLevels: _levels,
    SetByte: _byte,
    QueryMoving: lambda *_: tr("is any move still under way?"),
    QueryPulses: _pulses,
    ReadDigital: _digital,
    ReadAnalog: _analog,
    QueryVersion: lambda *_: tr("what are you? (the board and its version)"),
    Stop: _stop,
    ReadRegister: lambda command, _: tr("what is in register {register}?", register=command.register),
    WriteRegister: _write_register,
    RestoreRegisters: lambda *_: tr("all registers as they left the factory"),
    ShowStartup: lambda *_: tr("what is the startup text?"),
    AppendStartup: lambda command, _: tr("add “{text}” to the startup text", text=command.text),
    DeleteStartup: lambda command, _: tr("delete the last {count} characters of the startup text", count=command.count),
}


def reply_in_words(query: Query | None, data: bytes, names: Names = NO_NAMES) -> str:
    """What these bytes from the board say.

    Args:
        query: what had been asked; None where nothing had.
        data: as they came.
        names: of the servos, by channel; the others are called "servo 7".
    """
    if query is None:
        return tr("nothing had been asked")
    decoder = ReplyDecoder()
    decoder.expect(query)
    replies = decoder.feed(data)
    if not replies:
        return tr("no whole answer to what had been asked")
    said = _ANSWERS[type(query)](query, replies[0].value, names)
    return tr("{said}; besides, bytes that nobody asked for", said=said) if decoder.take_stray() else said


def _pulses_said(query: QueryPulses, pulses_us: tuple[int, ...], names: Names) -> str:
    pairs = zip(query.channels, pulses_us, strict=True)
    said = [f"{_name(channel, names)} {f'{pulse} µs' if pulse else 'no pulse'}" for channel, pulse in pairs]
    return tr("the board sends to {listed} (commanded, not measured)", listed=_listed(said))


def _digital_said(query: ReadDigital, levels: tuple[bool, ...], _: Names) -> str:
    pairs = zip(query.inputs, levels, strict=True)
    said = [f"{ranges.DIGITAL_INPUTS[pin]} {_level(level, latched)}" for (pin, latched), level in pairs]
    return _listed(said)


def _level(high: bool, latched: bool) -> str:
    if latched:
        return tr("always high since the last time") if high else tr("low, or has been")
    return "high" if high else "low"


def _analog_said(query: ReadAnalog, volts: tuple[float, ...], _: Names) -> str:
    pairs = zip(query.inputs, volts, strict=True)
    return _listed([f"{ranges.ANALOG_INPUTS[pin]} {volt:.2f} V" for pin, volt in pairs])


_ANSWERS: dict[type[Any], Callable[[Any, Any, Names], str]] = {
    QueryMoving: lambda _, moving, __: tr("a move is still under way") if moving else tr("all moves are finished"),
    QueryPulses: _pulses_said,
    ReadDigital: _digital_said,
    ReadAnalog: _analog_said,
    QueryVersion: lambda _, text, __: tr("the board calls itself {text}", text=text),
    ReadRegister: lambda query, value, _: tr("register {register} holds {value}", register=query.register, value=value),
    RestoreRegisters: lambda *_: tr("the registers are as they left the factory"),
    ShowStartup: lambda _, text, __: (
        tr("the startup text is “{text}”", text=text) if text else tr("there is no startup text")
    ),
}
