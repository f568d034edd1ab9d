"""The numbers of the sources once more: what is printed, what the printed formula gives, and what is right."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from rvsim.files import load_robot
from rvsim.lab.sources.claim import Claim
from rvsim.lab.sources.claims import other_claims
from rvsim.lab.sources.claims_000 import claims_000
from rvsim.lab.sources.collection import errata
from rvsim.lab.sources.erratum import Comparison, Erratum
from rvsim.lab.sources.experiments import keys_in_order
from rvsim.lab.sources.figures import Numbers, as_numbers, pose_text, shown_value, unit_of
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot.arrays import FloatArray

_SAME = 1e-6  # in the units that are printed


class Reproduction(NamedTuple):
    """One number (or several) of a source; angles in degrees, lengths in mm (units), as the item says.

    Args:
        source, item: "000", and the place with what it is, its unit and the pose, in the language that is spoken.
        printed: the number in the source, None where it prints a formula only.
        formula: what the printed formula or program gives, None where there is none.
        ours: what is right.
        verdict: in a word or two, in English: a key of `VERDICTS`.
    """

    source: str
    item: str
    printed: Numbers | None
    formula: Numbers | None
    ours: Numbers
    verdict: str


class _Pick(NamedTuple):
    """Which number of a matrix tells the fault; its name is in English."""

    name: str
    unit: str
    of: Callable[[FloatArray], float | FloatArray]


_PLACE = _Pick(tr_later("tool's place"), "mm", lambda T: 1e3 * T[:3, 3])
_DETERMINANT = _Pick(tr_later("determinant"), "", lambda T: float(np.linalg.det(T)))
_RANK = _Pick(tr_later("rank"), "", lambda J: float(np.linalg.matrix_rank(J)) if np.isfinite(J).all() else np.nan)
_PICKS = {
    "000-3": _PLACE,
    "000-2": _PLACE._replace(name=tr_later("origin")),
    "000-4": _DETERMINANT,
    "000-8": _PLACE,
    "000-9": _PLACE,
    "000-21": _Pick(tr_later("column 4, linear"), "mm/rad", lambda J: 1e3 * J[:3, 3]),
    "000-22": _RANK,
    "001-3": _PLACE._replace(name=tr_later("origin")),
    "002-R": _Pick("e12, e22", "", lambda R: R[:2, 1]),
    "002-J": _Pick(tr_later("column 2"), "mm/rad", lambda J: 1e3 * J[:, 1]),
    "004-2.2": _Pick(tr_later("entry [2, 4]"), "mm", lambda A: 1e3 * A[1, 3]),
    "004-3.8": _DETERMINANT,
    "004-3.12": _DETERMINANT,
    "004-3.13": _Pick(tr_later("entry [1, 1]"), "", lambda A: float(A[0, 0])),
    "004-3.15": _DETERMINANT,
    "004-4.7": _RANK,
    "004-4.11": _Pick(tr_later("J1, linear"), "mm/rad", lambda column: 1e3 * column[:3]),
    "004-4.15": _Pick(tr_later("J5, linear"), "mm/rad", lambda column: 1e3 * column[:3]),
}
# The numbers that the sources print themselves, where they belong to a formula of the list.
_PRINTED: dict[str, Numbers] = {"000-P6": 0.0, "002-rms": 1.0}
_WITHOUT_POSE = ("002-target", "002-rms")
_AMONG_CLAIMS = ("002-spacing", "002-ik")


class KeyedReproduction(NamedTuple):
    """A row, and the key of the experiment or erratum that it belongs to."""

    key: str
    row: Reproduction


def reproduce() -> tuple[Reproduction, ...]:
    """Every number, worked out now (about a second): source by source, in the order of `experiments()`."""
    return tuple(keyed.row for keyed in reproduce_by_key())


def reproduce_by_key() -> tuple[KeyedReproduction, ...]:
    """The same with keys."""
    *_, rows = reproduction_parts()
    assert isinstance(rows, tuple)
    return rows


def reproduction_parts() -> Iterator[float | tuple[KeyedReproduction, ...]]:
    """The same step by step: the share that is done, 0…1, and last all rows. Whoever stops asking stops the work."""
    makers = _makers()
    rows: list[KeyedReproduction] = []
    for done, make in enumerate(makers, start=1):
        rows += make()
        yield done / len(makers)
    place = {key: number for number, key in enumerate(keys_in_order())}
    yield tuple(sorted(rows, key=lambda keyed: place[keyed.key]))


def _makers() -> list[Callable[[], list[KeyedReproduction]]]:
    of_errata = [partial(_keyed_erratum, entry) for entry in errata() if _has_numbers(entry)]
    return [*of_errata, *(partial(_keyed_claims, make) for make in (*claims_000(), *other_claims()))]


def _keyed_erratum(entry: Erratum) -> list[KeyedReproduction]:
    return [KeyedReproduction(entry.key, _of_erratum(entry))]


def _keyed_claims(make: Callable[[], tuple[Claim, ...]]) -> list[KeyedReproduction]:
    return [KeyedReproduction(claim.key, Reproduction(*claim[1:])) for claim in make()]


def _has_numbers(entry: Erratum) -> bool:
    return entry.printed is not None and entry.key not in _AMONG_CLAIMS


def reproduction_text(rows: tuple[Reproduction, ...]) -> str:
    """All rows for people: the item, and below it the numbers and the verdict."""
    return "\n".join(_paragraph(row) for row in rows)


def _paragraph(row: Reproduction) -> str:
    values = ((tr("printed"), row.printed), (tr("its formula"), row.formula), (tr("ours"), row.ours))
    numbers = "   ".join(f"{name} {left_to_right(shown_value(value))}" for name, value in values if value is not None)
    return f"{row.source}  {row.item}\n     {numbers}   {tr(row.verdict)}"


# What an item says, with and without a unit and a pose.
_ITEMS = {
    (True, True): tr_later("{where}: {what} [{unit}] at {pose}"),
    (True, False): tr_later("{where}: {what} [{unit}]"),
    (False, True): tr_later("{where}: {what} at {pose}"),
    (False, False): tr_later("{where}: {what}"),
}


def _of_erratum(entry: Erratum) -> Reproduction:
    robot = load_robot(entry.robot)
    comparison = entry.compare(robot, entry.pose)
    assert comparison is not None  # only those with numbers are asked
    name, unit, printed, right = _picked(entry, comparison)
    pose = "" if entry.key in _WITHOUT_POSE else pose_text(robot, entry.pose)
    text = _ITEMS[bool(unit), bool(pose)]
    item = tr(text, where=tr(entry.where), what=name, unit=unit, pose=pose)
    claimed, formula, ours = _PRINTED.get(entry.key), as_numbers(printed), as_numbers(right)
    verdict = _verdict(printed, right) if claimed is None else "contradiction"
    return Reproduction(entry.source, item, claimed, formula, ours, verdict)


def _picked(entry: Erratum, comparison: Comparison) -> tuple[str, str, FloatArray, FloatArray]:
    """What is shown of a comparison: its name, its unit, and the two values in that unit."""
    if entry.key in _PICKS:
        name, unit, of = _PICKS[entry.key]
        return tr(name), unit, np.asarray(of(comparison.printed)), np.asarray(of(comparison.right))
    unit, factor = unit_of(load_robot(entry.robot), str(comparison.kinds.flat[0]))
    return (
        _names(entry.rows) if entry.rows else tr(entry.title),
        unit,
        comparison.printed * factor,
        comparison.right * factor,
    )


def _names(rows: tuple[str, ...]) -> str:
    """The names of several entries; one text in another, so that all of it can be said in English too."""
    if len(rows) < 2:
        return tr("".join(rows))
    return tr("{others}, {last}", others=_names(rows[:-1]), last=tr(rows[-1]))


def _verdict(formula: FloatArray, ours: FloatArray) -> str:
    if np.isnan(formula).all():
        return "undefined"
    return "confirmed" if np.allclose(formula, ours, rtol=0.0, atol=_SAME) else "misprint"
