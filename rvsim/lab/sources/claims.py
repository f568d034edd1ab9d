"""What the sources say of their own examples: how much of a path is drawn, and which numbers come out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.dynamics import gravity_torques
from rvsim.experiment import PathOrientation
from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.lab.drawings import ELLIPSE_SAMPLES, ellipse, spiral
from rvsim.lab.lines import line_presets
from rvsim.lab.named_paths import line_of, named_path
from rvsim.lab.sources.figures import Numbers, as_numbers
from rvsim.lab.sources.source_002_errata import spacing, tilt_range
from rvsim.lab.sources.source_003 import program_place, roll
from rvsim.lab.sources.source_004_motion import quintic_coefficients
from rvsim.motion import Path, track
from rvsim.motion.laws import quintic_between
from rvsim.robot import Robot
from rvsim.spatial import rotation_error_angle
from rvsim.units import degrees_from_radians, millimetres_from_metres, radians_from_degrees


class Claim(NamedTuple):
    """A row of the reproduction: see `Reproduction`."""

    source: str
    item: str
    printed: Numbers | None
    formula: Numbers | None
    ours: Numbers
    verdict: str


def claims() -> tuple[Claim, ...]:
    """All of them, worked out now; about a second."""
    return (*_source_000(), *_source_002(), *_source_003(), *_source_004())


# --- what can be drawn -----------------------------------------------------------------------------------------------


def _drawn(source: str, item: str, robot: Robot, path: Path, *, ignore_limits: bool = False) -> Claim:
    """The source draws every point; how many the arm can draw."""
    wanted = path.samples
    reached = track(robot, path, ignore_limits=ignore_limits).reached_count
    verdict = "confirmed" if reached == wanted else "partly reached" if reached else "cannot be reached"
    return Claim(source, f"{item}, points reached of {wanted}", float(wanted), None, float(reached), verdict)


def _named(source: str, item: str, arm: str, name: str, orientation: PathOrientation | None = None) -> Claim:
    robot = load_robot(arm)
    return _drawn(source, item, robot, named_path(name, robot, orientation=orientation))


def _source_000() -> tuple[Claim, ...]:
    robot = load_robot("rv-m1")
    line = line_of(robot, next(p for p in line_presets(robot) if p.name == "source-000").task())
    return (
        _drawn("000", "Programs 7 and 8: the line, without limits", robot, line, ignore_limits=True),
        _drawn("000", "Programs 7 and 8: the line, within the source's limits", robot, line),
        _named("000", "Program 9: the letter as printed, in decimetres", "rv-m1", "letter-raw"),
        _named("000", "Program 16: the letter divided by 40, at a height of 300 mm", "rv-m1", "letter-scaled"),
        _elbow(robot, "Program 5", 90.0),
        _elbow(robot, "Program 6", 60.0),
        _stretched(robot),
    )


def _elbow(robot: Robot, program: str, printed: float) -> Claim:
    lower, upper = degrees_from_radians(robot.limits[2])
    nearest = float(np.clip(printed, lower, upper))
    return Claim(
        "000", f"{program}: elbow θ₃, nearest within the limits [deg]", printed, None, nearest, "outside limits"
    )


def _stretched(robot: Robot) -> Claim:
    """(30): θ3 = 0 and θ4 = π/2 of the table."""
    q = radians_from_degrees([30.0, 40.0, 0.0, 0.0, 0.0])
    sigma = as_numbers(np.linalg.svd(jacobian(robot, q)[:3, :4], compute_uv=False)[-1])
    return Claim("000", "(30): smallest singular value of Ĵ at θ₃ = 0, θ₄ = 90°", 0.0, 0.0, sigma, "confirmed")


# --- numbers ---------------------------------------------------------------------------------------------------------


def _source_002() -> tuple[Claim, ...]:
    robot = load_robot("ur5e")
    first = as_numbers(millimetres_from_metres(ellipse()[1, :2]))
    gaps = as_numbers(millimetres_from_metres(spacing(robot, robot.home)))
    tilts = as_numbers(degrees_from_radians(tilt_range(robot, robot.home)))
    return (
        Claim("002", "Code 1: the number of points", 184.0, float(ELLIPSE_SAMPLES), float(len(ellipse())), "confirmed"),
        Claim("002", "Code 1: the second point, x and y [mm]", (134.9794, 100.8582), first, first, "confirmed"),
        Claim("002", "Code 1: least and largest distance of neighbours [mm]", 1.2, gaps, gaps, "contradiction"),
        Claim("002", "Code 2: tool axis to the desired one, with right formulas [deg]", 0.0, tilts, 0.0, "ignored"),
        _named("002", "The ellipse with the desired rotation", "ur5e", "ellipse"),
        _named("002", "The ellipse with any rotation", "ur5e", "ellipse", "free"),
        *(_gravity(pose) for pose in ((0.0,) * 6, (0.0, -60.0, 90.0, -120.0, -90.0, 30.0))),
    )


def _gravity(pose_deg: tuple[float, ...]) -> Claim:
    torques = as_numbers(gravity_torques(load_robot("ur5e"), radians_from_degrees(pose_deg)))
    pose = ", ".join(f"{angle:g}" for angle in pose_deg).replace("-", "\u2212")
    item = f"Table: torques that hold the arm by its masses [N m] at ({pose})°"
    return Claim("002", item, None, None, torques, "computed")


def _source_003() -> tuple[Claim, ...]:
    robot = load_robot("rrrp")
    tracking = track(robot, named_path("spiral", robot))
    wrong = np.array(tracking.q)
    wrong[:, 2] = [roll(robot, q) for q in tracking.q]
    R_wrong, R = (forward_kinematics(robot, q)[:, :3, :3] for q in (wrong, tracking.q))
    turned = degrees_from_radians(float(np.max(rotation_error_angle(R_wrong, R))))
    places = np.array([program_place(robot, q, float(robot.dh[1, 2])) for q in tracking.q])
    gap = as_numbers(np.abs(places - spiral()).max())
    return (
        _named("003", "The spiral", "rrrp", "spiral"),
        Claim("003", "AT with l₅: largest distance from the path [unit]", 0.0, gap, 0.0, "confirmed"),
        Claim("003", "θ₃ in the program: largest error of the tool's orientation [deg]", 0.0, turned, 0.0, "misprint"),
    )


def _source_004() -> tuple[Claim, ...]:
    printed = quintic_coefficients(0.0, 40.0, 0.0, 2.0, as_printed=True)
    ours = quintic_between(0.0, 2.0, 0.0, 40.0).coefficients[0, :, 0]
    item = "(5.22) with t₀ = 0: a₀ to a₅ from 0 to 40° in 2 s [deg, s]"
    return (Claim("004", item, None, as_numbers(printed), as_numbers(ours), "confirmed"),)
