"""All that a session file holds: the experiment, those of the other arms, the device's settings, the view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rvsim.experiment.experiment import Experiment
from rvsim.robot.arrays import FloatArray, frozen_array

Look = Literal["stick", "solid", "both"]
Language = Literal["ssc32", "bridge"]
Tracked = Literal["", "line", "trajectory"]


@dataclass(frozen=True)
class DeviceSettings:
    """The port that was chosen, not opened by itself: its URL (which may say a seed), speed and language."""

    url: str = ""
    baud: int = 9600
    language: Language = "ssc32"


@dataclass(frozen=True, eq=False)
class CameraView:
    """From where the scene is seen, as in `rvsim.scene.Camera`.

    `target` (3,) and `distance` [m] are None where everything is framed, however large the window is.
    """

    azimuth: float
    elevation: float
    field_of_view: float
    orthographic: bool = False
    target: FloatArray | None = None
    distance: float | None = None

    def __post_init__(self) -> None:
        if self.target is not None:
            object.__setattr__(self, "target", frozen_array("camera target", self.target, (3,)))


@dataclass(frozen=True, eq=False)
class TrackedFrom:
    """Where the tracking of a path began, so that tracking it again gives the same motion.

    Args:
        near: (n,) the pose [rad, m] in which it was tracked, nearest to which its branches are.
        start: (n,) the pose [rad, m] in which the motion begins.
        lifts: the numbers of the points before which a repair lifts the pen, counted from 0.
    """

    near: FloatArray
    start: FloatArray
    lifts: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "near", frozen_array("near", self.near, (-1,)))
        object.__setattr__(self, "start", frozen_array("start", self.start, (-1,)))


@dataclass(frozen=True, eq=False)
class View:
    """How it is looked at: the camera, the arm's look, the panel or page in front, and how motions are played.

    `tracked` is the path that had been tracked, "" for none: who opens the session tracks it again, from where
    `tracked_from` says; None is the present pose.
    """

    camera: CameraView | None = None
    look: Look = "solid"
    panel: str = ""
    speed: float = 1.0
    loop: bool = False
    tracked: Tracked = ""
    tracked_from: TrackedFrom | None = None


@dataclass(frozen=True, eq=False)
class SessionState:
    """The experiment, and beside it: `left`, those of other arms as they were left; the device; the view."""

    experiment: Experiment
    left: tuple[Experiment, ...] = ()
    device: DeviceSettings = DeviceSettings()
    view: View = View()

    def __post_init__(self) -> None:
        began, dof = self.view.tracked_from, self.experiment.robot.dof
        for name, q in () if began is None else (("near", began.near), ("start", began.start)):
            frozen_array(f"{name} of the tracked path", q, (dof,))
