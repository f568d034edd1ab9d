"""How a particular arm was really put together: nobody tells, a calibration has to find it out."""

from __future__ import annotations

import random
from dataclasses import replace

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.servo import LONGEST_US, SHORTEST_US, GripperServo, Servo

ZERO_SPREAD_US = 40.0
GAIN_SPREAD = 0.08
STOP_SPREAD_US = 30.0  # the end stops lie up to so far beyond the file's pulse limits
_MIRROR_US = SHORTEST_US + LONGEST_US


def hidden_servos(robot: Robot, seed: int) -> tuple[tuple[Servo, ...], GripperServo | None]:
    """The servos as they really are; min_us and max_us are the pulses at the physical end stops.

    The file's channels; zero ±40 µs and µs/° ±8 % of the file's; the same for the same seed. Seeds other than 0 mount
    some servos the other way round (pulse p becomes 3000 − p), so that a calibration must find signs too.

    Raises:
        RobotDefinitionError: the arm has no servos.
    """
    if not robot.servos:
        raise RobotDefinitionError(
            robot.name, tr("it has no [[servo]] tables, so there is nothing to drive on a wire.")
        )
    dice = random.Random(f"servos of {robot.name} {seed}")
    servos = tuple(_hidden_servo(servo, dice, flips=seed != 0) for servo in robot.servos)
    gripper = robot.gripper_servo
    return servos, None if gripper is None else _hidden_gripper(gripper, dice, flips=seed != 0)


def _hidden_servo(servo: Servo, dice: random.Random, flips: bool) -> Servo:
    zero = servo.zero_us + dice.uniform(-ZERO_SPREAD_US, ZERO_SPREAD_US)
    gain = servo.us_per_rad * (1.0 + dice.uniform(-GAIN_SPREAD, GAIN_SPREAD))
    least, largest = servo.limits
    ends = sorted(zero + servo.sign * gain * q for q in (least, largest))
    low, high = (
        _pulse(end + side * dice.uniform(0.0, STOP_SPREAD_US)) for end, side in zip(ends, (-1, 1), strict=True)
    )
    real = replace(servo, zero_us=zero, us_per_rad=gain, min_us=low, max_us=high, assumed=False, source="hidden")
    return _mirrored(real) if dice.random() < 0.5 and flips else real


def _hidden_gripper(gripper: GripperServo, dice: random.Random, flips: bool) -> GripperServo:
    ends = [_pulse(end + dice.uniform(-ZERO_SPREAD_US, ZERO_SPREAD_US)) for end in (gripper.open_us, gripper.closed_us)]
    if dice.random() < 0.5 and flips:
        ends = [_MIRROR_US - end for end in ends]
    return replace(gripper, open_us=ends[0], closed_us=ends[1], assumed=False, source="hidden")


def _mirrored(servo: Servo) -> Servo:
    return replace(
        servo,
        sign=-servo.sign,
        zero_us=_MIRROR_US - servo.zero_us,
        min_us=_MIRROR_US - servo.max_us,
        max_us=_MIRROR_US - servo.min_us,
    )


def _pulse(pulse_us: float) -> float:
    return min(max(pulse_us, SHORTEST_US), LONGEST_US)
