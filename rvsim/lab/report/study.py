"""What is reported on: an experiment, and what has come of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.experiment import Experiment
from rvsim.kinematics import forward_kinematics, inverse_kinematics, jacobian
from rvsim.kinematics.inverse import InverseResult
from rvsim.lab.sentences import Units
from rvsim.motion import Tracking, Trajectory
from rvsim.motion.honesty import Report, check
from rvsim.playback.curves import Curves, curves_of
from rvsim.playback.player import Playable
from rvsim.playback.recording import Recording
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_UNITS = Units()
_MOMENTS_A_SECOND, _FEWEST, _MOST = 100.0, 201, 1500


@dataclass(frozen=True, eq=False)
class Study:
    """One experiment and its outcome; each is worked out when it is first asked for.

    Args:
        tracking, motion: the tracked path and the motion that is loaded, None where there is none.
        recording: what came back when a motion ran on an arm, None where none did.
        measured: what "measured" is there, a sentence.
        run: how it was run: on which arm, and with which faults; sentences.
        table: its height [m], None where there is none.
    """

    experiment: Experiment
    tracking: Tracking | None = None
    motion: Playable | None = None
    recording: Recording | None = None
    measured: str = ""
    table: float | None = 0.0
    units: Units = _UNITS
    run: str = ""

    @property
    def robot(self) -> Robot:
        """The arm."""
        return self.experiment.robot

    @property
    def q(self) -> FloatArray:
        """(n,) its pose [rad, m]."""
        return self.experiment.q

    @cached_property
    def T(self) -> FloatArray:
        """T_base_tool (4, 4)."""
        return np.asarray(forward_kinematics(self.robot, self.q))

    @cached_property
    def J(self) -> FloatArray:
        """(6, n) at the tool, base axes."""
        return np.asarray(jacobian(self.robot, self.q))

    @cached_property
    def inverse(self) -> InverseResult | None:
        """All branches of the tool's pose, None for an arm without a closed form."""
        try:
            return inverse_kinematics(self.robot, self.T, near=self.q)
        except NoClosedFormError:
            return None

    @property
    def trajectory(self) -> Trajectory | None:
        """The motion, where it is one along a path or between poses."""
        return self.motion if isinstance(self.motion, Trajectory) else None

    @cached_property
    def check(self) -> Report | None:
        """The path, looked at before it runs; None without one."""
        return None if self.tracking is None else check(self.tracking, self.trajectory, table=self.table)

    @cached_property
    def curves(self) -> Curves | None:
        """The motion over time, None without one."""
        if self.trajectory is None:
            return None
        samples = int(np.clip(round(_MOMENTS_A_SECOND * self.trajectory.duration) + 1, _FEWEST, _MOST))
        return curves_of(self.robot, self.trajectory, self.tracking, samples)
