"""A pose as a pasted text: 4 × 4, 3 × 4, 3 × 3 and a position, or a rotation alone; NumPy, MATLAB, LaTeX or plain."""

from __future__ import annotations

import re

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from rvsim.errors import PoseError
from rvsim.gui.text_box import TextBox
from rvsim.gui.theme import set_role
from rvsim.language import tr, trn
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import nearest_rotation

_LONGEST = 20_000  # characters: more than any matrix has, and a clipboard may hold a whole book
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_ROTATION = 1e-2  # a rotation that far from orthogonal is a mistake, not rounding
_LENGTHS = re.compile(r"(?:lengths? in|radians and)\s+(mm|millimet\w+|m|met\w+|unit)\b")
_VECTOR = re.compile(r"^\s*([noap])\s*=\s*(.+)$", re.MULTILINE)
_EXAMPLE = "1 0 0 300\n0 −1 0 0\n0 0 −1 150\n0 0 0 1"


def pose_from_text(text: str, T: FloatArray, factor: float) -> FloatArray:
    """The pose (4, 4) [m] that a text means.

    Args:
        text: rows on lines of their own, or separated by ";", "]," or "\\\\"; what our own Copy makes is understood.
        T: (4, 4) the pose whose position is kept if the text is a rotation alone.
        factor: metres · factor is what a number means, where the text does not say its unit.

    Raises:
        PoseError: the text is no pose; the message says what was found.
    """
    said = _LENGTHS.search(text)
    if said is not None:
        factor = 1e3 if said[1].startswith(("mm", "milli")) else 1.0
    named = dict(_VECTOR.findall(text.replace("\u2212", "-")))
    pose = _assembled(_columns(named) if set(named) == set("noap") else _rows(text), T, factor)
    astray = float(np.abs(pose[:3, :3].T @ pose[:3, :3] - np.eye(3)).max())
    if astray > _ROTATION or np.linalg.det(pose[:3, :3]) < 0.0:
        raise PoseError(
            tr(
                "the columns of its rotation must be orthogonal unit vectors that make a right-handed frame; "
                "they are off by {astray:.2g}.",
                astray=astray,
            )
        )
    pose[:3, :3] = nearest_rotation(pose[:3, :3])
    return pose


def _columns(named: dict[str, str]) -> list[list[float]]:
    """The rows of a pose written as its vectors, each on a line: n = (…), o = (…), a = (…), p = (…)."""
    vectors = [[float(number) for number in _NUMBER.findall(named[letter])] for letter in "noap"]
    if any(len(vector) != 3 for vector in vectors):
        raise PoseError(tr("each of n, o, a, p must have three numbers."))
    return [list(row) for row in zip(*vectors, strict=True)]


def _rows(text: str) -> list[list[float]]:
    """The numbers, row by row; comments and names are left out."""
    lines = (re.sub(r"[#%].*", "", line) for line in text.replace("\u2212", "-").splitlines())
    bare = "\n".join(lines)
    bare = bare[bare.rfind("T =") + 3 :] if "T =" in bare else bare
    bare = re.sub(r"\.\.\.\s*\n", " ", bare)
    bare = re.sub(r"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*", lambda word: word[0] if word[0] in "eE" else " ", bare)
    pieces = re.split(r";|\]|\\\\|\n", bare)
    rows = [[float(number) for number in _NUMBER.findall(piece)] for piece in pieces]
    return [row for row in rows if row]


def _assembled(rows: list[list[float]], T: FloatArray, factor: float) -> FloatArray:
    """The pose of rows of numbers: by their lengths one knows what they are."""
    shape = tuple(len(row) for row in rows)
    pose = np.array(T, dtype=np.float64)
    if shape in ((16,), (12,)):
        rows = np.reshape(rows[0], (-1, 4)).tolist()
        shape = tuple(len(row) for row in rows)
    if shape in ((4, 4, 4, 4), (4, 4, 4)):
        if len(rows) == 4 and rows[3] != [0.0, 0.0, 0.0, 1.0]:
            raise PoseError(
                tr("its last row must be 0 0 0 1, but is {row}.", row=" ".join(f"{number:g}" for number in rows[3]))
            )
        pose[:3] = rows[:3]
    elif shape in ((3, 3, 3, 3), (3, 3, 3, 1, 1, 1)):
        pose[:3, :3] = rows[:3]
        pose[:3, 3] = np.concatenate([np.array(row) for row in rows[3:]])
    elif shape == (3, 3, 3):
        pose[:3, :3] = rows
        return pose
    else:
        raise PoseError(_found(shape))
    pose[:3, 3] /= factor
    return pose


def _found(shape: tuple[int, ...]) -> str:
    wanted = tr("It takes 4 rows of 4 numbers, 3 rows of 4, 3 rows of 3 and a position, or 3 rows of 3.")
    if not shape:
        return f"{tr('there are no numbers in it.')} {wanted}"
    counts = ", ".join(map(str, shape))
    found = trn("found {n} row of {counts} numbers.", "found {n} rows of {counts} numbers.", len(shape), counts=counts)
    return f"{found} {wanted}"


class MatrixDialog(QDialog):
    """Asks for a matrix; `taken(T)` tells a pose (4, 4) [m] that could be read."""

    taken = Signal(object)

    def __init__(self, T: FloatArray, factor: float, unit: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._T, self._factor = T, factor
        self.setObjectName("matrix_dialog")
        self.setWindowTitle(tr("Paste a matrix"))
        self.text = TextBox(QGuiApplication.clipboard().text(), _LONGEST)
        self.text.setObjectName("matrix_text")
        self.text.setAccessibleName(tr("Matrix"))
        self.text.setPlaceholderText(_EXAMPLE)
        self.text.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.problem = QLabel(wordWrap=True)
        self.problem.setObjectName("matrix_problem")
        set_role(self.problem, level="error")
        what = QLabel(
            tr(
                "T_base_tool as 4 × 4, 3 × 4, or 3 × 3 and a position; NumPy, MATLAB or plain. Lengths in {unit}, "
                "unless the text says another unit.",
                unit=unit,
            ),
            wordWrap=True,
        )
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        buttons.button(QDialogButtonBox.StandardButton.Ok).setText(tr("Take as target"))
        buttons.button(QDialogButtonBox.StandardButton.Cancel).setText(tr("Cancel"))
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        for widget in (what, self.text, self.problem, buttons):
            column.addWidget(widget)
        self.resize(420, 300)

    def accept(self) -> None:
        """Take the matrix, or say what is wrong with it."""
        try:
            pose = pose_from_text(self.text.toPlainText(), self._T, self._factor)
        except PoseError as problem:
            self.problem.setText(str(problem))
            return
        self.taken.emit(pose)
        super().accept()
