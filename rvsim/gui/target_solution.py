"""What a wanted tool pose means for the joints: every branch, which one the arm follows, or why it cannot. No Qt."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import NoClosedFormError
from rvsim.experiment import limit_violations
from rvsim.kinematics import (
    SOLVERS,
    Branch,
    Failure,
    NumericResult,
    SolverOptions,
    forward_kinematics,
    inverse_tasks,
    jacobian,
    limit_margins,
    solve_numeric,
)
from rvsim.kinematics.inverse.creep import Crept, creep
from rvsim.kinematics.inverse.nearest import nearest_configuration
from rvsim.kinematics.inverse.result import in_order
from rvsim.kinematics.inverse.solve import attempt
from rvsim.kinematics.inverse.words import branch_title
from rvsim.lab.sentences import Units, failure_sentence
from rvsim.language import tr, tr_later
from rvsim.motion.continuity import continuous
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import pose_difference

CLOSED_FORM = "closed"
SOLVER_TITLES = {
    CLOSED_FORM: tr_later("Closed form, all branches"),
    "newton": tr_later("Newton–Raphson"),
    "dls": tr_later("Damped least squares"),
    "lm": tr_later("Levenberg–Marquardt"),
    "bfgs": tr_later("BFGS, gradient projection"),
}
TASK_TITLES = {
    "pose": tr_later("Full pose"),
    "position+pitch+roll": tr_later("Position, pitch and roll: keep the cup level"),
    "position+yaw": tr_later("Position and yaw"),
    "position": tr_later("Position only"),
    "position, wrist kept": tr_later("Wrist kept as it is relative to the arm"),
    "x,y": tr_later("Position in the plane, x and y"),
}
_KEPT = {"position, wrist kept": (3, 4)}  # the joints that a task leaves as they are
PLACES = ("position", "position, wrist kept", "x,y")  # tasks that leave the whole orientation open
_CREEPING_STEPS = 8  # of Newton's method, a tenth of a millisecond each
LEAP = 0.25  # [rad, m] an arm that was left behind goes no further back to the target at once
_LANDED = 0.02  # [rad, m] what creeping leaves of the way to a branch: it goes slowly where it is singular
_HERE = 1e-9  # [rad, m] a branch so close is where the arm is


def label_title(label: str) -> str:
    """The label of a row of an answer as it is said: that of a branch, or of the solver that found it."""
    return tr(label) if label in SOLVER_TITLES.values() else branch_title(label)


class Offer(NamedTuple):
    """What can be asked of an arm: the tasks with a closed form, its own first, or why there is none."""

    tasks: tuple[str, ...]
    no_closed_form: str = ""

    @property
    def solvers(self) -> tuple[str, ...]:
        """The solvers that can be chosen, the first one by default."""
        return ("lm", *(name for name in SOLVERS if name != "lm")) if self.no_closed_form else tuple(SOLVER_TITLES)


def offer_of(robot: Robot) -> Offer:
    """What can be asked of this arm."""
    try:
        return Offer(inverse_tasks(robot))
    except NoClosedFormError as problem:
        return Offer(("pose", "position") if robot.dof >= 6 else ("position", "pose"), str(problem))


@dataclass(frozen=True, eq=False)
class Question:
    """A wanted pose T (4, 4), what of it counts, how to solve it, and where the arm is: q (n,) [rad, m]."""

    robot: Robot
    T: FloatArray
    task: str
    solver: str
    q: FloatArray
    order: tuple[str, ...]
    ignore_limits: bool = False

    @property
    def place_only(self) -> bool:
        """Whether the orientation is left open."""
        return self.task in PLACES


@dataclass(frozen=True, eq=False)
class Answer:
    """All branches, best first, or the one row of a numeric solver; `failure` or `numeric` say why none will do.

    `T_goal` (4, 4) is the wanted pose as the arm can understand it. A `hurried` answer does not know why not.
    """

    question: Question
    branches: tuple[Branch, ...]
    failure: Failure | None = None
    numeric: NumericResult | None = None
    T_goal: FloatArray | None = None
    hurried: bool = False

    @property
    def usable(self) -> tuple[Branch, ...]:
        """The branches the arm may go to, best first."""
        if self.numeric is not None and not self.numeric.converged:
            return ()
        return tuple(branch for branch in self.branches if branch.within_limits or self.question.ignore_limits)

    @property
    def missed(self) -> bool:
        """Whether the arm cannot do what is asked."""
        return not self.usable


def solve(question: Question, *, hurried: bool = False) -> Answer:
    """Every branch for the question, or what the numeric solver finds from where the arm is.

    In a hurry nobody asks why a place cannot be reached, and a numeric solver tries no other starts.
    """
    if question.solver != CLOSED_FORM:
        return _solve_numeric(question, hurried)
    tried = attempt(question.robot, question.T, task=question.task, near=question.q, order=question.order)
    known = tried.reached or (hurried and not tried.branches)
    return Answer(question, tried.branches, None if known else tried.failure(), None, tried.found.T_goal, hurried)


_HURRIED = SolverOptions(max_iterations=60, allow_random_restarts=False)


def _solve_numeric(question: Question, hurried: bool) -> Answer:
    robot = question.robot
    task = "position" if question.place_only else "pose"
    options = _HURRIED if hurried else SolverOptions()
    found = solve_numeric(robot, question.T, question.q, question.solver, task=task, options=options)
    margin = limit_margins(robot, found.q)
    entries = np.s_[:3, 3:] if question.place_only else np.s_[:3, :]
    sigma = np.linalg.svd(jacobian(robot, found.q), compute_uv=False)
    branch = Branch(
        q=found.q,
        label=SOLVER_TITLES[question.solver],
        within_limits=bool((margin >= -_HERE).all()),
        limit_margin=margin,
        residual=float(np.abs(forward_kinematics(robot, found.q) - question.T)[entries].max()),
        manipulability=float(sigma.prod()),
        distance=float(np.abs(found.q - question.q).max()),
        continuum=False,
    )
    return Answer(question, (branch,), None, found, question.T, hurried)


class Step(NamedTuple):
    """Where the arm goes: the branch, and whether it had to leave its own."""

    branch: Branch
    changed_branch: bool


def followed(answer: Answer, own: str = "") -> Step | None:
    """The branch that the arm follows: its own as long as it goes on, else the nearest; None if there is none.

    At the edge of its reach an arm is on two branches at once: there it takes the one labelled `own`.
    """
    nearest = sorted(answer.usable, key=lambda branch: branch.distance)
    if not nearest:
        return None
    first, *others = sorted(nearest, key=lambda branch: branch.label != own)
    if first.distance < _HERE or _go_on(answer.question, [first])[0]:
        return Step(first, False)
    going_on = zip(others, _go_on(answer.question, others), strict=True)
    return next((Step(branch, False) for branch, goes_on in going_on if goes_on), Step(nearest[0], True))


def _go_on(question: Question, branches: Sequence[Branch]) -> NDArray[np.bool_]:
    """(b,) whether the arm can go there without changing its branch."""
    ends = np.array([branch.q for branch in branches]).reshape(-1, question.robot.dof)
    return continuous(question.robot, np.tile(question.q, (len(ends), 1)), ends, not question.place_only)


def seen_from(answer: Answer, q: FloatArray) -> Answer:
    """The same answer with the arm at q (n,): other distances, maybe another order."""
    moved = [replace(branch, distance=float(np.abs(branch.q - q).max())) for branch in answer.branches]
    branches = in_order(moved, answer.question.order)
    return replace(answer, question=replace(answer.question, q=q), branches=branches)


def branch_at(answer: Answer, q: FloatArray) -> Branch | None:
    """The branch on which the arm stands."""
    here = [branch for branch in answer.branches if float(np.abs(branch.q - q).max()) < 1e-6]
    return here[0] if here else None


class NearestPose(NamedTuple):
    """The best the arm can do within its limits: joints (n,), the pose (4, 4) they give, and the whole sentence."""

    q: FloatArray
    T: FloatArray
    sentence: str
    position_error: float
    rotation_error: float


def nearer(answer: Answer, times: int = 1) -> Crept:
    """The joints that bring the tool nearer to the wanted pose without a jump, by so many strides."""
    question, limits = answer.question, _allowed(answer.question)
    T = question.T if answer.T_goal is None else answer.T_goal
    crept = Crept(question.q, False)
    for _ in range(times):
        crept = creep(question.robot, crept.q, T, limits, place_only=question.place_only, steps=_CREEPING_STEPS)
        if crept.settled:
            break
    return crept


def towards(answer: Answer, branch: Branch, times: int = 1) -> Crept:
    """The joints on the way back to the arm's own branch, by so many strides: where an arm is stretched out, only the
    branch's joints tell to which side its elbow was."""
    way = branch.q - answer.question.q
    share = min(1.0, times * LEAP / max(float(np.abs(way).max()), 1e-300))
    return Crept(branch.q if share == 1.0 else answer.question.q + share * way, share == 1.0)


