"""The pose: joints, each A_i with its numbers, the tool's pose as matrix, place and orientation."""

from __future__ import annotations

import numpy as np

from rvsim.experiment import limit_violations
from rvsim.kinematics import joint_transforms
from rvsim.lab.report.figures import PLAIN, Measures, transform_latex
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Column, Formula, Formulas, Paragraph, Section, Table, Words
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial import axis_angle_from_rotation, quaternion_from_rotation, rpy_from_rotation


def pose_section(study: Study, measures: Measures) -> Section:
    """From the joints to the tool."""
    robot, unit = study.robot, measures.length.unit
    links = tuple(
        f"A_{{{number}}} = {transform_latex(A, measures.length)}"
        for number, A in enumerate(joint_transforms(robot, study.q), 1)
    )
    return Section(
        tr("The pose: forward kinematics"),
        (
            _joints_table(study, measures),
            Paragraph(tr("With these values the transforms of the links are (lengths in {unit}):", unit=unit)),
            Formulas(links),
            Paragraph(tr("Their product is the pose of the tool in the base frame (lengths in {unit}):", unit=unit)),
            Formula("{}^{b}T_t", (_product(robot), transform_latex(study.T, measures.length))),
            *_tool(study, measures),
        ),
    )


def _product(robot: Robot) -> str:
    base = "" if np.allclose(robot.T_base_0, np.eye(4), atol=1e-12) else "{}^{b}T_0\\,"
    tool = "" if np.allclose(robot.T_flange_tool, np.eye(4), atol=1e-12) else f"\\,{{}}^{{{robot.dof}}}T_t"
    return base + "\\,".join(f"A_{{{number}}}" for number in range(1, robot.dof + 1)) + tool


def _joints_table(study: Study, measures: Measures) -> Table:
    si = "rad" if study.robot.is_revolute.all() else f"rad, {measures.metre}"
    columns = (
        Column("i", "center"), Column(tr("Joint"), "left"), Column(tr("unit"), "center"), Column("qᵢ"),
        Column(tr("nearer limit")), Column(tr("room to it")), Column(f"qᵢ [{si}]"),
    )  # fmt: skip
    rows = tuple(_joint_row(index, study, measures) for index in range(study.robot.dof))
    outside = bool(limit_violations(study.robot, study.q))
    return Table(
        tr("The joints."), columns, rows, tr("Room below 0: the joint is outside its limits.") if outside else ""
    )


def _joint_row(index: int, study: Study, measures: Measures) -> tuple[Words, ...]:
    joint, value, measure = study.robot.joints[index], float(study.q[index]), measures.joint(index)
    below, above = value - joint.lower, joint.upper - value
    limit, room = (joint.lower, below) if below < above else (joint.upper, above)
    texts = (measure.text(value), measure.text(limit), measure.text(room), PLAIN.text(value))
    return (str(index + 1), tr(joint.name), measure.unit, *texts)


def _tool(study: Study, measures: Measures) -> tuple[Block, ...]:
    place, R = study.T[:3, 3], study.T[:3, :3]
    rpy, quaternion = rpy_from_rotation(R), quaternion_from_rotation(R)
    axis, angle = axis_angle_from_rotation(R)
    length, turn = measures.length, measures.angle
    columns = (
        Column(tr("Quantity"), "left"),
        Column(tr("entries"), "left"),
        *(Column("") for _ in range(4)),
        Column(tr("unit"), "left"),
    )
    rows = (
        (tr("Position"), "x, y, z", *(length.text(float(v)) for v in place), "", length.unit),
        (tr("Orientation"), tr("roll, pitch, yaw"), *(turn.text(float(v)) for v in rpy), "", turn.unit),
        (tr("Quaternion"), "w, x, y, z", *(PLAIN.text(float(v)) for v in quaternion), ""),
        (
            tr("Axis and angle"),
            tr("x, y, z; angle"),
            *(PLAIN.text(float(v)) for v in axis),
            turn.text(float(angle)),
            turn.unit,
        ),
    )
    note = tr("R = Rz(yaw) Ry(pitch) Rx(roll), about the axes of the base; the axis is a unit vector.")
    return (Table(tr("Place and orientation of the tool."), columns, rows, note),)
