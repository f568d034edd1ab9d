"""The experiments of source 000: its text in the order of its equations, and Programs 1 to 16."""

from __future__ import annotations

from rvsim.experiment import LineTask, TrajectoryTask
from rvsim.files import load_robot
from rvsim.lab.lines import line_presets
from rvsim.lab.sources.arms import degrees
from rvsim.lab.sources.claims_000 import COMMENT_LINE, EXAMPLE_POSE, STRETCHED_POSE
from rvsim.lab.sources.experiment import PanelName, Setup, SourceExperiment
from rvsim.lab.sources.programs_000 import LETTER_PAUSE, LINE_PAUSE
from rvsim.lab.sources.source_000_frames import TEXT_POSE
from rvsim.language import tr_later

_START_POSE = degrees(0.0, 45.0, -60.0, 0.0, 45.0)  # of Programs 12 and 13
_TOOL_DOWN_POSE = degrees(30.0, 40.0, -80.0, -50.0, 0.0)
_ERROR_POSE = degrees(0.0, 45.0, 60.0, 45.0, 0.0)  # of Program 6
_LETTER = TrajectoryTask("letter-raw")
_LETTER_SCALED = TrajectoryTask("letter-scaled", height=0.3)


def _source_line() -> LineTask:
    return next(p for p in line_presets(load_robot("rv-m1")) if p.name == "source-000").task()


def _entry(key: str, item: str, title: str, shows: str, setup: Setup, errata: tuple[str, ...] = ()) -> SourceExperiment:
    return SourceExperiment(f"000-{key}", "000", item, title, "rv-m1", shows, setup, errata)


def _at(panel: PanelName, pose: tuple[float, ...]) -> Setup:
    return Setup(panel, pose)


