"""The calibration of an arm's servos: what turns its joint values into pulses."""

from __future__ import annotations

from collections.abc import Iterator

from rvsim.lab.report.figures import DASH, Measures, number
from rvsim.lab.report.values import Column, Table, Words
from rvsim.language import left_to_right, listed, tr, tr_later
from rvsim.robot import GripperServo, Robot, Servo

_NOTE = tr_later("pulse = zero + direction · gain · q, kept between the shortest and the longest.")


def servo_tables(robot: Robot, measures: Measures) -> Iterator[Table]:
    """One table, or none for an arm without servos."""
    if not robot.servos:
        return
    columns = (
        Column(tr("Joint"), "left"), Column(tr("channel")), Column(tr("direction")),
        Column(tr("gain [µs/{units}]", units=_units(robot, measures))),
        Column(tr("zero [µs]")), Column("min [µs]"), Column("max [µs]"),
    )  # fmt: skip
    rows = [_row(f"J{i + 1} {tr(robot.joint_names[i])}", i, servo, measures) for i, servo in enumerate(robot.servos)]
    gripper = robot.gripper_servo
    notes = [tr(_NOTE)]
    if gripper is not None:
        rows.append(_gripper_row(gripper))
        ends = tr(
            "The gripper is closed at {closed} µs and open at {open} µs.",
            closed=number(gripper.closed_us, 0),
            open=number(gripper.open_us, 0),
        )
        notes.append(ends)
    yield Table(tr("Calibration of the servos."), columns, tuple(rows), " ".join((*notes, *_sources(robot))))


def _sources(robot: Robot) -> Iterator[str]:
    """Where the numbers come from: each source once, with the rows that it gives."""
    rows: dict[str, list[str]] = {}
    for index, servo in enumerate(robot.servos):
        rows.setdefault(_origin(servo), []).append(left_to_right(f"J{index + 1}"))
    if robot.gripper_servo is not None:
        rows.setdefault(_origin(robot.gripper_servo), []).append(tr("gripper"))
    for origin, names in rows.items():
        yield tr("Source of {rows}: {origin}.", rows=listed(names), origin=origin)


def _units(robot: Robot, measures: Measures) -> str:
    units = dict.fromkeys(measures.joint(index).unit for index in range(robot.dof))
    return tr(" or ").join(units)


def _row(name: str, index: int, servo: Servo, measures: Measures) -> tuple[Words, ...]:
    gain = number(servo.us_per_rad / measures.joint(index).factor, 3)
    ends = (number(value, 0) for value in (servo.min_us, servo.max_us))
    direction = "+1" if servo.sign > 0 else number(-1, 0)
    return (name, str(servo.channel), direction, gain, number(servo.zero_us, 1), *ends)


def _gripper_row(servo: GripperServo) -> tuple[Words, ...]:
    ends = sorted((servo.closed_us, servo.open_us))
    return (tr("gripper"), str(servo.channel), DASH, DASH, DASH, *(number(value, 0) for value in ends))


def _origin(servo: Servo | GripperServo) -> str:
    words = tr(servo.source) if servo.source else tr("the robot file")
    return tr("assumed ({words})", words=words) if servo.assumed else words
