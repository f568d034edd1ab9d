"""What the Dynamics page says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_number, format_quantity
from rvsim.lab.worked import Equation
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# [m/s²] at the surface: standard gravity, and the equatorial values of the planetary fact sheets.
PLACES: Mapping[str, str] = {
    "9.80665": tr_later("Earth"),
    "1.62": tr_later("Moon"),
    "3.71": tr_later("Mars"),
    "0.0": tr_later("none"),
}
_LARGE_ARM = 0.5  # [kg m²]


def rates_note(time: float | None) -> str:
    """Where the rates come from."""
    if time is None:
        return tr("Type rates, or play a motion: then they are the motion's own.")
    return tr("From the motion, {time} s after its start.", time=format_number(time, 2))


def energy_text(kinetic: float, potential: float, power: float, preferences: Preferences) -> str:
    """Both energies and the power of the drives."""
    T, V = (format_quantity(value, "energy", preferences) for value in (kinetic, potential))
    decimals = 2 + preferences["extra_decimals"]
    return tr(
        "Kinetic {kinetic}, potential {potential}, power of the drives {power} W.",
        kinetic=T,
        potential=V,
        power=format_number(power, decimals),
    )


def no_mass_text(robot: Robot) -> str:
    """The empty state."""
    return tr(
        "No mass data: no source says what the links of the {robot} weigh, so nothing can be said about its "
        "dynamics. Type masses below, or start with a guess: the arm becomes a copy of your own, which can be saved.",
        robot=tr(robot.title),
    )


def mass_note(robot: Robot) -> str:
    """What the tables hold, where it comes from, how it is changed."""
    parts = [tr("Centre of mass and moments in the link's DH frame.")]
    if robot.length_unit == "unit":
        parts.append(tr("One unit counts as one metre."))
    if any(link.assumed for link in robot.masses):
        parts.append(tr("Italic: assumed."))
    parts += _unsaid_note(robot)
    sources = dict.fromkeys(tr(link.source) for link in robot.masses if link.source)
    if sources:
        parts.append(tr("Source: {sources}.", sources=tr("; ").join(sources)))
    return " ".join([*parts, tr("Double-click a number to change it: the arm follows on a copy of your own.")])


def _unsaid_note(robot: Robot) -> list[str]:
    """Which moments the source leaves out, and what that makes of the mass matrix."""
    silent = [not link.assumed and bool(link.source) and not link.inertia.any() for link in robot.masses]
    if not any(silent):
        return []
    others = [f"{number}" for number, unsaid in enumerate(silent, start=1) if not unsaid]
    if not others:
        return [tr("\u2013: not in the source, taken as 0; the mass matrix is that of point masses.")]
    return [
        tr(
            "\u2013: not in the source, taken as 0; the mass matrix is that of point masses but for link {links}.",
            links=", ".join(others),
        )
    ]


def torques_title(units: Sequence[str]) -> str:
    """With the unit that all joints share; else it stands at the sums."""
    return tr("Joint torques, {unit}", unit=units[0]) if len(set(units)) == 1 else tr("Joint torques")


def matrix_note(robot: Robot) -> str:
    """Its units, and what it is for."""
    units = (
        tr("In kg m².")
        if robot.is_revolute.all()
        else tr("In kg m² between turning joints, kg between sliding ones, else kg m.")
    )
    return f"{units} {tr('Kinetic energy: ½ vᵀ M v, v the joint velocities.')}"


def matrix_decimals(robot: Robot) -> int:
    """A small arm's entries are small: as many as show the inertia of its wrist."""
    stretched = sum(link.mass for link in robot.masses) * robot.size**2
    return 4 if stretched > _LARGE_ARM else 5


def matrix_equation(M: FloatArray, decimals: int) -> Equation:
    """M(q) with its numbers, SI."""
    rows = (" & ".join(_entry(value, decimals) for value in row) for row in M.tolist())
    return Equation("M(q)", "", "", "\\begin{bmatrix} " + " \\\\ ".join(rows) + " \\end{bmatrix}")


def _entry(value: float, decimals: int) -> str:
    text = f"{abs(value):.{decimals}f}"
    sign = "{-}" if value < 0.0 and float(text) != 0.0 else "\\phantom{-}"
    return sign + text
