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
from rvsim.device.words import one_after_another
from rvsim.language import listed, tr, tr_later, trn

Names: TypeAlias = Mapping[int, str]
NO_NAMES: Names = MappingProxyType({})
# How long moves take: by whether it is several servos, and what is said of their time.
_PACES: dict[tuple[bool, str], str] = {
    (False, "time"): tr_later("{moves} in {time} ms"),
    (True, "time"): tr_later("{moves}, together in {time} ms"),
    (False, "time and speed"): tr_later("{moves} in at least {time} ms"),
    (True, "time and speed"): tr_later("{moves}, together in at least {time} ms"),
    (False, "speed"): "{moves}",
    (True, "speed"): tr_later("{moves}, together"),
    (False, ""): tr_later("{moves} at full speed"),
    (True, ""): tr_later("{moves}, together at full speed"),
}


def sent_in_words(line: bytes, names: Names = NO_NAMES, asleep: Set[int] = frozenset()) -> str:
    """What the board makes of these bytes, one line or several, with or without CR.

    Args:
        line: as it was sent.
        names: of the servos, by channel; the others are called "servo 7".
        asleep: channels whose position the board does not know: they jump.
    """
    lines = line.removesuffix(b"\r").split(b"\r")
    return one_after_another(_line(one, names, asleep) for one in lines)


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


def _name(channel: int, names: Names) -> str:
    return tr(names[channel]) if channel in names else tr("servo {channel}", channel=channel)


def _move(move: Move, names: Names, asleep: Set[int]) -> str:
    waking = tuple(servo for servo in move.servos if servo.pulse_us and servo.channel in asleep)
    rest = replace(move, servos=tuple(servo for servo in move.servos if servo not in waking))
    said = [_going(rest, names)] if rest.servos else []
    return one_after_another([*([_waking(waking, move.time_ms, names)] if waking else []), *said])


def _waking(servos: Sequence[ServoMove], time_ms: int | None, names: Names) -> str:
    """The board knows no position from which a first move could be slow."""
    jump = trn(
        "wakes {servos}: it jumps to {pulses} µs",
        "wakes {servos}: they jump to {pulses} µs",
        len(servos),
        servos=listed([_named(servo.channel, names) for servo in servos]),
        pulses=listed([str(servo.pulse_us) for servo in servos]),
    )
    given = [*("T" for _ in range(time_ms is not None)), *("S" for _ in range(any(servo.speed for servo in servos)))]
    if not given:
        return jump
    return trn("{jump}, {letters} is ignored", "{jump}, {letters} are ignored", len(given), jump=jump,
               letters=listed(given))  # fmt: skip


def _named(channel: int, names: Names) -> str:
    return tr("the {joint}", joint=_name(channel, names)) if channel in names else _name(channel, names)


def _going(move: Move, names: Names) -> str:
    """All servos of a line, and how long they take."""
    moves = listed([_servo(servo, names) for servo in move.servos])
    going = [servo for servo in move.servos if servo.pulse_us]
    if not going:
        return moves
    told = [*(["time"] if move.time_ms else []), *(["speed"] if any(servo.speed for servo in going) else [])]
    return tr(_PACES[len(going) > 1, " and ".join(told)], moves=moves, time=move.time_ms)


def _servo(servo: ServoMove, names: Names) -> str:
    name = _name(servo.channel, names)
    if not servo.pulse_us:
        return tr("{servo} off (limp)", servo=name)
    if servo.speed is None:
        return tr("{servo} to {pulse} µs", servo=name, pulse=servo.pulse_us)
    return tr("{servo} to {pulse} µs at no more than {speed} µs/s", servo=name, pulse=servo.pulse_us, speed=servo.speed)


def _offsets(command: SetOffsets, names: Names) -> str:
    parts = [
        tr("{servo} by {offset:+d} µs", servo=_name(channel, names), offset=offset)
        for channel, offset in command.offsets
    ]
    return tr("shift all pulses of {servos}, until the power goes", servos=listed(parts))


