"""The same path by the closed form and by each numeric solver, warm-started from point to point, side by side.

Source 000 sets out to compare solving times, errors and success; here all do the same path, each as it would be used.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoClosedFormError
from rvsim.kinematics import AS_IN_SOURCE_000, SolverOptions, forward_kinematics, solve_numeric
from rvsim.kinematics.numeric import Solver, Task
from rvsim.kinematics.singularity import task_rows
from rvsim.language import tr_later
from rvsim.motion.path import Path
from rvsim.motion.tracking import find_jumps, track
from rvsim.motion.turns import existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array
from rvsim.spatial import pose_difference

Clock = Callable[[], float]


class Contestant(NamedTuple):
    """Who tracks. `solver` None is the closed form with the best sequence of branches."""

    name: str
    title: str
    solver: Solver | None
    options: SolverOptions = SolverOptions(max_iterations=300)


CONTESTANTS = (
    Contestant("closed form", tr_later("Closed form, best branches"), None),
    Contestant("newton", tr_later("Newton–Raphson"), "newton"),
    Contestant("dls", tr_later("Damped least squares"), "dls"),
    Contestant("lm", tr_later("Levenberg–Marquardt"), "lm"),
    Contestant("bfgs", tr_later("BFGS gradient projection"), "bfgs"),
    Contestant("source 000", AS_IN_SOURCE_000.title, AS_IN_SOURCE_000.solver, AS_IN_SOURCE_000.options),
)


@dataclass(frozen=True, eq=False)
class Entry:
    """One row of the comparison.

    Args:
        q: (m, n) the joints, NaN rows where it found none.
        seconds: it took in all; per point it is `seconds_per_point`.
        iterations: of all points together, None for the closed form.
        position_error, rotation_error: (m,) [m], [rad], NaN where it found none; the rotation is NaN too where the
            path leaves it free, or the arm's task does not ask for it.
        jumps: indices of points that follow the one before only by leaving the path.
    """

    contestant: Contestant
    q: FloatArray
    seconds: float
    iterations: int | None
    position_error: FloatArray
    rotation_error: FloatArray
    jumps: tuple[int, ...]

    @property
    def seconds_per_point(self) -> float:
        """The time divided by the number of points."""
        return self.seconds / len(self.q)

    @property
    def success(self) -> float:
        """The share of the points for which joints were found."""
        return float(existing(self.q).mean())

    @property
    def rms(self) -> float:
        """The root of the mean square position error over the points found [m]; nan where none was."""
        return _rms(self.position_error)

    @property
    def largest(self) -> float:
        """The largest position error over the points found [m]; nan where none was."""
        return _largest(self.position_error)

    @property
    def largest_rotation(self) -> float:
        """The largest rotation error over the points found [rad]; nan where there is none."""
        return _largest(self.rotation_error)


def comparison(
    robot: Robot,
    path: Path,
    *,
    near: ArrayLike | None = None,
    ignore_limits: bool = False,
    contestants: tuple[Contestant, ...] = CONTESTANTS,
    clock: Clock = perf_counter,
) -> Iterator[Entry | float]:
    """One entry after the other; in between the share that is done, 0…1, at which it may be given up.

    Each numeric solver starts in `near` (n,), None for home, and from then on in its last solution. An arm without a
    closed form has no such entry.
    """
    present = robot.home if near is None else frozen_array("near", near, (robot.dof,))
    for number, contestant in enumerate(contestants):
        parts = _closed(robot, path, present, ignore_limits, contestant, clock) if contestant.solver is None else (
            _numeric(robot, path, present, ignore_limits, contestant, clock)
        )  # fmt: skip
        for part in parts:
            yield part if isinstance(part, Entry) else (number + part) / len(contestants)


def _closed(
    robot: Robot, path: Path, near: FloatArray, ignore_limits: bool, contestant: Contestant, clock: Clock
) -> Iterator[Entry | float]:
    yield 0.0
    begun = clock()
    try:
        tracking = track(robot, path, near=near, ignore_limits=ignore_limits)
    except NoClosedFormError:
        return
    yield _entry(robot, path, contestant, tracking.q, clock() - begun, None)


def _numeric(
    robot: Robot, path: Path, near: FloatArray, ignore_limits: bool, contestant: Contestant, clock: Clock
) -> Iterator[Entry | float]:
    """Point after point."""
    assert contestant.solver is not None
    options = _without_limits(contestant.options) if ignore_limits else contestant.options
    task: Task = "pose" if _asks_for_rotation(robot, path) else "position"
    T, q, here = path.poses(), np.full((path.samples, robot.dof), np.nan), near
    seconds, iterations = 0.0, 0
    for index, pose in enumerate(T):
        yield index / path.samples
        begun = clock()
        found = solve_numeric(robot, pose, here, contestant.solver, task=task, options=options)
        seconds += clock() - begun
        iterations += found.iterations
        if found.converged:
            q[index] = here = found.q
    yield _entry(robot, path, contestant, q, seconds, iterations)


def _without_limits(options: SolverOptions) -> SolverOptions:
    return replace(options, enforce_joint_limits=False)


def _asks_for_rotation(robot: Robot, path: Path) -> bool:
    """Whether the orientation belongs to what is asked of the arm: an arm for places turns its tool as it must."""
    return path.rotations is not None and len(task_rows(robot)) == 6


def _entry(
    robot: Robot, path: Path, contestant: Contestant, q: FloatArray, seconds: float, iterations: int | None
) -> Entry:
    with_rotation = _asks_for_rotation(robot, path)
    known = existing(q)
    position, rotation = np.full(len(q), np.nan), np.full(len(q), np.nan)
    if known.any():
        difference = pose_difference(forward_kinematics(robot, q[known]), path.poses()[known])
        position[known] = difference.position
        if with_rotation:
            rotation[known] = difference.angle
    return Entry(
        contestant,
        frozen_array("q", q, q.shape),
        seconds,
        iterations,
        frozen_array("position error", position, position.shape),
        frozen_array("rotation error", rotation, rotation.shape),
        find_jumps(robot, q, with_rotation),
    )


def _rms(errors: FloatArray) -> float:
    known = errors[np.isfinite(errors)]
    return float(np.sqrt(np.mean(known**2))) if known.size else math.nan


def _largest(errors: FloatArray) -> float:
    known = errors[np.isfinite(errors)]
    return float(known.max()) if known.size else math.nan
