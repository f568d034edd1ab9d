"""What the sources print for a step, with this target's numbers, where it is not what is right."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from rvsim.lab.sources import printed
from rvsim.lab.worked.figures import Figures, wrapped
from rvsim.language import sentences, tr

Numbers = Mapping[str, float]
Note = Callable[[Figures, Numbers], str]


def source_note(robot: str, figures: Figures, step: str, numbers: Numbers) -> str:
    """The remark on a step of an arm, "" where its source is right or silent."""
    note = _NOTES.get((robot, step))
    return note(figures, numbers) if note else ""


def _angle(figures: Figures, value: float) -> str:
    return figures.text(wrapped(value), "angle")


def _waist_000(figures: Figures, k: Numbers) -> str:
    waist = _angle(figures, printed.waist_000(k["x"], k["y"]))
    if waist == _angle(figures, k["psi"]):
        return ""
    return tr(
        "Source 000, (10), prints atan2(x, −y), its y counted the other way round: {waist}. "
        "In the sense of the DH table it is {right}.",
        waist=waist,
        right=_angle(figures, k["psi"]),
    )


def _links_000(figures: Figures, k: Numbers) -> str:
    """θ2 of (14) and θ3 of (15), printed and right; the printed sign is the one that is right in the corrected form."""
    triangle = printed.Triangle(k["w"], k["u"], k["a2"], k["a3"])
    gamma = printed.gamma_000(triangle)
    second, third = printed.shoulder_000(triangle, k["q2"], gamma), printed.elbow_000(triangle, k["q2"])
    return sentences(
        tr(
            "Source 000, (14), prints γ = {printed}; right is {right}: α² + β² is added.",
            printed=figures.text(gamma, "length"),
            right=figures.text(printed.gamma(triangle), "length"),
        ),
        _shoulder_000(figures, second, k["q2"]),
        tr(
            "(15) has atan2's arguments exchanged: {printed}, not {right}.",
            printed=_angle(figures, third),
            right=_angle(figures, k["q3"]),
        ),
    )


def _shoulder_000(figures: Figures, printed_q2: float, q2: float) -> str:
    if math.isnan(printed_q2):
        return tr("With it the root is not real.")
    return tr(
        "With its atan2(α, β) θ₂ would be {printed}, not {right}.",
        printed=_angle(figures, printed_q2),
        right=_angle(figures, q2),
    )


def _pitch_000(figures: Figures, k: Numbers) -> str:
    fourth = k["phi"] - k["q2"] - k["q3"]
    wrist, right = _angle(figures, fourth), _angle(figures, fourth + 0.5 * math.pi)
    return tr(
        "Source 000, (16) and (17), call the sum φ but mean the DH angle, which is the joint's plus {quarter_turn}: "
        "with the pitch as φ it would give {wrist} where the DH angle is {right}.",
        quarter_turn="90°" if figures.in_degrees else "π/2",
        wrist=wrist,
        right=right,
    )


def _centre_001(figures: Figures, k: Numbers) -> str:
    return tr(
        "Source 001, (5), prints P6 = P5 = P4. Only P5 = P4 holds; P6 is {distance} away from them.",
        distance=figures.text(k["d6"], "length"),
    )


def _wrist_004(figures: Figures, k: Numbers) -> str:
    c, s = math.cos(k["phi"]), math.sin(k["phi"])
    height = printed.wrist_height_004(k["z"], k["d1"], k["d5"], k["phi"])
    text = figures.text
    note = tr(
        "Source 004, (3.26), prints d₅ cos ψ where d₅ sin ψ belongs (its ψ is our φ): the height would be "
        "{printed}, not {right}.",
        printed=text(height, "length"),
        right=text(k["z"] - k["d1"] - k["d5"] * s, "length"),
    )
    if k["rho"] ** 2 < k["d5"] * c:
        root = tr("(3.29) draws the root over x² + y² − d₅ cos ψ (here negative); it ends before − d₅ cos ψ.")
    else:
        root = tr("(3.29) draws the root over x² + y² − d₅ cos ψ; it ends before − d₅ cos ψ.")
    return sentences(note, root)


def _links_004(figures: Figures, k: Numbers) -> str:
    square = k["u"] ** 2 + k["w"] ** 2
    upper, fore = k["a2"], k["a3"]
    ratio = (square + upper * upper - fore * fore) / (2.0 * upper * math.sqrt(square))
    beta = math.acos(max(-1.0, min(1.0, ratio)))
    third = printed.elbow_004(square, upper, fore)
    return tr(
        "Source 004, (3.22), prints β = atan2(s² + a₃² − a₄², 2a₃s) = {printed_beta}; right is the arccos of their "
        "ratio, {right_beta}. (3.23) in the same way prints θ₃ = {printed_theta}, not {right_theta}.",
        printed_beta=_angle(figures, printed.beta_004(square, upper, fore)),
        right_beta=_angle(figures, beta),
        printed_theta=_angle(figures, third),
        right_theta=_angle(figures, k["q3"]),
    )


def _waist_003(figures: Figures, k: Numbers) -> str:
    waist = printed.waist_003(k["px"], k["py"])
    if math.isnan(waist) or _angle(figures, waist) == _angle(figures, k["psi"]):
        return ""
    return tr(
        "Source 003 prints θ₁ = arctan(Py/Px) = {printed}; it must be atan2(Py−l₂, Px−l₁) = {right}, as its program "
        "has it.",
        printed=_angle(figures, waist),
        right=_angle(figures, k["psi"]),
    )


def _roll_003(figures: Figures, k: Numbers) -> str:
    """The program feeds θ1 in radians to cosd and sind."""
    roll = _angle(figures, printed.roll_003(k["q1"], printed.Hand(k["nx"], k["ny"], k["ox"], k["oy"])))
    if roll == _angle(figures, k["q3"]):
        return ""
    return tr(
        "Source 003's program takes cosd and sind of a θ₁ in radians: its θ₃ would be {printed}, not {right}.",
        printed=roll,
        right=_angle(figures, k["q3"]),
    )


def _extension_003(figures: Figures, k: Numbers) -> str:
    extension = printed.extension_003(k["w"], k["q2"], k["a2"], k["d3"])
    if math.isnan(extension):
        return tr("Source 003 divides by C₂, which is 0 here; along the tool axis nothing is divided.")
    value = figures.text(extension, "length")
    return tr("Source 003 prints l₆ = (w − l₅S₂)/C₂ − l₇ = {value}: right as long as C₂ is not 0.", value=value)


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
