"""Ways through the wizard that a page needs: another joint first, what is left, a line instead of marks; and words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rvsim.device.calibrate import CalibrationWizard, Fit, Mark, Result, Step
from rvsim.device.calibration.steps import ENDS, GRIPPER_STAGES, POSES
from rvsim.device.words import axis_name
from rvsim.gui.panels.device_calibrate_jog import Part, pulse_for
from rvsim.gui.quantities import format_number
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import GripperServo, Robot, Servo

_PLUS_MINUS = {1: "+", -1: "\u2212"}


def part_title(robot: Robot, part: Part) -> str:
    """ "J2 shoulder", or "gripper"."""
    return tr("gripper") if part is None else f"J{part + 1} {axis_name(robot, part)}"


def found_parts(wizard: CalibrationWizard) -> tuple[Part, ...]:
    """Joints, and None for the gripper, whose servos have been found."""
    return tuple(result.joint for result in wizard.results)


def current_part(wizard: CalibrationWizard) -> Part:
    """What the present step is about; the last one where all is done."""
    return wizard.parts[-1] if wizard.step is None else wizard.step.joint


def at_part(wizard: CalibrationWizard, part: Part) -> CalibrationWizard:
    """The same wizard at the first step of a part; what was found of others stays, the rest comes after it."""
    done = [other for other in found_parts(wizard) if other != part]
    rest = [other for other in wizard.parts if other != part and other not in done]
    marks = [mark for other in done for mark in _whole(wizard, other)]
    return replace(wizard, parts=(*done, part, *rest), marks=tuple(marks))


def where_words(wizard: CalibrationWizard) -> str:
    """How far one is: "Joint 1 of 6, step 1 of 2"; "" where all is done."""
    step = wizard.step
    if step is None:
        return ""
    stages = GRIPPER_STAGES if step.joint is None else POSES + (ENDS if wizard.ends else ())
    part = wizard.parts.index(step.joint) + 1
    whole = (
        tr_later("Joint {part} of {parts}, step {step} of {steps}")
        if step.joint is not None
        else tr_later("Gripper, {part} of {parts}, step {step} of {steps}")
    )
    step_number = stages.index(step.stage) + 1
    return tr(whole, part=part, parts=len(wizard.parts), step=step_number, steps=len(stages))


def with_ends(wizard: CalibrationWizard, ends: bool) -> CalibrationWizard:
    """The same with or without the question how far each joint may go; without it what was marked of that goes too."""
    marks = tuple(mark for mark in wizard.marks if ends or mark.stage not in ENDS)
    return replace(wizard, ends=ends, marks=marks)


def left_over(wizard: CalibrationWizard) -> tuple[Part, ...]:
    """Parts of which nothing has been found, the present one first."""
    here = wizard.parts.index(current_part(wizard))
    found = found_parts(wizard)
    return tuple(part for part in (*wizard.parts[here:], *wizard.parts[:here]) if part not in found)


def skipped(wizard: CalibrationWizard) -> CalibrationWizard:
    """Without what the step asks for; at the first end without both."""
    after = wizard.skip()
    both = wizard.step is not None and after.step is not None and {wizard.step.stage, after.step.stage} == set(ENDS)
    return after.skip() if both else after


def pose_steps(wizard: CalibrationWizard) -> tuple[Step, Step]:
    """Both poses of a joint at whose first one the wizard is."""
    first = wizard.step
    assert first is not None
    guess = Mark(first.joint, first.stage, first.expected_us, _value(first))
    second = replace(wizard, marks=(*wizard.marks, guess)).step
    assert second is not None
    return first, second


def with_fit(wizard: CalibrationWizard, fit: Fit) -> CalibrationWizard:
    """The wizard, at the first pose of a joint, goes on after it: a line through many samples stands for two marks."""
    steps = pose_steps(wizard)
    ends = ENDS if wizard.ends else ()
    poses = [Mark(step.joint, step.stage, pulse_for(fit.servo, _value(step)), _value(step)) for step in steps]
    return replace(wizard, marks=(*wizard.marks, *poses, *(Mark(steps[0].joint, end, None) for end in ends)))


def result_rows(result: Result) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What is now and what was: for a joint direction, µs/°, pulse at zero, range; for the gripper both its pulses."""
    return _numbers(result, new=True), _numbers(result, new=False)


def _numbers(result: Result, *, new: bool) -> tuple[str, ...]:
    servo = result.new if new else result.old
    if isinstance(servo, GripperServo):
        return (
            tr("open {pulse:.0f} µs", pulse=servo.open_us),
            tr("closed {pulse:.0f} µs", pulse=servo.closed_us),
        )
    per_step = next(change for change in result.changes if "/" in change.unit)
    return (
        _PLUS_MINUS[servo.sign],
        left_to_right(format_number(per_step.new if new else per_step.old, 2)),
        left_to_right(format_number(servo.zero_us, 0)),
        left_to_right(_range(servo)),
    )


def _range(servo: Servo) -> str:
    return f"{servo.min_us:.0f} … {servo.max_us:.0f}"


def _whole(wizard: CalibrationWizard, part: Part) -> Iterator[Mark]:
    """The marks of a part that was found; ends nobody has asked for count as skipped."""
    marks = [mark for mark in wizard.marks if mark.joint == part]
    yield from marks
    if part is not None and wizard.ends:
        given = {mark.stage for mark in marks}
        yield from (Mark(part, stage, None) for stage in ENDS if stage not in given)


def _value(step: Step) -> float:
    assert step.value is not None
    return step.value
