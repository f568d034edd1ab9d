"""A program, an ordered tuple of moves, and its edits: each gives another program and leaves the first as it was."""

from __future__ import annotations

from rvsim.motion.moves import MOVE_KINDS, ArcMove, Gripper, JointMove, LineMove, Move, ToolRule, Triple, Wait, kind_of

__all__ = [
    "MOVE_KINDS",
    "ArcMove",
    "Gripper",
    "JointMove",
    "LineMove",
    "Move",
    "Program",
    "ToolRule",
    "Triple",
    "Wait",
    "duplicated",
    "inserted",
    "kind_of",
    "removed",
    "replaced",
    "shifted",
]

Program = tuple[Move, ...]


def inserted(program: Program, index: int, move: Move) -> Program:
    """With a move before the one of that index, or at the end."""
    return (*program[:index], move, *program[index:])


def removed(program: Program, index: int) -> Program:
    """Without the move of that index."""
    return (*program[:index], *program[index + 1 :])


def replaced(program: Program, index: int, move: Move) -> Program:
    """With another move in the place of that index."""
    return (*program[:index], move, *program[index + 1 :])


def shifted(program: Program, index: int, by: int) -> Program:
    """With the move of that index `by` places later (earlier if negative), as far as there are places."""
    others = removed(program, index)
    return inserted(others, min(max(index + by, 0), len(others)), program[index])


def duplicated(program: Program, index: int) -> Program:
    """With the move of that index twice."""
    return inserted(program, index, program[index])
