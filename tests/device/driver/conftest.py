"""A driver, a wire and a virtual arm in virtual time, with everything that arrives at the board written down."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.device.bridge import messages
from rvsim.device.bridge.frames import BadFrame, FrameDecoder
from rvsim.device.driver.actions import Connect, Refusal, Wake
from rvsim.device.driver.core import DriverCore
from rvsim.device.link.pacing import PacedArm
from rvsim.device.ssc32 import commands
from rvsim.device.ssc32.board_side import BoardDecoder
from rvsim.device.virtual.arm import VirtualArm
from rvsim.robot import Robot

STEP = 0.004


class Told(NamedTuple):
    """One thing that the board was told: when, which axes go somewhere, and what it was."""

    time: float
    moves: frozenset[int]
    limp: frozenset[int]
    stops: frozenset[int]


class Listener:
    """Stands before the board and writes down what arrives, as the board understands it."""

    def __init__(self, arm: VirtualArm, channels: tuple[int, ...]) -> None:
        self.arm, self.channels = arm, channels
        self.told: list[Told] = []
        self.bytes: list[tuple[float, int]] = []
        self.deaf = False
        self._lines, self._frames = BoardDecoder(), FrameDecoder()

    def write(self, data: bytes) -> None:
        if self.deaf:
            return
        self.bytes += [(self.arm.time, byte) for byte in data]
        self.told += self._bridge(data) if self.arm.language == "bridge" else self._ssc32(data)
        self.arm.write(data)

    def process(self, dt: float) -> None:
        self.arm.process(dt)

    def read(self) -> bytes:
        return self.arm.read()

    def _ssc32(self, data: bytes) -> list[Told]:
        told = []
        for command in self._lines.feed(data):
            if isinstance(command, commands.Move):
                moves = [self.channels.index(servo.channel) for servo in command.servos if servo.pulse_us]
                limp = [self.channels.index(servo.channel) for servo in command.servos if not servo.pulse_us]
                told.append(self._of(moves, limp))
            elif isinstance(command, commands.Stop):
                told.append(self._of(stops=[command.channel]))
            else:
                assert isinstance(command, commands.QueryPulses | commands.QueryVersion | commands.ReadAnalog), command
        return told

    def _bridge(self, data: bytes) -> list[Told]:
        told = []
        for frame in self._frames.feed(data):
            message = None if isinstance(frame, BadFrame) else messages.decode(frame)
            if isinstance(message, messages.SetPoints):
                told.append(self._of([axis for axis, place in enumerate(message.places) if place is not None]))
            elif isinstance(message, messages.Wake):
                told.append(self._of([message.axis]))
            elif isinstance(message, messages.Limp):
                told.append(self._of(limp=[message.axis]))
            elif isinstance(message, messages.Stop):
                told.append(self._of(stops=range(32)))
        return told

    def _of(self, moves=(), limp=(), stops=()) -> Told:
        return Told(self.arm.time, frozenset(moves), frozenset(limp), frozenset(stops))


class Rig:
    """Time passes when `run` is told."""

    def __init__(self, robot: Robot, language: str = "ssc32", baud: int = 9600, **options: object) -> None:
        taps = bool(options.pop("potentiometers", False))
        board_baud = options.pop("board_baud", None)
        self.robot = robot
        self.arm = VirtualArm(robot, language=language, potentiometers=taps, **options)
        self.channels = (*(servo.channel for servo in robot.servos), robot.gripper_servo.channel)
        self.board = Listener(self.arm, self.channels)
        self.wire = PacedArm(self.board, baud, board_baud=board_baud)
        self.logged: list[tuple[float, str, bytes]] = []
        self.core = DriverCore(
            robot, language=language, baud=baud, potentiometers=taps, log=lambda *entry: self.logged.append(entry)
        )
        self.baud, self.now = baud, 0.0
        self.sent = bytearray()
        self.home = np.clip(robot.home, *self.core.limits.T)

    @property
    def state(self):
        return self.core.state

    @property
    def pulses(self) -> np.ndarray:
        """(m,) what the board has on its pins."""
        return self.arm.commanded_pulses[list(self.channels)]

    def do(self, action) -> Refusal | None:
        return self.core.do(action)

    def done(self, action) -> None:
        assert self.core.do(action) is None

    def step(self, dt: float = STEP) -> None:
        self._urgent()
        self.wire.process(dt)
        self.now += dt
        out = self.core.process(self.now, self.wire.receive())
        self._urgent()
        self._send(out)

    def _urgent(self) -> None:
        first = self.core.urgent()
        if first is not None:
            self.wire.cancel_output()
            self._send(first)

    def _send(self, data: bytes) -> None:
        self.sent += data
        self.wire.send(data)

    def run(self, seconds: float, dt: float = STEP) -> None:
        for _ in range(round(seconds / dt)):
            self.step(dt)

    def until(self, phase: str, seconds: float = 20.0) -> None:
        end = self.now + seconds
        while self.state.phase != phase:
            self.step()
            assert self.now < end, self.state

    def connect(self) -> None:
        self.done(Connect())
        self.until("asleep")

    def wake_all(self, gripper: bool = True) -> None:
        for axis in range(self.robot.dof):
            self.done(Wake(axis, self.home[axis]))
            self.until("ready")
        if gripper:
            self.done(Wake("gripper", 0.5))
            self.until("ready")

    def ready(self) -> Rig:
        self.connect()
        self.wake_all()
        return self


@pytest.fixture(scope="session")
def al5b() -> Robot:
    return load_robot("al5b")


@pytest.fixture
def rig(al5b: Robot) -> Callable[..., Rig]:
    """Makes one; in hypothesis tests as often as asked for."""
    return lambda language="ssc32", baud=9600, **options: Rig(al5b, language, baud, **options)
