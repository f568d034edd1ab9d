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
class View:
    """How it is looked at: the camera, the arm's look, the panel or page in front, and how motions are played.

    `tracked` is the path that had been tracked, "" for none: who opens the session tracks it again.
    """

    camera: CameraView | None = None
    look: Look = "solid"
    panel: str = ""
    speed: float = 1.0
    loop: bool = False
    tracked: Tracked = ""


@dataclass(frozen=True, eq=False)
class SessionState:
    """The experiment, and beside it: `left`, those of other arms as they were left; the device; the view."""

    experiment: Experiment
    left: tuple[Experiment, ...] = ()
    device: DeviceSettings = DeviceSettings()
    view: View = View()
