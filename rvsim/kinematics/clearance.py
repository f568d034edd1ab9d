"""How far an arm is from the table and from itself, by the capsules and boxes of its solid look.

A capsule counts exactly. Against the table a box counts exactly too (its corners); against the arm itself it is filled
with capsules from within: its edges and corners count as rounded, by less than a third of its shortest edge. An arm
without a solid look is taken as the lines between its joints, without thickness. Links that share a joint are left
out, and those that touch each other at home or nearly do: they are so close by their making. The base stands on the
table, so it never counts against it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics.dh import joint_array
from rvsim.kinematics.forward import link_transforms
from rvsim.robot import BoxShape, CapsuleShape, Robot
from rvsim.robot.arrays import FloatArray

_MOST_SIDE_BY_SIDE = 6  # capsules in a box
_AT_ONCE = 200_000  # pairs of capsules
_CLOSE_BY_MAKING = 0.02  # of the arm's size, at home
_TINY = 1e-300

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Clearance:
    """Of poses (...,).

    Args:
        table: (...) the height of the lowest point of the moving arm above the table [m], negative below it; inf for
            an arm without one.
        own: (...) the least distance between two of its links [m]; negative where they overlap, by how much their
            capsules' radii do; inf where no two links can meet.
        lowest: (...) the link of that point: 0 the base, i the one behind joint i; the tool belongs to the last one.
        pair: (..., 2) the two links.
    """

    table: FloatArray
    own: FloatArray
    lowest: NDArray[Any]
    pair: NDArray[Any]


def clearance(robot: Robot, q: ArrayLike, *, table: float = 0.0) -> Clearance:
    """Of the poses q (..., n) [rad, m].

    Args:
        table: its height, z in base axes [m].

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    poses = joint_array(robot, q)
    leading = poses.shape[:-1]
    T = link_transforms(robot, poses.reshape(-1, robot.dof))
    height, lowest = _above_table(_body(robot), T)
    own, pair = _apart(_body(robot), _pairs(robot), T)
    return Clearance(
        (height - table).reshape(leading),
        own.reshape(leading),
        lowest.reshape(leading),
        pair.reshape(*leading, 2),
    )


class _Body(NamedTuple):
    """All capsules (k,) of an arm, and the points (p,) that are lowest: ends with a radius, or corners without one."""

    link: Indices
    start: FloatArray
    end: FloatArray
    radius: FloatArray
    point_link: Indices
    point: FloatArray
    point_radius: FloatArray


class _Piece(NamedTuple):
    start: FloatArray
    end: FloatArray
    radius: float


@lru_cache(maxsize=64)
def _body(robot: Robot) -> _Body:
    links: list[int] = []
    pieces: list[_Piece] = []
    points: list[tuple[int, FloatArray, float]] = []
    for link, shape in _shapes(robot):
        made = [_Piece(shape.start, shape.end, shape.radius)] if isinstance(shape, CapsuleShape) else _filled(shape)
        pieces += made
        links += [link] * len(made)
        if link and isinstance(shape, CapsuleShape):
            points += [(link, shape.start, shape.radius), (link, shape.end, shape.radius)]
        elif link and isinstance(shape, BoxShape):
            points += [(link, corner, 0.0) for corner in _corners(shape)]
    return _Body(
        np.array(links, dtype=np.intp),
        np.array([piece.start for piece in pieces]).reshape(-1, 3),
        np.array([piece.end for piece in pieces]).reshape(-1, 3),
        np.array([piece.radius for piece in pieces]),
        np.array([link for link, _, _ in points], dtype=np.intp),
        np.array([point for _, point, _ in points]).reshape(-1, 3),
        np.array([radius for _, _, radius in points]),
    )


def _shapes(robot: Robot) -> list[tuple[int, CapsuleShape | BoxShape]]:
    """Each shape in the frame of the link it moves with; those of the tool in that of the last link."""
    if not robot.shapes:
        return _lines(robot)
    placed: list[tuple[int, CapsuleShape | BoxShape]] = []
    for shape in robot.shapes:
        if shape.frame <= robot.dof:
            placed.append((shape.frame, shape))
        else:
            placed += [(robot.dof, capsule) for capsule in _on_the_flange(robot, shape)]
    return placed


def _on_the_flange(robot: Robot, shape: CapsuleShape | BoxShape) -> list[CapsuleShape]:
    """A shape of the tool frame as capsules of the last link: a turned box has no edges along that link's axes."""
    T = robot.T_flange_tool
    pieces = [_Piece(shape.start, shape.end, shape.radius)] if isinstance(shape, CapsuleShape) else _filled(shape)
    R, p = T[:3, :3], T[:3, 3]
    return [CapsuleShape(robot.dof, R @ piece.start + p, R @ piece.end + p, piece.radius) for piece in pieces]


def _lines(robot: Robot) -> list[tuple[int, CapsuleShape | BoxShape]]:
    """From each joint to the next, as seen from the link between them, for an arm that slides along none of them."""
    T = link_transforms(robot, robot.home)
    origins = T[:, :3, 3]
    lines: list[tuple[int, CapsuleShape | BoxShape]] = []
    for link in range(1, robot.dof + 1):
        R, p = T[link, :3, :3], origins[link]
        lines.append((link, CapsuleShape(link, R.T @ (origins[link - 1] - p), np.zeros(3), 0.0)))
    tip = robot.T_flange_tool[:3, 3]
    return [*lines, (robot.dof, CapsuleShape(robot.dof, np.zeros(3), tip, 0.0))]


