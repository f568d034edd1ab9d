"""The calibration wizard without its window: what to nudge where, and the servos that follow from it.

A joint is marked in two poses that people recognise; a line through them gives direction, pulse at zero and µs per
degree. Then, if one likes, its ends are found by nudging. The arm gives way under its weight while it is looked at:
marks allow for that as far as the arm's masses are known. The wizard goes from the hand to the base, so that whatever
a joint carries is already calibrated.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.calibration import steps
from rvsim.device.calibration.fit import Fit, Objection, fit_from_samples, sweep_pulses
from rvsim.device.calibration.found import (
    CLOSE,
    CLOSE_SLIDING,
    Mark,
    found_of,
    objection_to_last,
    objection_to_pulse,
)
from rvsim.device.calibration.marks import MarkPlan, mark_plan, usual_range
from rvsim.device.calibration.results import Change, Result, gripper_result, joint_result
from rvsim.device.calibration.sag import sag_of
from rvsim.device.calibration.steps import Stage, Step
from rvsim.device.words import axis_name
from rvsim.errors import RobotDefinitionError, ShapeError
from rvsim.language import tr
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.servo import LONGEST_US, SHORTEST_US

__all__ = [
    "Calibration",
    "CalibrationWizard",
    "Change",
    "Fit",
    "Mark",
    "Objection",
    "Result",
    "Step",
    "fit_from_samples",
    "sag_of",
    "sweep_pulses",
]

_FIRST_LAST = {"first pose": 0, "second pose": 1, "least end": 0, "largest end": 1}
_STEP, _STEP_SLIDING = math.radians(1.0), 0.001


class Calibration(NamedTuple):
    """All servos of an arm, those that were not marked as they were."""

    servos: tuple[Servo, ...]
    gripper_servo: GripperServo | None


@dataclass(frozen=True, eq=False)
class CalibrationWizard:
    """A state of the wizard; each answer makes another one. Begin with `CalibrationWizard.begin(robot)`.

    Args:
        robot: with its present servos.
        parts: the joints (from 0) to be calibrated, in this order; None is the gripper.
        weight: whether marks allow for the arm's sag under its weight.
        ends: whether the joints' ends are asked for.
        reach: one a joint of the arm: the least and the largest value that is asked for [rad, m].
        marks: the answers so far.
    """

    robot: Robot
    parts: tuple[int | None, ...]
    weight: bool
    ends: bool
    reach: tuple[tuple[float, float], ...]
    marks: tuple[Mark, ...] = ()

    @classmethod
    def begin(
        cls,
        robot: Robot,
        parts: Sequence[int | None] | None = None,
        *,
        weight: bool = True,
        ends: bool = True,
    ) -> CalibrationWizard:
        """The first step.

        Args:
            robot: the arm.
            parts: joints (from 0), None for the gripper; all, from the hand to the base, where nothing is said.
            weight: allow for the sag under the arm's weight, as far as its masses are known.
            ends: also ask how far each joint may go; without it joints may go as far as before, in degrees.

        Raises:
            RobotDefinitionError: the arm has no servos, or no gripper servo where one is asked for.
        """
        if not robot.servos:
            raise RobotDefinitionError(robot.name, tr("it has no [[servo]] tables, so there is nothing to calibrate."))
        grip = () if robot.gripper_servo is None else (None,)
        chosen = (*reversed(range(robot.dof)), *grip) if parts is None else tuple(parts)
        if None in chosen and robot.gripper_servo is None:
            raise RobotDefinitionError(robot.name, tr("it has no [gripper_servo] to calibrate."))
        return cls(robot, chosen, weight, ends, tuple(usual_range(robot, joint) for joint in range(robot.dof)))

    # --- where it stands ---------------------------------------------------------------------------------------------

    @cached_property
    def step(self) -> Step | None:
        """What to do next; None when all is done."""
        place = self._place
        return None if place is None else self._step(*place)

    @property
    def done(self) -> bool:
        """Whether nothing is left to do."""
        return self._place is None

    @property
    def progress(self) -> float:
        """0…1."""
        return self._number / self.count

    @property
    def count(self) -> int:
        """How many steps there are."""
        return len(self._places)

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """Of each part that has been marked."""
        return tuple(result for part in self.parts if (result := self._result(part)) is not None)

    @property
    def robot_so_far(self) -> Robot:
        """The arm with what has been found: for the pulses of what comes next."""
        servos, gripper = self.calibration("")
        return replace(self.robot, servos=servos, gripper_servo=gripper)

    def calibration(self, source: str) -> Calibration:
        """All servos; those that were marked say `source`, for instance "calibrated on 2026-03-01"."""
        found = {result.joint: result.new for result in self.results}
        servos = list(self.robot.servos)
        gripper = self.robot.gripper_servo
        for joint, servo in found.items():
            if joint is None and isinstance(servo, GripperServo):
                gripper = replace(servo, source=source)
            elif joint is not None and isinstance(servo, Servo):
                servos[joint] = replace(servo, source=source)
        return Calibration(tuple(servos), gripper)

    # --- answers -----------------------------------------------------------------------------------------------------

    def mark(
        self, pulse_us: float, *, value: float | None = None, posture: ArrayLike | None = None
    ) -> CalibrationWizard | Objection:
        """The arm is as the step says, and the servo gets this pulse [µs].

        Args:
            value: where the joint really is [rad, m], if not where the step wants it.
            posture: (n,) how the arm stands [rad, m], if not as the step says; what counts is its weight.

        Raises:
            ShapeError: the posture is not one number a joint.
        """
        step = self.step
        if step is None:
            return Objection(tr("All is marked. Undo leads back."))
        asked = self._asked_for(step, value, posture)
        answered = self._with(Mark(step.joint, step.stage, float(pulse_us), asked))
        wrong = objection_to_pulse(pulse_us) or objection_to_last(self.robot, answered.marks)
        return Objection(wrong) if wrong else answered

    def skip(self) -> CalibrationWizard:
        """Leave this step out: an end, or all that is left of a joint or the gripper."""
        place = self._place
        return self if place is None else self._with(Mark(*place, pulse_us=None))

    def undo(self) -> CalibrationWizard:
        """Without the last answer."""
        return replace(self, marks=self.marks[:-1])

    def cannot_reach(self) -> CalibrationWizard | Objection:
        """The arm does not come to the pose of this step: ask for another one.

        A first mark that does not go with the other pose is taken back.
        """
        step = self.step
        if step is None or step.value is None or step.joint is None:
            return Objection(tr("Nothing is to be reached here: mark how far it goes, or skip."))
        joint, revolute = step.joint, self.robot.joints[step.joint].revolute
        lower, upper = self.reach[joint]
        little = _STEP if revolute else _STEP_SLIDING
        narrower = (step.value + little, upper) if step.stage == "first pose" else (lower, step.value - little)
        if narrower[1] - narrower[0] < (CLOSE if revolute else CLOSE_SLIDING):
            return Objection(
                tr("No two poses are left that are far enough apart. Skip this joint, and look at its horn.")
            )
        reach = tuple(narrower if index == joint else pair for index, pair in enumerate(self.reach))
        other = replace(self, reach=reach)
        kept = step.stage == "first pose" or self._plan(joint).values[0] == other._plan(joint).values[0]
        return other if kept else replace(other, marks=self.marks[:-1])

    # --- inside ------------------------------------------------------------------------------------------------------

    @cached_property
    def _places(self) -> tuple[tuple[int | None, Stage], ...]:
        joint = steps.POSES + (steps.ENDS if self.ends else ())
        return tuple((part, s) for part in self.parts for s in (steps.GRIPPER_STAGES if part is None else joint))

    @cached_property
    def _number(self) -> int:
        """How many steps are over. A pose that was skipped takes the rest of its part with it."""
        if not self.marks:
            return 0
        last = self.marks[-1]
        number = self._places.index((last.joint, last.stage)) + 1
        if last.pulse_us is None and last.stage not in steps.ENDS:
            while number < self.count and self._places[number][0] == last.joint:
                number += 1
        return number

    @property
    def _place(self) -> tuple[int | None, Stage] | None:
        return self._places[self._number] if self._number < self.count else None

    def _step(self, joint: int | None, stage: Stage) -> Step:
        plan = self._plan(joint)
        name = axis_name(self.robot, self.robot.dof if joint is None else joint)
        index = _FIRST_LAST.get(stage, 0)
        value = plan.values[index] if stage in steps.POSES else None
        return Step(
            joint,
            stage,
            title=steps.title(name, stage),
            instruction=steps.instruction(self.robot, joint, stage, plan),
            value=value,
            posture=plan.postures[index],
            channel=(self._grip if joint is None else self.robot.servos[joint]).channel,
            expected_us=self._expected(joint, stage, value),
            skip=steps.skip(joint, stage),
            number=self._number + 1,
            count=self.count,
        )

    def _plan(self, joint: int | None) -> MarkPlan:
        if joint is None:
            return MarkPlan((0.0, 0.0), (self.robot.home, self.robot.home))
        return mark_plan(self.robot, joint, *self.reach[joint])

    def _with(self, mark: Mark) -> CalibrationWizard:
        return replace(self, marks=(*self.marks, mark))

    def _asked_for(self, step: Step, value: float | None, posture: ArrayLike | None) -> float:
        """What the pulse of a pose asks for: what one sees, and how far weight has pulled it from there."""
        seen = step.value if value is None else value
        if step.joint is None or seen is None:
            return math.nan
        pose = np.array(step.posture if posture is None else posture, dtype=np.float64)
        if pose.shape != (self.robot.dof,):
            raise ShapeError("posture", f"({self.robot.dof},)", pose.shape)
        pose[step.joint] = seen
        return seen + (float(sag_of(self.robot, pose)[step.joint]) if self.weight else 0.0)

    @property
    def _grip(self) -> GripperServo:
        """Asked for only where the gripper is a part, and `begin` has seen to it that it has a servo."""
        return cast("GripperServo", self.robot.gripper_servo)

    def _expected(self, part: int | None, stage: Stage, value: float | None) -> float | None:
        """By the present calibration, of a pose or of what the gripper does."""
        if part is None:
            return self._grip.open_us if stage == "open" else self._grip.closed_us
        if value is None:
            return None
        servo = self.robot.servos[part]
        return min(max(servo.zero_us + servo.gain * value, SHORTEST_US), LONGEST_US)

    def _result(self, part: int | None) -> Result | None:
        new = found_of(self.robot, self.marks, part)
        if isinstance(new, GripperServo):
            return gripper_result(self._grip, new)
        return joint_result(self.robot, part, new) if isinstance(new, Servo) and part is not None else None
