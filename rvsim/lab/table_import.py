"""What a table of joints or of points is for an arm: which columns it needs, and the values that it means."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from rvsim.errors import PathFileError
from rvsim.experiment import limit_violations
from rvsim.experiment.program import JointMove, LineMove, Program
from rvsim.lab.sentences import joint_amount
from rvsim.lab.table_file import Column, ColumnUnit, RawTable, column_for, table_values, unit_of
from rvsim.language import tr, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

Content = Literal["joints", "points"]
MOST_MOVES = 500  # of a program: more of them nobody reads


class Wanted(NamedTuple):
    """A value that is looked for: its name, how a header may call it, and its unit where the header has none."""

    name: str
    spellings: tuple[str, ...]
    unit: ColumnUnit


def wanted_columns(robot: Robot, content: Content) -> tuple[Wanted, ...]:
    """The values of a row: the joints, or x, y, z."""
    length: ColumnUnit = "unit" if robot.length_unit == "unit" else "mm"
    if content == "points":
        return tuple(Wanted(axis, (axis, f"{axis}_actual"), length) for axis in "xyz")
    return tuple(
        Wanted(f"q{number}", (f"q{number}", f"q_{number}", joint.name, joint.name.replace(" ", "_"), f"j{number}"),
               "deg" if joint.revolute else length)
        for number, joint in enumerate(robot.joints, 1)
    )  # fmt: skip


TIME = Wanted("t", ("t", "time"), "s")


def guessed_content(robot: Robot, table: RawTable) -> Content:
    """Joints where the header names them, or has as many columns as the arm has joints; else points."""
    joints, points = wanted_columns(robot, "joints"), wanted_columns(robot, "points")
    if all(column_for(table, wanted.spellings) is not None for wanted in joints):
        return "joints"
    if all(column_for(table, wanted.spellings) is not None for wanted in points):
        return "points"
    return "joints" if len(table.names) in (robot.dof, robot.dof + 1) and robot.dof != 3 else "points"


def guessed_columns(table: RawTable, wanted: Sequence[Wanted]) -> tuple[int, ...]:
    """The column of each: by its name, else the first ones in their order."""
    named = [column_for(table, each.spellings) for each in wanted]
    if all(index is not None for index in named):
        return tuple(index for index in named if index is not None)
    first = 1 if column_for(table, TIME.spellings) == 0 and len(table.names) > len(wanted) else 0
    return tuple(min(first + number, len(table.names) - 1) for number in range(len(wanted)))


def guessed_unit(table: RawTable, index: int, wanted: Wanted) -> ColumnUnit:
    """The unit in the column's name, else the usual one."""
    return unit_of(table.names[index]) or wanted.unit


def joints_in(table: RawTable, columns: Sequence[Column], robot: Robot, *, ignore_limits: bool) -> FloatArray:
    """(m, n) the poses of a table.

    Raises:
        PathFileError: a cell is no number, or a joint lies outside its limits, with row and column.
    """
    q = table_values(table, columns)
    lower, upper = robot.limits.T
    outside = np.flatnonzero(np.any((q < lower - 1e-9) | (q > upper + 1e-9), axis=1))
    if not len(outside) or ignore_limits:
        return q
    row = int(outside[0])
    joint, value, limit = limit_violations(robot, q[row])[0]
    name = robot.joint_names[joint]
    column = columns[joint]
    where = tr(
        "row {row}, column {column} ({name})", row=table.rows[row].number, column=column.index + 1, name=column.name
    )
    found, stop = (joint_amount(robot, name, number) for number in (value, limit))
    raise PathFileError(
        table.path, where, found, tr("the {joint} within its limits: it stops at {stop}", joint=tr(name), stop=stop)
    )


def times_in(table: RawTable, column: Column) -> FloatArray:
    """(m,) times [s] that increase.

    Raises:
        PathFileError: they do not, with the row.
    """
    times = table_values(table, [column])[:, 0]
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if len(back):
        where = tr(
            "row {row}, column {column} ({name})",
            row=table.rows[int(back[0]) + 1].number,
            column=column.index + 1,
            name=column.name,
        )
        raise PathFileError(
            table.path, where, f"{times[back[0] + 1]:g} s", tr("a time after {seconds:g} s", seconds=times[back[0]])
        )
    return times


def moves_through(table: RawTable, values: FloatArray, content: Content) -> Program:
    """A program of joint moves, or of lines: one a row.

    Raises:
        PathFileError: too many rows.
    """
    if len(values) > MOST_MOVES:
        raise PathFileError(
            table.path,
            tr("the file"),
            trn("{n} row", "{n} rows", len(values)),
            tr("at most {most} for a program", most=MOST_MOVES),
        )
    if content == "joints":
        return tuple(JointMove(tuple(row)) for row in values.tolist())
    return tuple(LineMove((x, y, z)) for x, y, z in values.tolist())