_TABLE = _entry(
    "figure-5",
    tr_later("Figure 5"),
    tr_later("The Denavit–Hartenberg table"),
    tr_later(
        "Figure 5 gives the last but one joint the range of the table's angle, 0° to 180°; section 3 gives the "
        "joint's own, −90° to 90°."
    ),
    _at("dh", TEXT_POSE),
)
_CLOSED_FORM = _entry(
    "6.1",
    tr_later("Section 6.1"),
    tr_later("Inverse kinematics by geometry"),
    tr_later(
        "Every tool pose in reach has four solutions: two ways of the waist, each with the elbow up or down. The "
        "closed form leads to them step by step."
    ),
    _at("how", TEXT_POSE),
)
_STRETCHED = _entry(
    "30",
    "(30)",
    tr_later("The arm stretched out"),
    tr_later(
        "With θ₃ = 0 and the hand in line with the forearm the tool cannot move outwards: one singular value of the "
        "position part is 0."
    ),
    _at("singular", STRETCHED_POSE),
)
_BEFORE: tuple[str | SourceExperiment, ...] = (
    _TABLE, "000-3", "000-2", "000-4", "000-8", "000-9", _CLOSED_FORM, "000-10", "000-14g", "000-14", "000-15",
    "000-17", "000-21", "000-22", "000-24", "000-29", _STRETCHED, "000-31",
)  # fmt: skip
_FORWARD = (
    _entry(
        "P1",
        tr_later("Program 1"),
        tr_later("The frames of the arm"),
        tr_later(
            "The table with its offsets is right: the toolbox's figure has the tool where it is. The elbow stands "
            "at 90° though, outside the source's own limits."
        ),
        _at("matrices", EXAMPLE_POSE),
    ),
    _entry(
        "P2",
        tr_later("Program 2"),
        tr_later("The matrix of one row"),
        tr_later("The standard form, and a rotation: its determinant is 1, unlike that of equation (4)."),
        _at("matrices", TEXT_POSE),
    ),
    _entry(
        "P3",
        tr_later("Program 3"),
        tr_later("Eleven points of the arm"),
        tr_later("The base, the five frames and five points of the gripper: the finger tips lie in frame 5."),
        _at("points", TEXT_POSE),
    ),
    _entry(
        "P4",
        tr_later("Program 4"),
        tr_later("The stick figure"),
        tr_later("The lines between the points are the lengths of the table."),
        _at("points", EXAMPLE_POSE),
    ),
    _entry(
        "P5",
        tr_later("Program 5"),
        tr_later("Forward kinematics of the example"),
        tr_later("The elbow at +90°: its limits are −110° and 0°, so the limits are ignored here."),
        _at("tool", EXAMPLE_POSE),
        ("000-P5",),
    ),
    _entry(
        "P6",
        tr_later("Program 6"),
        tr_later("“Error 0” between two ways"),
        tr_later("The offsets are added in one of the two ways only: they are 102 mm apart, not 0."),
        Setup("source", _ERROR_POSE, erratum="000-P6"),
        ("000-P6",),
    ),
)
_LINE = (
    _entry(
        "P7",
        tr_later("Program 7"),
        tr_later("The points of a line"),
        tr_later(
            "A step of 0.1 makes eleven points, in a list made for ten; the line of the comment, in decimetres, "
            "lies metres away."
        ),
        Setup("path", None, COMMENT_LINE, track="line"),
    ),
    _entry(
        "P8",
        tr_later("Program 8"),
        tr_later("The line, solved without limits"),
        tr_later(
            "The toolbox's tree has no limits: every point of the line is found. Within them even the solver with "
            "the source's settings finds few."
        ),
        Setup("path", _TOOL_DOWN_POSE, _source_line(), track="line", ignore_limits=True),
        ("000-P8",),
    ),
)
_PLAYED = (
    _entry(
        "P10",
        tr_later("Program 10"),
        tr_later("The line, drawn slowly"),
        tr_later(
            "A pause of 0.51 s at every point. The axes say metres and have decimetres; X and Y are reversed on the "
            "display only."
        ),
        Setup("path", None, _source_line(), track="line", path_seconds=11 * LINE_PAUSE),
        ("000-plots",),
    ),
    _entry(
        "P11",
        tr_later("Program 11"),
        tr_later("The letter, drawn slowly"),
        tr_later(
            "A pause of 0.7 s at every point; all of it took the source about 240 s. The letter is shown at a "
            "height where some of it is in reach."
        ),
        Setup("path", None, trajectory=_LETTER_SCALED, track="trajectory", path_seconds=50 * LETTER_PAUSE),
    ),
    _entry(
        "P12",
        tr_later("Program 12"),
        tr_later("Tracking the line"),
        tr_later(
            "Within the source's own limits the arm reaches 4 of the 11 points: the elbow would have to bend beyond "
            "−110°."
        ),
        Setup("path", _START_POSE, _source_line(), track="line"),
    ),
    _entry(
        "P13",
        tr_later("Program 13"),
        tr_later("Tracking the letter"),
        tr_later(
            "Start and end are typed in, and not used. The nearest point of the letter is three quarters of a metre "
            "away; the arm reaches half a metre."
        ),
        Setup("path", _START_POSE, trajectory=_LETTER, track="trajectory"),
    ),
    _entry(
        "P14",
        tr_later("Program 14"),
        tr_later("The window"),
        tr_later("Five joints, a start and an end: eleven boxes, as in the panels Arm and Path of this window."),
        Setup("path", None, _source_line()),
    ),
    _entry(
        "P15",
        tr_later("Program 15"),
        tr_later("The window's functions"),
        tr_later(
            "Boxes 10 and 11 are read into each other's joint, so that the arm is drawn elsewhere; “Track "
            "Trajectory” ignores the boxes of the line."
        ),
        Setup("source", TEXT_POSE, erratum="000-P15"),
        ("000-P15",),
    ),
    _entry(
        "P16",
        tr_later("Program 16"),
        tr_later("The letter, smaller"),
        tr_later(
            "Divided by 40, without a height: at 300 mm 21 of 50 points are in reach, tool down and within the limits."
        ),
        Setup("path", None, trajectory=_LETTER_SCALED, track="trajectory"),
    ),
)
_RAW = _entry(
    "P9",
    tr_later("Program 9"),
    tr_later("The letter as printed"),
    tr_later("Its points are decimetres, up to seven metres away: nothing of it is in reach."),
    Setup("path", None, trajectory=_LETTER, track="trajectory"),
)
EXPERIMENTS_000: tuple[str | SourceExperiment, ...] = (*_BEFORE, *_FORWARD, *_LINE, _RAW, *_PLAYED)
