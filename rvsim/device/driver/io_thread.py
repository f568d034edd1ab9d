"""The driver at a real port: one thread that reads, writes and keeps time, whatever a window does meanwhile."""

from __future__ import annotations

import atexit
import contextlib
import logging
import re
import sys
import threading
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, ClassVar, Self

import serial
from numpy.typing import ArrayLike

import rvsim.device  # so that pyserial knows al5b://  # noqa: F401
from rvsim.device.driver import actions
from rvsim.device.driver.actions import Action, Axis, Playable, Refusal
from rvsim.device.driver.core import DriverCore
from rvsim.device.driver.languages import LanguageName
from rvsim.device.driver.outbox import BITS
from rvsim.device.driver.state import DriverState
from rvsim.device.link.real_time import WallClock
from rvsim.device.wire_log import WireLog
from rvsim.language import left_to_right, tr
from rvsim.playback.recording import Recording
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.arrays import FloatArray

if TYPE_CHECKING:
    from rvsim.device.virtual.arm import VirtualArm

_logger = logging.getLogger(__name__)

_TICK, _IDLE_TICK = 0.004, 0.02  # [s] between looks at the port: while the arm may move, and otherwise
_SWITCH = 0.001  # [s] so soon a busy window lets this thread in; the interpreter's own 5 ms are felt at each step
_WRITE_TIMEOUT = 0.2  # [s] pieces are so small that a port which does not take one in this time is stuck
_BUFFERED = 0.05  # [s] what is written may lie in an adapter before it goes over the wire
_CLOSING, _CLOSING_OPENING = 3.0, 0.2  # [s] a close waits for the thread at most; for one that only opens a port
_MOST_READ = 4096  # bytes