def landed(answer: Answer, q: FloatArray) -> Step | None:
    """The branch on which an arm that crept to q (n,) has come to the target after all; None if it has not."""
    near = [branch for branch in answer.usable if float(np.abs(branch.q - q).max()) < _LANDED]
    return Step(near[0], False) if near else None


def _allowed(question: Question) -> FloatArray:
    """(n, 2) the bounds of the joints: limits, if they count, and joints that the task keeps where they are."""
    robot = question.robot
    limits = np.tile([-np.inf, np.inf], (robot.dof, 1)) if question.ignore_limits else robot.limits.copy()
    kept = list(_KEPT.get(question.task, ()))
    limits[kept] = question.q[kept, None]
    return limits


def nearest_pose(answer: Answer, units: Units) -> NearestPose:
    """The nearest pose for a target that cannot be had. It takes 20 to 100 ms: not for the window's own thread."""
    question, failure = answer.question, answer.failure
    robot = question.robot
    sentence = failure_sentence(failure, units) if failure is not None else immediate_sentence(answer, units)
    q = None if failure is None else failure.nearest.q
    if q is None or (not question.ignore_limits and limit_violations(robot, q)):
        starts = np.array([question.q, *(branch.q for branch in answer.branches)])
        limits, place_only = _allowed(question), question.place_only
        q = nearest_configuration(robot, question.T, question.q, limits, starts, place_only=place_only).q
    T = forward_kinematics(robot, q)
    left = pose_difference(T, question.T)
    return NearestPose(q, T, sentence, float(left.position), float(left.angle))


_NOT_ASKED = tr_later("Out of reach.")
_AT_ONCE = {
    "reach": tr_later("The place is out of reach."),
    "orientation": tr_later("The place can be reached, but not in this orientation."),
}


def immediate_sentence(answer: Answer, units: Units) -> str:
    """Why not, as far as it is known without looking for the nearest pose; nothing where the arm can."""
    if not answer.missed:
        return ""
    if answer.numeric is not None:
        return answer.numeric.reason
    failure = answer.failure
    if failure is None and answer.hurried:
        return tr(_NOT_ASKED)
    assert failure is not None, "no branch that can be used, and no reason"
    return failure_sentence(failure, units) if failure.kind == "limits" else tr(_AT_ONCE[failure.kind])
