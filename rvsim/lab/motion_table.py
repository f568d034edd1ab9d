"""A whole motion as a table for programs: time, joints, their speeds and accelerations, and the tool's pose."""

from __future__ import annotations

import csv
import io
from typing import Literal

import numpy as np

from rvsim.lab.tables import length_unit, shown_factors, shown_length
from rvsim.playback.curves import Curves
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation
from rvsim.units import degrees_from_radians

TableUnits = Literal["si", "screen"]

_POWERS = ("", "/s", "/s^2")


def motion_csv(curves: Curves, units: TableUnits = "screen") -> str:
    """One row a moment; a comment names the arm and its joints, the header each column with its unit.

    Columns: t; q1 … qn, qd1 … qdn, qdd1 … qddn; x, y, z; roll, pitch, yaw with R = Rz(yaw) Ry(pitch) Rx(roll).

    Args:
        units: "screen" for degrees and millimetres (the arm's own unit where its source gives its lengths none), "si"
            for radians and metres.
    """
    robot = curves.robot
    text = io.StringIO()
    joints = ", ".join(f"q{i} = {name}" for i, name in enumerate(robot.joint_names, 1))
    text.write(f"# {robot.title} ({robot.name}): {joints}. Tool in base axes, rpy: R = Rz(yaw) Ry(pitch) Rx(roll).\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_header(robot, units))
    writer.writerows([repr(float(value) + 0.0) for value in row] for row in _values(curves, units))
    return text.getvalue()


def _header(robot: Robot, units: TableUnits) -> list[str]:
    length = length_unit(robot) if units == "screen" or length_unit(robot) == "unit" else "m"
    angle = "deg" if units == "screen" else "rad"
    of_joints = [angle if revolute else length for revolute in robot.is_revolute]
    joints = [
        f"{name}{i} [{unit}{power}]"
        for name, power in zip(("q", "qd", "qdd"), _POWERS, strict=True)
        for i, unit in enumerate(of_joints, 1)
    ]
    tool = [*(f"{axis} [{length}]" for axis in "xyz"), *(f"{name} [{angle}]" for name in ("roll", "pitch", "yaw"))]
    return ["t [s]", *joints, *tool]


def _values(curves: Curves, units: TableUnits) -> FloatArray:
    robot, place, rpy = curves.robot, curves.place, rpy_from_rotation(curves.tool[:, :3, :3])
    factors = np.ones(robot.dof)
    if units == "screen":
        factors, place, rpy = shown_factors(robot), shown_length(robot, place), degrees_from_radians(rpy)
    columns = (curves.times[:, None], *(part * factors for part in (curves.q, curves.qd, curves.qdd)), place, rpy)
    return np.hstack(columns)
