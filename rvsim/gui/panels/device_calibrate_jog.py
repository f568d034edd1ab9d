"""The pulses of the arm's servos while it is calibrated: where each is, and going elsewhere slowly."""

from __future__ import annotations

import math

from rvsim.device.driver.state import DriverState
from rvsim.gui.device_control import DeviceControl
from rvsim.language import tr
from rvsim.robot import GripperServo, Robot, Servo

Part = int | None  # a joint (from 0), or the gripper
_PACE = 300.0  # [µs/s], some 30°/s: slow enough to stop in time where a sign is wrong
_QUICKEST = 0.1  # [s]
_SAME_US = 0.6  # pulses are whole µs
_SAME_OPENING = 1e-3
_PATIENCE = 15  # looks at an arm at rest until somebody else must have moved it


def seconds_between(from_us: float, to_us: float) -> float:
    """How long a servo is given from one pulse to another [µs] while nobody knows its sign [s]."""
    return max(abs(to_us - from_us) / _PACE, _QUICKEST) if math.isfinite(from_us) else _QUICKEST


def servo_of(robot: Robot, part: Part) -> Servo | GripperServo:
    """What a part hangs on."""
    if part is not None:
        return robot.servos[part]
    assert robot.gripper_servo is not None
    return robot.gripper_servo


def pulse_for(servo: Servo | GripperServo, value: float) -> float:
    """The pulse [µs] of a joint's value [rad, m] or of an opening."""
    return servo.pulse(value) if isinstance(servo, GripperServo) else servo.zero_us + servo.gain * value


class Jog:
    """What was asked for counts as the pulse at once, so that quick nudges add up."""

    def __init__(self, device: DeviceControl) -> None:
        self._device = device
        self._goals: dict[Part, float] = {}
        self._looks: dict[Part, int] = {}

    def pulse(self, part: Part) -> float:
        """Where the servo is, or is going [µs]; NaN while it sleeps."""
        known = self._known(part)
        return self._goals.get(part, known) if math.isfinite(known) else math.nan

    def go(self, part: Part, pulse_us: float, seconds: float | None = None) -> str:
        """Go to a pulse [µs], slowly; why not, or ""."""
        driver = self._device.driver
        if driver is None:
            return tr("No arm is connected.")
        self._device.set_live(False)
        seconds = seconds_between(self.pulse(part), pulse_us) if seconds is None else seconds
        refusal = driver.jog_pulse(servo_of(driver.robot, part).channel, pulse_us, seconds)
        if refusal is not None:
            return refusal.sentence
        self._goals[part], self._looks[part] = float(round(pulse_us)), 0
        return ""

    def go_all(self, pulses_us: dict[Part, float]) -> str:
        """Several at once, as slowly as the one with the longest way; the first that is refused says why."""
        longest = max((seconds_between(self.pulse(part), us) for part, us in pulses_us.items()), default=_QUICKEST)
        problems = [self.go(part, us, longest) for part, us in pulses_us.items()]
        return next(filter(None, problems), "")

    def follow(self, state: DriverState | None) -> None:
        """Forget what has been reached, what a stop has ended, and what others have changed."""
        if state is None or not state.connected or state.phase == "stopped":
            self._goals.clear()
            return
        for part in list(self._goals):
            if self._is_over(part, state):
                del self._goals[part]

    def _is_over(self, part: Part, state: DriverState) -> bool:
        known, goal = self._known(part), self._goals[part]
        if math.isnan(known) or (part is not None and abs(known - goal) < _SAME_US):
            return True
        self._looks[part] = 0 if state.busy or self._is_there(part, goal, state) else self._looks[part] + 1
        return self._looks[part] > _PATIENCE

    def _is_there(self, part: Part, goal: float, state: DriverState) -> bool:
        """The gripper's state says 0 or 1 for all pulses beyond: the goal is the better number."""
        driver = self._device.driver
        if part is not None or driver is None or driver.robot.gripper_servo is None:
            return False
        return abs(driver.robot.gripper_servo.opening(goal) - state.gripper) < _SAME_OPENING

    def _known(self, part: Part) -> float:
        driver, state = self._device.driver, self._device.state
        if driver is None or state is None or (part is None and driver.robot.gripper_servo is None):
            return math.nan
        value = state.gripper if part is None else float(state.commanded_q[part])
        return math.nan if math.isnan(value) else pulse_for(servo_of(driver.robot, part), value)
