"""The experiments of sources 001 to 004, each in the order of its text."""

from __future__ import annotations

import numpy as np

from rvsim.experiment import NO_LOAD, Load, TrajectoryTask
from rvsim.lab.sources.arms import degrees
from rvsim.lab.sources.claims import GRAVITY_002, STRETCHED_41, TEXTBOOK_ARMS, UPRIGHT_001
from rvsim.lab.sources.experiment import Move, Setup, SourceExperiment
from rvsim.lab.sources.source_004_kinematics import TEXT_POSE
from rvsim.language import tr_later

_ARMS = {"001": "rv-1a", "002": "ur5e", "003": "rrrp", "004": "al5b"}
_FIRST_GRAVITY, _SECOND_GRAVITY = (degrees(*pose) for pose in GRAVITY_002)
_ZERO = (0.0,) * 5
_FORTY = degrees(40.0, 0.0, 0.0, 0.0, 0.0)
_ALONG_THE_TOOL = Load(np.array([0.0, 0.0, 10.0, 0.0, 0.0, 0.0]), "tool")  # [N]
_FIGURES = {
    "2.3": tr_later("Figure 2.3"),
    "2.6": tr_later("Figure 2.6"),
    "2.7": tr_later("Figure 2.7"),
    "2.9": tr_later("Figure 2.9"),
    "2.12": tr_later("Figure 2.12"),
}
_WORKSPACES = {
    "articulated": tr_later("The articulated arm (RRR)"),
    "spherical": tr_later("The spherical arm (RRP)"),
    "scara": tr_later("The SCARA arm (RRP)"),
    "cylindrical": tr_later("The cylindrical arm (RPP)"),
    "cartesian": tr_later("The Cartesian arm (PPP)"),
}


def _entry(
    key: str, item: str, title: str, shows: str, setup: Setup, errata: tuple[str, ...] = (), robot: str = ""
) -> SourceExperiment:
    return SourceExperiment(key, key[:3], item, title, robot or _ARMS[key[:3]], shows, setup, errata)


EXPERIMENTS_001: tuple[str | SourceExperiment, ...] = (
    _entry(
        "001-table",
        tr_later("Table 1"),
        tr_later("The Denavit–Hartenberg table"),
        tr_later("The manufacturer's zero is the table's with 90° at the shoulder: the upper arm stands upright."),
        Setup("dh", UPRIGHT_001),
    ),
    "001-3",
    "001-5",
)


def _drawn(name: str, **more: str) -> Setup:
    return Setup("path", None, trajectory=TrajectoryTask(name, **more), track="trajectory")  # type: ignore[arg-type]  # an orientation


EXPERIMENTS_002: tuple[str | SourceExperiment, ...] = (
    _entry(
        "002-gravity-1",
        tr_later("Table"),
        tr_later("Masses: the arm stretched out level"),
        tr_later("What the joints hold by the arm's own weight; the shoulder holds the most."),
        Setup("dynamics", _FIRST_GRAVITY, load=NO_LOAD),
    ),
    _entry(
        "002-gravity-2",
        tr_later("Table"),
        tr_later("Masses: the arm bent"),
        tr_later("The same arm with the elbow up: the shoulder holds a third less."),
        Setup("dynamics", _SECOND_GRAVITY, load=NO_LOAD),
    ),
    "002-x",
    "002-z2",
    _entry(
        "002-code-1",
        tr_later("Code 1"),
        tr_later("The points of the ellipse"),
        tr_later("184 points at even angles, which is not evenly apart: 0.86 to 1.20 mm."),
        _drawn("ellipse"),
        ("002-spacing",),
    ),
    "002-target",
    _entry(
        "002-rotation",
        tr_later("Code 2"),
        tr_later("The ellipse with the desired rotation"),
        tr_later("114 of 184 points: nearer to the base axis than d₄ = 133 mm that rotation cannot be held."),
        _drawn("ellipse"),
    ),
    _entry(
        "002-any",
        tr_later("Code 2"),
        tr_later("The ellipse with any rotation"),
        tr_later("Every point can be reached when the tool may turn as it likes, which is what the program does."),
        _drawn("ellipse", orientation="free"),
    ),
    "002-ik",
    "002-a",
    "002-pos",
    "002-R",
    "002-J",
    "002-scale",
    _entry(
        "002-rms",
        tr_later("The whole program"),
        tr_later("An arm that draws its ellipse elsewhere"),
        tr_later(
            "Run as printed the program believes to be within 1 mm of its ellipse; the real arm would be 431 mm away."
        ),
        Setup("lab", None, lab="source 002"),
        ("002-rms",),
    ),
)
EXPERIMENTS_003: tuple[str | SourceExperiment, ...] = (
    _entry(
        "003-spiral",
        tr_later("Desired 2-Stage Trajectory"),
        tr_later("The path of 2001 points"),
        tr_later(
            "Straight up for ten seconds, then a spiral: all of it is reached, and the waist turns two and a half "
            "times."
        ),
        _drawn("spiral"),
    ),
    "003-t1",
    "003-t3",
    "003-l6",
    "003-15",
)


