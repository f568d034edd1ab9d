"""What the Jacobian page says: rows and units of each kind of Jacobian, and a column's identity with its numbers."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from rvsim.gui.panels.inspect_jacobian_table import Column, Row
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, length_kind
from rvsim.kinematics import jacobian, link_transforms
from rvsim.kinematics.differences import Rows
from rvsim.kinematics.rates import analytic_jacobian, tool_jacobian
from rvsim.lab.worked import Equation
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.jacobian_column import frame_of_joint
from rvsim.scene.points import joint_axes

_MOST_DECIMALS = 3  # six columns stand side by side


class JacobianKind(NamedTuple):
    """A kind of Jacobian: its title, the names of its rows, and what it is in a sentence."""

    title: str
    names: tuple[str, ...]
    meaning: str


_LINEAR = ("vx", "vy", "vz")
_TURNS = ("ωx", "ωy", "ωz")
KINDS: dict[Rows, JacobianKind] = {
    "base": JacobianKind(
        tr_later("Base axes"), (*_LINEAR, *_TURNS), tr_later("Geometric: v and ω of the tool in the base's axes.")
    ),
    "tool": JacobianKind(
        tr_later("Tool axes"), (*_LINEAR, *_TURNS), tr_later("Geometric: v and ω of the tool in its own axes.")
    ),
    "rpy": JacobianKind(
        tr_later("RPY rates"),
        ("ẋ", "ẏ", "ż", tr_later("roll′"), tr_later("pitch′"), tr_later("yaw′")),
        tr_later("Analytic: how fast position, roll, pitch and yaw change."),
    ),
    "zyz": JacobianKind(
        tr_later("ZYZ rates"),
        ("ẋ", "ẏ", "ż", "φ′", "θ′", "ψ′"),
        tr_later("Analytic: how fast position and the ZYZ angles change."),
    ),
}
FORMULAS: dict[Rows, Callable[[Robot, FloatArray], FloatArray]] = {
    "base": jacobian,
    "tool": tool_jacobian,
    "rpy": partial(analytic_jacobian, angles="rpy"),
    "zyz": partial(analytic_jacobian, angles="zyz"),
}
_LOCKED = {
    "rpy": tr_later("At pitch ±90° roll and yaw have no rates: the notation is singular there, not the arm."),
    "zyz": tr_later("At θ = 0° or 180° φ and ψ have no rates: the notation is singular there, not the arm."),
}


def meaning(kind: Rows, J: FloatArray) -> str:
    """What these rows are, and why some of them are missing."""
    return tr(_LOCKED[kind] if np.isnan(J).any() else KINDS[kind].meaning)


def length_factor(robot: Robot, preferences: Preferences) -> tuple[float, str, int]:
    """Shown lengths a metre, their unit, and the decimals for which there is room."""
    shown = display(length_kind(robot), preferences)
    return shown.factor, shown.suffix.strip(), min(shown.decimals, _MOST_DECIMALS)


def table_rows(kind: Rows, robot: Robot, preferences: Preferences) -> tuple[Row, ...]:
    """The six rows."""
    _, unit, decimals = length_factor(robot, preferences)
    words = [tr("speed of the tool's origin [{unit}/s per joint speed]", unit=unit)] * 3 + [
        tr("turning [rad/s per joint speed]")
    ] * 3
    places = [decimals] * 3 + [_MOST_DECIMALS] * 3
    return tuple(
        Row(tr(name), f"{tr(name)}: {text}", count, block)
        for name, text, count, block in zip(KINDS[kind].names, words, places, (0, 0, 0, 1, 1, 1), strict=True)
    )


def table_columns(robot: Robot) -> tuple[Column, ...]:
    """One a joint."""
    return tuple(Column(f"J{i}", f"J{i} {tr(joint.name)}", joint.color) for i, joint in enumerate(robot.joints, 1))


def shown_values(J: FloatArray, robot: Robot, preferences: Preferences) -> FloatArray:
    """J (6, n) in the units that are shown; a sliding joint's columns have a length on both sides."""
    factor = length_factor(robot, preferences)[0]
    values = np.array(J)
    values[:3, robot.is_revolute] *= factor
    values[3:, ~robot.is_revolute] /= factor
    return values


def entry_units(robot: Robot, preferences: Preferences) -> list[list[str]]:
    """(6, n) the unit of each entry."""
    unit = length_factor(robot, preferences)[1]
    linear = [f"{unit}/rad" if turns else f"{unit}/{unit}" for turns in robot.is_revolute]
    angular = ["rad/rad" if turns else f"rad/{unit}" for turns in robot.is_revolute]
    return [linear] * 3 + [angular] * 3


def units_line(robot: Robot, preferences: Preferences) -> str:
    """The units in a line below the table."""
    return tr(_units_template(robot), unit=length_factor(robot, preferences)[1])


def plain_units_line(robot: Robot, preferences: Preferences) -> str:
    """The same in English, for what is copied."""
    return _units_template(robot).format(unit=length_factor(robot, preferences)[1])


def _units_template(robot: Robot) -> str:
    if robot.is_revolute.all():
        return tr_later("{unit} per rad in the upper rows, rad per rad in the lower ones.")
    if robot.is_revolute.any():
        return tr_later(
            "{unit} per rad in the upper rows, rad per rad in the lower ones; sliding joints: {unit} per {unit}."
        )
    return tr_later("Sliding joints: {unit} per {unit}.")


