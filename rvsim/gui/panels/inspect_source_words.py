"""What the sources page says: numbers with their units, how far printed and right are apart, in plain sentences."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, Kind, display, format_number, format_scientific, length_kind
from rvsim.lab.sources import Comparison, Erratum, Topic
from rvsim.language import left_to_right, listed, tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

TOPIC_TITLES: dict[Topic, str] = {
    "frames": tr_later("Frames and forward kinematics"),
    "inverse": tr_later("Inverse kinematics"),
    "jacobian": tr_later("Jacobian"),
    "singularity": tr_later("Singularities"),
    "path": tr_later("Paths and programs"),
    "dynamics": tr_later("Forces"),
    "time law": tr_later("Time law"),
}
_KINDS: dict[str, Kind] = {
    "number": "number",
    "angle": "angle",
    "lever": "length",
    "rate": "angle_speed",
    "acceleration": "angle_acceleration",
    "torque": "torque",
}
_NONE = "–"  # in the place of a number that does not exist
_TINY = 5e-4  # a plain number below this is written with its power of ten
# By whether the source's frame is elsewhere, and whether it is turned.
_DRAWN = {
    (True, True): tr_later(
        "The dashed frame in the scene is where the source puts the tool: {away} away and turned by {angle}."
    ),
    (True, False): tr_later("The dashed frame in the scene is where the source puts the tool: {away} away."),
    (False, True): tr_later("The dashed frame in the scene is where the source puts the tool: turned by {angle}."),
    (False, False): tr_later("The dashed frame in the scene is where the source puts the tool."),
}
REMARK = tr_later("A remark: there is no formula to work out.")


class Sheet(NamedTuple):
    """A small table of numbers as texts: heads of its columns and rows, cells, and which of them are wrong."""

    columns: tuple[str, ...]
    rows: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]
    wrong: NDArray[np.bool_]


class Sheets(NamedTuple):
    """A comparison as tables, each with a title; and the units in a line, where the heads do not say them."""

    sheets: tuple[tuple[str, Sheet], ...]
    units: str


Shown = Callable[[str], Display]


def nothing_known(robot: Robot) -> str:
    """What the page says of an arm without errata."""
    return tr(
        "{robot}: no formula of the sources about this arm is known to be wrong. The arms with errata are the RV-M1, "
        "the RV-1A, the UR5e, the RRRP arm and the AL5B.",
        robot=tr(robot.title),
    )


def heading(entry: Erratum) -> str:
    """Where it is in which source."""
    return tr("Source {source}, {place}", source=entry.source, place=tr(entry.where))


def full_heading(entry: Erratum) -> str:
    """Where it is, and what is wrong."""
    return tr("{place}: {erratum}", place=heading(entry), erratum=tr(entry.title))


def pose_text(entry: Erratum) -> str:
    """What going to its pose is called."""
    return tr("Pose of source {source}, {place}", source=entry.source, place=tr(entry.where))


def shown_as(robot: Robot, preferences: Preferences, *, fewer: int = 0) -> Shown:
    """How a kind of entry is shown; `fewer` decimals where the room is short."""

    @lru_cache(maxsize=len(_KINDS) + 2)
    def shown(kind: str) -> Display:
        own = length_kind(robot) if kind in ("length", "lever") else _KINDS[kind]
        found = display(own, preferences)
        return found._replace(decimals=max(found.decimals - fewer, 0))

    return shown


def unit(kind: str, shown: Shown) -> str:
    """The unit of a kind of entry, "" for a plain number."""
    suffix = shown(kind).suffix.strip()
    return f"{suffix}/rad" if kind == "lever" else suffix


def sheets(entry: Erratum, comparison: Comparison, shown: Shown) -> Sheets:
    """Printed, ours and difference: side by side for numbers and vectors, below each other for matrices."""
    return (_matrices if comparison.right.ndim == 2 else _columns)(entry, comparison, shown)


def _columns(entry: Erratum, comparison: Comparison, shown: Shown) -> Sheets:
    printed, right, gap = (np.atleast_1d(a) for a in (comparison.printed, comparison.right, comparison.difference))
    kinds, wrong = np.atleast_1d(comparison.kinds), np.atleast_1d(comparison.differs)
    names = entry.rows or ("",) * len(right)
    heads = tuple(_head(tr(name), unit(str(kind), shown)) for name, kind in zip(names, kinds, strict=True))
    cells = tuple(
        tuple(cell(float(value), str(kind), shown) for value in row)
        for *row, kind in zip(printed, right, gap, kinds, strict=True)
    )
    marks = np.column_stack([wrong, np.zeros_like(wrong), wrong])
    return Sheets((("", Sheet((tr("printed"), tr("ours"), tr("off by")), heads, cells, marks)),), "")


def _head(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _matrices(entry: Erratum, comparison: Comparison, shown: Shown) -> Sheets:
    wrong = comparison.differs
    right = np.zeros_like(wrong)
    made = (
        (tr("Printed"), _sheet(entry, comparison.printed, comparison.kinds, shown, wrong)),
        (tr("Ours"), _sheet(entry, comparison.right, comparison.kinds, shown, right)),
        (tr("Difference"), _sheet(entry, np.where(wrong, comparison.difference, 0.0), comparison.kinds, shown, wrong)),
    )
    return Sheets(made, _unit_line(entry, comparison.kinds, shown))


def _sheet(
    entry: Erratum, values: FloatArray, kinds: NDArray[np.str_], shown: Shown, wrong: NDArray[np.bool_]
) -> Sheet:
    cells = tuple(
        tuple(cell(float(value), str(kind), shown) for value, kind in zip(row, row_kinds, strict=True))
        for row, row_kinds in zip(values, kinds, strict=True)
    )
    return Sheet(tuple(map(tr, entry.columns)), tuple(map(tr, entry.rows)), cells, wrong)


def cell(value: float, kind: str, shown: Shown) -> str:
    """A value in its unit without it; a dash for what does not exist."""
    if np.isnan(value):
        return _NONE
    factor, _, decimals, _ = shown(kind)
    number = value * factor
    if kind == "number" and abs(number - round(number)) < 1e-12:
        return format_number(number, 0)
    if kind == "number" and 1e-9 < abs(number) < _TINY:
        return format_scientific(number)
    return format_number(number, decimals)


def _unit_line(entry: Erratum, kinds: NDArray[np.str_], shown: Shown) -> str:
    if entry.quantity == "transform":
        return tr("The last column is in {unit}.", unit=unit("length", shown))
    if "lever" in kinds:
        lever = unit("lever", shown)
        if len(kinds) == 6:
            return tr("Rows x to z in {unit}, the others without a unit.", unit=lever)
        return tr("In {unit}.", unit=lever)
    return ""


def verdict(entry: Erratum, comparison: Comparison, shown: Shown) -> tuple[str, str]:
    """A sentence about the difference, and its level: "error" where there is one, "good" where there is none."""
    if np.isnan(comparison.printed).any():
        return tr(entry.undefined), "error"
    if comparison.agree:
        return tr("At this pose the printed formula happens to be right."), "good"
    if comparison.right.ndim < 2:
        return "", "error"
    wrong = int(comparison.differs.sum())
    counted = trn(
        "{n} of {total} entries is wrong.", "{n} of {total} entries are wrong.", wrong, total=comparison.right.size
    )
    return f"{counted} {_worst(comparison, shown)}", "error"


def _worst(comparison: Comparison, shown: Shown) -> str:
    """The largest difference of each kind of entry."""
    parts = []
    for kind in dict.fromkeys(comparison.kinds[comparison.differs].ravel()):
        gaps = np.abs(comparison.difference[comparison.kinds == kind])
        parts.append(f"{cell(float(gaps.max()), str(kind), shown)} {unit(str(kind), shown)}".strip())
    return tr("The largest difference is {differences}.", differences=listed([left_to_right(part) for part in parts]))


def drawn_sentence(distance: float, turned: float, shown: Shown) -> str:
    """How far from the arm's own tool the source puts it [m, rad]."""
    away = f"{cell(distance, 'length', shown)} {unit('length', shown)}"
    angle = f"{cell(turned, 'angle', shown)}{shown('angle').suffix}"
    return tr(_DRAWN[distance > 1e-9, turned > 1e-9], away=away, angle=angle)
