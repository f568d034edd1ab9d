"""Edits of one DH value: a copy of the arm, its solid look stretched along, its home kept within the limits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from rvsim.errors import UnknownNameError
from rvsim.language import tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import Convention, Joint, LinkMass, Robot
from rvsim.robot.shape import BoxShape, CapsuleShape, Shape

DHKey = Literal["theta", "d", "a", "alpha", "lower", "upper", "home"]
DH_KEYS: tuple[DHKey, ...] = get_args(DHKey)
OWN_PREFIX = "my-"  # an edited copy of "rv-m1" is named "my-rv-m1", until it is saved under another name
_COPY = re.compile(r"(?:edited )?copy of [^;]+ \(([^;()]+)\)(?:;|$)")
_GEOMETRY = ("theta", "d", "a", "alpha")
_BAR = 0.03  # the radius of a bar, of the arm's size
_EDITED = tr_later("of the link before its DH row was edited")

_Piece = tuple[int, FloatArray, FloatArray]


def copied_source(robot: Robot) -> str:
    """The source of a copy: whose copy it is, and where the numbers of that one are from. In English, as in files."""
    return f"copy of {robot.title} ({robot.name})" + (f"; {robot.source}" if robot.source else "")


def original_name(robot: Robot) -> str:
    """The name of the arm that this one is an edited copy of, as its source says; its own name if it is none."""
    copy = _COPY.match(robot.source)
    return copy[1] if copy else robot.name.removeprefix(OWN_PREFIX)


@dataclass(frozen=True, eq=False)
class _Segment:
    """A straight piece of a link, from `start` along the unit vector `axis` for `old` metres, in frame `frame`.

    It becomes `new` metres long; the origin of the frame stays where it is: at the start (`from_start`) or at the end.
    """

    frame: int
    start: FloatArray
    axis: FloatArray
    old: float
    new: float
    from_start: bool

    def moved(self, point: FloatArray) -> FloatArray:
        """Where a point of the link goes: what lies beyond the ends of the piece is shifted, not stretched."""
        fraction = float(np.clip((point - self.start) @ self.axis / self.old, 0.0, 1.0))
        share = fraction if self.from_start else fraction - 1.0
        return point + share * (self.new - self.old) * self.axis


def with_dh_value(robot: Robot, joint: int, key: DHKey, value: float, *, look_of: Robot | None = None) -> Robot:
    """A copy whose joint `joint` (from 0) has another DH value, limit or home [rad, m; ±inf for no limit].

    Its shapes are those of `look_of` (by default the arm itself), stretched along the lengths a and d that differ; give
    the arm that the edits began with, and a link that was 0 for a moment gets its look back. A home outside the new
    limits moves to the nearest limit. The mass of a link whose geometry changes stays, marked as assumed.

    Raises:
        UnknownNameError: no such key.
        RobotDefinitionError: the value makes no arm (not finite, a lower limit above the upper one).
    """
    if key not in DH_KEYS:
        raise UnknownNameError(tr_later("DH value"), key, DH_KEYS)
    changes: dict[str, float] = {key: value}
    old = robot.joints[joint]
    if key in ("lower", "upper"):
        lower, upper = changes.get("lower", old.lower), changes.get("upper", old.upper)
        changes["home"] = min(max(old.home, lower), upper)
    edited = robot.with_joint(joint, **changes)
    if key not in _GEOMETRY or value == getattr(old, key):
        return edited
    return replace(edited, shapes=stretched_shapes(look_of or robot, edited), masses=_marked(edited, joint, key))


def stretched_shapes(original: Robot, edited: Robot) -> tuple[Shape, ...]:
    """The shapes of `original`, stretched piece by piece where `edited` (of the same joints) has another a or d.

    A length that was 0 has nothing that could be stretched: a bar is put there.
    """
    shapes = original.shapes
    for segment in _changed_segments(original, edited):
        shapes = tuple(_stretched(shape, segment) if shape.frame == segment.frame else shape for shape in shapes)
    return (*shapes, *_bars(original, edited)) if shapes else ()


def _bars(original: Robot, edited: Robot) -> Iterator[Shape]:
    for index, (old, new) in enumerate(zip(original.joints, edited.joints, strict=True)):
        for frame, start, end in _new_pieces(original.convention, index, old, new):
            yield CapsuleShape(frame, start, end, _BAR * original.size)


def _new_pieces(convention: Convention, index: int, old: Joint, new: Joint) -> Iterator[_Piece]:
    """The pieces of a DH row that were of no length before: (frame, start, end)."""
    x, origin = np.array([1.0, 0.0, 0.0]), np.zeros(3)
    new_a = old.a == 0.0 != new.a
    # With a new a the look of d is no longer on the joint's axis.
    new_d = new.revolute and new.d != 0.0 and (new_a or old.d == 0.0)
    z, corner = np.array([0.0, 0.0, 1.0]), origin
    if convention == "standard":
        z, corner = np.array([0.0, np.sin(new.alpha), np.cos(new.alpha)]), -new.a * x
    if new_a:
        yield (index + 1, corner, origin) if convention == "standard" else (index, origin, new.a * x)
    if new_d:
        yield index + 1, corner - new.d * z, corner


def _changed_segments(original: Robot, edited: Robot) -> Iterator[_Segment]:
    for index, (old, new) in enumerate(zip(original.joints, edited.joints, strict=True)):
        for segment in _segments(original.convention, index, old, new):
            if segment.old != 0.0 and segment.new != segment.old:
                yield segment


def _segments(convention: Convention, index: int, old: Joint, new: Joint) -> Iterator[_Segment]:
    """The pieces of a DH row: a along x, d along z, each in the frame of the link that it is a part of.

    The d of a prismatic joint is its stroke's offset, which no link is as long as.
    """
    x, z, origin = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]), np.zeros(3)
    if convention == "standard":
        yield _Segment(index + 1, -old.a * x, x, old.a, new.a, from_start=False)
        # z of the frame before, seen from behind the twist alpha.
        z = np.array([0.0, np.sin(old.alpha), np.cos(old.alpha)])
    else:
        yield _Segment(index, origin, x, old.a, new.a, from_start=True)
    if old.revolute:
        yield _Segment(index + 1, -old.d * z, z, old.d, new.d, from_start=False)
        if index == 0:  # the base's column stands under the first joint
            yield _Segment(0, origin, np.array([0.0, 0.0, 1.0]), old.d, new.d, from_start=True)


def _stretched(shape: Shape, segment: _Segment) -> Shape:
    if isinstance(shape, CapsuleShape):
        return replace(shape, start=segment.moved(shape.start), end=segment.moved(shape.end))
    return _stretched_box(shape, segment)


def _stretched_box(box: BoxShape, segment: _Segment) -> BoxShape:
    """A box grows along an edge; across its edges it can only be moved."""
    half = box.size / 2 * np.abs(segment.axis)
    if np.count_nonzero(np.abs(segment.axis) > 1e-9) > 1:
        return replace(box, center=segment.moved(box.center))
    near, far = segment.moved(box.center - half), segment.moved(box.center + half)
    size = np.where(np.abs(segment.axis) > 1e-9, np.maximum(np.abs(far - near), 1e-4), box.size)
    return replace(box, center=(near + far) / 2, size=size)


def _marked(robot: Robot, joint: int, key: DHKey) -> tuple[LinkMass, ...]:
    """The masses, that of the link whose geometry the key is a part of marked as assumed."""
    link = joint - 1 if robot.convention == "modified" and key in ("a", "alpha") else joint
    return tuple(
        replace(mass, assumed=True, source=_EDITED) if index == link and not mass.assumed else mass
        for index, mass in enumerate(robot.masses)
    )