def _filled(box: BoxShape) -> list[_Piece]:
    """Capsules side by side along the longest edge, as thick as the shortest one."""
    short, middle, long = np.argsort(box.size, kind="stable")
    radius = 0.5 * float(box.size[short])
    count = min(math.ceil(float(box.size[middle]) / (2.0 * radius)), _MOST_SIDE_BY_SIDE)
    half, side = np.zeros(3), np.zeros(3)
    half[long] = 0.5 * box.size[long] - radius
    side[middle] = 0.5 * box.size[middle] - radius
    offsets = np.linspace(-1.0, 1.0, count) if count > 1 else np.zeros(1)
    return [_Piece(box.center + t * side - half, box.center + t * side + half, radius) for t in offsets]


def _corners(box: BoxShape) -> FloatArray:
    """(8, 3)."""
    signs = np.array(np.meshgrid((-0.5, 0.5), (-0.5, 0.5), (-0.5, 0.5))).reshape(3, -1).T
    return np.asarray(box.center + signs * box.size)


def _above_table(body: _Body, T: FloatArray) -> tuple[FloatArray, Indices]:
    """(m,) the least height z [m] at link transforms T (m, n + 1, 4, 4), and its link."""
    if not len(body.point):
        return np.full(len(T), np.inf), np.zeros(len(T), dtype=np.intp)
    row = T[:, body.point_link, 2]
    heights = np.sum(row[..., :3] * body.point, axis=-1) + row[..., 3] - body.point_radius
    lowest = np.argmin(heights, axis=1)
    return heights[np.arange(len(T)), lowest], body.point_link[lowest]


# --- the arm from itself -----------------------------------------------------------------------------------------


@lru_cache(maxsize=64)
def _pairs(robot: Robot) -> tuple[Indices, Indices]:
    """(p,) the capsules of two links each whose distance counts."""
    body, home = _body(robot), link_transforms(robot, robot.home)[None]
    members = [np.flatnonzero(body.link == link) for link in range(robot.dof + 1)]
    pairs = []
    for low, high in combinations(range(robot.dof + 1), 2):
        one, other = (part.ravel() for part in np.meshgrid(members[low], members[high]))
        close = _CLOSE_BY_MAKING * robot.size
        if high - low > 1 and len(one) and _apart(body, (one, other), home)[0][0] > close:
            pairs.append((one, other))
    if not pairs:
        return np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
    return np.concatenate([first for first, _ in pairs]), np.concatenate([second for _, second in pairs])


def _apart(body: _Body, pairs: tuple[Indices, Indices], T: FloatArray) -> tuple[FloatArray, NDArray[Any]]:
    """(m,) the least distance of all pairs (p,), and (m, 2) the links."""
    count = len(pairs[0])
    own, which = np.full(len(T), np.inf), np.zeros(len(T), dtype=np.intp)
    if not count:
        return own, np.zeros((len(T), 2), dtype=np.intp)
    block = max(_AT_ONCE // count, 1)
    for first in range(0, len(T), block):
        part = slice(first, first + block)
        own[part], which[part] = _least(body, pairs, T[part])
    return own, np.stack([body.link[pairs[0][which]], body.link[pairs[1][which]]], axis=-1)


def _least(body: _Body, pairs: tuple[Indices, Indices], T: FloatArray) -> tuple[FloatArray, Indices]:
    """(m,) the least distance and which pair has it; pairs that are too far apart by their middles are spared."""
    start, end = _moved(T, body.link, body.start), _moved(T, body.link, body.end)
    one, other = pairs
    radii = body.radius[one] + body.radius[other]
    half = 0.5 * np.linalg.norm(body.end - body.start, axis=1)
    middle = 0.5 * (start + end)
    far = np.linalg.norm(middle[:, one] - middle[:, other], axis=-1) - radii
    pose, chosen = np.nonzero(far - half[one] - half[other] <= far.min(axis=1, keepdims=True))
    a, b = one[chosen], other[chosen]
    exact = segment_distance(start[pose, a], end[pose, a], start[pose, b], end[pose, b]) - radii[chosen]
    distances = np.full(far.shape, np.inf)
    distances[pose, chosen] = exact
    which = np.argmin(distances, axis=1)
    return distances[np.arange(len(T)), which], which


def _moved(T: FloatArray, link: Indices, points: FloatArray) -> FloatArray:
    """(m, k, 3) points (k, 3) of links in base axes."""
    frames = T[:, link]
    return np.asarray(np.einsum("mkij,kj->mki", frames[..., :3, :3], points) + frames[..., :3, 3])


def segment_distance(p0: FloatArray, p1: FloatArray, q0: FloatArray, q1: FloatArray) -> FloatArray:
    """(...) the least distance between the segments p0–p1 and q0–q1, all (..., 3); a segment may be a point.

    Ericson, Real-Time Collision Detection (2005), §5.1.9.
    """
    d1, d2, r = p1 - p0, q1 - q0, p0 - q0
    a, e, f = (np.sum(u * v, axis=-1) for u, v in ((d1, d1), (d2, d2), (d2, r)))
    b, c = np.sum(d1 * d2, axis=-1), np.sum(d1 * r, axis=-1)
    determinant = a * e - b * b
    crossing = determinant > 1e-12 * a * e
    s = np.where(crossing, np.clip((b * f - c * e) / np.where(crossing, determinant, 1.0), 0.0, 1.0), 0.0)
    t = np.clip((b * s + f) / np.maximum(e, _TINY), 0.0, 1.0)
    s = np.clip((b * t - c) / np.maximum(a, _TINY), 0.0, 1.0)
    t = np.clip((b * s + f) / np.maximum(e, _TINY), 0.0, 1.0)
    return np.asarray(np.linalg.norm(r + s[..., None] * d1 - t[..., None] * d2, axis=-1))
