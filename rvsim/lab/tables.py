"""Results as records and tables for programs: degrees and millimetres, and no number that is not finite."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.inverse import Branch, Failure, InverseResult
from rvsim.motion import Tracking, Unreached
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation
from rvsim.units import degrees_from_radians, millimetres_from_metres

Record = dict[str, Any]

_DEGREES_IN_A_RADIAN = degrees_from_radians(1.0)
_MILLIMETRES_IN_A_METRE = millimetres_from_metres(1.0)


def shown_factors(robot: Robot) -> FloatArray:
    """(n,) from q [rad, m] to degrees or millimetres."""
    return np.where(robot.is_revolute, _DEGREES_IN_A_RADIAN, _MILLIMETRES_IN_A_METRE)


def shown_joints(robot: Robot, q: ArrayLike) -> FloatArray:
    """q (..., n) in degrees, millimetres for a prismatic joint."""
    return np.asarray(np.asarray(q, dtype=np.float64) * shown_factors(robot))


def tracking_record(tracking: Tracking) -> Record:
    """The outcome of a tracking, as `rvsim track --json` prints it."""
    return {
        "points": tracking.samples,
        "reached": tracking.reached_count,
        "unreached": [_unreached_record(tracking.robot, point) for point in tracking.unreached],
        "rms_mm": _millimetres(tracking.rms),
        "max_mm": _millimetres(tracking.max_deviation),
        "jumps": len(tracking.jumps),
        "ik_ms": 1e3 * tracking.solve_seconds,
    }


def inverse_record(robot: Robot, result: InverseResult) -> Record:
    """Every branch and the failure, as `rvsim ik --json` prints them."""
    return {
        "robot": robot.name,
        "branches": [_branch_record(robot, branch) for branch in result.branches],
        "failure": None if result.failure is None else _failure_record(robot, result.failure),
    }


def pose_record(T: FloatArray) -> Record:
    """Place and orientation of a pose (4, 4); the rotation is Rz(yaw) Ry(pitch) Rx(roll)."""
    rpy = rpy_from_rotation(T[:3, :3])
    return {"xyz_mm": millimetres_from_metres(T[:3, 3]), "rpy_deg": degrees_from_radians(rpy)}


def tracking_csv(tracking: Tracking) -> str:
    """One row a point: where the tool should be, the joints, where it is; empty cells where it was not reached."""
    joints = [f"{_column(joint.name)}_{'deg' if joint.revolute else 'mm'}" for joint in tracking.robot.joints]
    header = ["index", "x_mm", "y_mm", "z_mm", "reached", *joints, "x_actual_mm", "y_actual_mm", "z_actual_mm"]
    rows = zip(
        millimetres_from_metres(tracking.path.points),
        tracking.reached,
        shown_joints(tracking.robot, tracking.q),
        millimetres_from_metres(tracking.actual),
        millimetres_from_metres(tracking.deviation),
        strict=True,
    )
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*header, "deviation_mm"])
    for index, (point, reached, q, actual, deviation) in enumerate(rows):
        writer.writerow([index, *_cells(point), int(reached), *_cells(q), *_cells(actual), *_cells([deviation])])
    return text.getvalue()


def without_nan(value: Any) -> Any:
    """The same record with None for every number that is not finite, arrays as lists: what JSON can say."""
    if isinstance(value, dict):
        return {key: without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return without_nan(value.tolist())
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _branch_record(robot: Robot, branch: Branch) -> Record:
    return {
        "label": branch.label,
        "q": shown_joints(robot, branch.q),
        "within_limits": branch.within_limits,
        "limit_margin": shown_joints(robot, branch.limit_margin),
        "residual": branch.residual,
        "manipulability": branch.manipulability,
        "continuum": branch.continuum,
    }


def _failure_record(robot: Robot, failure: Failure) -> Record:
    nearest = {"q": shown_joints(robot, failure.nearest_q), **pose_record(failure.nearest_T)}
    return {"kind": failure.kind, "reason": failure.reason, "joint": failure.joint, "nearest": nearest}


def _unreached_record(robot: Robot, point: Unreached) -> Record:
    value = limit = None
    if point.joint is not None and point.value is not None and point.limit is not None:
        factor = float(shown_factors(robot)[robot.joint_names.index(point.joint)])
        value, limit = point.value * factor, point.limit * factor
    return {"index": point.index, "kind": point.kind, "joint": point.joint, "value": value, "limit": limit}


def _millimetres(length: float | None) -> float | None:
    return None if length is None else millimetres_from_metres(length)


def _column(name: str) -> str:
    return name.replace(" ", "_")


def _cells(values: Iterable[float]) -> list[str]:
    return [repr(float(value)) if math.isfinite(value) else "" for value in values]
