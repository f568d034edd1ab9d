"""What the Singular page says: the verdict, what is lost, and the sizes of the ellipsoids."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, format_quantity, joint_kind, length_kind
from rvsim.kinematics import LostMotion, Measures, SingularFamily, Singularity, SingularPose
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

NEAR = 0.1  # of a family's scaled terms: some 6°, or a tenth of the arm's size
_ALIGNED = 0.9999  # cosine to an axis that is called by its letter
_MINUS = "\u2212"


class Light(NamedTuple):
    """One of the three lights: the level that colours it, its symbol and its word."""

    level: str
    symbol: str
    word: str


CLEAR = Light("good", "●", "Clear of singularities")
CLOSE = Light("warning", "▲", "Close to a singularity")
PLACE_SINGULAR = Light("warning", "▲", "The place alone is singular")
SINGULAR = Light("error", "✖", "Singular")

PLACE = "Place (v)", "The upper three rows of J alone: moving the tool, whatever it turns."
ALL_ROWS = "All of J", "All six rows of J, those that this arm's own task does not ask for too."
TASK_TITLES = {
    6: ("Tool (v, ω)", "All six rows of J: moving the tool and turning it at once."),
    3: PLACE,
    4: ("Place, yaw", "The rows of J that this arm's task asks for: moving, and turning about z."),
    2: ("x, y", "The rows of J that this arm's task asks for: moving in the plane."),
}
MEASURES: tuple[tuple[str, str], ...] = (
    ("σ min", "The smallest singular value of J: how fast the tool moves in its worst direction for joint speeds of "
     "length 1. Metres and radians are mixed in it: compare poses of one arm with it, not arms."),
    ("σ min / σ max", "One over the condition: 0 at a singularity, 1 where all directions are alike. The light looks "
     "at it, because it does not grow with the arm."),
    ("Condition", "σ max / σ min: how unlike the best and the worst direction are, and how much small errors of the "
     "tool grow in the joints."),
    ("Manipulability", "The product of all σ, √det(J Jᵀ) or √det(Jᵀ J), after Yoshikawa: the volume of the velocity "
     "ellipsoid, but for a factor."),
    ("Rank", "How many directions the tool can move in at once: singular values above 1e-6, of those there could be."),
)  # fmt: skip


def measure_texts(measures: Measures) -> tuple[str, ...]:
    """The five numbers of `MEASURES`."""
    return (
        small_number(measures.sigma_min),
        small_number(measures.ratio),
        _condition(measures.condition),
        small_number(measures.manipulability),
        f"{measures.rank} of {measures.full_rank}",
    )


def _condition(value: float) -> str:
    if math.isinf(value):
        return "∞"
    return format_number(value, 1) if value < 1e5 else f"{value:.1e}"


def small_number(value: float) -> str:
    """Four decimals, but never rounded to 0: below that in powers of ten, and 0 where only rounding is left."""
    if abs(value) < 1e-12:
        return "0"
    return format_number(value, 4) if abs(value) >= 5e-4 else f"{value:.1e}".replace("-", _MINUS)


def bars_sentence(robot: Robot, rows: int) -> str:
    """The scale of the bars and the unit of what they show."""
    length = "m" if robot.length_unit == "millimetre" else "units"
    tool = f"{length} and rad together" if rows in (4, 6) else length
    joint = "rad" if robot.is_revolute.all() else "rad or length"
    return (
        f"σ in {tool} per {joint} of the joints. Logarithmic bars, from σ max down to a ten thousandth of it; "
        "dashed: the threshold."
    )


def light_of(found: Singularity, threshold: float) -> Light:
    """Which light is on."""
    measures = found.task
    if measures.rank < measures.full_rank:
        return SINGULAR
    if measures is found.whole and found.position.rank < found.position.full_rank:
        return PLACE_SINGULAR
    return CLOSE if measures.ratio < threshold else CLEAR


def verdict_sentence(found: Singularity) -> str:
    """The active families in words, or "" where there is none."""
    sentences = [f"{family.name.capitalize()} ({family.kind}): {family.sentence}" for family in found.families]
    sentences += [
        f"{family.name.capitalize()} ({family.kind}): {family.sentence} Turning the tool is as free as ever."
        for family in found.position_families
        if not found.families
    ]
    return "\n".join(sentences)


# --- what is lost ------------------------------------------------------------------------------------------------


def lost_sentence(motions: tuple[LostMotion, ...], found: Measures, robot: Robot, preferences: Preferences) -> str:
    """What the tool cannot do here, one line a motion."""
    lines = [_motion(motion, robot, preferences) for motion in motions]
    if sum(not motion.alone for motion in motions) > found.full_rank - found.rank:
        lines.append(f"With {robot.dof} joints one of these is always missing.")
    return "\n".join(lines)


def _motion(motion: LostMotion, robot: Robot, preferences: Preferences) -> str:
    way = direction_text(motion.direction)
    if motion.kind == "turn":
        return f"Cannot turn about {way}{' with the tip at rest' if motion.alone else ''}."
    away = float(np.linalg.norm(motion.offset))
    distance = format_quantity(away, length_kind(robot), preferences)
    line = "" if away < 1e-4 * robot.size else f" on the dashed line, {distance} beside the tip"
    return f"Cannot move along {way}{' without turning' if motion.alone else line}."


def direction_text(direction: FloatArray) -> str:
    """A letter for an axis of the base, else the three numbers."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) > _ALIGNED:
        return "xyz"[axis]
    return f"({', '.join(format_number(float(value), 2) for value in direction)})"


