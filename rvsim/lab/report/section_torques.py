"""Forces and torques: τ = Jᵀ F with its numbers, and what the arm's own weight asks for where masses are known."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rvsim.dynamics import STANDARD_GRAVITY, gravity_torques, joint_torques, payload_wrench
from rvsim.lab.report.figures import DASH, lined_up, number, table_latex
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import ASSUMED, Block, Column, Formula, Paragraph, Section, Table, Words
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_EXERTS = {
    "base": tr_later("The tool exerts the force {force} and the moment {moment} in base axes."),
    "tool": tr_later("The tool exerts the force {force} and the moment {moment} in tool axes."),
}


@dataclass(frozen=True, eq=False)
class Torques:
    """What the joints give [N m, N]: against the wrench and payload (n,), and against the arm's weight, if known.

    Whether the weight is counted in the whole is for the student to say, as in the window.
    """

    wrench: FloatArray
    outer: FloatArray
    weight: FloatArray | None
    counted: bool

    @property
    def total(self) -> FloatArray:
        """(n,) what is counted."""
        return self.outer if self.weight is None or not self.counted else np.asarray(self.outer + self.weight)


def torques_of(study: Study) -> Torques:
    """At the pose, in base axes; the payload is carried upwards."""
    load, robot = study.experiment.load, study.robot
    wrench = load.in_base(study.T[:3, :3]) + payload_wrench(load.payload, STANDARD_GRAVITY)
    weight = gravity_torques(robot, study.q) if robot.masses else None
    counted = load.own_weight and weight is not None
    return Torques(np.asarray(wrench), np.asarray(joint_torques(robot, study.q, wrench)), weight, counted)


def torques_section(study: Study) -> Section:
    """The load, the formula with its numbers, one row a joint."""
    found = torques_of(study)
    return Section(
        tr("Forces and torques"),
        (
            Paragraph(" ".join(_load_words(study, found))),
            *(_formula(study, found) if np.any(found.wrench) else ()),
            _table(study, found),
        ),
    )


def _load_words(study: Study, found: Torques) -> Iterator[str]:
    load = study.experiment.load
    if np.any(load.wrench):
        force, moment = (", ".join(number(float(v), 2) for v in load.wrench[k : k + 3]) for k in (0, 3))
        yield tr(_EXERTS[load.axes], force=f"({force}) N", moment=f"({moment}) N m")
    if load.payload:
        yield tr("The tool carries {payload}.", payload=f"{load.payload:.3g} kg")
    if np.any(load.wrench) or load.payload:
        yield tr("The joints balance it with τ = Jᵀ F, F being what the tool exerts at its origin.")
    else:
        yield tr("No force at the tool and no payload were set.")
    if found.counted:
        yield tr("The arm’s own weight is counted in.")
    elif found.weight is not None:
        yield tr("The arm’s own weight was not to be counted: its column is there for comparison only.")


def _formula(study: Study, found: Torques) -> Iterator[Block]:
    told = tr("With F in base axes, force [N] above moment [N m], and J in metres and radians:")
    own = tr("With F in base axes, force [N] above moment, and J in the arm’s own unit and radians:")
    yield Paragraph(own if study.robot.length_unit == "unit" else told)
    yield Formula(
        "\\tau",
        (
            "J^T F",
            f"{table_latex(study.J.T, 3)}\\,{table_latex(found.wrench, 2)}",
            table_latex(found.outer, 3),
        ),
    )


def _table(study: Study, found: Torques) -> Table:
    robot = study.robot
    together = (tr("together"),) if found.counted else ()
    heads = (tr("from F"), tr("own weight"), *together, tr("rated"), tr("share"))
    columns = (Column("i", "center"), Column(tr("Joint"), "left"), Column(tr("unit"), "center"), *map(Column, heads))
    rows = lined_up([_row(robot, index, found) for index in range(robot.dof)])
    return Table(tr("Torques of the joints at rest."), columns, rows, " ".join(_notes(robot, found)))


def _notes(robot: Robot, found: Torques) -> Iterator[str]:
    if any(joint.max_torque and joint.max_torque.assumed for joint in robot.joints):
        yield tr("{assumed} assumed: no source gives it.", assumed=ASSUMED)
    if found.weight is None:
        yield tr("{dash}: the masses of this arm are not known.", dash=DASH)
    elif any(mass.assumed for mass in robot.masses):
        sources = dict.fromkeys(tr(mass.source).rstrip(".") for mass in robot.masses if mass.source)
        said = tr("; ").join(sources)
        yield tr("The masses behind the column “own weight” are assumed, not measured: {sources}.", sources=said)


def _row(robot: Robot, index: int, found: Torques) -> tuple[Words, ...]:
    joint, total = robot.joints[index], float(found.total[index])
    rating = joint.max_torque
    weight = DASH if found.weight is None else number(float(found.weight[index]), 3)
    rated = f"{rating.value:.4g}{' ' + ASSUMED if rating.assumed else ''}" if rating else DASH
    share = f"{100.0 * abs(total) / rating.value:.0f} %" if rating else DASH
    unit = "N m" if joint.revolute else "N"
    outer = number(float(found.outer[index]), 3)
    together = (number(total, 3),) if found.counted else ()
    return (str(index + 1), tr(joint.name), unit, outer, weight, *together, rated, share)
