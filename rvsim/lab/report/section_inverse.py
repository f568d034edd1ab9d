"""Inverse kinematics: every branch of the tool's pose with its verdict, and the closed form worked out by hand."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.inverse import Branch
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.words import branch_title
from rvsim.lab.report.figures import Measures, number, number_word, scientific, small, subscript, within_limits_words
from rvsim.lab.report.pictures import branches_picture
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import (
    Block,
    Column,
    Figure,
    Formula,
    Items,
    Paragraph,
    Run,
    Section,
    Subheading,
    Table,
    Words,
    with_indices,
)
from rvsim.lab.sentences import failure_sentence
from rvsim.lab.worked import Equation, Step, WorkedBranch, WorkedSolution, worked_solution
from rvsim.language import tr, tr_later, trn

_SAME = 1e-6
_HYPHEN = "\u2011"  # at which no line breaks: "no-flip" is one word
TASKS = {
    "pose": tr_later("place and orientation of the tool"),
    "position": tr_later("the place of the tool; its orientation follows"),
    "position+yaw": tr_later("the place of the tool and its yaw"),
    "x,y": tr_later("the place of the tool in the plane"),
}


def inverse_section(study: Study, measures: Measures, *, steps: bool = True) -> Section:
    """Branches, and with `steps` the way to the one that the arm is in."""
    try:
        solution = worked_solution(study.robot, study.T, study.q, study.units)
    except NoClosedFormError as problem:
        return Section(tr("Inverse kinematics"), (Paragraph(str(problem)),))
    return Section(
        tr("Inverse kinematics"),
        (
            *_branches(study, measures, solution),
            *(_worked(study, solution) if steps else ()),
        ),
    )


def _branches(study: Study, measures: Measures, solution: WorkedSolution) -> Iterator[Block]:
    assert study.inverse is not None, "a worked solution has branches"
    found = study.inverse.branches
    within = sum(branch.within_limits for branch in found)
    count = trn(
        "The closed form finds {count} branch for the pose above.",
        "The closed form finds {count} branches for the pose above.",
        len(found),
        count=number_word(len(found)),
    )
    asked = tr("Asked for is {task}.", task=tr(TASKS[closed_form(study.robot).task]))
    verdict = within_limits_words(within, len(found)) if found else ""
    yield Paragraph(f"{asked} {count} {verdict}".rstrip())
    yield _branch_table(study, measures, found)
    if len(found) > 1:
        yield Figure(
            tr(
                "All branches, numbered as in the table: in colour those within the limits, dashed those that break "
                "one."
            ),
            (branches_picture(study, found),),
        )
    dead = [end for end in solution.branches if end.q is None]
    if dead:
        yield Paragraph(tr("Without a solution:"))
        yield Items(tuple(f"{branch_title(end.label)}: {end.reason}" for end in dead))
    failure = study.inverse.failure
    if failure is not None:
        yield Paragraph(failure_sentence(failure, study.units))


def _branch_table(study: Study, measures: Measures, found: tuple[Branch, ...]) -> Table:
    joints = tuple(Column(f"q{subscript(i + 1)} [{measures.joint(i).unit}]") for i in range(study.robot.dof))
    columns = (
        Column("", "center"), Column(tr("Branch"), "left", wide=True), *joints, Column(tr("within"), "center"),
        Column(tr("margin")), Column(tr("residual")), Column("w"),
    )  # fmt: skip
    rows = tuple(_branch_row(number, study, measures, branch) for number, branch in enumerate(found, 1))
    note = tr(
        "▸ the pose of the arm. Margin: of the joint that is nearest to a limit or farthest beyond it. "
        "Residual: the largest entry of |FK − T| (lengths in metres). w: manipulability."
    )
    return Table(tr("All branches, the nearest to the arm's pose first."), columns, rows, note)


def _branch_row(row: int, study: Study, measures: Measures, branch: Branch) -> tuple[Words, ...]:
    here = float(np.abs(branch.q - study.q).max()) < _SAME
    tightest = int(np.argmin(branch.limit_margin))
    margin = measures.joint(tightest)
    verdict = Run(tr("✓ yes"), "good") if branch.within_limits else Run(tr("✗ no"), "bad")
    joints = (measures.joint(i).text(float(value), 1) for i, value in enumerate(branch.q))
    return (
        f"{row}{' ▸' if here else ''}",
        branch_title(branch.label).replace("-", _HYPHEN),
        *joints,
        verdict,
        f"{number(float(branch.limit_margin[tightest]) * margin.factor, 1)} {margin.unit}".replace(" °", "°"),
        scientific(branch.residual),
        small(branch.manipulability),
    )


# --- step by step --------------------------------------------------------------------------------------------------


def _worked(study: Study, solution: WorkedSolution) -> Iterator[Block]:
    end = _end(study, solution)
    if end is None:
        return
    branch = tr("The closed form, step by step: branch “{branch}”", branch=branch_title(end.label))
    yield Subheading(branch if end.label else tr("The closed form, step by step: solution"))
    for count, step in enumerate(solution.along(end.path), 1):
        yield from step_blocks(count, step)


def _end(study: Study, solution: WorkedSolution) -> WorkedBranch | None:
    """The branch that the arm is in, or else the nearest."""
    known = solution.solutions
    return min(known, key=lambda end: float(np.abs(_turned(study, end)).max()), default=None)


def _turned(study: Study, end: WorkedBranch) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    assert end.q is not None
    gap = end.q - study.q
    turns = 2.0 * np.pi * np.rint(gap / (2.0 * np.pi))
    return np.asarray(gap - np.where(study.robot.is_revolute, turns, 0.0))


def step_blocks(count: int, step: Step) -> Iterator[Block]:
    """A step: its title and reason, its equations, and where a source has it otherwise."""
    text = f" {step.text}" if step.text else ""
    yield Paragraph((Run(tr("Step {count}. {title}.", count=count, title=step.title), "bold"), *with_indices(text)))
    for equation in step.equations:
        yield Formula(equation.left, _sides(equation))
    if step.failure:
        yield Paragraph(step.failure)
    if step.source_note:
        yield Paragraph(step.source_note, "note")


def _sides(equation: Equation) -> tuple[str, ...]:
    return tuple(side for side in (equation.formula, equation.substituted, equation.result) if side)