# --- families ----------------------------------------------------------------------------------------------------


def state_text(measure: float, active: bool) -> str:
    """Whether a family is active or near."""
    return "active" if active else "near" if measure < NEAR else ""


def value_text(family: SingularFamily, q: FloatArray, robot: Robot, preferences: Preferences) -> str:
    """The terms as they are now."""
    kinds = [length_kind(robot) if term.is_length else "number" for term in family.terms]
    shown = [
        format_quantity(float(value), kind, preferences) if kind != "number" else small_number(float(value))
        for value, kind in zip(family.values(q), kinds, strict=True)
    ]
    return f"now {' and '.join(shown)}"


def refusal(robot: Robot, way: SingularPose, preferences: Preferences) -> str:
    """Why a family cannot be shown, with the numbers."""
    if way.outside is None or not way.joints:
        return way.reason
    parts = []
    for i in way.joints:
        kind, (lower, upper) = joint_kind(robot, i), robot.limits[i]
        needs, low, high = (
            format_quantity(float(value), kind, preferences) for value in (way.outside[i], lower, upper)
        )
        parts.append(f"{robot.joint_names[i]} would need {needs}, but has {low} to {high}")
    return f"Outside the limits: {'; '.join(parts)}."


# --- ellipsoids --------------------------------------------------------------------------------------------------


class Scale(NamedTuple):
    """How large an ellipsoid is drawn: metres for one of its units, the longest half axis [m], and the unit's name."""

    factor: float
    longest: float
    unit: str


def ellipsoid_scale(robot: Robot, part: str, kind: str) -> Scale:
    """The same for all poses of an arm, so that an ellipsoid grows and shrinks as it should."""
    size, length = robot.size, "m" if robot.length_unit == "millimetre" else "unit"
    factors = {
        ("linear", "velocity"): (0.4, f"{length}/s"),
        ("angular", "velocity"): (0.12 * size, "rad/s"),
        ("linear", "force"): (0.06 * size**2, "N"),
        ("angular", "force"): (0.12 * size, "N m"),
    }
    factor, unit = factors[part, kind]
    return Scale(_round(factor), _round(0.5 * size), unit)


def _round(value: float) -> float:
    """One digit, so that the scale can be said."""
    power = 10.0 ** math.floor(math.log10(value))
    return round(value / power) * power


def scale_sentence(robot: Robot, part: str, kinds: tuple[str, ...], preferences: Preferences) -> str:
    """What the drawn ellipsoids mean, and their scale."""
    lines = []
    turning = bool(robot.is_revolute.all())
    together = {
        "velocity": f"joint speeds of norm 1{' rad/s' if turning else ''}",
        "force": f"joint torques of norm 1{' N m' if turning else ''}",
    }
    for kind in kinds:
        factor, longest, unit = ellipsoid_scale(robot, part, kind)
        drawn, cut = (_drawn(robot, value, preferences) for value in (factor, longest))
        end = f", cut at {cut}" if kind == "force" else ""
        lines.append(f"{kind.capitalize()} for {together[kind]}: 1 {unit} is drawn as {drawn}{end}.")
    return "\n".join(lines)


def _drawn(robot: Robot, value: float, preferences: Preferences) -> str:
    shown = display(length_kind(robot), preferences)
    return f"{value * shown.factor:.4g}{shown.suffix}"
