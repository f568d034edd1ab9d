"""The robot: what it is, its DH table, its limits, where the numbers come from and what is assumed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rvsim.lab.report.figures import (
    DASH,
    Measure,
    Measures,
    lined_up,
    number_word,
    subscript,
    transform_latex,
    with_minus,
)
from rvsim.lab.report.pictures import floor_distance, robot_picture
from rvsim.lab.report.servo_table import servo_tables
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import ASSUMED, Block, Column, Figure, Formula, Items, Paragraph, Section, Table, Words
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Datum, Joint, Robot

_LINK_PRODUCTS = {
    "standard": "R_z(\\theta_i)\\,T_z(d_i)\\,T_x(a_i)\\,R_x(\\alpha_i)",
    "modified": "R_x(\\alpha_{i-1})\\,T_x(a_{i-1})\\,T_z(d_i)\\,R_z(\\theta_i)",
}
_CONVENTIONS = {
    "standard": tr_later("standard Denavit–Hartenberg convention"),
    "modified": tr_later("modified Denavit–Hartenberg convention (Craig)"),
}
_ZERO = 1e-12


def robot_section(study: Study, measures: Measures) -> Section:
    """Picture, table, transforms, origin of the numbers."""
    robot = study.robot
    return Section(
        tr("The robot"),
        (
            Paragraph(_introduction(robot)),
            Figure(
                tr(
                    "The arm in the pose of this report, with the frames of its table; the lines of the floor are "
                    "{distance} apart.",
                    distance=measures.length.shorter(floor_distance(robot)),
                ),
                (robot_picture(study),),
            ),
            Paragraph(
                tr(
                    "Its links follow the {convention}; one link is the product",
                    convention=tr(_CONVENTIONS[robot.convention]),
                )
            ),
            Formula("{}^{i-1}T_i = A_i", (_LINK_PRODUCTS[robot.convention],)),
            _dh_table(robot, measures),
            *_fixed_transforms(robot, measures),
            _limits_table(robot, measures),
            *servo_tables(robot, measures),
            *_origin(robot),
        ),
    )


def _introduction(robot: Robot) -> str:
    name = tr("{robot} ({family})", robot=tr(robot.title), family=tr(robot.family)) if robot.family else tr(robot.title)
    turning = int(robot.is_revolute.sum())
    sliding = robot.dof - turning
    sentences = []
    if turning:
        count = number_word(turning)
        sentences.append(
            trn(
                "The {robot} has {count} joint that turns.",
                "The {robot} has {count} joints that turn.",
                turning,
                robot=name,
                count=count,
            )
        )
    if sliding:
        count = number_word(sliding)
        sentences.append(
            trn(
                "The {robot} has {count} joint that slides.",
                "The {robot} has {count} joints that slide.",
                sliding,
                robot=tr(robot.title) if turning else name,
                count=count,
            )
        )
        sentences.append(tr("The variable qᵢ of a joint is an angle where it turns and a length where it slides."))
    return " ".join(sentences)


def _dh_table(robot: Robot, measures: Measures) -> Table:
    shift = "" if robot.convention == "standard" else "₋₁"
    heads = ("θᵢ", "dᵢ", f"aᵢ{shift}", f"αᵢ{shift}")
    units = (measures.angle.unit, measures.length.unit, measures.length.unit, measures.angle.unit)
    columns = (
        Column("i", "center"),
        Column(tr("Joint"), "left"),
        *(Column(f"{head} [{unit}]") for head, unit in zip(heads, units, strict=True)),
    )
    rows = tuple(_dh_row(index, joint, measures) for index, joint in enumerate(robot.joints))
    note = tr("qᵢ: the joint variable.")
    if any(joint.dh_assumed for joint in robot.joints):
        note = " ".join((note, tr("{assumed} assumed: no source gives the row.", assumed=ASSUMED)))
    return Table(tr("DH parameters of the {title}.", title=tr(robot.title)), columns, rows, note)


def _dh_row(index: int, joint: Joint, measures: Measures) -> tuple[Words, ...]:
    angle, length = measures.angle, measures.length
    variable = f"q{subscript(index + 1)}"
    theta = _with_variable(variable, joint.theta, angle) if joint.revolute else angle.text(joint.theta)
    d = length.text(joint.d) if joint.revolute else _with_variable(variable, joint.d, length)
    mark = f" {ASSUMED}" if joint.dh_assumed else ""
    return (str(index + 1), f"{tr(joint.name)}{mark}", theta, d, length.text(joint.a), angle.text(joint.alpha))


def _with_variable(variable: str, offset: float, measure: Measure) -> str:
    if abs(offset) < _ZERO:
        return variable
    return f"{variable} {'+' if offset > 0.0 else '−'} {measure.text(abs(offset))}"


def _fixed_transforms(robot: Robot, measures: Measures) -> Iterator[Block]:
    unit = measures.length.unit
    if not np.allclose(robot.T_base_0, np.eye(4), atol=_ZERO):
        yield Paragraph(tr("Frame 0 of the table stands in the base frame as follows (lengths in {unit}):", unit=unit))
        yield Formula("{}^{b}T_0", (transform_latex(robot.T_base_0, measures.length),))
    if not np.allclose(robot.T_flange_tool, np.eye(4), atol=_ZERO):
        yield Paragraph(
            tr(
                "The tool is “{title}”; it is bolted to the flange by (lengths in {unit})",
                title=tr(robot.tool.title),
                unit=unit,
            )
        )
        yield Formula(f"{{}}^{{{robot.dof}}}T_t", (transform_latex(robot.T_flange_tool, measures.length),))


def _limits_table(robot: Robot, measures: Measures) -> Table:
    columns = (
        Column("i", "center"),
        Column(tr("Joint"), "left"),
        *unit_columns(measures),
        Column(measures.head(tr("from"))),
        Column(measures.head(tr("to"))),
        Column(measures.head(tr("home"))),
        Column(measures.head(tr("speed"), "/s")),
        Column(measures.head(tr("accel."), "/s²")),
        Column(tr("torque [N m]") if robot.is_revolute.all() else tr("torque [N m, N]")),
    )
    rows = lined_up([_limits_row(index, joint, measures) for index, joint in enumerate(robot.joints)])
    assumed = any(_marked(joint) for joint in robot.joints)
    notes = (
        *((tr("{assumed} assumed: no source gives it.", assumed=ASSUMED),) if assumed else ()),
        *(() if measures.in_heads else (tr("Speed and acceleration in the joint’s unit."),)),
    )
    return Table(tr("Limits of the joints, and what their drives may do."), columns, rows, " ".join(notes))


def unit_columns(measures: Measures) -> tuple[Column, ...]:
    """The column of the units of joints, where the heads of the others do not say it."""
    return () if measures.in_heads else (Column(tr("unit"), "center"),)


def _marked(joint: Joint) -> bool:
    rated = (joint.max_speed, joint.max_acceleration, joint.max_torque)
    return joint.limits_assumed or any(datum is not None and datum.assumed for datum in rated)


def _limits_row(index: int, joint: Joint, measures: Measures) -> tuple[Words, ...]:
    measure = measures.joint(index)
    mark = f" {ASSUMED}" if joint.limits_assumed else ""
    bounds = [measure.text(value, 1) for value in (joint.lower, joint.upper, joint.home)]
    rates = [_rated(datum, measure.factor) for datum in (joint.max_speed, joint.max_acceleration)]
    return (
        str(index + 1), f"{tr(joint.name)}{mark}", *measures.unit_cell(index), *bounds, *rates,
        _rated(joint.max_torque, 1.0),
    )  # fmt: skip


def _rated(datum: Datum | None, factor: float) -> str:
    if datum is None:
        return DASH
    return f"{datum.value * factor:.4g}{' ' + ASSUMED if datum.assumed else ''}"


def _origin(robot: Robot) -> Iterator[Block]:
    if robot.source:
        yield Paragraph(tr("Source of the numbers: {source}.", source=tr(robot.source).rstrip(".")))
    notes = tuple(with_minus(line.strip()) for line in tr(robot.notes).strip().splitlines() if line.strip())
    if notes:
        yield Paragraph(tr("What to know about them:"))
        yield Items(notes)
