"""How the report was made: conventions, versions, and how to work its numbers out once more."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version

import rvsim
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Items, Paragraph, Run, Section
from rvsim.language import left_to_right, listed, tr, tr_later

_ANGLES = {"deg": tr_later("degrees"), "rad": tr_later("radians")}
_LENGTHS = {"mm": tr_later("millimetres"), "m": tr_later("metres")}
_PARTS = ("numpy", "PySide6-Essentials", "ruckig", "ziamath")


def versions() -> tuple[tuple[str, str], ...]:
    """Name and version of what computed and drew."""
    known = [("rvsim", rvsim.__version__), ("Python", platform.python_version())]
    return (*known, *((part, _version(part)) for part in _PARTS))


def _version(part: str) -> str:
    try:
        return version(part)
    except PackageNotFoundError:  # in a bundle without metadata
        return tr("in the bundle")


def end_section(study: Study, files: Mapping[str, str]) -> Section:
    """Conventions; the files beside the report with what is in them; versions."""
    angles = tr(_ANGLES[study.units.angle])
    lengths = tr("the arm’s own unit") if study.robot.length_unit == "unit" else tr(_LENGTHS[study.units.length])
    conventions = (
        tr(
            "Angles are shown in {angles}, lengths in {lengths}; inside, everything is computed in radians and metres.",
            angles=angles,
            lengths=lengths,
        ),
        tr(
            "A transform with a above and b below maps coordinates of frame b to frame a; neighbours cancel in a "
            "product."
        ),
        tr("Twists and wrenches have their linear part first; the Jacobian is geometric, at the tool, in base axes."),
        tr("Roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll). Quaternions have w first, and w ≥ 0."),
    )
    names = tuple((Run(name, "code"), Run(f" – {what}")) for name, what in files.items())
    made = listed([left_to_right(f"{name} {number}") for name, number in versions()])
    return Section(
        tr("How this was computed"),
        (
            Items(conventions),
            *((Paragraph(tr("Beside this report lie:")), Items(names)) if names else ()),
            Paragraph(tr("Computed and drawn with {made}.", made=made)),
        ),
    )
