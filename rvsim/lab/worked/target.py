"""The first step of all: the pose that is wanted."""

from __future__ import annotations

import numpy as np

from rvsim.lab.worked.figures import Kind, Quantity
from rvsim.lab.worked.notebook import Notebook
from rvsim.language import sentences, tr, tr_later
from rvsim.spatial.arrays import FloatArray

_COLUMNS: tuple[Kind, ...] = ("number", "number", "number", "length")
_AXES = "xyz"
_TAKEN_OFF = {
    ("base",): tr_later("The arm's base transform is taken off first."),
    ("tool",): tr_later("The arm's tool transform is taken off first."),
    ("base", "tool"): tr_later("The arm's base and tool transforms are taken off first."),
}


def write_target(book: Notebook, S: FloatArray, *, flange: bool = True, base: bool = False) -> None:
    """The pose (4, 4) that is to be reached: of the last frame, or of the tool; in frame 0, or in the base's."""
    rows, n = book.rows, book.rows.robot.dof
    off = [name for name, T in (("base", rows.T_base_0), ("tool", rows.T_n_tool)) if not _is_identity(T)]
    off = [name for name in off if not (name == "tool" and not flange) and not (name == "base" and base)]
    if base:
        text = tr("The wanted pose of the tool in the base frame, with its columns n, o, a and p.")
    elif flange:
        text = tr("The wanted pose of frame {n} in frame 0, with its columns n, o, a and p.", n=n)
    else:
        text = tr("The wanted pose of the tool in frame 0, with its columns n, o, a and p.")
    if off:
        text = sentences(text, tr(_TAKEN_OFF[tuple(off)]))
    name = f"{{}}^{'b' if base else '0'}T_{n if flange else 't'}"
    formula = "\\begin{bmatrix} n & o & a & p \\end{bmatrix}"
    book.step((), tr("The target"), text, book.figures.matrix(name, formula, S[:3], _COLUMNS))


def place(S: FloatArray, mark: str = "") -> tuple[Quantity, Quantity, Quantity]:
    """The coordinates x, y, z of a pose's origin, with an index if wanted."""
    x, y, z = (Quantity(f"{axis}_{mark}" if mark else axis, float(v)) for axis, v in zip(_AXES, S[:3, 3], strict=True))
    return x, y, z


def column(S: FloatArray, name: str) -> tuple[Quantity, Quantity, Quantity]:
    """The components of column n, o or a of a pose."""
    values = S[:3, "noa".index(name)]
    x, y, z = (Quantity(f"{name}_{axis}", float(v), "number") for axis, v in zip(_AXES, values, strict=True))
    return x, y, z


def _is_identity(T: FloatArray) -> bool:
    return bool(np.allclose(T, np.eye(4), atol=1e-12))
