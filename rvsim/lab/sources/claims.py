"""What sources 001 to 004 say of their own examples: how much of a path is drawn, and which numbers come out."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np

from rvsim.dynamics import gravity_torques
from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.lab.drawings import ELLIPSE_SAMPLES, ellipse, spiral
from rvsim.lab.named_paths import named_path
from rvsim.lab.sources.arms import degrees
from rvsim.lab.sources.claim import Claim, drawn_by_name
from rvsim.lab.sources.figures import as_numbers, pose_text
from rvsim.lab.sources.source_002_errata import spacing, tilt_range
from rvsim.lab.sources.source_003 import program_place, roll
from rvsim.lab.sources.source_004_motion import quintic_coefficients
from rvsim.lab.tables import shown_length
from rvsim.language import tr
from rvsim.motion import track
from rvsim.motion.laws import cubic, quintic_between
from rvsim.spatial import rotation_error_angle
from rvsim.units import degrees_from_radians, millimetres_from_metres, radians_from_degrees

UPRIGHT_001 = degrees(0.0, 90.0, 0.0, 0.0, 0.0, 0.0)
GRAVITY_002 = ((0.0,) * 6, (0.0, -60.0, 90.0, -120.0, -90.0, 30.0))  # [deg]
STRETCHED_41 = degrees(30.0, 0.0)
# The arms of source 004, section 2.1: the figure, and the arm's name.
TEXTBOOK_ARMS = (
    ("2.3", "articulated"),
    ("2.6", "spherical"),
    ("2.7", "scara"),
    ("2.9", "cylindrical"),
    ("2.12", "cartesian"),
)
_QUARTERS = np.pi / 2 * np.array([-1.0, 0.0, 1.0])


def other_claims() -> tuple[Callable[[], tuple[Claim, ...]], ...]:
    """Makers of the rows, each a small piece of the work."""
    return (_source_001, _ellipse_points, _ellipse_drawn, _gravity, _source_003, _textbook_arms, _source_004)


def _source_001() -> tuple[Claim, ...]:
    robot = load_robot("rv-1a")
    place = as_numbers(millimetres_from_metres(forward_kinematics(robot, UPRIGHT_001)[:3, 3]))
    item = tr("Table 1: tool's place [mm] at {pose}", pose=pose_text(robot, UPRIGHT_001))
    return (Claim("001-table", "001", item, None, None, place, "computed"),)


def _ellipse_points() -> tuple[Claim, ...]:
    robot = load_robot("ur5e")
    first = as_numbers(millimetres_from_metres(ellipse()[1, :2]))
    gaps = as_numbers(millimetres_from_metres(spacing(robot, robot.home)))
    own, count = "002-code-1", float(len(ellipse()))
    return (
        Claim(own, "002", tr("Code 1: the number of points"), 184.0, float(ELLIPSE_SAMPLES), count, "confirmed"),
        Claim(
            own, "002", tr("Code 1: the second point, x and y [mm]"), (134.9794, 100.8582), first, first, "confirmed"
        ),
        Claim(
            own, "002", tr("Code 1: least and largest distance of neighbours [mm]"), 1.2, gaps, gaps, "contradiction"
        ),
    )


def _ellipse_drawn() -> tuple[Claim, ...]:
    robot = load_robot("ur5e")
    tilts = as_numbers(degrees_from_radians(tilt_range(robot, robot.home)))
    item = tr("Code 2: tool axis to the desired one, with right formulas [deg]")
    return (
        Claim("002-ik", "002", item, 0.0, tilts, 0.0, "ignored"),
        drawn_by_name("002-rotation", tr("The ellipse with the desired rotation"), "ur5e", "ellipse"),
        drawn_by_name("002-any", tr("The ellipse with any rotation"), "ur5e", "ellipse", "free"),
    )


def _gravity() -> tuple[Claim, ...]:
    return tuple(_gravity_at(f"002-gravity-{number}", pose) for number, pose in enumerate(GRAVITY_002, start=1))


def _gravity_at(key: str, pose_deg: tuple[float, ...]) -> Claim:
    torques = as_numbers(gravity_torques(load_robot("ur5e"), radians_from_degrees(pose_deg)))
    pose = ", ".join(f"{angle:g}" for angle in pose_deg).replace("-", "\u2212")
    item = tr("Table: torques that hold the arm by its masses [N m] at ({pose})°", pose=pose)
    return Claim(key, "002", item, None, None, torques, "computed")


def _source_003() -> tuple[Claim, ...]:
    robot = load_robot("rrrp")
    tracking = track(robot, named_path("spiral", robot))
    wrong = np.array(tracking.q)
    wrong[:, 2] = [roll(robot, q) for q in tracking.q]
    R_wrong, R = (forward_kinematics(robot, q)[:, :3, :3] for q in (wrong, tracking.q))
    turned = degrees_from_radians(float(np.max(rotation_error_angle(R_wrong, R))))
    places = np.array([program_place(robot, q, float(robot.dh[1, 2])) for q in tracking.q])
    gap = as_numbers(np.abs(places - spiral()).max())
    error = tr("θ₃ in the program: largest error of the tool's orientation [deg]")
    return (
        drawn_by_name("003-spiral", tr("The spiral"), "rrrp", "spiral"),
        Claim("003-spiral", "003", tr("AT with l₅: largest distance from the path [unit]"), 0.0, gap, 0.0, "confirmed"),
        Claim("003-t3", "003", error, 0.0, turned, 0.0, "misprint"),
    )


def _textbook_arms() -> tuple[Claim, ...]:
    return tuple(_farthest(figure, arm) for figure, arm in TEXTBOOK_ARMS)


def _farthest(figure: str, arm: str) -> Claim:
    """These arms reach farthest with every joint at a stop or at a quarter turn."""
    robot = load_robot(arm)
    values = [
        np.unique(np.clip(np.concatenate([limits, _QUARTERS]), *limits)) if revolute else limits
        for limits, revolute in zip(robot.limits, robot.is_revolute, strict=True)
    ]
    places = forward_kinematics(robot, np.array(list(product(*values))))[:, :3, 3]
    farthest = as_numbers(shown_length(robot, np.hypot(places[:, 0], places[:, 1]).max()))
    item = tr("Figure {figure}: farthest from the base axis, within the limits [mm]", figure=figure)
    return Claim(f"004-{figure}", "004", item, None, None, farthest, "computed")


def _source_004() -> tuple[Claim, ...]:
    planar, al5b = load_robot("planar"), load_robot("al5b")
    sigma = as_numbers(np.linalg.svd(jacobian(planar, STRETCHED_41)[:2], compute_uv=False)[-1])
    place = as_numbers(millimetres_from_metres(forward_kinematics(al5b, np.zeros(5))[:3, 3]))
    start = as_numbers(cubic(0.0, 2.0, 0.0, 40.0).at(0.0).qdd[0])
    printed = as_numbers(quintic_coefficients(0.0, 40.0, 0.0, 2.0, as_printed=True))
    ours = as_numbers(quintic_between(0.0, 2.0, 0.0, 40.0).coefficients[0, :, 0])
    quintic = tr("(5.22) with t₀ = 0: a₀ to a₅ from 0 to 40° in 2 s [deg, s]")
    jump = tr("Section 5.1: acceleration at the start of a cubic from 0 to 40° in 2 s [deg/s²]")
    return (
        Claim("004-3.1", "004", tr("Table 3.1: tool's place [mm] with all joints 0"), None, None, place, "computed"),
        Claim(
            "004-4.1", "004", tr("Figure 4.1: smallest singular value, stretched out"), 0.0, None, sigma, "confirmed"
        ),
        Claim("004-cubic", "004", jump, None, None, start, "computed"),
        Claim("004-quintic", "004", quintic, None, printed, ours, "confirmed"),
    )
