"""What the Singular page says: the verdict, what is lost, and the sizes of the ellipsoids."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, format_quantity, joint_kind, length_kind
from rvsim.kinematics import LostMotion, Measures, SingularFamily, Singularity, SingularPose
from rvsim.language import left_to_right, listed, tr, tr_later
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


CLEAR = Light("good", "●", tr_later("Clear of singularities"))
CLOSE = Light("warning", "▲", tr_later("Close to a singularity"))
PLACE_SINGULAR = Light("warning", "▲", tr_later("The place alone is singular"))
SINGULAR = Light("error", "✖", tr_later("Singular"))

PLACE = tr_later("Place (v)"), tr_later("The upper three rows of J alone: moving the tool, whatever it turns.")
ALL_ROWS = tr_later("All of J"), tr_later("All six rows of J, those that this arm's own task does not ask for too.")
TASK_TITLES = {
    6: (tr_later("Tool (v, ω)"), tr_later("All six rows of J: moving the tool and turning it at once.")),
    3: PLACE,
    4: (tr_later("Place, yaw"), tr_later("The rows of J that this arm's task asks for: moving, and turning about z.")),
    2: ("x, y", tr_later("The rows of J that this arm's task asks for: moving in the plane.")),
}
MEASURES: tuple[tuple[str, str], ...] = (
    (
        "σ min",
        tr_later(
            "The smallest singular value of J: how fast the tool moves in its worst direction for joint speeds of "
            "length 1. Metres and radians are mixed in it: compare poses of one arm with it, not arms."
        ),
    ),
    (
        "σ min / σ max",
        tr_later(
            "One over the condition: 0 at a singularity, 1 where all directions are alike. The light looks at it, "
            "because it does not grow with the arm."
        ),
    ),
    (
        tr_later("Condition"),
        tr_later(
            "σ max / σ min: how unlike the best and the worst direction are, and how much small errors of the tool "
            "grow in the joints."
        ),
    ),
    (
        tr_later("Manipulability"),
        tr_later(
            "The product of all σ, √det(J Jᵀ) or √det(Jᵀ J), after Yoshikawa: the volume of the velocity ellipsoid, "
            "but for a factor."
        ),
    ),
    (
        tr_later("Rank"),
        tr_later(
            "How many directions the tool can move in at once: singular values above 1e-6, of those there could be."
        ),
    ),
)
# What σ is counted in: whether turning the tool counts too, whether all joints turn.
_PER_JOINT = {
    (True, True): tr_later("σ in {length} and rad together per rad of the joints."),
    (True, False): tr_later("σ in {length} and rad together per rad or length of the joints."),
    (False, True): tr_later("σ in {length} per rad of the joints."),
    (False, False): tr_later("σ in {length} per rad or length of the joints."),
}


def measure_texts(measures: Measures) -> tuple[str, ...]:
    """The five numbers of `MEASURES`."""
    return (
        small_number(measures.sigma_min),
        small_number(measures.ratio),
        _condition(measures.condition),
        small_number(measures.manipulability),
        tr("{rank} of {full_rank}", rank=measures.rank, full_rank=measures.full_rank),
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
    length = "m" if robot.length_unit == "millimetre" else tr("units")
    template = _PER_JOINT[rows in (4, 6), bool(robot.is_revolute.all())]
    bars = tr("Logarithmic bars, from σ max down to a ten thousandth of it; dashed: the threshold.")
    return f"{tr(template, length=length)} {bars}"


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
    sentences = [_family_sentence(family) for family in found.families]
    if not sentences:
        free = tr("Turning the tool is as free as ever.")
        sentences = [f"{_family_sentence(family)} {free}" for family in found.position_families]
    return "\n".join(sentences)


def _family_sentence(family: SingularFamily) -> str:
    return tr("{family} ({kind}): {loss}", family=family.heading, kind=family.kind_title, loss=family.sentence)


# --- what is lost ------------------------------------------------------------------------------------------------


def lost_sentence(motions: tuple[LostMotion, ...], found: Measures, robot: Robot, preferences: Preferences) -> str:
    """What the tool cannot do here, one line a motion."""
    lines = [_motion(motion, robot, preferences) for motion in motions]
    if sum(not motion.alone for motion in motions) > found.full_rank - found.rank:
        lines.append(tr("With {dof} joints one of these is always missing.", dof=robot.dof))
    return "\n".join(lines)


def _motion(motion: LostMotion, robot: Robot, preferences: Preferences) -> str:
    way = direction_text(motion.direction)
    if motion.kind == "turn":
        if motion.alone:
            return tr("Cannot turn about {axis} with the tip at rest.", axis=way)
        return tr("Cannot turn about {axis}.", axis=way)
    if motion.alone:
        return tr("Cannot move along {axis} without turning.", axis=way)
    away = float(np.linalg.norm(motion.offset))
    if away < 1e-4 * robot.size:
        return tr("Cannot move along {axis}.", axis=way)
    distance = format_quantity(away, length_kind(robot), preferences)
    return tr("Cannot move along {axis} on the dashed line, {distance} beside the tip.", axis=way, distance=distance)


def direction_text(direction: FloatArray) -> str:
    """A letter for an axis of the base, else the three numbers."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) > _ALIGNED:
        return "xyz"[axis]
    return left_to_right(f"({', '.join(format_number(float(value), 2) for value in direction)})")


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
    return tr("now {values}", values=listed([left_to_right(text) for text in shown]))


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
        parts.append(
            tr(
                "{joint} would need {needs}, but has {low} to {high}",
                joint=tr(robot.joint_names[i]),
                needs=needs,
                low=low,
                high=high,
            )
        )
    return tr("Outside the limits: {joints}.", joints=tr("; ").join(parts))


# --- ellipsoids --------------------------------------------------------------------------------------------------


class Scale(NamedTuple):
    """How large an ellipsoid is drawn: metres for one of its units, the longest half axis [m], and the unit's name."""

    factor: float
    longest: float
    unit: str


def ellipsoid_scale(robot: Robot, part: str, kind: str) -> Scale:
    """The same for all poses of an arm, so that an ellipsoid grows and shrinks as it should."""
    size, length = robot.size, "m" if robot.length_unit == "millimetre" else tr("unit")
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
    for kind in kinds:
        factor, longest, unit = ellipsoid_scale(robot, part, kind)
        drawn, cut = (_drawn(robot, value, preferences) for value in (factor, longest))
        lines.append(tr(_DRAWN_AS[kind, turning], unit=unit, drawn=drawn, cut=cut))
    return "\n".join(lines)


# By the kind of ellipsoid, and whether all joints turn.
_DRAWN_AS = {
    ("velocity", True): tr_later("Velocity for joint speeds of norm 1 rad/s: 1 {unit} is drawn as {drawn}."),
    ("velocity", False): tr_later("Velocity for joint speeds of norm 1: 1 {unit} is drawn as {drawn}."),
    ("force", True): tr_later("Force for joint torques of norm 1 N m: 1 {unit} is drawn as {drawn}, cut at {cut}."),
    ("force", False): tr_later("Force for joint torques of norm 1: 1 {unit} is drawn as {drawn}, cut at {cut}."),
}


def _drawn(robot: Robot, value: float, preferences: Preferences) -> str:
    shown = display(length_kind(robot), preferences)
    return f"{value * shown.factor:.4g}{shown.suffix}"