def _workspace(figure: str, arm: str) -> SourceExperiment:
    shows = tr_later("Its workspace in sections; lengths and limits are ours, for the text gives none.")
    return _entry(f"004-{figure}", _FIGURES[figure], _WORKSPACES[arm], shows, Setup("workspace"), (), arm)


EXPERIMENTS_004: tuple[str | SourceExperiment, ...] = (
    *(_workspace(figure, arm) for figure, arm in TEXTBOOK_ARMS),
    "004-2.2",
    _entry(
        "004-3.1",
        tr_later("Table 3.1"),
        tr_later("The modified Denavit–Hartenberg table"),
        tr_later("Each row has a and α of the link before. With all joints 0 the arm lies stretched out along x."),
        Setup("dh", _ZERO),
    ),
    "004-3.8",
    "004-3.12",
    "004-3.13",
    "004-3.15",
    "004-3.21",
    "004-3.22",
    "004-3.23",
    "004-3.26",
    "004-3.29",
    _entry(
        "004-4.7",
        tr_later("(4.6) and (4.7)"),
        tr_later("Every column one joint too early"),
        tr_later(
            "Joint 1 appears twice and the roll is missing, so that the rank is 4; and the sentence below (4.6) "
            "exchanges J_v and J_w."
        ),
        Setup("source", TEXT_POSE, erratum="004-4.7"),
        ("004-4.6", "004-4.7"),
    ),
    "004-4.8",
    "004-4.9",
    "004-4.11",
    "004-4.15",
    _entry(
        "004-4.1",
        tr_later("Figure 4.1"),
        tr_later("Two links in a straight line"),
        tr_later("Stretched out, the arm can move its tool only across the links: the boundary singularity."),
        Setup("singular", STRETCHED_41),
        (),
        "planar",
    ),
    "004-4.16",
    _entry(
        "004-4.24",
        tr_later("(4.24) and (4.25)"),
        tr_later("The torques that hold a force"),
        tr_later(
            "10 N along the tool's own axis pass through the wrist: joint 4 holds nothing. With the tool's F and "
            "the base's J it would."
        ),
        Setup("forces", TEXT_POSE, load=_ALONG_THE_TOOL),
        ("004-4.24",),
    ),
    _entry(
        "004-cubic",
        tr_later("Section 5.1"),
        tr_later("A cubic from 0 to 40° in 2 s"),
        tr_later("Place and speed are continuous, the acceleration begins at 60 °/s² at once."),
        Setup("path", _ZERO, move=Move(_FORTY, 2.0, "cubic")),
    ),
    _entry(
        "004-quintic",
        tr_later("Figure 5.4"),
        tr_later("A quintic from 0 to 40° in 2 s"),
        tr_later("Place, speed and acceleration are continuous; with t₀ = 0 the misprints of (5.22) do not show."),
        Setup("path", _ZERO, move=Move(_FORTY, 2.0, "quintic")),
    ),
    "004-5.22",
)
