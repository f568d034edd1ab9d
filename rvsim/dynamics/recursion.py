"""The recursive Newton–Euler algorithm, written on a tape: outwards go the velocities, inwards the forces.

Source: Luh, Walker and Paul, On-line computational scheme for mechanical manipulators (1980); Siciliano et al.,
Robotics (2009), section 7.5. All vectors are in the axes of a frame that does not turn with parallel joints: a frame is
left only where the axis changes direction, so three parallel joints cost one rotation, not three. Gravity is an upward
acceleration of the base.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from rvsim.kinematics.chain import Frame, Vector, combined, cross, frame_of
from rvsim.kinematics.tape import Number, Tape
from rvsim.robot import Joint, LinkMass, Robot
from rvsim.spatial.arrays import FloatArray

_ZERO: Vector = (0.0, 0.0, 0.0)


class Motion(NamedTuple):
    """How a body moves: angular velocity and acceleration, and the acceleration of the present origin."""

    w: Vector
    wd: Vector
    a: Vector

    def acceleration_at(self, p: Vector) -> Vector:
        """Of the body's point p, seen from the origin: a + ẇ × p + w × (w × p)."""
        (x, y, z), (dx, dy, dz) = self.w, self.wd
        columns: tuple[Vector, Vector, Vector] = (
            (-(y * y + z * z), x * y + dz, x * z - dy),
            (x * y - dz, -(x * x + z * z), y * z + dx),
            (x * z + dy, y * z - dx, -(x * x + y * y)),
        )
        return combined((1.0, self.a), *zip(p, columns, strict=True))


class Load(NamedTuple):
    """What is passed inwards: a force and its moment about the present origin."""

    f: Vector
    n: Vector


class _Step(Protocol):
    """A step outwards, kept to be taken back inwards."""

    def inwards(self, load: Load) -> Load:
        """The load on the near side."""
        ...


class _Driven(NamedTuple):
    """A joint about or along the z axis."""

    joint: int
    revolute: bool

    def inwards(self, load: Load) -> Load:
        return load

    def torque(self, load: Load) -> Number:
        """What the drive has to take of the load: the rest goes into the bearings."""
        return load.n[2] if self.revolute else load.f[2]


class _Shifted(NamedTuple):
    """The origin has moved."""

    by: Vector

    def inwards(self, load: Load) -> Load:
        return Load(load.f, _added(load.n, cross(self.by, load.f)))


class _Turned(NamedTuple):
    """The axes are others: those of `frame`, seen in the axes before."""

    frame: Frame

    def inwards(self, load: Load) -> Load:
        f, n = (combined(*zip(part, self.frame[:3], strict=True)) for part in load)
        return Load(f, n)


class _Weight(NamedTuple):
    """A body takes a force at its centre of mass, and a moment."""

    com: Vector
    force: Vector
    moment: Vector

    def inwards(self, load: Load) -> Load:
        return Load(_added(load.f, self.force), _added(load.n, self.moment, cross(self.com, self.force)))


class Rates(NamedTuple):
    """How the joints move (numbers on the tape; 0.0 leaves a part out) and how strong gravity is."""

    qd: Sequence[Number]
    qdd: Sequence[Number]
    gravity: Number


