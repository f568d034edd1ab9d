"""Results as records and tables for programs: degrees and millimetres, and no number that is not finite.

The lengths of an arm whose source gives them no unit are in its own unit.
"""

from __future__ import annotations

import csv
import io
import json
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

_FACTORS = {"deg": degrees_from_radians(1.0), "mm": millimetres_from_metres(1.0), "unit": 1.0}


def length_unit(robot: Robot) -> str:
    """What its lengths are shown in: "mm", or "unit" where its source gives them none."""
    return "unit" if robot.length_unit == "unit" else "mm"


def shown_length(robot: Robot, length: ArrayLike) -> FloatArray:
    """Lengths [m] in the arm's `length_unit`."""
    return np.asarray(np.asarray(length, dtype=np.float64) * _FACTORS[length_unit(robot)])


def joint_units(robot: Robot) -> tuple[str, ...]:
    """What each joint is shown in: "deg", or the unit of length for a prismatic one."""
    return tuple("deg" if joint.revolute else length_unit(robot) for joint in robot.joints)


def shown_factors(robot: Robot) -> FloatArray:
    """(n,) from q [rad, m] to the `joint_units`."""
    return np.array([_FACTORS[unit] for unit in joint_units(robot)])


def shown_joints(robot: Robot, q: ArrayLike) -> FloatArray:
    """q (..., n) in the `joint_units`."""
    return np.asarray(np.asarray(q, dtype=np.float64) * shown_factors(robot))


def tracking_record(tracking: Tracking) -> Record:
    """The outcome of a tracking, as `rvsim track --json` prints it; an index counts from 0.

    An arm without a unit of length has "rms_unit" and "max_unit" as well; its "…_mm" count a unit as 1000 mm.
    """
    deviations = {"rms": tracking.rms, "max": tracking.max_deviation}
    own = {f"{name}_unit": value for name, value in deviations.items() if length_unit(tracking.robot) == "unit"}
    return {
        "points": tracking.samples,
        "reached": tracking.reached_count,
        "unreached": [_unreached_record(tracking.robot, point) for point in tracking.unreached],
        **{f"{name}_mm": _millimetres(value) for name, value in deviations.items()},
        "jumps": len(tracking.jumps),
        "ik_ms": 1e3 * tracking.solve_seconds,
        **own,
    }


def inverse_record(robot: Robot, result: InverseResult) -> Record:
    """Every branch and the failure, as `rvsim ik --json` prints them."""
    return {
        "robot": robot.name,
        "branches": [_branch_record(robot, branch) for branch in result.branches],
        "failure": None if result.failure is None else _failure_record(robot, result.failure),
    }


def pose_record(robot: Robot, T: FloatArray) -> Record:
    """Place ("xyz_mm" or "xyz_unit") and orientation of a pose (4, 4); the rotation is Rz(yaw) Ry(pitch) Rx(roll)."""
    rpy = rpy_from_rotation(T[:3, :3])
    return {f"xyz_{length_unit(robot)}": shown_length(robot, T[:3, 3]), "rpy_deg": degrees_from_radians(rpy)}


def tracking_csv(tracking: Tracking) -> str:
    """One row a point: where the tool should be, the joints, where it is; empty cells where it was not reached.

    The index counts from 0, and each column's name ends in its unit.
    """
    robot, unit = tracking.robot, length_unit(tracking.robot)
    joints = [f"{_column(name)}_{shown}" for name, shown in zip(robot.joint_names, joint_units(robot), strict=True)]
    places = [f"{axis}_{unit}" for axis in ("x", "y", "z", "x_actual", "y_actual", "z_actual")]
    header = ["index", *places[:3], "reached", *joints, *places[3:], f"deviation_{unit}"]
    rows = zip(
        shown_length(robot, tracking.path.points),
        tracking.reached,
        shown_joints(robot, tracking.q),
        shown_length(robot, tracking.actual),
        shown_length(robot, tracking.deviation),
        strict=True,
    )
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
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


def json_text(record: Any) -> str:
    """The record as JSON: a line an entry, and a line an item of a list in it; thousands of them stay legible."""
    return _lines(without_nan(record), 2)


def _lines(value: Any, levels: int, indent: str = "") -> str:
    """Two levels broken into lines, unless there is only a list of numbers or names; what is inside is compact."""
    if not levels or not _is_nested(value):
        return json.dumps(value, allow_nan=False, ensure_ascii=False)
    inside, is_dict = f"{indent}  ", isinstance(value, dict)
    keys = [f"{json.dumps(key, ensure_ascii=False)}: " for key in value] if is_dict else [""] * len(value)
    items = value.values() if is_dict else value
    rows = [f"{inside}{key}{_lines(item, levels - 1, inside)}" for key, item in zip(keys, items, strict=True)]
    first, last = "{}" if is_dict else "[]"
    return "\n".join((first, ",\n".join(rows), f"{indent}{last}"))


def _is_nested(value: Any) -> bool:
    """A record, or a list that holds other than numbers and names."""
    return isinstance(value, dict) or (isinstance(value, list) and any(isinstance(i, (dict, list)) for i in value))


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
    nearest = {"q": shown_joints(robot, failure.nearest_q), **pose_record(robot, failure.nearest_T)}
    return {"kind": failure.kind, "reason": failure.reason, "joint": failure.joint, "nearest": nearest}


def _unreached_record(robot: Robot, point: Unreached) -> Record:
    value = limit = unit = None
    if point.joint is not None and point.value is not None and point.limit is not None:
        unit = joint_units(robot)[robot.joint_names.index(point.joint)]
        value, limit = point.value * _FACTORS[unit], point.limit * _FACTORS[unit]
    joint = {"joint": point.joint, "value": value, "limit": limit, "unit": unit}
    return {"index": point.index, "kind": point.kind, **joint}


def _millimetres(length: float | None) -> float | None:
    return None if length is None else millimetres_from_metres(length)


def _column(name: str) -> str:
    return name.replace(" ", "_")


def _cells(values: Iterable[float]) -> list[str]:
    return [repr(float(value)) if math.isfinite(value) else "" for value in values]
