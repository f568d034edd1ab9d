"""The virtual arm: servos that lag, sag and stick, behind a board that speaks the real one's language. No clock."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.bridge.board import BridgeBoard
from rvsim.device.virtual.board import VERSION, Ssc32Board
from rvsim.device.virtual.bounds import settling_time
from rvsim.device.virtual.calibration import hidden_servos
from rvsim.device.virtual.channels import Channels
from rvsim.device.virtual.clock import FRAME, FRAME_NS, NANO, Clock, frame_after
from rvsim.device.virtual.contract import Board, ChannelState, Language
from rvsim.device.virtual.faults import DARK_AFTER, DARKNESS, NO_FAULTS, Fault, Faults
from rvsim.device.virtual.servo import Drive, drive_of, places_after, servo_bank
from rvsim.device.virtual.wire import Wire
from rvsim.errors import ShapeError
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import CHANNELS

_AT_REST = 3  # frames without any change: a pulse takes one frame to be seen and another to act
_NOTHING = np.full(CHANNELS, np.nan)
_UNKNOWN = Channels().states


class Motion(NamedTuple):
    """Where the servos were at the last frame (m,), what acts on them until the next, and when that was [ns].

    One value, replaced at once: a window may look while another thread lets time pass.
    """

    places: FloatArray
    drive: Drive
    since: int


_PAUSE = NANO // 10  # set-points that follow sooner than that [ns] are one move for the supply


class VirtualArm:
    """An arm with its controller, whose port is `write` and `read`, and whose time is what `process` is told.

    process(a) and process(b) are process(a + b), bit for bit: servos change with their frames of 20 ms, whoever calls.
    A new one has no power on its servos; it stands as far sunk from home as friction lets it.

    Args:
        robot: an arm with servos.
        seed: of its hidden calibration; 0 is mounted as the robot file says, others may turn the other way.
        language: what its board speaks.
        version: what an SSC-32 calls itself.
        potentiometers: whether the SSC-32's analog inputs are wired to the servos' potentiometers.

    Raises:
        RobotDefinitionError: the arm has no servos.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        seed: int = 0,
        language: Language = "ssc32",
        version: str = VERSION,
        potentiometers: bool = False,
    ) -> None:
        self.robot, self.language = robot, language
        self.servos, self.gripper_servo = hidden_servos(robot, seed)
        self._bank = servo_bank(robot, self.servos, self.gripper_servo)
        self._channels = list(self._bank.channels)
        self._clock, self._wire, self._faults = Clock(), Wire(), NO_FAULTS
        self._dark_until: int | None = None
        self._board_time = self._quiet = 0
        self._move_began = self._moved_last = -NANO
        self._next_frame = FRAME_NS
        self.board: Board = (
            BridgeBoard(robot, self.servos, self.gripper_servo, self._measured)
            if language == "bridge"
            else Ssc32Board(self.servos, self._measured, version=version, potentiometers=potentiometers, seed=seed)
        )
        self._pulses = self._pins()
        self._place(np.append(robot.home, [0.5] * (len(self._channels) - robot.dof)))
        self._sink()

    # What a person in the room sees.

    @property
    def time(self) -> float:
        """[s] since it was made."""
        return self._clock.seconds

    @property
    def true_q(self) -> FloatArray:
        """(n,) where the joints really are now [rad, m]."""
        return self._now()[: self.robot.dof]

    @property
    def true_opening(self) -> float:
        """How far the gripper really is open, 0 closed … 1 open; 1 for an arm without one."""
        places = self._now()
        return float(places[self.robot.dof]) if len(places) > self.robot.dof else 1.0

    @property
    def commanded_pulses(self) -> FloatArray:
        """(32,) the pulses on the board's pins [µs]; NaN where there is none."""
        return _NOTHING.copy() if self.dark else self.board.pulses

    @property
    def channels(self) -> tuple[ChannelState, ...]:
        """(32) what each of the board's channels is doing."""
        return _UNKNOWN if self.dark else self.board.channels

    @property
    def resting(self) -> bool:
        """Whether nothing changes until bytes arrive or someone touches it: then time costs nothing."""
        return self._quiet >= _AT_REST and not self.board.busy and self._dark_until is None

    @property
    def dark(self) -> bool:
        """Whether the board is without power just now."""
        return self._dark_until is not None and self._clock.now < self._dark_until

    @property
    def vanished(self) -> bool:
        """Whether the port is gone."""
        return Fault.PORT_VANISHES in self._faults

    @property
    def faults(self) -> Faults:
        """What goes wrong; another value holds from now on."""
        return self._faults

    @faults.setter
    def faults(self, faults: Faults) -> None:
        begins = Fault.BROWN_OUT in faults and Fault.BROWN_OUT not in self._faults
        self._run_board(self._clock.now)
        self._faults = self.board.faults = faults
        self._wire.use(faults)
        self._quiet = 0
        if begins:
            self._brown_out(self._clock.now)

    # The port.

    def write(self, data: bytes) -> None:
        """Bytes arrive at the board now."""
        now = self._clock.now
        self._run_board(now)
        arrived = self._wire.to_board(data, now)
        if not arrived or self._dark_until is not None:
            return
        self.board.write(arrived)
        self._wire.from_board(self.board.read(), now)
        self._quiet = 0

    def read(self) -> bytes:
        """What the board's answers have brought to the port since the last call."""
        return self._wire.read(self._clock.now)

    # Time, and hands.

    def process(self, dt: float) -> None:
        """So much time passes [s].

        Raises:
            SettingError: dt is negative or no number.
        """
        until = self._clock.advance(dt)
        while self._next_frame <= until:
            if self.resting:
                self._next_frame = frame_after(until)
                return
            self._frame(self._next_frame)
            self._next_frame += FRAME_NS

    def power_cycle(self) -> None:
        """Someone switches the board off and on: all positions are forgotten, registers take effect."""
        self._run_board(self._clock.now)
        self._wire.clear()
        self.board.power_cycle()
        self._quiet = 0

    def put(self, q: ArrayLike) -> None:
        """A hand brings the limp joints to q (n,) [rad, m], within the end stops, and lets go; driven ones resist.

        Raises:
            ShapeError: q is not one number a joint.
        """
        wanted = np.asarray(q, dtype=np.float64)
        if wanted.shape != (self.robot.dof,):
            raise ShapeError("q", f"({self.robot.dof},)", wanted.shape)
        places = self._now()
        limp = ~np.isfinite(self._pulses[: self.robot.dof])
        places[: self.robot.dof][limp] = wanted[limp]
        self._place(places)

    # Inside. Frames come when they are due, not when `process` is called: the clock may be ahead of them.

    def _now(self) -> FloatArray:
        return self._places_at(self._clock.now)

    def _measured(self) -> FloatArray:
        return self._places_at(self._board_time)[: self.robot.dof]

    def _places_at(self, now: int) -> FloatArray:
        places, drive, since = self._motion
        return places_after(self._bank, places, drive, min(now - since, FRAME_NS) / NANO)

    def _pins(self) -> FloatArray:
        return (_NOTHING if self._dark_until is not None else self.board.pulses)[self._channels]

    def _place(self, places: FloatArray) -> None:
        """From now on the servos are there, and the present pulses act on them."""
        places = np.clip(places, self._bank.lower, self._bank.upper)
        self._motion = self._motion_from(places, self._clock.now)
        self._quiet = 0

    def _motion_from(self, places: FloatArray, now: int) -> Motion:
        return Motion(places, drive_of(self._bank, places, self._pulses, self._faults), now)

    def _sink(self) -> None:
        """Let go of the arm before anyone looks, until it lies still."""
        for _ in range(round(settling_time(self.robot) / FRAME)):
            places = self._places_at(FRAME_NS)
            if np.array_equal(places, self._motion.places):
                return
            self._place(places)

    def _frame(self, now: int) -> None:
        """What the servos did since the last frame, and what they do until the next: a pulse is seen a frame late."""
        self._run_board(now)
        pulses = self._pins()
        changed = pulses.tobytes() != self._pulses.tobytes()
        if changed or self._quiet < _AT_REST:
            self._move(now, pulses, changed)
        self._minds_supply(now, changed)

    def _move(self, now: int, pulses: FloatArray, changed: bool) -> None:
        places = self._places_at(now)
        stirred = places.tobytes() != self._motion.places.tobytes()
        self._motion = self._motion_from(places, now)
        self._pulses = pulses
        self._quiet = 0 if stirred or changed else self._quiet + 1

    def _minds_supply(self, now: int, changed: bool) -> None:
        """A weak supply breaks down under a move."""
        if not (changed or self.board.moving):
            return
        if now - self._moved_last > _PAUSE:
            self._move_began = now
        self._moved_last = now
        if changed and now - self._move_began >= DARK_AFTER * NANO and Fault.BROWN_OUT_IN_MOVE in self._faults:
            self._brown_out(now)

    def _brown_out(self, now: int) -> None:
        self._dark_until = now + round(DARKNESS * NANO)
        self._wire.clear()
        self.board.power_cycle()
        self._quiet = 0
        self._move_began = self._moved_last = -NANO

    def _run_board(self, now: int) -> None:
        """The board's time up to now; where a brown-out ends by then it starts again."""
        end = self._dark_until
        if end is not None and end <= now:
            self._run_board_only(end)
            self._dark_until = None
            self.board.power_cycle()
        self._run_board_only(now)

    def _run_board_only(self, now: int) -> None:
        if now > self._board_time:
            passed, self._board_time = now - self._board_time, now
            self.board.process(passed / NANO)
        answers = self.board.read()
        if self._dark_until is None:
            self._wire.from_board(answers, now)
