"""What a source says of an example of its own, with the number that it prints and ours."""

from __future__ import annotations

from typing import NamedTuple

from rvsim.experiment import PathOrientation
from rvsim.files import load_robot
from rvsim.lab.named_paths import named_path
from rvsim.lab.sources.figures import Numbers
from rvsim.language import tr
from rvsim.motion import Path, track
from rvsim.robot import Robot


class Claim(NamedTuple):
    """A row of the reproduction, see `Reproduction`; `key` is that of the experiment or erratum that it belongs to."""

    key: str
    source: str
    item: str
    printed: Numbers | None
    formula: Numbers | None
    ours: Numbers
    verdict: str


def drawn(key: str, item: str, robot: Robot, path: Path, *, ignore_limits: bool = False) -> Claim:
    """The source draws every point; how many the arm can draw."""
    wanted = path.samples
    reached = track(robot, path, ignore_limits=ignore_limits).reached_count
    verdict = "confirmed" if reached == wanted else "partly reached" if reached else "cannot be reached"
    return Claim(
        key,
        key[:3],
        tr("{item}, points reached of {wanted}", item=item, wanted=wanted),
        float(wanted),
        None,
        float(reached),
        verdict,
    )


def drawn_by_name(key: str, item: str, arm: str, name: str, orientation: PathOrientation | None = None) -> Claim:
    """The same of a path that has a name."""
    robot = load_robot(arm)
    return drawn(key, item, robot, named_path(name, robot, orientation=orientation))
