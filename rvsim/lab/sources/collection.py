"""All errata, asked for by arm and topic."""

from __future__ import annotations

from rvsim.errors import UnknownNameError
from rvsim.lab.sources.erratum import TOPICS, Erratum, Topic
from rvsim.lab.sources.source_000_frames import ERRATA_000_FRAMES
from rvsim.lab.sources.source_000_motion import ERRATA_000_MOTION
from rvsim.lab.sources.source_001 import ERRATA_001
from rvsim.lab.sources.source_002_errata import ERRATA_002
from rvsim.lab.sources.source_003 import ERRATA_003
from rvsim.lab.sources.source_004_kinematics import ERRATA_004_KINEMATICS
from rvsim.lab.sources.source_004_motion import ERRATA_004_MOTION
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.edits import original_name

_ALL = (
    *ERRATA_000_FRAMES,
    *ERRATA_000_MOTION,
    *ERRATA_001,
    *ERRATA_002,
    *ERRATA_003,
    *ERRATA_004_KINEMATICS,
    *ERRATA_004_MOTION,
)
_BY_KEY = {entry.key: entry for entry in _ALL}


def errata(robot: Robot | str | None = None, topic: Topic | None = None) -> tuple[Erratum, ...]:
    """The errata of an arm (also of an edited copy with the same number of joints) and a topic; all where None."""
    return tuple(e for e in _ALL if _is_of(e, robot) and topic in (None, e.topic))


def erratum_of(key: str) -> Erratum:
    """The erratum of that key, for instance "000-22".

    Raises:
        UnknownNameError: no such erratum.
    """
    if key not in _BY_KEY:
        raise UnknownNameError(tr_later("erratum"), key, tuple(_BY_KEY))
    return _BY_KEY[key]


def topics(robot: Robot | str) -> tuple[Topic, ...]:
    """The topics that an arm has errata of, in the order in which one learns them."""
    present = {entry.topic for entry in errata(robot)}
    return tuple(topic for topic in TOPICS if topic in present)


def _is_of(entry: Erratum, robot: Robot | str | None) -> bool:
    if robot is None or isinstance(robot, str):
        return robot in (None, entry.robot)
    return original_name(robot) == entry.robot and robot.dof == len(entry.pose)
