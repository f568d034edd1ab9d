"""The geometry of an arm, written once for all uses: a frame that walks from the base to the tool.

Both DH conventions are the same four moves in another order. Successive turns about parallel axes are one turn by the
sum of their angles, so the walk keeps the angle and the place in the plane apart until the axis changes direction.
"""

from __future__ import annotations

from typing import NamedTuple

from rvsim.kinematics.tape import Number, Tape, snapped
from rvsim.robot import Joint, Robot
from rvsim.spatial.arrays import FloatArray

Vector = tuple[Number, Number, Number]


class Frame(NamedTuple):
    """Axes and origin in base axes."""

    x: Vector
    y: Vector
    z: Vector
    origin: Vector

    @property
    def entries(self) -> tuple[Number, ...]:
        """The sixteen entries of the 4 × 4 matrix, row by row."""
        rows = zip(self.x, self.y, self.z, self.origin, strict=True)
        return (*(entry for row in rows for entry in row), 0.0, 0.0, 0.0, 1.0)


class Axis(NamedTuple):
    """The axis of a joint: its direction and a point on it, in base axes."""

    direction: Vector
    point: Vector


class Walk:
    """A frame on its way along the arm, for joint variables on a tape."""

    def __init__(self, tape: Tape, T_base_0: FloatArray) -> None:
        self._tape = tape
        self._settle(frame_of(T_base_0))

    def _settle(self, frame: Frame) -> None:
        """Start anew from here: no turn about z yet, no step away from the origin."""
        self._frame = frame
        self._joints: tuple[int, ...] = ()
        self._constant = 0.0
        self._place: Vector = (0.0, 0.0, 0.0)

    @property
    def frame(self) -> Frame:
        """Where the walk stands."""
        cosine, sine = self._cos_sin()
        x, y, z, _ = self._frame
        return Frame(combined((cosine, x), (sine, y)), combined((cosine, y), (-sine, x)), z, self.origin)

    @property
    def origin(self) -> Vector:
        """Where the walk's origin stands."""
        x, y, z, origin = self._frame
        u, v, w = self._place
        return combined((1.0, origin), (u, x), (v, y), (w, z))

    def pass_joint(self, robot: Robot, index: int) -> Axis:
        """Walk the DH row of one joint; its axis is the z axis at which it turns or slides."""
        joint = robot.joints[index]
        if robot.convention == "standard":
            axis = Axis(self._frame.z, self.origin)
            self._move_along_z(joint, index)
            self._move_along_x(joint)
        else:
            self._move_along_x(joint)
            axis = Axis(self._frame.z, self.origin)
            self._move_along_z(joint, index)
        return axis

    def pass_transform(self, T: FloatArray) -> None:
        """Walk a constant transform (4, 4)."""
        here, step = self.frame, frame_of(T)
        axes = [combined(*zip(column, here[:3], strict=True)) for column in step]
        self._settle(Frame(axes[0], axes[1], axes[2], combined((1.0, here.origin), (1.0, axes[3]))))

    def _move_along_z(self, joint: Joint, index: int) -> None:
        u, v, w = self._place
        if joint.revolute:
            self._joints += (index,)
            self._place = (u, v, w + joint.d)
        else:
            self._place = (u, v, w + (joint.d + self._tape.joint(index)))
        self._constant += joint.theta

    def _move_along_x(self, joint: Joint) -> None:
        if joint.a != 0.0:
            cosine, sine = self._cos_sin()
            u, v, w = self._place
            self._place = (u + joint.a * cosine, v + joint.a * sine, w)
        cosine, sine = self._tape.cos_sin((), joint.alpha)
        if (cosine, sine) != (1.0, 0.0):
            x, y, z, origin = self.frame
            self._settle(Frame(x, combined((cosine, y), (sine, z)), combined((cosine, z), (-sine, y)), origin))

    def _cos_sin(self) -> tuple[Number, Number]:
        return self._tape.cos_sin(self._joints, self._constant)


def frame_of(T: FloatArray) -> Frame:
    """The constant frame of T (4, 4)."""
    columns = [tuple(snapped(float(entry)) for entry in T[:3, column]) for column in range(4)]
    x, y, z, origin = ((column[0], column[1], column[2]) for column in columns)
    return Frame(x, y, z, origin)


def combined(*parts: tuple[Number, Vector]) -> Vector:
    """The sum of factor · vector over the parts."""
    x, y, z = (_sum_of_products([(factor, vector[i]) for factor, vector in parts]) for i in range(3))
    return x, y, z


def cross(a: Vector, b: Vector) -> Vector:
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _sum_of_products(pairs: list[tuple[Number, Number]]) -> Number:
    total: Number = 0.0
    for factor, value in pairs:
        total = total + factor * value
    return total
