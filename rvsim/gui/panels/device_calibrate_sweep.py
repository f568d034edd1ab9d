"""Calibration without hands, where the real angles of the joints can be seen: each joint sweeps gently, then a fit."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from PySide6.QtCore import QObject, Signal

from rvsim.device.calibrate import CalibrationWizard, Objection, fit_from_samples, sag_of
from rvsim.device.words import axis_name
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.device_calibrate_flow import at_part, current_part, left_over, pose_steps, with_fit
from rvsim.gui.panels.device_calibrate_jog import Jog, Part, pulse_for, seconds_between
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray

_STEPS = 5  # from one pose to the other
_SAMPLES = 2 * _STEPS - 1  # there and back
_MARGIN = 0.1  # of the way, kept at both ends: a stop of the real servo may lie before the pose
_REST = 0.6  # [s] a sample, until the arm has come to rest and been looked at
_STILL = 1e-4  # [rad, m] between two looks
_LOOKS = 4  # in a row without a change: the arm stands
_STOPPED = tr_later("The automatic calibration has ended: the arm was stopped.")
_CANCELLED = tr_later("The automatic calibration was cancelled; what it has found stays.")
_LOST = tr_later("The automatic calibration has ended: nothing can be measured any more.")

Eyes = Callable[[], FloatArray | None]


@dataclass(eq=False)
class _Joint:
    """The joint that sweeps: pulses still to be visited, and what was seen at those that were."""

    joint: int
    pulses: Iterator[float]
    at: list[float] = field(default_factory=list)
    seen: list[float] = field(default_factory=list)


class Sweep(QObject):
    """Goes through the joints that a wizard has left, each between its two poses; the gripper is left to hands.

    Signals:
        advanced(wizard): another joint has been found.
        ended(sentence): it is over; the sentence says how.
    """

    advanced = Signal(object)
    ended = Signal(str)

    def __init__(self, device: DeviceControl, jog: Jog, eyes: Eyes, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._device, self._jog, self._eyes = device, jog, eyes
        self._wizard: CalibrationWizard | None = None
        self._joint: _Joint | None = None
        self._last: FloatArray | None = None
        self._looks = 0
        device.polled.connect(self._look)

    @property
    def running(self) -> bool:
        """Whether joints are being swept."""
        return self._wizard is not None

    @property
    def progress(self) -> float:
        """0…1."""
        if self._wizard is None or self._joint is None:
            return 0.0
        joints = self._wizard.robot.dof
        left = sum(part is not None for part in left_over(self._wizard))
        return (joints - left + len(self._joint.seen) / _SAMPLES) / joints

    @property
    def words(self) -> str:
        """Which joint is swept: a sentence."""
        if self._wizard is None or self._joint is None:
            return ""
        return tr("Sweeping the {joint}. Esc stops.", joint=axis_name(self._wizard.robot, self._joint.joint))

    def begin(self, wizard: CalibrationWizard) -> None:
        """From the joint at which a wizard is."""
        self._wizard = at_part(wizard, current_part(wizard))
        self._next_joint()

    def cancel(self, sentence: str = _CANCELLED) -> None:
        """End it; the arm holds where it is."""
        if self._wizard is None:
            return
        self._wizard = self._joint = None
        if self._device.driver is not None:
            self._device.driver.hold()
        self.ended.emit(tr(sentence))

    def _next_joint(self) -> None:
        assert self._wizard is not None
        joints = [part for part in left_over(self._wizard) if part is not None]
        if not joints:
            self.cancel(tr("All joints have been swept. Look at what was found, then take the calibration."))
            return
        if current_part(self._wizard) != joints[0]:
            self._wizard = at_part(self._wizard, joints[0])
        first, second = pose_steps(self._wizard)
        self._joint = _Joint(joints[0], iter(_there_and_back(first.expected_us or 0.0, second.expected_us or 0.0)))
        self._go(near_pulses(self._wizard))

    def _go(self, pulses_us: dict[Part, float]) -> None:
        self._looks = 0
        problem = self._jog.go_all(pulses_us)
        if problem:
            self.cancel(problem)

    def _look(self) -> None:
        """At each poll: whether the arm stands, and so can be measured."""
        state = self._device.state
        if self._wizard is None:
            return
        if state is None or not state.connected or state.phase == "stopped":
            self.cancel(_STOPPED)
            return
        q = self._eyes()
        if q is None:
            self.cancel(_LOST)
            return
        before, self._last = self._last, q
        still = before is not None and not state.busy and bool(np.abs(q - before).max() < _STILL)
        self._looks = self._looks + 1 if still else 0
        if self._looks >= _LOOKS:
            self._on_still(q)

    def _on_still(self, q: FloatArray) -> None:
        assert self._joint is not None
        assert self._wizard is not None
        if self._joint.at:
            sag = sag_of(self._wizard.robot, q)[self._joint.joint]
            self._joint.seen.append(float(q[self._joint.joint] + sag))
        pulse = next(self._joint.pulses, None)
        if pulse is None:
            self._fit(self._joint)
        else:
            self._joint.at.append(pulse)
            self._go({self._joint.joint: pulse})

    def _fit(self, swept: _Joint) -> None:
        assert self._wizard is not None
        fit = fit_from_samples(self._wizard.robot.servos[swept.joint], swept.at, swept.seen)
        if isinstance(fit, Objection):
            self.cancel(
                tr("{joint}: {problem}", joint=axis_name(self._wizard.robot, swept.joint), problem=fit.sentence)
            )
            return
        self._wizard = with_fit(self._wizard, fit)
        self.advanced.emit(self._wizard)
        self._next_joint()


def _there_and_back(first_us: float, second_us: float) -> list[float]:
    """Whole pulses between two poses [µs]: servos stop a little short of where they are sent, on either way."""
    margin = _MARGIN * (second_us - first_us)
    there = [round(pulse) for pulse in np.linspace(first_us + margin, second_us - margin, _STEPS).tolist()]
    return [*there, *there[-2::-1]]


def sweep_seconds(wizard: CalibrationWizard) -> float:
    """How long the sweep of the joints that a wizard has left will take, about [s]; 0 where none is left."""
    total = 0.0
    for joint in (part for part in left_over(wizard) if part is not None):
        first, second = pose_steps(at_part(wizard, joint))
        way = seconds_between(first.expected_us or 0.0, second.expected_us or 0.0)
        total += way * (0.5 + 2.0 * (1.0 - 2.0 * _MARGIN)) + (_SAMPLES + 1) * _REST  # to its beginning, there and back
    return total


def near_pulses(wizard: CalibrationWizard) -> dict[Part, float]:
    """Pulses [µs] that bring all joints near to the present step's pose, as far as the calibration so far is right."""
    step = wizard.step
    if step is None:
        return {}
    robot = wizard.robot_so_far
    pulses: dict[Part, float] = {
        joint: float(np.clip(pulse_for(servo, float(q)), servo.min_us, servo.max_us))
        for joint, (servo, q) in enumerate(zip(robot.servos, step.posture, strict=True))
    }
    if step.expected_us is None:
        pulses.pop(step.joint, None)  # an end is found by nudging
        return {} if step.joint is None else pulses
    return {**pulses, step.joint: step.expected_us} if step.joint is not None else {None: step.expected_us}