class ArmDriver:
    """An arm at a port. Every method may be called from any thread and returns at once; `state` is what is known.

    Methods that ask for something return None, or a `Refusal` whose sentence says why not.

    Args:
        robot: with servos.
        url: what pyserial opens: "COM3", "/dev/ttyUSB0", "al5b://", "socket://host:port", "rfc2217://host:port".
        baud: [bit/s].
        language: "ssc32" or "bridge".
        potentiometers: the SSC-32's analog inputs are wired to the joints' potentiometers.
        log: where every line goes; a new one if none is given.

    Raises:
        RobotDefinitionError: the arm has no servos, or one that allows no value of its joint.
    """

    clock: ClassVar[WallClock] = WallClock()

    def __init__(
        self,
        robot: Robot,
        url: str = "al5b://",
        *,
        baud: int = 9600,
        language: LanguageName = "ssc32",
        potentiometers: bool = False,
        log: WireLog | None = None,
    ) -> None:
        self.url, self.baud, self.language = url, baud, language
        self.log = WireLog() if log is None else log
        self._core = DriverCore(robot, language=language, baud=baud, potentiometers=potentiometers, log=self.log.add)
        # One lock, and who holds it may take it again: a condition in `wait` may ask for something.
        self._lock, self._wake = threading.Condition(threading.RLock()), threading.Event()
        self._state = self._core.state
        self._began = self.clock.now()
        self._port: Any = None
        self._arm: VirtualArm | None = None
        self._through = 0.0  # when what has been written will have gone over the wire [s]
        self._closing = False
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, _: TracebackType | None
    ) -> None:
        self.close()

    # --- to be read at any time ----------------------------------------------------------------------------------

    @property
    def state(self) -> DriverState:
        """What the driver knows; a value that costs nothing to read."""
        return self._state

    @property
    def robot(self) -> Robot:
        """With the servos in use."""
        return self._core.robot

    @property
    def limits(self) -> FloatArray:
        """(n, 2) what arm and servos both allow [rad, m]."""
        return self._core.limits

    @property
    def recording(self) -> Recording:
        """Of the trajectory that runs, or of the last one; a copy that stays as it is."""
        with self._lock:
            return self._core.recording

    @property
    def virtual(self) -> VirtualArm | None:
        """The arm behind an `al5b://` port, for its faults and its true pose; None at other ports."""
        return self._arm

    def wait(self, until: Callable[[DriverState], bool], seconds: float) -> bool:
        """Block until a state fulfils a condition, at most so many seconds; whether it does. Not for a window."""
        with self._lock:
            return self._lock.wait_for(lambda: until(self._state), seconds)

    # --- to be asked for -------------------------------------------------------------------------------------------

    def connect(self) -> Refusal | None:
        """Open the port and ask the board for its name. Nothing moves. Also after the port was lost."""
        if self._closing:
            return Refusal(tr("This driver has been closed."))
        refusal = self._do(actions.Connect())
        if self._thread is None:
            self._thread = threading.Thread(target=self._live, name=f"arm at {self.url}", daemon=True)
            self._thread.start()
            atexit.register(self.close)
        return refusal

    def disconnect(self) -> Refusal | None:
        """Stop what moves and close the port; the servos hold."""
        return self._do(actions.Disconnect())

    def wake(self, axis: Axis, value: float) -> Refusal | None:
        """The first move of a joint (from 0) or "gripper", at full speed, to q [rad, m] or an opening."""
        return self._do(actions.Wake(axis, value))

    def move_to(self, q: ArrayLike, seconds: float | None = None) -> Refusal | None:
        """All joints together to q (n,) [rad, m]."""
        return self._do(actions.MoveTo(q, seconds))

    def stream(self, q: ArrayLike) -> Refusal | None:
        """Follow: the newest q (n,) counts."""
        return self._do(actions.Stream(q))

    def run(self, trajectory: Playable, *, approach: bool = False) -> Refusal | None:
        """Follow a trajectory, from its start or after a calm way there."""
        plan = self._core.plan(trajectory)  # takes a while for a long one: not while the thread would have to wait
        return plan if isinstance(plan, Refusal) else self._do(actions.Run(plan, approach))

    def hold(self) -> Refusal | None:
        """End what moves, without latching anything."""
        return self._do(actions.Hold())

    def grip(self, opening: float, seconds: float | None = None) -> Refusal | None:
        """The gripper to an opening, 0 closed … 1 open."""
        return self._do(actions.Grip(opening, seconds))

    def jog_pulse(self, channel: int, pulse_us: float, seconds: float | None = None) -> Refusal | None:
        """One awake channel to a pulse [µs], for calibration."""
        return self._do(actions.JogPulse(channel, pulse_us, seconds))

    def limp(self, axis: Axis) -> Refusal | None:
        """Switch a joint (from 0) or "gripper" off."""
        return self._do(actions.Limp(axis))

    def stop(self, reason: str = actions.PRESSED) -> Refusal | None:
        """The emergency stop. Latches."""
        return self._do(actions.StopAll(reason))

    def reset(self) -> Refusal | None:
        """Leave the latched stop. Nothing moves."""
        return self._do(actions.Reset())

    def use_servos(self, servos: Sequence[Servo], gripper_servo: GripperServo | None) -> Refusal | None:
        """Another calibration."""
        return self._do(actions.UseServos(servos, gripper_servo))

    def close(self) -> None:
        """Stop what moves, close the port and end the thread; waits for it, a fraction of a second as a rule."""
        self._do(actions.Disconnect())  # first: a thread that is to end without a stop to say would end silently
        self._closing = True
        thread = self._thread
        if thread is not None and thread is not threading.current_thread():
            thread.join(_CLOSING if self._port is not None else _CLOSING_OPENING)
        atexit.unregister(self.close)

    def _do(self, action: Action) -> Refusal | None:
        with self._lock:
            refusal = self._core.do(action)
            self._publish()
        self._wake.set()
        return refusal

    def _publish(self) -> None:
        self._state = self._core.state
        self._lock.notify_all()

    # --- the thread ----------------------------------------------------------------------------------------------

    def _live(self) -> None:
        usual = sys.getswitchinterval()
        sys.setswitchinterval(min(usual, _SWITCH))
        try:
            self._take_turns()
        finally:
            sys.setswitchinterval(usual)

    def _take_turns(self) -> None:
        while not (self._closing and self._port is None):
            try:
                self._turn()
            except (serial.SerialException, OSError) as problem:
                self._lose(
                    tr("The port {port} is lost: {problem}", port=self.url, problem=_said_once(problem, self.url))
                )
            except Exception as problem:  # whatever it is: the arm must not be left without a driver
                _logger.exception("the driver's thread")
                self._stop_without_core()
                self._lose(
                    tr("Something went wrong inside the driver: {problem!r}. The port is closed.", problem=problem)
                )
            idle = self._state.phase in ("disconnected", "lost")
            self.clock.wait(self._wake, _IDLE_TICK if idle else _TICK)
            self._wake.clear()

    def _turn(self) -> None:
        wanted = self._core.wants_port and not self._closing
        if wanted and self._port is None:
            self._open()
        elif not wanted and self._port is not None:
            self._leave()
        if self._port is not None:
            self._exchange()

    def _open(self) -> None:
        try:
            port = serial.serial_for_url(
                self.url, baudrate=self.baud, timeout=0, write_timeout=_WRITE_TIMEOUT, exclusive=True
            )
            port.reset_input_buffer()
        except (serial.SerialException, OSError, ValueError, ImportError) as problem:
            self._lose(
                tr(
                    "The port {port} cannot be opened: {problem}",
                    port=self.url,
                    problem=_said_once(problem, self.url),
                )
            )
            return
        self._port, self._arm = port, getattr(port, "arm", None)

    def _exchange(self) -> None:
        self._write_urgent()
        now = self.clock.now()  # before it listens: what has come by then is not called late
        received = self._port.read(_MOST_READ)
        if self.clock.now() - now > _TICK:  # held up meanwhile: of an old moment set-points would follow too closely
            now = self.clock.now()
            received += self._port.read(_MOST_READ)
        with self._lock:
            out = self._core.process(now - self._began, received)
            self._publish()
        # A stop that came just now threw away what waits: these bytes too.
        if not self._write_urgent() and out:
            self._write(out)

    def _write_urgent(self) -> bool:
        with self._lock:
            first = self._core.urgent()
        if first is not None:
            self._write_at_once(first)
        return first is not None

    def _write_at_once(self, data: bytes) -> None:
        with contextlib.suppress(Exception):  # not every port can call bytes back, each must carry the stop
            self._port.reset_output_buffer()
        self._write(data)

    def _write(self, data: bytes) -> None:
        self._port.write(data)
        self._through = max(self._through, self.clock.now()) + len(data) * BITS / self.baud

    def _leave(self) -> None:
        """Let a last stop out, then close: a port that is closed may throw away what it has not sent."""
        with contextlib.suppress(Exception):  # it may be gone already
            self._write_urgent()
            left = self._through - self.clock.now()
            if left > 0.0:
                self.clock.sleep(left + _BUFFERED)
        self._close_port()

    def _stop_without_core(self) -> None:
        with contextlib.suppress(Exception):
            self._write_at_once(self._core.last_words())
        self._leave()

    def _lose(self, sentence: str) -> None:
        with self._lock:
            if self._core.wants_port:
                self._core.lose(sentence)
            self._core.urgent()  # nobody is there who could hear it
            self._publish()
        self._close_port()

    def _close_port(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            with contextlib.suppress(Exception):  # a port that is gone cannot be closed either
                port.close()


def _said_once(problem: Exception, url: str) -> str:
    """What is wrong, without the port's name, which the sentence has said already."""
    text = str(problem)
    if isinstance(problem, OSError) and problem.strerror:
        text = problem.strerror
    text = re.sub(rf"^could not open port '?{re.escape(url)}'?: ", "", text, flags=re.IGNORECASE)
    text = text.removeprefix(f"{url}: ").removeprefix(f"{left_to_right(url)}: ")
    text = re.sub(r"^\[Errno \d+\] ", "", text).removesuffix(f": '{url}'")
    return text if text.endswith(".") else f"{text}."