def _levels(command: SetLevels, _: Names) -> str:
    return listed(
        [
            tr("pin {pin} high (5 V)", pin=channel) if high else tr("pin {pin} low (0 V)", pin=channel)
            for channel, high in command.levels
        ]
    )


def _byte(command: SetByte, _: Names) -> str:
    first = 8 * command.bank
    return tr(
        "pins {first} to {last} to the bits of {number} ({number:08b}, the last is pin {first})",
        first=first,
        last=first + 7,
        number=command.value,
    )


def _digital(command: ReadDigital, _: Names) -> str:
    names = listed([ranges.DIGITAL_INPUTS[pin] for pin, _ in command.inputs])
    latched = [ranges.DIGITAL_INPUTS[pin] for pin, latched in command.inputs if latched]
    if not latched:
        return tr("is {inputs} high or low?", inputs=names)
    return tr(
        "is {inputs} high or low? ({latched}: or has been low since the last time)",
        inputs=names,
        latched=listed(latched),
    )


def _analog(command: ReadAnalog, _: Names) -> str:
    return tr("what is the voltage of {inputs}?", inputs=listed([ranges.ANALOG_INPUTS[pin] for pin in command.inputs]))


def _pulses(command: QueryPulses, names: Names) -> str:
    return tr(
        "which pulse does the board send to {servos}?",
        servos=listed([_name(channel, names) for channel in command.channels]),
    )


def _stop(command: Stop, names: Names) -> str:
    return tr("{servo} stops where it is", servo=_name(command.channel, names))


def _write_register(command: WriteRegister, _: Names) -> str:
    return tr(
        "register {register} becomes {number} when the power comes again",
        register=command.register,
        number=command.value,
    )


def _delete(command: DeleteStartup, _: Names) -> str:
    return trn(
        "delete the last {n} character of the startup text",
        "delete the last {n} characters of the startup text",
        command.count,
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
    DeleteStartup: _delete,
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
    said = [_pulse_said(_name(channel, names), pulse) for channel, pulse in pairs]
    return tr("the board sends to {servos} (commanded, not measured)", servos=listed(said))


def _pulse_said(name: str, pulse_us: int) -> str:
    if pulse_us:
        return tr("{servo} {pulse} µs", servo=name, pulse=pulse_us)
    return tr("{servo} no pulse", servo=name)


def _digital_said(query: ReadDigital, levels: tuple[bool, ...], _: Names) -> str:
    pairs = zip(query.inputs, levels, strict=True)
    said = [tr(_LEVELS[latched, high], pin=ranges.DIGITAL_INPUTS[pin]) for (pin, latched), high in pairs]
    return listed(said)


# By whether the input latches, and whether it is high.
_LEVELS = {
    (False, False): tr_later("{pin} low"),
    (False, True): tr_later("{pin} high"),
    (True, False): tr_later("{pin} low, or has been"),
    (True, True): tr_later("{pin} always high since the last time"),
}


def _analog_said(query: ReadAnalog, volts: tuple[float, ...], _: Names) -> str:
    pairs = zip(query.inputs, volts, strict=True)
    return listed([f"{ranges.ANALOG_INPUTS[pin]} {volt:.2f} V" for pin, volt in pairs])


_ANSWERS: dict[type[Any], Callable[[Any, Any, Names], str]] = {
    QueryMoving: lambda _, moving, __: tr("a move is still under way") if moving else tr("all moves are finished"),
    QueryPulses: _pulses_said,
    ReadDigital: _digital_said,
    ReadAnalog: _analog_said,
    QueryVersion: lambda _, text, __: tr("the board calls itself {name}", name=text),
    ReadRegister: lambda query, value, _: tr(
        "register {register} holds {number}", register=query.register, number=value
    ),
    RestoreRegisters: lambda *_: tr("the registers are as they left the factory"),
    ShowStartup: lambda _, text, __: (
        tr("the startup text is “{text}”", text=text) if text else tr("there is no startup text")
    ),
}
