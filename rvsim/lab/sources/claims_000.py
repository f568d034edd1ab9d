"""What comes out of source 000's Programs 1 to 16 and of its examples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rvsim.experiment import LineTask
from rvsim.files import load_robot
from rvsim.kinematics import AS_IN_SOURCE_000, forward_kinematics, inverse_branches, jacobian, solve_numeric
from rvsim.lab.drawings import letter_raw
from rvsim.lab.lines import line_presets
from rvsim.lab.named_paths import line_of
from rvsim.lab.sources.arms import degrees
from rvsim.lab.sources.claim import Claim, drawn, drawn_by_name
from rvsim.lab.sources.figures import Numbers, as_numbers, pose_text
from rvsim.lab.sources.programs_000 import BOXES, LETTER_PAUSE, LINE_PAUSE, compute_dh_matrix, rvm1_fk
from rvsim.lab.sources.source_000_frames import TEXT_POSE
from rvsim.language import tr, tr_later
from rvsim.motion import Path
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

_ARM = "rv-m1"
EXAMPLE_POSE = degrees(0.0, 30.0, 90.0, 60.0, 0.0)  # of section 5 and Program 5
STRETCHED_POSE = degrees(30.0, 40.0, 0.0, 0.0, 0.0)  # (30): θ3 = 0 and, in the table's angles, θ4 = π/2
# The line in the comment of Program 7: (7, 15, 25) to (27, 0, 0) dm.
COMMENT_LINE = LineTask(np.array([0.7, 1.5, 2.5]), np.array([2.7, 0.0, 0.0]), 0.1, "down")


def claims_000() -> tuple[Callable[[], tuple[Claim, ...]], ...]:
    """Makers of the rows, each a small piece of the work."""
    return (_of_the_text, _forward_programs, _figure_programs, _line_points, _line_tracked, _solver, _letter, _window)


def _at(q: tuple[float, ...]) -> str:
    return pose_text(load_robot(_ARM), q)


def _mm(lengths: FloatArray | float) -> Numbers:
    return as_numbers(millimetres_from_metres(lengths))


def _of_the_text() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    lower, upper = degrees_from_radians(robot.limits[3])
    branches = inverse_branches(robot, forward_kinematics(robot, TEXT_POSE))
    sigma = as_numbers(np.linalg.svd(jacobian(robot, STRETCHED_POSE)[:3, :4], compute_uv=False)[-1])
    return (
        Claim(
            "000-figure-5",
            "000",
            tr("Figure 5: range of θ₄ [deg]"),
            (0.0, 180.0),
            None,
            (lower, upper),
            "contradiction",
        ),
        Claim(
            "000-6.1",
            "000",
            tr("Section 6.1: solutions for the tool at {pose}", pose=_at(TEXT_POSE)),
            None,
            None,
            float(len(branches)),
            "computed",
        ),
        Claim(
            "000-30", "000", tr("(30): smallest singular value of Ĵ at θ₃ = 0, θ₄ = 90°"), 0.0, 0.0, sigma, "confirmed"
        ),
    )


def _forward_programs() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    block = float(np.linalg.det(compute_dh_matrix(0.0, 0.7, 0.0, TEXT_POSE[0])[:3, :3]))
    return (
        _tool_claim(robot, "000-P1", tr_later("Program 1: tool's place [mm] at {pose}"), EXAMPLE_POSE),
        Claim(
            "000-P2",
            "000",
            tr("Program 2: determinant with θ₁ = 30° and α = 0.7 rad"),
            None,
            as_numbers(block),
            1.0,
            "confirmed",
        ),
        _tool_claim(robot, "000-P3", tr_later("Program 3, pos(6): tool's place [mm] at {pose}"), TEXT_POSE),
    )


def _tool_claim(robot: Robot, key: str, item: str, q: tuple[float, ...]) -> Claim:
    formula, ours = _mm(rvm1_fk(np.array(q))[5]), _mm(forward_kinematics(robot, q)[:3, 3])
    return Claim(key, "000", tr(item, pose=_at(q)), None, formula, ours, "confirmed")


def _figure_programs() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    drawn_length = np.linalg.norm(np.diff(rvm1_fk(np.array(EXAMPLE_POSE))[:6], axis=0), axis=1).sum()
    return (
        Claim(
            "000-P4",
            "000",
            tr("Program 4: length of the stick figure [mm]"),
            None,
            _mm(drawn_length),
            _mm(np.abs(robot.dh[:, 1:3]).sum()),
            "confirmed",
        ),
        _elbow(robot, 5, 90.0),
        _elbow(robot, 6, 60.0),
    )


def _elbow(robot: Robot, program: int, printed: float) -> Claim:
    lower, upper = degrees_from_radians(robot.limits[2])
    nearest = float(np.clip(printed, lower, upper))
    item = tr("Program {number}: elbow θ₃, nearest within the limits [deg]", number=program)
    return Claim(f"000-P{program}", "000", item, printed, None, nearest, "outside limits")


def source_line(robot: Robot) -> Path:
    """The line of Programs 12 and 13: (1.1, 0, 1.3) to (2.3, 0, 3.33) dm, tool down."""
    return line_of(robot, next(p for p in line_presets(robot) if p.name == "source-000").task())


def _line_points() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    points = float(COMMENT_LINE.samples)
    return (
        Claim(
            "000-P7", "000", tr("Program 7: points of a line with the step 0.1"), 10.0, points, points, "contradiction"
        ),
        drawn("000-P7", tr("Program 7: the line of its comment"), robot, line_of(robot, COMMENT_LINE)),
    )


def _line_tracked() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    line = source_line(robot)
    reach = float(np.abs(robot.dh[1:, 1:3]).sum())
    return (
        drawn("000-P8", tr("Program 8: the line, without limits"), robot, line, ignore_limits=True),
        Claim(
            "000-P10",
            "000",
            tr("Programs 10 and 11: reach from the shoulder as the axes say [m]"),
            None,
            10.0 * reach,
            reach,
            "misprint",
        ),
        Claim("000-P10", "000", tr("Program 10: its pauses [s]"), None, None, LINE_PAUSE * line.samples, "computed"),
        drawn("000-P12", tr("Program 12: the line, within the source's limits"), robot, line),
    )


def _solver() -> tuple[Claim, ...]:
    """Program 8: from home, then from the solution before; no random restarts, so that it is the solver that counts."""
    robot = load_robot(_ARM)
    line, q, found = source_line(robot), robot.home, 0
    assert line.rotations is not None  # the tool points down
    options = replace(AS_IN_SOURCE_000.options, allow_random_restarts=False)
    for point, rotation in zip(line.points, line.rotations, strict=True):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = rotation, point
        result = solve_numeric(robot, T, q, task=AS_IN_SOURCE_000.task, options=options, clock=_no_clock)
        q, found = result.q, found + result.converged
    item = tr("Program 8: the line by Levenberg–Marquardt, tolerance 0.01, points found of 11")
    return (Claim("000-P8", "000", item, 11.0, None, float(found), "partly reached"),)


def _no_clock() -> float:
    """Time does not pass, so that the outcome does not depend on the machine."""
    return 0.0


def _letter() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    shoulder = np.array([0.0, 0.0, robot.dh[0, 1]])
    nearest = np.linalg.norm(letter_raw() - shoulder, axis=1).min()
    reach = np.abs(robot.dh[1:, 1:3]).sum()
    return (
        drawn_by_name("000-P9", tr("Program 9: the letter as printed, in decimetres"), _ARM, "letter-raw"),
        Claim(
            "000-P11", "000", tr("Program 11: its pauses [s]"), None, None, LETTER_PAUSE * len(letter_raw()), "computed"
        ),
        Claim(
            "000-P13",
            "000",
            tr("Program 13: the letter's nearest point from the shoulder, and the reach [mm]"),
            None,
            _mm(nearest),
            _mm(reach),
            "cannot be reached",
        ),
        drawn_by_name(
            "000-P16", tr("Program 16: the letter divided by 40, at a height of 300 mm"), _ARM, "letter-scaled"
        ),
    )


def _window() -> tuple[Claim, ...]:
    robot = load_robot(_ARM)
    exchanged = np.array(TEXT_POSE)[[0, 1, 2, 4, 3]]
    formula, ours = (_mm(forward_kinematics(robot, q)[:3, 3]) for q in (exchanged, np.array(TEXT_POSE)))
    return (
        Claim(
            "000-P14",
            "000",
            tr("Program 14: boxes to type into"),
            float(BOXES),
            None,
            float(robot.dof + 6),
            "confirmed",
        ),
        Claim(
            "000-P15",
            "000",
            tr("Program 15: tool's place [mm] for {pose} typed into boxes 7 to 11", pose=_at(TEXT_POSE)),
            None,
            formula,
            ours,
            "misprint",
        ),
    )
