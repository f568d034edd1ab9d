"""The IK laboratory: all numeric solvers on the same target, from the same start, with the same settings."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rvsim.experiment import limit_violations
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.numeric import (
    AS_IN_SOURCE_000,
    AS_IN_SOURCE_002,
    SOLVERS,
    NumericResult,
    Preset,
    Solver,
    SolverOptions,
    Task,
    solve_numeric,
)
from rvsim.lab.sentences import MINUS, Units, joint_amount, length_number
from rvsim.lab.source_002 import Comparison
from rvsim.language import listed, tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians

TITLES: dict[Solver, str] = {
    "newton": tr_later("Newton–Raphson"),
    "dls": tr_later("Damped least squares"),
    "lm": tr_later("Levenberg–Marquardt"),
    "bfgs": tr_later("BFGS gradient projection"),
}
SHORT_TITLES: dict[Solver, str] = {"newton": "Newton", "dls": "DLS", "lm": "LM", "bfgs": "BFGS"}
EXACT = Preset(
    tr_later("Exact, one try"),
    tr_later(
        "Until a millionth of a metre and of a radian, within the limits, and without random restarts: what each "
        "solver makes of this one start."
    ),
    "lm",
    "pose",
    SolverOptions(allow_random_restarts=False),
    None,
    False,
)
PRESETS = (EXACT, AS_IN_SOURCE_000, AS_IN_SOURCE_002)

_UNITS = Units()
_SAME = 1e-2  # [rad, m] configurations nearer than this are the same solution
# [s] by which the clock leaps when a contest is cancelled: the solver at work finds its time used up.
_LEAP = 1e9
# A solver that took less than this [s] is timed so many times more.
_BRIEF, _REPEATS = 0.02, 2


@dataclass(frozen=True, eq=False)
class Trial:
    """What all solvers are asked: an arm, a target T (4, 4), a start q0 (n,) [rad, m], the task and the settings."""

    robot: Robot
    T: FloatArray
    q0: FloatArray
    task: Task = "pose"
    options: SolverOptions = EXACT.options


class Outcome(NamedTuple):
    """What one solver made of a trial."""

    solver: Solver
    result: NumericResult

    @property
    def title(self) -> str:
        """The solver's name in full, in the language that is spoken."""
        return tr(TITLES[self.solver])


@dataclass(frozen=True, eq=False)
class Contest:
    """A trial and what came of it, one outcome a solver in the order of `SOLVERS`."""

    trial: Trial
    outcomes: tuple[Outcome, ...]

    @property
    def converged(self) -> tuple[Outcome, ...]:
        """Those that reached the target."""
        return tuple(outcome for outcome in self.outcomes if outcome.result.converged)

    @property
    def best(self) -> Outcome:
        """The one with the fewest iterations among those that reached the target; if none did, the nearest."""
        if self.converged:
            return min(self.converged, key=lambda outcome: outcome.result.iterations)
        return min(self.outcomes, key=lambda outcome: outcome.result.position_error + outcome.result.rotation_error)


def run_contest(trial: Trial, cancelled: Callable[[], bool] = lambda: False) -> Contest | None:
    """Let all solvers do the trial; None as soon as `cancelled()` is true.

    A first iteration that nobody sees makes what is prepared once an arm, so that the first solver does not pay for it.

    Raises:
        ShapeError, PoseError, SettingError: the trial makes no sense, as `solve_numeric` says.
    """
    _solved(replace(trial, options=replace(trial.options, max_iterations=1)), "lm", time.perf_counter)

    def clock() -> float:
        return time.perf_counter() + (_LEAP if cancelled() else 0.0)

    outcomes: list[Outcome] = []
    for solver in SOLVERS:
        outcomes.append(Outcome(solver, _quickest(trial, solver, clock)))
        if cancelled():
            return None
    return Contest(trial, tuple(outcomes))


def _quickest(trial: Trial, solver: Solver, clock: Callable[[], float]) -> NumericResult:
    """The result, which is the same each time, with the least of a few times taken: others use the machine as well."""
    result = _solved(trial, solver, clock)
    again = _REPEATS if result.elapsed < _BRIEF else 0
    return min((result, *(_solved(trial, solver, clock) for _ in range(again))), key=lambda each: each.elapsed)


def _solved(trial: Trial, solver: Solver, clock: Callable[[], float]) -> NumericResult:
    return solve_numeric(trial.robot, trial.T, trial.q0, solver, task=trial.task, options=trial.options, clock=clock)


def target_of(robot: Robot, q: FloatArray) -> FloatArray:
    """(4, 4) a pose that the arm can take: its own at q (n,)."""
    return np.asarray(forward_kinematics(robot, q))


# --- in words ----------------------------------------------------------------------------------------------------


def verdict(trial: Trial, outcome: Outcome, units: Units = _UNITS) -> str:
    """What one solver did, and why it ended."""
    result = outcome.result
    sentences = (
        trn("{solver} ends after {n} iteration.", "{solver} ends after {n} iterations.", result.iterations,
            solver=outcome.title),
        result.reason,
        "" if result.converged else tr("{missing} left.", missing=_missing(trial, result, units)),
        *_curve_notes(result),
        _limit_note(trial, result, units),
    )  # fmt: skip
    return " ".join(sentence for sentence in sentences if sentence)


