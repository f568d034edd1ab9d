"""Moves of a program in words, and why one cannot be done: what a list of moves and a message say."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.lab.sentences import MINUS, Units, first_reason, joint_amount, length_number
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.motion.program import Plan, Problem, ProblemKind
from rvsim.robot import Robot

_DEFAULT = Units()
# What is said of a line and of an arc, for each way in which the tool may turn.
_LINES = {
    "keep": tr_later("line to {place}, {percent}"),
    "turn": tr_later("line to {place}, tool turned, {percent}"),
    "free": tr_later("line to {place}, tool free, {percent}"),
}
_ARCS = {
    "keep": tr_later("arc over {via} to {place}, {percent}"),
    "turn": tr_later("arc over {via} to {place}, tool turned, {percent}"),
    "free": tr_later("arc over {via} to {place}, tool free, {percent}"),
}


def move_words(move: Move, robot: Robot, units: Units = _DEFAULT) -> str:
    """One move in a line: "line to (300.0, 0.0, 250.0) mm, tool free, 50 %"."""
    return str(_WORDS[type(move)](move, robot, units))


def _joint(move: JointMove, robot: Robot, units: Units) -> str:
    if move.pose:
        return tr("joints to “{pose}”, {percent}", pose=move.pose, percent=_percent(move.speed))
    names = robot.joint_names
    if len(move.q) != len(names):
        return trn("joints of an arm with {n} joint", "joints of an arm with {n} joints", len(move.q))
    values = (joint_amount(robot, name, value, units) for name, value in zip(names, move.q, strict=True))
    return tr("joints to ({values}), {percent}", values=", ".join(_alike(values)), percent=_percent(move.speed))


def _alike(values: Iterable[str]) -> list[str]:
    """The angles with a digit behind the point where one of them has one."""
    texts = list(values)
    exact = any("." in text for text in texts if text.endswith("°"))
    return [text.replace("°", ".0°") if exact and "." not in text else text for text in texts]


def _line(move: LineMove, robot: Robot, units: Units) -> str:
    return tr(_LINES[move.tool], place=_place(move.to, robot, units), percent=_percent(move.speed))


def _arc(move: ArcMove, robot: Robot, units: Units) -> str:
    via, to = (_place(place, robot, units) for place in (move.via, move.to))
    return tr(_ARCS[move.tool], via=via, place=to, percent=_percent(move.speed))


def _wait(move: Wait, _robot: Robot, _units: Units) -> str:
    return tr("wait {seconds:g} s", seconds=move.seconds)


def _gripper(move: Gripper, _robot: Robot, _units: Units) -> str:
    return {0.0: tr("close the gripper"), 1.0: tr("open the gripper")}.get(
        move.opening, tr("gripper {percent} open", percent=_percent(move.opening))
    )


_WORDS: dict[type[Move], Callable[[Any, Robot, Units], str]] = {
    JointMove: _joint,
    LineMove: _line,
    ArcMove: _arc,
    Wait: _wait,
    Gripper: _gripper,
}


def problem_sentence(robot: Robot, move: Move, problem: Problem, units: Units = _DEFAULT) -> str:
    """Why a move cannot be done, and what would help."""
    return _PROBLEMS[problem.kind](robot, move, problem, units)


def _no_pose(_robot: Robot, move: Move, _problem: Problem, _units: Units) -> str:
    name = move.pose if isinstance(move, JointMove) else ""
    return tr("No pose is remembered as “{name}”: save one under Arm, or give the joints.", name=name)


def _outside(robot: Robot, _move: Move, problem: Problem, units: Units) -> str:
    value, limit = (joint_amount(robot, problem.joint, number, units) for number in (problem.value, problem.limit))
    joint = tr(problem.joint)
    return tr("The {joint} would go to {value} and stops at {limit}.", joint=joint, value=value, limit=limit)


def _missed(_robot: Robot, _move: Move, problem: Problem, units: Units) -> str:
    assert problem.tracking is not None
    tracking = problem.tracking
    share = tracking.unreached[0].index / tracking.samples
    why = first_reason(tracking, units)
    if share == 0.0:
        return tr("From the very start the arm cannot follow: {why}.", why=why)
    return tr("After {percent} of the way the arm cannot follow: {why}.", percent=_percent(share), why=why)


def _beside(robot: Robot, _move: Move, problem: Problem, units: Units) -> str:
    number, unit = length_number(robot, problem.value, units)
    return tr(
        "The tool would leave its way by {distance}: it passes too near to a singular pose.",
        distance=f"{number:.2g} {unit}",
    )


def _said(text: str, *_: object) -> str:
    return tr(text)


_PROBLEMS: dict[ProblemKind, Callable[[Robot, Move, Problem, Units], str]] = {
    "pose": _no_pose,
    "joints": partial(_said, tr_later("The numbers are those of an arm with other joints.")),
    "limits": _outside,
    "path": _missed,
    "branch": partial(
        _said, tr_later("The arm would have to change its branch on the way: put a joint move before it.")
    ),
    "tolerance": _beside,
    "no closed form": partial(
        _said, tr_later("This arm has no closed form for its inverse kinematics: use joint moves.")
    ),
}


def plan_sentence(plan: Plan, units: Units = _DEFAULT) -> str:
    """The whole in one sentence: "All 5 moves can be done, in 12.3 s."."""
    count, seconds = len(plan.moves), float(plan.starts[-1])
    if not count:
        return tr("No move yet: add the present pose, a line to where the tool is, or a wait.")
    if plan.problem is None:
        return trn(
            "The one move can be done, in {seconds:.1f} s.",
            "All {n} moves can be done, in {seconds:.1f} s.",
            count,
            seconds=seconds,
        )
    number = len(plan.steps)
    why = problem_sentence(plan.robot, plan.moves[number], plan.problem, units)
    return tr("Move {number} of {count} cannot be done. {why}", number=number + 1, count=count, why=why)


def _place(place: Iterable[float], robot: Robot, units: Units) -> str:
    numbers = [length_number(robot, value, units) for value in place]
    unit = numbers[0][1]
    decimals = 1 if unit == "mm" else 3
    texts = (f"{round(number, decimals) + 0.0:.{decimals}f}".replace("-", MINUS) for number, _ in numbers)
    listing = ", ".join(texts)
    return f"{left_to_right(f'({listing})')} {unit}"


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f}\N{NO-BREAK SPACE}%"
