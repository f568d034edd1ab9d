"""The Jacobian with its numbers, its singular values, and the singularities of the arm and how far they are."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rvsim.kinematics.singular_families import SingularFamily, singular_families
from rvsim.kinematics.singularity import Measures as Values
from rvsim.kinematics.singularity import Singularity, singularity
from rvsim.lab.report.figures import Measure, Measures, entry, matrix_latex, number, small, subscript
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Column, Formula, Paragraph, Run, Section, Table, Words, with_indices
from rvsim.language import left_to_right, listed, tr

_NEAR = 0.1  # of a family's term, to be called near


def jacobian_section(study: Study, measures: Measures) -> Section:
    """J, σ, families."""
    found = singularity(study.robot, study.q)
    unit = measures.length.unit
    joint = "rad" if study.robot.is_revolute.all() else tr("rad or {metre}", metre=unit)
    return Section(
        tr("The Jacobian"),
        (
            Paragraph(
                tr(
                    "The geometric Jacobian at the tool, in base axes: (v, ω) = J q̇. Its first three rows are the "
                    "tool’s velocity in {metre}/s, the last three its turning in rad/s, each for 1 {joint} per second "
                    "of a joint.",
                    metre=unit,
                    joint=joint,
                )
            ),
            Formula("J", (_numbers(study, measures),)),
            _sigma_table(found, measures),
            *_families(study, found, measures),
        ),
    )


def _numbers(study: Study, measures: Measures) -> str:
    """J with its lengths as they are shown: a joint that slides has a length on both sides."""
    factor, turning = measures.length.factor, study.robot.is_revolute
    J = np.array(study.J)
    J[:3, turning] *= factor
    J[3:, ~turning] /= factor
    above, below = (Measure(1.0, "", decimals) for decimals in (min(measures.length.decimals, 4), 4))
    rows = [[entry(float(value), above if row < 3 else below) for value in J[row]] for row in range(6)]
    return matrix_latex(rows)


def _sigma_table(found: Singularity, measures: Measures) -> Table:
    parts = [(tr("whole twist (v, ω)"), found.whole), (tr("velocity v alone"), found.position)]
    if found.task is not found.whole and found.task.full_rank not in (3,):
        parts.append((tr("the arm’s own task"), found.task))
    most = max(len(values.singular_values) for _, values in parts)
    columns = (
        Column(tr("Rows of J"), "left"), *(Column(f"σ{subscript(i + 1)}") for i in range(most)),
        Column(tr("condition")), Column("w"), Column(tr("rank")),
    )  # fmt: skip
    rows = tuple(_sigma_row(name, values, most) for name, values in parts)
    note = tr(
        "w: manipulability, the product of all σ (Yoshikawa). All of it with lengths in {metre}; σ mixes {metre} and "
        "rad in the first row.",
        metre=measures.metre,
    )
    return Table(tr("Singular values of the Jacobian."), columns, rows, note)


def _sigma_row(name: str, values: Values, most: int) -> tuple[Words, ...]:
    sigma = [small(float(value)) for value in values.singular_values]
    condition = "∞" if math.isinf(values.condition) else number(values.condition, 1)
    if not math.isinf(values.condition) and values.condition >= 1e5:
        condition = small(values.condition)
    rank = tr("{number} of {count}", number=values.rank, count=values.full_rank)
    return (name, *sigma, *[""] * (most - len(sigma)), condition, small(values.manipulability), rank)


def _families(study: Study, found: Singularity, measures: Measures) -> Iterator[Block]:
    known = singular_families(study.robot)
    active = [*found.families, *found.position_families]
    if active:
        singular = tr("The pose is singular: {names}.", names=listed([family.title for family in active]))
        yield Paragraph(with_indices(" ".join((singular, *(family.sentence for family in active)))))
    elif found.task.rank == found.task.full_rank:
        yield Paragraph(tr("The pose is not singular: the Jacobian of the arm’s task has its full rank."))
    if known:
        columns = (
            Column(tr("Singularity"), "left", wide=True), Column(tr("kind"), "left"), Column(tr("where it is"), "left"),
            Column(tr("here")), Column("", "left"),
        )  # fmt: skip
        rows = tuple(_family_row(study, family, measures) for family in known)
        yield Table(tr("The singularities of this arm, and how far the pose is from them."), columns, rows)


def _family_row(study: Study, family: SingularFamily, measures: Measures) -> tuple[Words, ...]:
    values = [
        measures.length.amount(float(value)) if term.is_length else small(float(value))
        for term, value in zip(family.terms, family.values(study.q), strict=True)
    ]
    measure = float(family.measure(study.q))
    state = Run("✓", "good")
    if measure <= 1e-6:
        state = Run(tr("✗ active"), "bad")
    elif measure < _NEAR:
        state = Run(tr("▲ near"), "warning")
    return (family.title, tr(family.kind), Run(family.formula, "math"), left_to_right(", ".join(values)), state)
