"""The SSC-32 of the virtual arm: it does what lines of bytes tell it, in its own time, and answers queries only."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import Any

from rvsim.device.ssc32.board_side import (
    BoardDecoder,
    analog_reply,
    digital_reply,
    moving_reply,
    parse_line,
    pulses_reply,
    text_reply,
)
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
from rvsim.device.virtual.channels import Channels
from rvsim.device.virtual.clock import NANO, Clock, frame_after
from rvsim.device.virtual.contract import BoolArray, ChannelState, Measure
from rvsim.device.virtual.faults import NO_FAULTS, Fault
from rvsim.device.virtual.inputs import AnalogInputs, DigitalInputs, potentiometer_volts
from rvsim.device.virtual.memory import Memory
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import Servo
from rvsim.robot.servos import pulses_of

VERSION = "SSC32-V2.04GP"
RESTORING = int(1.2 * NANO)  # RDFLT takes more than a second
# Neither belongs into a startup text; the manual forbids it.
_NOT_AT_STARTUP = (WriteRegister, AppendStartup, DeleteStartup)


class Ssc32Board:
    """An SSC-32 or SSC-32U.

    Args:
        servos: as they really are; what potentiometer taps tell depends on them.
        measure: where the joints really are, (n,) [rad].
        version: what VER answers.
        potentiometers: whether the joints' potentiometers are tapped, joint i on the i-th of VA … VH.
        seed: of what an analog input answers first.
    """

    def __init__(
        self,
        servos: Sequence[Servo],
        measure: Measure,
        *,
        version: str = VERSION,
        potentiometers: bool = False,
        seed: int = 0,
    ) -> None:
        self.faults = NO_FAULTS
        self.memory = Memory()
        self._servos, self._measure, self._version = tuple(servos), measure, version
        self._potentiometers, self._dice = potentiometers, random.Random(f"analog {seed}")
        self._clock = Clock()
        self._answers = bytearray()
        self._digital = DigitalInputs()
        self._start()

    def _start(self) -> None:
        self._decoder = BoardDecoder()
        self._channels = Channels()
        self._analog = AnalogInputs(self._dice)
        self._restored_at: int | None = None
        self._answers.clear()
        self.baud = self.memory.baud
        self._channels.offset(self.memory.first_offsets())
        first = tuple(ServoMove(channel, pulse) for channel, pulse in self.memory.first_pulses())
        self._channels.start(Move(first), self._clock.now)
        for line in self.memory.first_lines():
            command = parse_line(line.encode("ascii"))
            if command is not None and not isinstance(command, _NOT_AT_STARTUP):
                self.execute(command)

    @property
    def pulses(self) -> FloatArray:
        """(32,) the pulses on the pins [µs], offsets included; NaN where there is none."""
        return self._channels.pulses

    @property
    def powered(self) -> BoolArray:
        """(32,) which pins have pulses."""
        return self._channels.powered

    @property
    def channels(self) -> tuple[ChannelState, ...]:
        """(32) what each is doing."""
        return self._channels.states

    @property
    def levels(self) -> dict[int, bool]:
        """Channels that are switches, and whether they are high."""
        return dict(self._channels.levels)

    @property
    def moving(self) -> bool:
        """What Q would answer of a sound board."""
        return self._channels.moving(self._clock.now)

    @property
    def busy(self) -> bool:
        """Whether some pulse will change, or an answer is still being worked at."""
        return self._channels.changing or self._restored_at is not None

    def set_input(self, pin: int, high: bool) -> None:
        """Pull a digital input (0 … 5 for A … F) up or down, as a switch on the pin does."""
        self._digital.set(pin, high, self._clock.now)

    def write(self, data: bytes) -> None:
        """Bytes arrive now; lines that they complete are executed."""
        for command in self._decoder.feed(data):
            self.execute(command)

    def process(self, dt: float) -> None:
        """So much time passes [s]."""
        frame = frame_after(self._clock.now)
        now = self._clock.advance(dt)
        while self._channels.changing and frame <= now:
            self._channels.frame(frame)
            frame = frame_after(frame)
        if self._restored_at is not None and self._restored_at <= now:
            self._restored_at = None
            self.memory.restore()
            self._answer(text_reply("OK"))

    def read(self) -> bytes:
        """What it has answered since the last call."""
        answers = bytes(self._answers)
        self._answers.clear()
        return answers

    def power_cycle(self) -> None:
        """Off and on: positions, offsets and unfinished lines are forgotten; registers and startup text take effect."""
        self._start()

    def execute(self, command: Command) -> None:
        """What a line does."""
        _DEEDS[type(command)](self, command)

    def _answer(self, data: bytes) -> None:
        self._answers += data

    def _move(self, command: Move) -> None:
        self._channels.start(command, self._clock.now)

    def _stop(self, command: Stop) -> None:
        self._channels.stop(command.channel)

    def _set_levels(self, command: SetLevels) -> None:
        for channel, high in command.levels:
            self._channels.set_level(channel, high)

    def _set_byte(self, command: SetByte) -> None:
        for bit in range(8):
            self._channels.set_level(8 * command.bank + bit, bool(command.value >> bit & 1))

    def _answer_moving(self, _: QueryMoving) -> None:
        self._answer(moving_reply(self.moving or Fault.STUCK_MOVING in self.faults))

    def _answer_pulses(self, command: QueryPulses) -> None:
        pulses = self.pulses if Fault.QP_WITH_OFFSET in self.faults else self._channels.commanded
        self._answer(pulses_reply(float(pulses[channel]) for channel in command.channels))

    def _answer_digital(self, command: ReadDigital) -> None:
        now = self._clock.now
        self._answer(digital_reply([self._digital.read(pin, latched, now) for pin, latched in command.inputs]))

    def _answer_analog(self, command: ReadAnalog) -> None:
        volts, forgetful = self._volts(), Fault.FIRST_ANALOG in self.faults
        self._answer(
            analog_reply([self._analog.read(pin, volts, self._clock.now, forgetful) for pin in command.inputs])
        )

    def _volts(self) -> list[float]:
        """Of the taps; inputs without one are at 0 V."""
        if not self._potentiometers:
            return []
        return [potentiometer_volts(pulse) for pulse in pulses_of(self._servos, self._measure()).tolist()]

    def _restore(self, _: RestoreRegisters) -> None:
        self._restored_at = self._clock.now + RESTORING


# One deed a command: the type of the key is the type that the deed takes.
_DEEDS: dict[type, Callable[[Ssc32Board, Any], None]] = {
    Move: Ssc32Board._move,
    Stop: Ssc32Board._stop,
    SetOffsets: lambda board, command: board._channels.offset(command.offsets),
    SetLevels: Ssc32Board._set_levels,
    SetByte: Ssc32Board._set_byte,
    QueryMoving: Ssc32Board._answer_moving,
    QueryPulses: Ssc32Board._answer_pulses,
    ReadDigital: Ssc32Board._answer_digital,
    ReadAnalog: Ssc32Board._answer_analog,
    QueryVersion: lambda board, _: board._answer(text_reply(board._version)),
    ReadRegister: lambda board, command: board._answer(text_reply(str(board.memory.read(command.register)))),
    WriteRegister: lambda board, command: board.memory.write(command.register, command.value),
    RestoreRegisters: Ssc32Board._restore,
    ShowStartup: lambda board, _: board._answer(text_reply(f'"{board.memory.startup}"')),
    AppendStartup: lambda board, command: board.memory.append_startup(command.text),
    DeleteStartup: lambda board, command: board.memory.delete_startup(command.count),
}
