"""What the workspace page says: its choices, the classic figures of the textbook arms, the table of a map."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.gui.panels.inspect_workspace_survey import Survey
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, format_quantity, length_kind
from rvsim.kinematics.singularity import task_rows
from rvsim.kinematics.workspace import SectionMap, WorkspaceTask, has_branches, holds_orientation
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

ORIENTATIONS = {"free": tr_later("Tool free to turn"), "fixed": tr_later("Tool held as now")}
COLORS = {
    "manipulability": tr_later("Manipulability"),
    "branches": tr_later("Branches"),
    "none": tr_later("No colours"),
}
SECTIONS = {"side": tr_later("From the side"), "top": tr_later("From above")}
POSES = (100_000, 1_000_000, 4_000_000)
LIMITS = {"within": tr_later("Within limits"), "ignored": tr_later("Ignoring limits")}

FIGURES = {
    "articulated": tr_later(
        "The elbow manipulator's workspace (source 004, §2.1.1, its figure 2.6): a ball, hollow where the elbow cannot "
        "fold further, cut off where the joints stop."
    ),
    "spherical": tr_later(
        "The spherical manipulator's workspace (source 004, §2.1.2, its figure 2.9): a thick shell between the "
        "shortest and the longest extension."
    ),
    "scara": tr_later(
        "The SCARA's workspace (source 004, §2.1.3, its figure 2.12): the ring of a planar arm, as high as the stroke "
        "of joint 3."
    ),
    "cylindrical": tr_later(
        "The cylindrical manipulator's workspace (source 004, its figure 2.11): a hollow cylinder."
    ),
    "cartesian": tr_later("The Cartesian manipulator's workspace (source 004, §2.1.4, its figure 2.14): a box."),
    "planar": tr_later(
        "The planar arm of source 004's figure 4.1 reaches a ring: its rims are the boundary singularities, stretched "
        "out and folded back."
    ),
}
_WHOLE = 6  # rows of J
_TASKS = {
    (0, 1): tr_later("largest manipulability of x, y, SI"),
    (0, 1, 2): tr_later("largest manipulability of the place, SI"),
    (0, 1, 2, 5): tr_later("largest manipulability of place and yaw, SI"),
}
EMPTY = tr_later("No workspace yet: press Sample, and see where the tool can go.")


class Values(NamedTuple):
    """What a map is coloured by: the values, the largest, and what they are called; no values: one colour."""

    values: FloatArray | None
    largest: float
    title: str
    whole: bool = False


def values_of(survey: Survey, section: SectionMap, color: str) -> Values:
    """The values of a section under a choice of colour; the scale is that of both sections and the cloud."""
    if color == "branches" and section.branches is not None:
        return Values(section.branches, _largest(survey, color), tr("branches, the most at each place"), whole=True)
    if color == "none":
        return Values(None, 1.0, "")
    title = _measure(survey.workspace.task.robot)
    return Values(section.manipulability, _largest(survey, "manipulability"), title)


def _measure(robot: Robot) -> str:
    """Yoshikawa's measure of this arm's task."""
    rows = task_rows(robot)
    if len(rows) < _WHOLE:
        return tr(_TASKS[rows])
    formula = "√det(JᵀJ)" if robot.dof < _WHOLE else "√det(JJᵀ)"
    return tr("largest manipulability {formula}, SI", formula=formula)


def cloud_shares(survey: Survey, color: str) -> FloatArray:
    """(m,) 0…1 for the cloud, by the same scale as the maps."""
    result = survey.workspace
    if color == "branches" and result.cloud_branches is not None:
        return np.asarray((result.cloud_branches - 1.0) / max(_largest(survey, color) - 1.0, 1.0))
    if color == "none":
        return np.full(len(result.cloud), 0.5)
    return np.asarray(result.cloud_manipulability / max(_largest(survey, "manipulability"), 1e-300))


def _largest(survey: Survey, color: str) -> float:
    result = survey.workspace
    maps = (result.side.branches, result.top.branches, result.cloud_branches)
    if color != "branches":
        maps = (result.side.manipulability, result.top.manipulability, result.cloud_manipulability)
    found = [float(values[~np.isnan(values)].max(initial=0.0)) for values in maps if values is not None]
    return max(found) or 1.0


def refusal(robot: Robot, choice: str) -> str:
    """Why a choice makes no sense for an arm, or ""."""
    if choice == "fixed" and not holds_orientation(robot):
        return tr("This arm cannot hold the tool's orientation all over an area.")
    if choice == "branches" and not has_branches(robot):
        return tr("This arm has no closed form, so its branches cannot be counted.")
    return ""


def done_sentence(survey: Survey) -> str:
    """What was done, and how long it took."""
    task = survey.workspace.task
    seconds = f"{survey.seconds:.2f}"
    if task.fixed and task.ignore_limits:
        return tr("Every cell asked in {seconds} s, joint limits ignored.", seconds=seconds)
    if task.fixed:
        return tr("Every cell asked in {seconds} s, within the joint limits.", seconds=seconds)
    if task.ignore_limits:
        return trn(
            "{n:,} pose sampled in {seconds} s, joint limits ignored.",
            "{n:,} poses sampled in {seconds} s, joint limits ignored.",
            task.poses,
            seconds=seconds,
        )
    return trn(
        "{n:,} pose sampled in {seconds} s, within the joint limits.",
        "{n:,} poses sampled in {seconds} s, within the joint limits.",
        task.poses,
        seconds=seconds,
    )


def section_sentence(survey: Survey, kind: str, preferences: Preferences) -> str:
    """Where the section lies, and what its rim is."""
    result = survey.workspace
    robot = result.task.robot
    section = result.side if kind == "side" else result.top
    rim = tr("The rim is exact.") if section.exact else tr("The rim goes round the cells that were reached.")
    if kind == "top":
        height = format_quantity(float(section.origin[2]), length_kind(robot), preferences)
        place = tr("Level section at the tool's height, z = {height}.", height=height)
        return f"{place} {rim}"
    if section.projected:
        return f"{tr('All places, seen along y.')} {rim}"
    angle = format_quantity(float(np.arctan2(section.axis_u[1], section.axis_u[0])), "angle", preferences)
    place = tr("Upright section through the base axis, at azimuth {angle}.", angle=angle)
    return f"{place} {rim}"


def axis_titles(section: SectionMap, kind: str) -> tuple[str, str]:
    """The names of the axes, below and beside."""
    if kind == "top":
        return "x", "y"
    return ("x", "z") if abs(section.axis_u[1]) < 1e-12 and not section.exact and section.projected else ("r", "z")


def map_csv(survey: Survey, kind: str, shown: Display) -> str:
    """The reached cells of a map: their middle in base axes, manipulability and branches (empty: not counted)."""
    section = survey.workspace.side if kind == "side" else survey.workspace.top
    reached = section.reached.reshape(-1)
    places = section.place(section.grid.centers()[reached]) * shown.factor
    measure = section.manipulability.reshape(-1)[reached]
    counts = [""] * len(places)
    if section.branches is not None:
        counts = ["" if np.isnan(count) else f"{count:.0f}" for count in section.branches.reshape(-1)[reached]]
    unit = shown.suffix.strip()
    rows = (
        ",".join((*(f"{value:.9g}" for value in place), f"{value:.9g}", count))
        for place, value, count in zip(places.tolist(), measure.tolist(), counts, strict=True)
    )
    return "\n".join((f"x_{unit},y_{unit},z_{unit},manipulability,branches", *rows, ""))


def task_of(robot: Robot, q: FloatArray, choices: dict[str, object]) -> WorkspaceTask:
    """What the page's choices ask for."""
    poses = choices["poses"]
    assert isinstance(poses, int)
    return WorkspaceTask(
        robot,
        q,
        fixed=choices["orientation"] == "fixed",
        branches=choices["color"] == "branches",
        poses=poses,
        ignore_limits=choices["limits"] == "ignored",
    )
