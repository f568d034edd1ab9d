"""What an experiment of a source is: where it stands, what it shows, and how the window must be set up to see it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from rvsim.experiment import Experiment, LineTask, Load, TrajectoryTask, limit_violations
from rvsim.motion.trajectory import Law
from rvsim.robot.arrays import FloatArray

PanelName = Literal[
    "path", "inverse", "how", "lab", "jacobian", "velocity", "singular", "forces", "dynamics", "workspace", "source",
    "tool", "matrices", "points", "dh",
]  # fmt: skip
LabPage = Literal["", "solvers", "source 002"]
Tracked = Literal["", "line", "trajectory"]


@dataclass(frozen=True)
class Move:
    """A motion of the joints from the pose of the setup to `end` (n,) [rad, m] in so many seconds."""

    end: tuple[float, ...]
    seconds: float
    law: Law


@dataclass(frozen=True, eq=False)
class Setup:
    """How to see an experiment; what is None or empty stays as it is.

    Args:
        panel: the panel or page that comes to the front.
        pose: q (n,) [rad, m], None for the arm's home.
        line, trajectory: what the panel Path is to hold.
        track: which of them is tracked.
        ignore_limits: as the source does; poses outside the limits are taken in any case.
        path_seconds: how long the path takes [s], as `Experiment` has it.
        erratum: the key of the erratum that the page of the sources shows.
        load: what the tool pulls at and carries.
        lab: the page of the laboratory.
        move: what is played, with its curves.
    """

    panel: PanelName
    pose: tuple[float, ...] | None = None
    line: LineTask | None = None
    trajectory: TrajectoryTask | None = None
    track: Tracked = ""
    ignore_limits: bool = False
    path_seconds: float | None = None
    erratum: str = ""
    load: Load | None = None
    lab: LabPage = ""
    move: Move | None = None

    def applied(self, before: Experiment) -> Experiment:
        """The state in which it can be seen, from a state with its arm; what is not asked for stays."""
        robot = before.robot
        q: FloatArray | tuple[float, ...] = robot.home if self.pose is None else self.pose
        return replace(
            before.at(q),
            line=self.line or before.line,
            trajectory=self.trajectory or before.trajectory,
            ignore_limits=self.ignore_limits or bool(limit_violations(robot, q)),
            target=None,
            law="quintic" if self.move is None else self.move.law,
            path_seconds=self.path_seconds,
            load=self.load or before.load,
        )


@dataclass(frozen=True, eq=False)
class SourceExperiment:
    """One experiment of a source.

    Args:
        key: the stable id; it begins with the source.
        source, item: "000" and for instance "Program 5".
        title: in words.
        robot: the name of the arm.
        shows: what can be seen, in a sentence or two.
        setup: how the window is set up for it.
        errata: keys of the errata that belong to it. Its rows of the reproduction have its own key or one of these.
    """

    key: str
    source: str
    item: str
    title: str
    robot: str
    shows: str
    setup: Setup
    errata: tuple[str, ...] = ()

    @property
    def keys(self) -> tuple[str, ...]:
        """Those that its rows of the reproduction may have."""
        return (self.key, *(key for key in self.errata if key != self.key))
