"""A pose is read from what people paste, in its unit; what is no pose is refused with what was found."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDialogButtonBox

from rvsim.errors import PoseError
from rvsim.gui.panels.inverse_matrix import MatrixDialog, pose_from_text
from rvsim.lab.texts import matrix_latex, matrix_numpy, pose_text
from rvsim.spatial import rotation_from_rpy

HERE = np.eye(4)
HERE[:3, 3] = (0.1, 0.2, 0.3)
POSE = np.eye(4)
POSE[:3, :3] = rotation_from_rpy([0.3, -1.0, 2.0])
POSE[:3, 3] = (0.11, -0.25, 0.4)
MILLIMETRES = POSE.copy()
MILLIMETRES[:3, 3] *= 1e3
R, P = POSE[:3, :3], MILLIMETRES[:3, 3]


def matlab(matrix: np.ndarray) -> str:
    return "[" + "; ".join(" ".join(f"{number:.15g}" for number in row) for row in matrix) + "]"


@pytest.mark.parametrize(
    "text",
    [
        matrix_numpy(MILLIMETRES),
        f"T = {matrix_numpy(MILLIMETRES)}",
        f"# RV-M1, radians and metres\nq = {matrix_numpy(np.zeros(5))}\nT = {matrix_numpy(POSE)}",
        f"# T_base_tool, lengths in m\n{matrix_numpy(POSE)}",
        f"% T_base_tool, lengths in mm\n{matrix_latex(MILLIMETRES)}",
        f"T_base_tool, lengths in mm\n{pose_text(MILLIMETRES)}",
        f"T = {matlab(MILLIMETRES)};",
        matlab(MILLIMETRES[:3]),
        matlab(np.vstack([R, P])),
        f"{matlab(R)}\n{matlab(P[:, None])}",
        " ".join(map(str, MILLIMETRES.ravel())),
        "\n".join("\t".join(map(str, row)) for row in MILLIMETRES).replace("-", "\u2212"),
        repr(MILLIMETRES.tolist()),
    ],
)  # fmt: skip
def test_what_people_paste_is_read(text: str) -> None:
    np.testing.assert_allclose(pose_from_text(text, HERE, 1e3), POSE, atol=1e-5)


def test_a_rotation_alone_keeps_the_place() -> None:
    pose = pose_from_text(matlab(R), HERE, 1e3)
    np.testing.assert_allclose(pose[:3, :3], R, atol=1e-12)
    np.testing.assert_array_equal(pose[:3, 3], HERE[:3, 3])


def test_rounded_numbers_become_a_rotation_again() -> None:
    pose = pose_from_text("\n".join(" ".join(f"{n:.3f}" for n in row) for row in MILLIMETRES), HERE, 1e3)
    np.testing.assert_allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3), atol=1e-12)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "no numbers"),
        ("hello", "no numbers"),
        ("1 2 3\n4 5", "2 rows of 3, 2 numbers"),
        (matlab(2.0 * np.eye(4)), "last row must be 0 0 0 1, but is 0 0 0 2"),
        ("1 0 0 0; 0 1 0 0; 0 0 -1 0; 0 0 0 1", "right-handed"),
        ("1 0 0 0; 0.5 1 0 0; 0 0 1 0; 0 0 0 1", "off by 0.5"),
    ],
)
def test_what_is_no_pose_is_refused_with_what_was_found(text: str, found: str) -> None:
    with pytest.raises(PoseError, match=found):
        pose_from_text(text, HERE, 1e3)


def test_the_dialog_says_what_is_wrong_and_takes_what_is_right(qtbot) -> None:
    QGuiApplication.clipboard().setText("1 2 3")
    dialog = MatrixDialog(HERE, 1e3, "mm")
    qtbot.addWidget(dialog)
    dialog.show()
    taken: list[np.ndarray] = []
    dialog.taken.connect(taken.append)
    ok = dialog.findChild(QDialogButtonBox).button(QDialogButtonBox.StandardButton.Ok)
    ok.click()
    assert "1 row of 3 numbers" in dialog.problem.text()
    assert dialog.isVisible()
    dialog.text.setPlainText(matlab(MILLIMETRES))
    ok.click()
    assert not dialog.isVisible()
    np.testing.assert_allclose(taken[0], POSE, atol=1e-12)