def contest_sentence(contest: Contest, units: Units = _UNITS) -> str:
    """Who reached the target, who needed least, and whether they came to the same joints."""
    done, count = contest.converged, len(contest.outcomes)
    if not done:
        nearest = contest.best
        missing = _missing(contest.trial, nearest.result, units)
        return tr(
            "None of the {count} reaches the target. Nearest: {solver}, {missing} left.",
            count=count,
            solver=nearest.title,
            missing=missing,
        )
    if len(done) == 1:
        return trn(
            "Only {solver} reaches the target, in {n} iteration.",
            "Only {solver} reaches the target, in {n} iterations.",
            done[0].result.iterations,
            solver=done[0].title,
        )
    who = (
        tr("All {count} reach the target.", count=count)
        if len(done) == count
        else tr("{reached} of {count} reach the target.", reached=len(done), count=count)
    )
    return f"{who} {_fewest_sentence(contest)} {_solutions_sentence(contest)}"


def _fewest_sentence(contest: Contest) -> str:
    least = contest.best.result.iterations
    first = [outcome for outcome in contest.converged if outcome.result.iterations == least]
    if len(first) == 1:
        return tr("{solver} needs the fewest iterations ({least}).", solver=contest.best.title, least=least)
    return tr("{solvers} need the fewest iterations ({least}).", solvers=_together(first), least=least)


def _solutions_sentence(contest: Contest) -> str:
    groups = same_solutions(contest)
    if len(groups) == 1:
        return tr("They end in the same pose of the arm.")
    return tr(
        "They end in {count} different poses of the arm: {groups}.",
        count=len(groups),
        groups=tr("; ").join(map(_together, groups)),
    )


def _together(group: Sequence[Outcome]) -> str:
    return listed([SHORT_TITLES[outcome.solver] for outcome in group])


def same_solutions(contest: Contest) -> tuple[tuple[Outcome, ...], ...]:
    """The outcomes that converged, those with the same joints (whole turns apart) together."""
    groups: list[list[Outcome]] = []
    turning = contest.trial.robot.is_revolute
    for outcome in contest.converged:
        for group in groups:
            apart = outcome.result.q - group[0].result.q
            apart = np.where(turning, np.remainder(apart + np.pi, 2.0 * np.pi) - np.pi, apart)
            if np.abs(apart).max() < _SAME:
                group.append(outcome)
                break
        else:
            groups.append([outcome])
    return tuple(map(tuple, groups))


def _missing(trial: Trial, result: NumericResult, units: Units) -> str:
    number, unit = length_number(trial.robot, result.position_error, units)
    text = f"{_short(number)} {unit}"
    if trial.task != "pose":
        return text
    turn = result.rotation_error
    angle = f"{_short(degrees_from_radians(turn))}°" if units.angle == "deg" else f"{_short(turn)} rad"
    return tr("{length} and {angle}", length=text, angle=angle)


def _short(number: float) -> str:
    """Three digits; powers of ten only where the number is small."""
    text = f"{number:.0f}" if number >= 100.0 else f"{number:.3g}"
    return text.replace("-", MINUS)


def _curve_notes(result: NumericResult) -> tuple[str, ...]:
    if not result.restarts:
        return ()
    if not result.converged:
        return (tr("The curve shows the best try alone."),)
    return (
        trn("It took {n} random restart.", "It took {n} random restarts.", result.restarts),
        tr("The curve shows the last try alone."),
    )


def _limit_note(trial: Trial, result: NumericResult, units: Units) -> str:
    violations = limit_violations(trial.robot, result.q)
    if trial.options.enforce_joint_limits or not violations:
        return ""
    first = violations[0]
    name = trial.robot.joint_names[first.joint]
    return tr(
        "Outside the limits: {joint} at {value}.",
        joint=tr(name),
        value=joint_amount(trial.robot, name, float(result.q[first.joint]), units),
    )


def source_002_sentence(comparison: Comparison, units: Units = _UNITS) -> str:
    """What the misprints of source 002 cost, and what the program believes meanwhile."""
    printed, corrected = comparison
    unit = units.length
    factor, more = (1.0, 0) if unit == "mm" else (1e-3, 3)
    off = [
        f"{factor * distance:.{more}f}"
        for distance in (printed.rms, printed.deviations.min(), printed.deviations.max())
    ]
    believed = f"{factor * printed.believed_deviations.max():.{more + 1}f}"
    return (
        tr(
            "As printed, the real UR5e is {rms} {unit} RMS away from the ellipse ({least} to {most} {unit}), "
            "while the program believes itself within {believed} {unit}. "
            "Corrected: {corrected:.0e} {unit} RMS, which is rounding alone.",
            rms=off[0],
            unit=unit,
            least=off[1],
            most=off[2],
            believed=believed,
            corrected=factor * corrected.rms,
        )
    ).replace("e-", f"e{MINUS}")


SOURCE_002_READING = tr_later(
    "With the misprints read as they stand in code 2: a2 and a3 positive (the table of the same source has them "
    "negative), d6 without sin θ5 in x and missing in y, and terms lost in the Jacobian. Its fourth column cannot be "
    "read in the published copy; it is taken as the third without a3. Degrees become radians by 0.0175, 0.01744 and "
    "0.01745 in turn. How far the arm is off exactly is an accident of the start: with the wrong Jacobian the first "
    "point takes a long way, and a ten thousandth of a degree elsewhere ends some hundred millimetres off as well, at "
    "other angles."
)
