"""What the sources print for a step, with this target's numbers, where it is not what is right."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from rvsim.lab.worked.figures import Figures, wrapped

Numbers = Mapping[str, float]
Note = Callable[[Figures, Numbers], str]


def source_note(robot: str, figures: Figures, step: str, numbers: Numbers) -> str:
    """The remark on a step of an arm, "" where its source is right or silent."""
    note = _NOTES.get((robot, step))
    return note(figures, numbers) if note else ""


def _angle(figures: Figures, value: float) -> str:
    return figures.text(wrapped(value), "angle")


def _waist_000(figures: Figures, k: Numbers) -> str:
    printed = _angle(figures, math.atan2(k["x"], k["y"]))
    if printed == _angle(figures, k["psi"]):
        return ""
    return (
        f"Source 000, (10), prints atan2(x, −y), its y counted the other way round: {printed}. "
        f"In the sense of the DH table it is {_angle(figures, k['psi'])}."
    )


def _links_000(figures: Figures, k: Numbers) -> str:
    """θ2 of (14) and θ3 of (15), printed and right; the printed sign is the one that is right in the corrected form."""
    a2, a3, alpha, beta = k["a2"], k["a3"], k["w"], k["u"]
    square = alpha * alpha + beta * beta
    right, printed = ((a2 * a2 - a3 * a3 + sign * square) / (2.0 * a2) for sign in (1.0, -1.0))
    third = math.atan2(beta - a2 * math.cos(k["q2"]), alpha - a2 * math.sin(k["q2"])) - k["q2"]
    root = square - printed * printed
    text = (
        f"Source 000, (14), prints γ = {figures.text(printed, 'length')}; right is {figures.text(right, 'length')}: "
        "α² + β² is added. "
    )
    if root >= 0.0:
        sign = _sign_of(k["q2"], right, math.sqrt(max(square - right * right, 0.0)), math.atan2(beta, alpha))
        second = math.atan2(printed, sign * math.sqrt(root)) - math.atan2(alpha, beta)
        text += f"With its atan2(α, β) θ₂ would be {_angle(figures, second)}, not {_angle(figures, k['q2'])}. "
    else:
        text += "With it the root is not real. "
    return text + f"(15) has atan2's arguments exchanged: {_angle(figures, third)}, not {_angle(figures, k['q3'])}."


def _sign_of(q2: float, gamma: float, root: float, turn: float) -> float:
    """Which sign of the root gives q2 in the corrected (14)."""
    errors = {sign: abs(wrapped(math.atan2(gamma, sign * root) - turn - q2)) for sign in (1.0, -1.0)}
    return min(errors, key=lambda sign: errors[sign])


def _pitch_000(figures: Figures, k: Numbers) -> str:
    fourth = k["phi"] - k["q2"] - k["q3"]
    printed, right = _angle(figures, fourth), _angle(figures, fourth + 0.5 * math.pi)
    return (
        "Source 000, (16) and (17), call the sum φ but mean the DH angle, which is the joint's plus 90°: with the "
        f"pitch as φ it would give {printed} where the DH angle is {right}."
    )


def _centre_001(figures: Figures, k: Numbers) -> str:
    return (
        "Source 001, (5), prints P6 = P5 = P4. Only P5 = P4 holds; P6 is "
        f"{figures.text(k['d6'], 'length')} away from them."
    )


def _wrist_004(figures: Figures, k: Numbers) -> str:
    c, s = math.cos(k["phi"]), math.sin(k["phi"])
    printed = k["z"] - k["d1"] - k["d5"] * c
    text = figures.text
    note = (
        f"Source 004, (3.26), prints d₅ cos ψ where d₅ sin ψ belongs (its ψ is our φ): the height would be "
        f"{text(printed, 'length')}, not {text(k['z'] - k['d1'] - k['d5'] * s, 'length')}."
    )
    negative = " (here negative)" if k["rho"] ** 2 < k["d5"] * c else ""
    return f"{note} (3.29) draws the root over x² + y² − d₅ cos ψ{negative}; it ends before − d₅ cos ψ."


def _links_004(figures: Figures, k: Numbers) -> str:
    square = k["u"] ** 2 + k["w"] ** 2
    s = math.sqrt(square)
    top, bottom = square + k["a2"] ** 2 - k["a3"] ** 2, 2.0 * k["a2"] * s
    beta = math.acos(max(-1.0, min(1.0, top / bottom)))
    third = math.atan2(square - k["a2"] ** 2 - k["a3"] ** 2, 2.0 * k["a2"] * k["a3"])
    printed = _angle(figures, math.atan2(top, bottom))
    return (
        f"Source 004, (3.22), prints β = atan2(s² + a₃² − a₄², 2a₃s) = {printed}; right is the arccos of their ratio, "
        f"{_angle(figures, beta)}. (3.23) in the same way prints θ₃ = {_angle(figures, third)}, "
        f"not {_angle(figures, k['q3'])}."
    )


def _waist_003(figures: Figures, k: Numbers) -> str:
    if not k["px"]:
        return ""
    printed = _angle(figures, math.atan(k["py"] / k["px"]))
    if printed == _angle(figures, k["psi"]):
        return ""
    return (
        f"Source 003 prints θ₁ = arctan(Py/Px) = {printed}; it must be atan2(Py−l₂, Px−l₁) = "
        f"{_angle(figures, k['psi'])}, as its program has it."
    )


def _roll_003(figures: Figures, k: Numbers) -> str:
    """The program feeds θ1 in radians to cosd and sind."""
    c, s = (f(math.radians(k["q1"])) for f in (math.cos, math.sin))
    printed = _angle(figures, math.atan2(s * k["nx"] - c * k["ny"], s * k["ox"] - c * k["oy"]))
    if printed == _angle(figures, k["q3"]):
        return ""
    return (
        f"Source 003's program takes cosd and sind of a θ₁ in radians: its θ₃ would be {printed}, "
        f"not {_angle(figures, k['q3'])}."
    )


def _extension_003(figures: Figures, k: Numbers) -> str:
    c, s = math.cos(k["q2"]), math.sin(k["q2"])
    if abs(c) < 1e-6:
        return "Source 003 divides by C₂, which is 0 here; along the tool axis nothing is divided."
    printed = (k["w"] - k["a2"] * s) / c - k["d3"]
    return (
        f"Source 003 prints l₆ = (w − l₅S₂)/C₂ − l₇ = {figures.text(printed, 'length')}: right as long as C₂ is not 0."
    )


_NOTES: dict[tuple[str, str], Note] = {
    ("rv-m1", "waist"): _waist_000,
    ("rv-m1", "links"): _links_000,
    ("rv-m1", "pitch"): _pitch_000,
    ("rv-1a", "centre"): _centre_001,
    ("rrrp", "waist"): _waist_003,
    ("rrrp", "roll"): _roll_003,
    ("rrrp", "extension"): _extension_003,
    ("al5b", "wrist"): _wrist_004,
    ("al5b", "links"): _links_004,
}