class _Outwards:
    """The way from the base to the tool."""

    def __init__(self, robot: Robot, tape: Tape, rates: Rates) -> None:
        self._robot, self._tape, self._rates = robot, tape, rates
        self._joints: tuple[int, ...] = ()
        self._constant = 0.0
        up: Vector = (0.0, 0.0, rates.gravity)
        self._motion = Motion(_ZERO, _ZERO, _seen_in(frame_of(robot.T_base_0), up))
        self.steps: list[_Step] = []

    def pass_joint(self, index: int) -> None:
        """Its DH row."""
        joint = self._robot.joints[index]
        if self._robot.convention == "standard":
            self._drive(index, joint, joint.a)
            self._tilt(joint.alpha)
        else:
            self._shift(self._turned((joint.a, 0.0, 0.0)))
            self._tilt(joint.alpha)
            self._drive(index, joint, 0.0)

    def _drive(self, index: int, joint: Joint, along_x: float) -> None:
        """Turn about or slide along z; then walk `d` along z and some way along the new x."""
        self._constant += joint.theta
        if joint.revolute:
            self._turn(index)
            self._shift(self._turned((along_x, 0.0, joint.d)))
        else:
            x, y, _ = self._turned((along_x, 0.0, 0.0))
            self._shift((x, y, joint.d + self._tape.joint(index)))
            self._slide(index)

    def _turn(self, index: int) -> None:
        w, wd, a = self._motion
        rate: Vector = (0.0, 0.0, self._rates.qd[index])
        driven: Vector = (0.0, 0.0, self._rates.qdd[index])
        self._motion = Motion(_added(w, rate), _added(wd, driven, cross(w, rate)), a)
        self._joints += (index,)
        self.steps.append(_Driven(index, True))

    def _slide(self, index: int) -> None:
        w, wd, a = self._motion
        coriolis = cross(w, (0.0, 0.0, 2.0 * self._rates.qd[index]))
        self._motion = Motion(w, wd, _added(a, (0.0, 0.0, self._rates.qdd[index]), coriolis))
        self.steps.append(_Driven(index, False))

    def _shift(self, by: Vector) -> None:
        if by != _ZERO:
            self._motion = self._motion._replace(a=self._motion.acceleration_at(by))
            self.steps.append(_Shifted(by))

    def _tilt(self, alpha: float) -> None:
        """Leave these axes for ones tilted about the present x, unless they are the same."""
        cosine, sine = self._tape.cos_sin((), alpha)
        if (cosine, sine) == (1.0, 0.0):
            return
        y: Vector = self._turned((0.0, cosine, sine))
        z: Vector = self._turned((0.0, -sine, cosine))
        frame = Frame(self._turned((1.0, 0.0, 0.0)), y, z, _ZERO)
        self._motion = Motion(*(_seen_in(frame, vector) for vector in self._motion))
        self._joints, self._constant = (), 0.0
        self.steps.append(_Turned(frame))

    def _turned(self, vector: Vector) -> Vector:
        """A vector that turns with the joints passed since the last tilt, in the present axes."""
        cosine, sine = self._tape.cos_sin(self._joints, self._constant)
        x, y, z = vector
        return cosine * x - sine * y, sine * x + cosine * y, z

    def _turned_back(self, vector: Vector) -> Vector:
        cosine, sine = self._tape.cos_sin(self._joints, self._constant)
        x, y, z = vector
        return cosine * x + sine * y, cosine * y - sine * x, z

    def carry(self, link: LinkMass) -> None:
        """The link of the present DH frame takes its force."""
        com = self._turned((float(link.com[0]), float(link.com[1]), float(link.com[2])))
        self._carry(float(link.mass), com, self._moment(link.inertia))

    def carry_at_tool(self, mass: Number) -> None:
        """A point mass at the tool origin takes its force."""
        x, y, z = frame_of(self._robot.T_flange_tool).origin
        self._carry(mass, self._turned((x, y, z)), _ZERO)

    def _carry(self, mass: Number, com: Vector, moment: Vector) -> None:
        force = combined((mass, self._motion.acceleration_at(com)))
        self.steps.append(_Weight(com, force, moment))

    def _moment(self, inertia: FloatArray) -> Vector:
        """Euler's I ẇ + w × I w, in the axes of the link unless the link is alike all round its z axis."""
        if not np.any(inertia):
            return _ZERO
        if _is_round(inertia):
            return _euler(inertia, self._motion.w, self._motion.wd)
        return self._turned(_euler(inertia, self._turned_back(self._motion.w), self._turned_back(self._motion.wd)))


def record_torques(robot: Robot, tape: Tape, rates: Rates, payload: Number = 0.0) -> list[Number]:
    """The joint torques as n numbers on the tape; `payload` is a point mass at the tool origin."""
    outwards = _Outwards(robot, tape, rates)
    for index, link in enumerate(robot.masses):
        outwards.pass_joint(index)
        outwards.carry(link)
    outwards.carry_at_tool(payload)
    torques: list[Number] = [0.0] * robot.dof
    load = Load(_ZERO, _ZERO)
    for step in reversed(outwards.steps):
        if isinstance(step, _Driven):
            torques[step.joint] = step.torque(load)
        load = step.inwards(load)
    return torques


def _seen_in(frame: Frame, vector: Vector) -> Vector:
    """The components along the axes of a frame."""
    x, y, z = (sum((a * b for a, b in zip(axis, vector, strict=True)), start=0.0) for axis in frame[:3])
    return x, y, z


def _added(*vectors: Vector) -> Vector:
    return combined(*((1.0, vector) for vector in vectors))


def _euler(inertia: FloatArray, w: Vector, wd: Vector) -> Vector:
    return _added(_times(inertia, wd), cross(w, _times(inertia, w)))


def _times(matrix: FloatArray, vector: Vector) -> Vector:
    columns = matrix.T.tolist()
    return combined(*((factor, (c[0], c[1], c[2])) for factor, c in zip(vector, columns, strict=True)))


def _is_round(inertia: FloatArray) -> bool:
    return bool(inertia[0, 0] == inertia[1, 1] and not np.any(inertia - np.diag(np.diag(inertia))))
