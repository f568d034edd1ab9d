"""The driver without wires, threads and clocks: actions and bytes in, bytes out.

What it promises: nothing moves when it connects; a channel's first move is a `Wake`; what is planned outside the limits
is refused, what is streamed is held at them; a stop throws away what was to be written, goes first, and latches.

What goes wrong, and what it does then:
    no answer three times        the stop latches; `Reset` needs an answer first
    answers come late            set-points wait for them; a trajectory's time waits too
    split, doubled, wrong bytes  the codec sorts them out; a question that stays open counts as unanswered
    the board forgot (brown-out) the stop latches, and every channel is asleep again
    the board does otherwise     the stop latches: what it reports is far from what it was told, three times in a row
    the port has gone            "lost", all asleep; `Connect` begins anew
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.driver import actions
from rvsim.device.driver.actions import Action, Axis, Playable, Refusal
from rvsim.device.driver.belief import Belief
from rvsim.device.driver.conversation import Conversation, Mode
from rvsim.device.driver.motions import Following, Running
from rvsim.device.driver.orders import LONGEST, Order, Paces
from rvsim.device.driver.plan import Plan, approach_of, far_start, outside, plan_of
from rvsim.device.driver.watch import Watch
from rvsim.device.words import axis_name, in_a_row
from rvsim.errors import RobotDefinitionError
from rvsim.language import tr, tr_later, trn
from rvsim.robot.arrays import FloatArray

_NOT_OPEN: dict[Mode, str] = {
    "disconnected": tr_later("No arm is connected. Connect first."),
    "connecting": tr_later("The controller has not answered yet. Wait a moment."),
    "stopped": tr_later("The stop has latched. Reset it first."),
    "lost": tr_later("The port is lost. Connect again."),
}
_BUSY_RUNNING = tr_later("A trajectory is under way. Hold it first.")
_BUSY_MOVING = tr_later("The arm is still moving. Wait until it has arrived, or hold it.")


class DriverCore(Conversation):
    """A conversation that can be asked for something: `do` takes an action and says why not, if not.

    Refused is what is wrong or dangerous, in a sentence; nothing raises.
    """

    def do(self, action: Action) -> Refusal | None:
        """Ask for something. None: it will be done; else why not."""
        return _DEEDS[type(action)](self, action)

    def plan(self, trajectory: Playable) -> Plan | Refusal:
        """The trajectory looked at once and checked; takes a while for a long one, changes nothing, and can be run."""
        if isinstance(trajectory, Plan):
            return outside(self._robot, self.limits, trajectory.poses, trajectory.times) or trajectory
        return plan_of(trajectory, self._robot, self.limits)

    # --- who may ---------------------------------------------------------------------------------------------------

    def _closed(self) -> Refusal | None:
        return Refusal(tr(_NOT_OPEN[self._mode])) if self._mode != "open" else None

    def _asleep(self, axes: Sequence[int]) -> Refusal | None:
        """Why these axes cannot be moved."""
        names = [self._name(axis) for axis in axes if not self._belief.awake[axis]]
        if self._mode != "open" or not names:
            return self._closed()
        return Refusal(
            trn(
                "{joints} is asleep. Wake them one after the other first.",
                "{joints} are asleep. Wake them one after the other first.",
                len(names),
                joints=in_a_row(names),
            )
        )

    def _name(self, axis: int) -> str:
        return axis_name(self._robot, axis)

    def _axis(self, axis: Axis) -> int | Refusal:
        """The number of an axis."""
        n = self._robot.dof
        if axis == "gripper":
            return n if self._m > n else Refusal(tr("This arm has no gripper that can be driven."))
        known = isinstance(axis, int | np.integer) and 0 <= axis < n
        return (
            int(axis)
            if known
            else Refusal(tr("There is no joint {number!r}; they count from 0 to {last}.", number=axis, last=n - 1))
        )

    def _pose(self, q: ArrayLike) -> FloatArray | Refusal:
        """A pose (n,) of finite numbers."""
        n = self._robot.dof
        try:
            values = np.array(q, dtype=np.float64)
        except (TypeError, ValueError):
            return Refusal(tr("The pose is no list of numbers."))
        if values.shape != (n,):
            return Refusal(
                tr("The pose has the shape {shape}, the arm has {count} joints.", shape=values.shape, count=n)
            )
        return values if np.isfinite(values).all() else Refusal(tr("The pose has a number that is none, or infinite."))

    def _only(self, axis: int, value: float) -> FloatArray:
        """(m,) NaN but for one axis."""
        values = np.full(self._m, np.nan)
        values[axis] = value
        return values

    # --- deeds -------------------------------------------------------------------------------------------------------

    def _connect(self, _: actions.Connect) -> Refusal | None:
        if self.wants_port:
            return Refusal(tr("The arm is connected already. Disconnect first."))
        if self._wire.has_urgent:
            return Refusal(tr("The last stop is still on its way. Connect in a moment."))
        self._forget_all(self._wire.now)
        self._mode, self._reason = "connecting", ""
        return None

    def _disconnect(self, _: actions.Disconnect) -> Refusal | None:
        if self.wants_port and (self._moving or self._motion is not None):
            self._latch(tr("Disconnected while the arm moved."))
        self._belief = Belief(self._m)
        self._motion, self._recorded = None, None
        self._orders.clear()
        self._mode, self._reason = "disconnected", ""
        return None

    def _wake(self, action: actions.Wake) -> Refusal | None:
        axis = self._axis(action.axis)
        if isinstance(axis, Refusal):
            return axis
        if (refusal := self._closed()) is not None:
            return refusal
        if self._moving or self._motion is not None:
            return Refusal(tr(_BUSY_MOVING))
        if self._belief.awake[axis]:
            return Refusal(tr("{joint} is awake already.", joint=self._name(axis)))
        if (refusal := self._beyond(axis, action.value)) is not None:
            return refusal
        self._orders[f"wake {axis}"] = Order(self._language.raw(self._only(axis, action.value)), wake=True)
        return None

    def _beyond(self, axis: int, value: float) -> Refusal | None:
        """Why an axis is not sent to a value."""
        if axis >= self._robot.dof:
            good = isinstance(value, int | float | np.number) and 0.0 <= value <= 1.0
            return (
                None
                if good
                else Refusal(tr("The gripper goes from 0 (closed) to 1 (open), not to {opening}.", opening=value))
            )
        pose = np.clip(self._robot.home, *self.limits.T)
        try:
            pose[axis] = value
        except (TypeError, ValueError):
            return Refusal(tr("{typed!r} is no number.", typed=value))
        return outside(self._robot, self.limits, pose[None])

    def _move_to(self, action: actions.MoveTo) -> Refusal | None:
        q = self._pose(action.q)
        if isinstance(q, Refusal):
            return q
        refusal = self._asleep(range(self._robot.dof)) or _bad_time(action.seconds)
        refusal = refusal or outside(self._robot, self.limits, q[None])
        if refusal is None and isinstance(self._motion, Running):
            refusal = Refusal(tr(_BUSY_RUNNING))
        if refusal is None:
            self._motion, self._clamped = None, ()
            self._orders["joints"] = Order(self._language.raw(self._axes(q)), action.seconds)
        return refusal

    def _stream(self, action: actions.Stream) -> Refusal | None:
        q = self._pose(action.q)
        if isinstance(q, Refusal):
            return q
        refusal = self._asleep(range(self._robot.dof))
        if refusal is None and isinstance(self._motion, Running):
            refusal = Refusal(tr(_BUSY_RUNNING))
        if refusal is not None:
            return refusal
        self._orders.pop("joints", None)
        if not isinstance(self._motion, Following):
            self._motion = Following(self._paces.calm[: self._robot.dof])
        self._dropped += self._motion.follow(q)
        return None

    def _run(self, action: actions.Run) -> Refusal | None:
        refusal = self._asleep(range(self._robot.dof))
        if refusal is None and (self._moving or self._motion is not None):
            refusal = Refusal(tr(_BUSY_RUNNING if isinstance(self._motion, Running) else _BUSY_MOVING))
        plan = refusal or self.plan(action.trajectory)
        if isinstance(plan, Refusal):
            return plan
        here = self._language.values(self._belief.goal)[: self._robot.dof]
        if action.approach:
            plan = plan.after(approach_of(self._robot, here, plan.poses[0]))
        elif (refusal := far_start(self._robot, here, plan.poses[0])) is not None:
            return refusal
        self._motion = self._recorded = Running(plan)
        self._recorder.clear(plan.duration)
        return None

    def _hold(self, _: actions.Hold) -> Refusal | None:
        if (refusal := self._closed()) is not None:
            return refusal
        followed = self._motion is not None
        self._motion, self._clamped = None, ()
        moved = self._moving and not followed
        waking = any(order.wake for order in self._orders.values())
        self._orders.clear()
        if moved and not waking:
            self._orders["hold"] = Order(self._belief.at(self._wire.now), self.period)
        return None

    def _grip(self, action: actions.Grip) -> Refusal | None:
        axis = self._axis("gripper")
        if isinstance(axis, Refusal):
            return axis
        refusal = self._asleep([axis]) or _bad_time(action.seconds) or self._beyond(axis, action.opening)
        if refusal is None:
            raw = self._language.raw(self._only(axis, action.opening))
            self._orders["gripper"] = Order(raw, action.seconds)
        return refusal

    def _jog(self, action: actions.JogPulse) -> Refusal | None:
        if not _finite(action.pulse_us):
            return Refusal(tr("The pulse is no number."))
        found = self._language.jogged(action.channel, action.pulse_us)
        if isinstance(found, str):
            return Refusal(found)
        axis, raw = found
        refusal = self._asleep([axis]) or _bad_time(action.seconds)
        if refusal is None and self._motion is not None:
            refusal = Refusal(tr(_BUSY_RUNNING))
        if refusal is None:
            self._orders[f"jog {axis}"] = Order(self._only(axis, raw), action.seconds)
        return refusal

    def _limp(self, action: actions.Limp) -> Refusal | None:
        axis = self._axis(action.axis)
        if isinstance(axis, Refusal):
            return axis
        if (refusal := self._closed()) is not None:
            return refusal
        self._motion, self._clamped = None, ()
        self._orders.clear()
        self._orders[f"limp {axis}"] = Order(np.full(self._m, np.nan), limp=axis)
        return None

    def _stop(self, action: actions.StopAll) -> Refusal | None:
        if not self.wants_port:
            return self._closed()
        self._latch(tr(action.reason))
        return None

    def _reset(self, _: actions.Reset) -> Refusal | None:
        if self._mode != "stopped":
            return self._closed() or Refusal(tr("Nothing is stopped."))
        if self._rests is None or self._wire.questions.overdue(self._wire.now):
            return Refusal(
                tr("The controller has not answered since the stop. Look at its supply and its cable first.")
            )
        self._mode, self._reason = "open", ""
        self._wire.follow(self._language.clear())
        return None

    def _use_servos(self, action: actions.UseServos) -> Refusal | None:
        if self._moving or self._motion is not None:
            return Refusal(tr(_BUSY_MOVING))
        if len(action.servos) != self._robot.dof:
            return Refusal(
                tr("{servos} servos for {joints} joints.", servos=len(action.servos), joints=self._robot.dof)
            )
        try:
            robot = replace(self._robot, servos=tuple(action.servos), gripper_servo=action.gripper_servo)
            same = self._language.use(robot)
        except RobotDefinitionError as problem:
            return Refusal(str(problem))
        self._robot = robot
        if not same:
            self._rewired()
        return None

    def _rewired(self) -> None:
        """Channels mean other axes now: all are asleep, and what was asked meant the old ones."""
        self._m = self._language.axes
        self._paces = Paces(self._robot, self._m)
        self._belief, self._watch, self._rests = Belief(self._m), Watch(self._m), None
        self._report = self._measured = np.full(self._m, np.nan)
        self._reported_at, self._kind = -math.inf, "nothing"
        self._wire.ignore()


def _finite(value: object) -> bool:
    return isinstance(value, int | float | np.number) and math.isfinite(float(value))


def _bad_time(seconds: float | None) -> Refusal | None:
    if seconds is None or (_finite(seconds) and 0.0 <= seconds <= LONGEST):
        return None
    return Refusal(tr("A move takes from 0 to {longest:g} s, not {seconds} s.", longest=LONGEST, seconds=seconds))


_DEEDS: dict[type, Callable[[DriverCore, Any], Refusal | None]] = {
    actions.Connect: DriverCore._connect,
    actions.Disconnect: DriverCore._disconnect,
    actions.Wake: DriverCore._wake,
    actions.MoveTo: DriverCore._move_to,
    actions.Stream: DriverCore._stream,
    actions.Run: DriverCore._run,
    actions.Hold: DriverCore._hold,
    actions.Grip: DriverCore._grip,
    actions.JogPulse: DriverCore._jog,
    actions.Limp: DriverCore._limp,
    actions.StopAll: DriverCore._stop,
    actions.Reset: DriverCore._reset,
    actions.UseServos: DriverCore._use_servos,
}