def check_line(difference: float, rows: Rows) -> str:
    """How far the formulas are from differences of the forward kinematics [m, rad]."""
    if np.isnan(difference):
        return ""
    error = format_error(difference)
    if rows in _LOCKED:
        return tr(
            "Checked by differences of the angles of the forward kinematics: largest difference {error}.", error=error
        )
    return tr("Checked by differences of the forward kinematics: largest difference {error}.", error=error)


def format_error(value: float) -> str:
    """A residual as it stands in a sentence."""
    return f"{value:.1e}".replace("-", "\u2212")


# --- one column ------------------------------------------------------------------------------------------------------


def column_equations(
    robot: Robot, q: FloatArray, joint: int, kind: Rows, J: FloatArray, preferences: Preferences
) -> tuple[Equation, ...]:
    """The identity of a column with the present numbers, in the axes that are shown."""
    T = link_transforms(robot, q)
    tool = T[-1] @ robot.T_flange_tool
    frame, z = frame_of_joint(robot, joint), joint_axes(robot, T)[joint]
    arm = tool[:3, 3] - T[frame, :3, 3]
    if kind == "tool":
        z, arm = z @ tool[:3, :3], arm @ tool[:3, :3]
    factor, _, decimals = length_factor(robot, preferences)
    axis = column_vector(z, _MOST_DECIMALS)
    if not robot.joints[joint].revolute:
        return (
            Equation(f"J_{{{joint + 1}}}", _stacked(f"z_{{{frame}}}", "0"), "", ""),
            Equation(f"z_{{{frame}}}", "", "", axis),
        )
    cross = f"z_{{{frame}}}\\times (p-o_{{{frame}}})"
    lines = [
        Equation(f"J_{{{joint + 1}}}", _stacked(cross, _lower(kind, frame)), "", ""),
        Equation(
            cross,
            "",
            f"{axis}\\times {column_vector(factor * arm, decimals)}",
            column_vector(factor * np.cross(z, arm), decimals),
        ),
    ]
    if kind in ("rpy", "zyz"):
        lines.append(Equation(_lower(kind, frame), "", "", column_vector(J[3:, joint], _MOST_DECIMALS)))
    return tuple(lines)


def whole_equations(
    robot: Robot, q: FloatArray, kind: Rows, J: FloatArray, preferences: Preferences
) -> tuple[Equation, ...]:
    """J's definition for this arm, column by column, each with the present numbers."""
    columns = "\\ ".join(f"J_{{{joint + 1}}}" for joint in range(robot.dof))
    each = (column_equations(robot, q, joint, kind, J, preferences) for joint in range(robot.dof))
    return (Equation("J", f"[{columns}]", "", ""), *(line for lines in each for line in lines))


def column_title(robot: Robot, joint: int) -> str:
    """Above the identity."""
    name, number = robot.joint_names[joint], joint + 1
    if name == f"J{number}":
        return tr("Column J{number}", number=number)
    return tr("Column J{number}, {joint}", number=number, joint=tr(name))


def column_note(robot: Robot, joint: int, kind: Rows, preferences: Preferences) -> str:
    """What the letters are."""
    frame, unit = frame_of_joint(robot, joint), length_factor(robot, preferences)[1]
    if not robot.joints[joint].revolute:
        return tr(
            "{z}: the way of the sliding joint. It moves the tool along, and does not turn it.", z=f"z{_sub(frame)}"
        )
    letters = {"z": f"z{_sub(frame)}", "o": f"o{_sub(frame)}", "unit": unit}
    if kind == "tool":
        return tr("{z}: the joint's axis; {o}: a point on it; p: the tool. Lengths in {unit}, tool axes.", **letters)
    note = tr("{z}: the joint's axis; {o}: a point on it; p: the tool. Lengths in {unit}, base axes.", **letters)
    return f"{note} {tr('B⁻¹ turns ω into the rates of the angles.')}" if kind in ("rpy", "zyz") else note


def speed_text(robot: Robot, q: FloatArray, joint: int, preferences: Preferences) -> str:
    """How fast the tool moves for one of the joint: the label in the scene."""
    factor, unit, decimals = length_factor(robot, preferences)
    length = float(np.linalg.norm(jacobian(robot, q)[:3, joint]))
    if robot.joints[joint].revolute:
        return f"{format_number(factor * length, decimals)} {unit}/rad"
    return f"{format_number(length, decimals)} {unit}/{unit}"


def _sub(number: int) -> str:
    return str(number).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


def _lower(kind: Rows, frame: int) -> str:
    return f"B^{{-1}} z_{{{frame}}}" if kind in ("rpy", "zyz") else f"z_{{{frame}}}"


def _stacked(*entries: str) -> str:
    return "\\begin{bmatrix}" + " \\\\ ".join(entries) + "\\end{bmatrix}"


def column_vector(values: FloatArray, decimals: int) -> str:
    """A column whose digits have fixed places: another pose is the same shape, and needs not to be set anew."""
    texts = ["–" if np.isnan(value) else f"{abs(value):.{decimals}f}" for value in values.tolist()]
    width = max(map(len, texts))
    cells = [_padded(text, value, width) for text, value in zip(texts, values.tolist(), strict=True)]
    return _stacked(*cells)


def _padded(digits: str, value: float, width: int) -> str:
    sign = "{-}" if value < 0.0 and float(digits) != 0.0 else "\\phantom{-}"
    return sign + "\\phantom{0}" * (width - len(digits)) + digits
