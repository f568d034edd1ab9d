"""Physics of hobby servos on an arm, all at once: they lag, stick within a dead band, sag under weight, and fall limp.

A powered servo drives towards its pulse at its top speed and, within the last degrees, in proportion to what is left
(a first-order lag); it does not see an error below its dead band. Under a load it gives way like a spring: full torque
needs an error of `FULL_TORQUE_AT`. Without pulses only friction holds the joint: what is too heavy for it sinks slowly.
Loads are those of gravity at rest; inertia of such small arms is the servo's business and left out.

Between two servo frames (20 ms) everything has a closed form, so a place is exact at any time in between.
These numbers are ours, for typical hobby servos; speeds, torques and masses are the robot file's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rvsim.device.virtual.clock import FRAME
from rvsim.device.virtual.contract import BoolArray
from rvsim.device.virtual.faults import SAG_FACTOR, Fault, Faults
from rvsim.dynamics import gravity_torques
from rvsim.kinematics.forward import forward_kinematics, link_transforms
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import Datum
from rvsim.robot.servo import GripperServo, Servo

DEAD_BAND_US = 4.0
LOOP_TIME = 0.04  # [s] the lag of the servo's own control loop
FULL_TORQUE_AT, FULL_FORCE_AT = math.radians(5.0), 0.002  # [rad], [m] the error at which a servo gives all it has
STATIC, SLIDING = 0.2, 0.12  # friction of the gears without power, of the servo's torque
FALL_RATE, TOP_FALL = 1.5, 0.5  # [rad/s] per servo's torque of load above friction; and at most
USUAL_SPEED, USUAL_TORQUE = math.radians(200.0), 1.0  # where the robot file has none
GRIPPER_SPEED = 2.0  # whole strokes a second


@dataclass(frozen=True, eq=False)
class ServoBank:
    """The servos of an arm: n joints [rad, m] and the gripper, if it has a servo, last (0 closed … 1 open); m in all.

    Args:
        robot: the arm whose weight they carry.
        channels: (m,) of the controller.
        zero_us, gain_us: (m,) pulse = zero_us + gain_us · place [µs].
        lower, upper: (m,) the physical end stops.
        speed: (m,) top speeds [1/s].
        torque: (m,) [N m, N].
        give: (m,) how far each gives way under one unit of load [rad/(N m), m/N]; 0 for the gripper.
        most: (m,) how far it gives way at most.
        dead: (m,) half width of the dead band.
    """

    robot: Robot
    channels: tuple[int, ...]
    zero_us: FloatArray
    gain_us: FloatArray
    lower: FloatArray
    upper: FloatArray
    speed: FloatArray
    torque: FloatArray
    give: FloatArray
    most: FloatArray
    dead: FloatArray

    @property
    def dof(self) -> int:
        """n: the joints, without the gripper."""
        return self.robot.dof

    def places_at(self, pulses_us: FloatArray) -> FloatArray:
        """(m,) where pulses (m,) want the servos, NaN where there is no pulse."""
        return (pulses_us - self.zero_us) / self.gain_us

    def loads(self, places: FloatArray) -> FloatArray:
        """(m,) the torques that hold the arm at these places [N m, N]; zeros for an arm without masses."""
        loads = np.zeros(len(places))
        if self.robot.masses:
            loads[: self.dof] = gravity_torques(self.robot, places[: self.dof])
        return loads


class Drive(NamedTuple):
    """What acts on the servos during one frame: (m,) each."""

    driven: BoolArray
    target: FloatArray  # where the driven ones come to rest, sag included
    sinking: FloatArray  # speed of the others [1/s]


def servo_bank(robot: Robot, servos: Sequence[Servo], gripper: GripperServo | None) -> ServoBank:
    """The servos of an arm whose calibration is `servos` and `gripper`; their pulse limits are the end stops."""
    grip: list[GripperServo] = [] if gripper is None else [gripper]
    channels = [servo.channel for servo in servos] + [servo.channel for servo in grip]
    torque = np.array([_value(joint.max_torque, USUAL_TORQUE) for joint in robot.joints] + [USUAL_TORQUE] * len(grip))
    most = np.where(robot.is_revolute, FULL_TORQUE_AT, FULL_FORCE_AT)
    most = np.append(most, [0.0] * len(grip))
    gain = np.array([servo.gain for servo in servos] + [g.open_us - g.closed_us for g in grip])
    ends = np.array([servo.limits for servo in servos] + [(0.0, 1.0)] * len(grip))
    return ServoBank(
        robot,
        tuple(channels),
        zero_us=np.array([servo.zero_us for servo in servos] + [g.closed_us for g in grip]),
        gain_us=gain,
        lower=ends[:, 0],
        upper=ends[:, 1],
        speed=np.array([_value(j.max_speed, USUAL_SPEED) for j in robot.joints] + [GRIPPER_SPEED] * len(grip)),
        torque=torque,
        give=most / torque,
        most=most,
        dead=DEAD_BAND_US / np.abs(gain),
    )


def drive_of(bank: ServoBank, places: FloatArray, pulses_us: FloatArray, faults: Faults) -> Drive:
    """What pulses (m,) [µs], NaN where there is none, do to servos that are at `places` (m,)."""
    loads = bank.loads(places)
    driven = np.isfinite(pulses_us)
    weakness = np.ones(len(places))
    weakness[faults.servos(Fault.SAGGING_SERVO, len(places))] = SAG_FACTOR
    target = np.where(driven, bank.places_at(pulses_us) - _sag(bank, loads, weakness), places)
    sinking = np.where(driven, 0.0, _sinking(bank, loads))
    stalled = faults.servos(Fault.STALLED_SERVO, len(places))
    target[stalled] = places[stalled]
    sinking[stalled] = 0.0
    if sinking.any() and _would_go_below(bank, places, places + sinking * FRAME):
        sinking[:] = 0.0
    return Drive(driven, target, sinking)


def places_after(bank: ServoBank, places: FloatArray, drive: Drive, elapsed: float) -> FloatArray:
    """(m,) where servos are `elapsed` [s] after they were at `places` (m,), while the same acts on them."""
    error = drive.target - places
    size = np.abs(error)
    at_full_speed = np.clip(size - bank.speed * LOOP_TIME, 0.0, bank.speed * elapsed)
    left = (size - at_full_speed) * np.exp((at_full_speed / bank.speed - elapsed) / LOOP_TIME)
    driven = np.where(size > bank.dead, drive.target - np.copysign(left, error), places)
    moved = np.where(drive.driven, driven, places + drive.sinking * elapsed)
    return np.clip(moved, bank.lower, bank.upper)


def lowest(robot: Robot, q: FloatArray) -> float:
    """The height of the lowest joint of an arm at q (n,), or of its tool [m]."""
    origins = link_transforms(robot, q)[1:, 2, 3]
    return float(min(origins.min(), forward_kinematics(robot, q)[2, 3]))


def _would_go_below(bank: ServoBank, places: FloatArray, then: FloatArray) -> bool:
    """Whether what sinks would sink into the table at z = 0; what has come to lie on it stays."""
    height = lowest(bank.robot, then[: bank.dof])
    return height < 0.0 and height < lowest(bank.robot, places[: bank.dof])


def _sag(bank: ServoBank, loads: FloatArray, weakness: FloatArray) -> FloatArray:
    return np.asarray(weakness * np.clip(loads * bank.give, -bank.most, bank.most))


def _sinking(bank: ServoBank, loads: FloatArray) -> FloatArray:
    """Speed (m,) at which servos without pulses give way: not at all while friction holds them."""
    share = np.abs(loads) / bank.torque
    speed = np.minimum(FALL_RATE * (share - SLIDING), TOP_FALL)
    return np.where(share > STATIC, -np.sign(loads) * speed, 0.0)


def _value(datum: Datum | None, usual: float) -> float:
    return usual if datum is None else datum.value
