"""The talk with the board: what is said when, what is made of the answers, and the stop. No wire, thread or clock."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from rvsim.device.driver.belief import Belief
from rvsim.device.driver.language import Latched, Measured, Named, Noticed, Reported, Unfit
from rvsim.device.driver.languages import LanguageName, language_of
from rvsim.device.driver.motions import Following, Running
from rvsim.device.driver.orders import Order, Paces
from rvsim.device.driver.plan import shown
from rvsim.device.driver.state import DriverState, MeasuredKind, Phase
from rvsim.device.driver.watch import FORGOTTEN, Watch, disobeyed
from rvsim.device.driver.wire import Log, Wire, no_log
from rvsim.device.words import axis_name
from rvsim.language import tr, tr_later
from rvsim.playback.recording import Recorder, Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

Mode = Literal["disconnected", "connecting", "open", "stopped", "lost"]

_FRAME = 0.02  # [s] set-points come in whole servo frames
_SHARE = 0.7  # of a question has room between two set-points
_BUSY, _IDLE = 0.05, 0.1  # [s] between questions
_SETTLE = 1.0  # [s] a recording goes on after the end of its trajectory
_CREEP = 15.0  # raw: two reports after a stop that differ by more show that the stop did not arrive
_RECENT = 1.0  # [s] a report counts so long
_SILENT = tr_later(
    "The controller has not answered three times in a row. Is it switched on, is the cable in, is the baud rate right?"
)
_NOBODY = tr_later(
    "Nothing answers at this port. Is the controller switched on, is it this port, is the baud rate right?"
)
_GARBAGE = tr_later("What comes back at this port makes no sense. Is the baud rate right, and the language?")
_LATE = tr_later("The controller answers late; the arm waits for it.")


class Conversation:
    """One arm on one wire: `process` says what to write now, `urgent` what to write before it.

    Args:
        robot: with servos.
        language: "ssc32" or "bridge".
        baud: [bit/s] of the wire.
        potentiometers: the SSC-32's analog inputs are wired to the joints' potentiometers.
        log: is told of every line both ways, with its time [s].

    Raises:
        RobotDefinitionError: the arm has no servos, or one that allows no value of its joint.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        language: LanguageName = "ssc32",
        baud: int = 9600,
        potentiometers: bool = False,
        log: Log = no_log,
    ) -> None:
        self._robot, self._baud, self._log = robot, baud, log
        self._language = language_of(language, robot, potentiometers=potentiometers)
        self._m = self._language.axes
        self._paces = Paces(robot, self._m)
        self._recorder = Recorder(robot.dof)
        self._mode: Mode = "disconnected"
        self._reason = ""
        self._forget_all(0.0)

    def _forget_all(self, now: float) -> None:
        """As if nothing had ever been said to the board."""
        self._language.forget()
        self._wire = Wire(self._language, self._baud, self._log)
        self._wire.now = now
        self._belief, self._watch = Belief(self._m), Watch(self._m)
        self._motion: Following | Running | None = None
        self._orders: dict[str, Order] = {}
        self._recorded: Running | None = None
        self._due = 0.0
        self._board = self._notice = ""
        self._clamped: tuple[str, ...] = ()
        self._dropped = 0
        self._report = np.full(self._m, np.nan)
        self._reported_at = -math.inf
        self._rests: FloatArray | None = None  # where the board says the axes stand after a stop
        self._measured = np.full(self._m, np.nan)
        self._kind: MeasuredKind = "nothing"

    # --- what a window reads -----------------------------------------------------------------------------------------

    @property
    def robot(self) -> Robot:
        """With the servos in use."""
        return self._robot

    @property
    def limits(self) -> FloatArray:
        """(n, 2) what arm and servos both allow [rad, m]."""
        return self._language.limits[: self._robot.dof]

    @property
    def period(self) -> float:
        """Between two set-points [s]: what the wire carries, in whole servo frames."""
        count = self._language.set_point_bytes + _SHARE * self._language.question_bytes
        return _FRAME * math.ceil(self._wire.seconds(1) * count / _FRAME)

    @property
    def stride(self) -> float:
        """How long a set-point's move is told to take [s]: over when the next one comes.

        The board begins the next one where it was in the last servo frame. A move that was not over would fall behind.
        """
        return self.period - 0.5 * _FRAME if self.period > 1.5 * _FRAME else 0.001

    @property
    def recording(self) -> Recording:
        """Of the last trajectory, or of the one that runs."""
        return self._recorder.recording(self._kind)

    @property
    def wants_port(self) -> bool:
        """Whether the port is to be open."""
        return self._mode in ("connecting", "open", "stopped")

    @property
    def phase(self) -> Phase:
        """See `Phase`."""
        if self._mode != "open":
            return self._mode
        if self._motion is not None:
            return "running" if isinstance(self._motion, Running) else "streaming"
        if self._moving:
            return "moving"
        return "ready" if self._belief.awake.any() else "asleep"

    @property
    def _all_joints_awake(self) -> bool:
        return bool(self._belief.awake[: self._robot.dof].all())

    @property
    def _moving(self) -> bool:
        return bool(self._orders) or self._belief.moving(self._wire.now)

    @property
    def state(self) -> DriverState:
        """A snapshot."""
        n, awake = self._robot.dof, self._belief.awake.tolist()
        values = self._language.values(self._belief.at(self._wire.now))
        gripper = self._m > n
        run = self._motion if isinstance(self._motion, Running) else None
        return DriverState(
            phase=self.phase,
            commanded_q=values[:n],
            measured_q=self._measured[:n].copy(),
            awake=tuple(awake[:n]),
            reason=self._words(),
            board=self._board,
            gripper_awake=gripper and awake[n],
            measured_kind=self._kind,
            gripper=float(values[n]) if gripper else math.nan,
            clamped=self._clamped,
            time=run.shown(self._wire.now, self.period) if run else 0.0,
            duration=run.plan.duration if run else 0.0,
            latency=self._wire.questions.latency,
            sent_bytes=self._wire.sent,
            received_bytes=self._wire.received,
            dropped_setpoints=self._dropped,
        )

    def _words(self) -> str:
        if self._mode == "open" and self._wire.questions.overdue(self._wire.now):
            return tr(_LATE)
        return self._notice if self._mode == "open" and self._notice else self._reason

    # --- what an owner of a wire calls -------------------------------------------------------------------------------

    def process(self, now: float, received: bytes = b"") -> bytes:
        """Time passes to `now` [s], these bytes have come; what to write, never more than the wire carries."""
        if not self.wants_port:
            self._wire.now = max(now, self._wire.now)
            return b""
        first = self.urgent()
        for event in self._wire.hear(now, received):
            _HEARD[type(event)](self, event)
        if self._wire.missed():
            self._miss()
        self._end_motion()
        if self.wants_port and self._wire.free:
            self._speak()
        return (first or b"") + (b"" if self._wire.has_urgent else self._wire.take())

    def urgent(self) -> bytes | None:
        """What is to be written at once, after what waits in the system's buffers has been thrown away. Mostly None."""
        return self._wire.urgent()

    def last_words(self) -> bytes:
        """A stop for all axes, whatever this conversation has come to: for who must leave the arm without it."""
        return self._language.stop((True,) * self._m)[0]

    def lose(self, sentence: str) -> None:
        """The port is gone, or could not be opened."""
        now = self._wire.now
        self._forget_all(now)
        self._mode, self._reason = "lost", sentence

    # --- speaking ----------------------------------------------------------------------------------------------------

    def _speak(self) -> None:
        """One line at most: what follows a stop, orders, set-points, questions, in this order."""
        if self._wire.say_rest():
            return
        held = self._mode != "open" or self._wire.questions.overdue(self._wire.now)
        if not held and (self._say_order() or self._say_set_point()):
            return
        busy = self._motion is not None or self._moving
        if self._wire.questions.may_ask(self._wire.now, _BUSY if busy else _IDLE, not self._language.named_answers):
            self._wire.ask(self._language.poll() if self._board else self._language.hello())

    def _say_order(self) -> bool:
        if not self._orders:
            return False
        order = self._orders.pop(next(iter(self._orders)))
        if not order.wake and np.any(np.isfinite(order.raw) & ~self._belief.awake):
            return False  # it fell asleep meanwhile
        if order.limp is not None:
            self._wire.say(self._language.limp(order.limp))
            self._belief.sleep(order.limp)
            return True
        seconds = self._paces.seconds(self._ways(order.raw), order)
        line = (self._language.wake if order.wake else self._language.set_points)(order.raw, seconds)
        self._belief.send(order.raw, self._wire.say(line), seconds, self._wakes_at if order.wake else None)
        if order.wake:
            self._watch.woke(order.raw, self._wire.now, seconds)
        return True

    @property
    def _wakes_at(self) -> FloatArray:
        """(m,) raw: from where axes that wake begin; NaN where they jump."""
        sensed = self._language.raw(self._measured) if self._language.gentle else self._report
        return np.where(np.isfinite(self._report), self._report, sensed)

    def _ways(self, raw: FloatArray) -> FloatArray:
        """(m,) how far each axis has to go at most, in values: from where it should be, is reported, or measured."""
        goal = self._language.values(raw)
        ways = np.abs(goal - self._language.values(self._belief.at(self._wire.now)))
        if self._wire.now - self._reported_at < _RECENT:
            ways = np.fmax(ways, np.abs(goal - self._language.values(self._report)))
        if self._kind not in ("nothing", "commanded pulse"):
            ways = np.fmax(ways, np.abs(goal - self._measured))
        return np.asarray(ways)

    def _say_set_point(self) -> bool:
        now, period = self._wire.now, self.period
        if self._motion is None or now < self._due or not self._all_joints_awake:
            return False
        q = self._next_pose(self._motion, now, period)
        if q is None:
            return False
        raw = self._clamp(q)
        self._belief.send(raw, self._wire.say(self._language.set_points(raw, self.stride)), self.stride)
        self._due = self._due + period if now < self._due + period else now + period
        self._record(now)
        return True

    def _next_pose(self, motion: Following | Running, now: float, period: float) -> FloatArray | None:
        if isinstance(motion, Running):
            return motion.next(now, self._wire.seconds(self._language.set_point_bytes) + self.stride, period)
        here = self._language.values(self._belief.at(now))[: self._robot.dof]
        return motion.next(here, period)

    def _clamp(self, q: FloatArray) -> FloatArray:
        """Raw numbers (m,) of a pose (n,), held within what arm and servos allow; the gripper is left alone."""
        lower, upper = self.limits.T
        held = np.clip(q, lower, upper)
        names = self._robot.joint_names
        self._clamped = tuple(names[i] for i in np.flatnonzero(np.abs(held - q) > 1e-9))
        return self._language.raw(self._axes(held))

    def _axes(self, q: FloatArray) -> FloatArray:
        return np.concatenate([q, np.full(self._m - len(q), np.nan)])

    # --- time --------------------------------------------------------------------------------------------------------

    def _end_motion(self) -> None:
        motion, moving = self._motion, self._belief.moving(self._wire.now)
        if motion is not None and not self._all_joints_awake:
            self._motion = motion = None
        over = motion.over(moving) if isinstance(motion, Running) else motion and motion.over(self._wire.now, moving)
        if over:
            self._motion = None
        if self._recorded and self._recorded.time(self._wire.now, self.period) > self._recorded.plan.duration + _SETTLE:
            self._recorded = None

    def _record(self, time: float, measured: FloatArray | None = None) -> None:
        """A row of the recording, of a moment that has just been."""
        if self._recorded is None:
            return
        t = self._recorded.time(time, self.period)
        commanded = self._language.values(self._belief.at(time))[: self._robot.dof]
        self._recorder.add(t, self._recorded.plan.q(t), commanded, measured)

    # --- stopping ----------------------------------------------------------------------------------------------------

    def _latch(self, reason: str, *, asleep: bool = False) -> None:
        """Nothing more is sent to servos but STOP. The first reason stays until the reset.

        Args:
            asleep: the board knows no positions any more.
        """
        here = self._belief.at(self._wire.now)
        awake = self._belief.awake.tolist()
        self._belief.hold(np.full(self._m, np.nan) if asleep else here)
        self._motion, self._recorded, self._rests, self._clamped = None, None, None, ()
        self._orders.clear()
        if self._mode != "stopped":
            self._mode, self._reason = "stopped", reason
        self._wire.cut(self._language.stop(awake))

    def _miss(self) -> None:
        """An answer did not come."""
        if not self._wire.questions.silent:
            return
        if self._mode == "connecting":
            self.lose(tr(_GARBAGE if self._wire.received else _NOBODY))
        elif self._mode == "open":
            self._latch(tr(_SILENT))

    # --- hearing -----------------------------------------------------------------------------------------------------

    def _hear_name(self, event: Named) -> None:
        self._board = event.text

    def _hear_report(self, event: Reported) -> None:
        self._report, self._reported_at = event.raw, self._wire.now
        if self._kind in ("nothing", "commanded pulse"):
            self._take(self._language.values(event.raw), "commanded pulse")
        if self._mode == "connecting":
            self._open()
        elif self._mode == "stopped":
            self._check_rest(event.raw)
        else:
            self._check_report(event.raw)

    def _hear_measurement(self, event: Measured) -> None:
        self._take(event.values, event.kind)
        if self._mode == "connecting" and math.isfinite(self._reported_at):
            self._open()

    def _open(self) -> None:
        """Connected when everything that can be known is known."""
        if self._kind != "commanded pulse" or not self._language.gentle:
            self._mode = "open"

    def _take(self, values: FloatArray, kind: MeasuredKind) -> None:
        self._measured, self._kind = values, kind
        self._record(min(self._wire.questions.reached_at, self._wire.now), values[: self._robot.dof])

    def _hear_notice(self, event: Noticed) -> None:
        self._notice = event.sentence

    def _hear_latched(self, event: Latched) -> None:
        if self._mode == "open":
            self._latch(event.sentence)

    def _hear_unfit(self, event: Unfit) -> None:
        self.lose(event.sentence)

    def _check_report(self, raw: FloatArray) -> None:
        asked, now = self._wire.questions.asked_at, self._wire.now
        if self._watch.forgotten(self._belief, raw, asked):
            self._latch(tr(FORGOTTEN), asleep=True)
            return
        axis = self._watch.astray(self._belief, raw, asked, now, self._language.tolerance)
        if axis is not None:
            name = axis_name(self._robot, axis)
            self._latch(disobeyed(name, *(self._shown(axis, of) for of in (self._belief.at(now), raw))))

    def _shown(self, axis: int, raw: FloatArray) -> str:
        value = float(self._language.values(raw)[axis])
        return (
            shown(self._robot, axis, value)
            if axis < self._robot.dof
            else tr("{percent:.0f} % open", percent=100.0 * value)
        )

    def _check_rest(self, raw: FloatArray) -> None:
        """After a stop: where the axes stand. Where they still move the stop has not arrived, and is said again.

        Who has cut the power meanwhile has a board that knows no positions: those axes are asleep.
        """
        if self._wire.questions.asked_at < self._wire.cut_until:
            return
        for axis in np.flatnonzero(self._belief.awake & np.isnan(raw)).tolist():
            self._belief.sleep(axis)
        if self._rests is None:
            self._rests = raw
            self._belief.hold(np.where(self._belief.awake, raw, np.nan))
        elif np.any(np.abs(raw - self._rests) > _CREEP):
            self._latch(self._reason)


_HEARD: dict[type, Callable[[Conversation, Any], None]] = {
    Named: Conversation._hear_name,
    Reported: Conversation._hear_report,
    Measured: Conversation._hear_measurement,
    Noticed: Conversation._hear_notice,
    Latched: Conversation._hear_latched,
    Unfit: Conversation._hear_unfit,
}
