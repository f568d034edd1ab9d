"""The Jacobian page shows J of the present pose in the chosen rows, and lights where a column comes from."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QTableView

from rvsim.files import load_robot
from rvsim.gui.panels.inspect_jacobian import JacobianPage
from rvsim.kinematics import jacobian
from rvsim.kinematics.rates import analytic_jacobian, tool_jacobian
from rvsim.scene.primitives import Labels

POSE = np.radians([30.0, 40.0, -70.0, -30.0, 20.0])


@pytest.fixture
def page_of(inspecting):
    return lambda name, q=None: inspecting(JacobianPage, name, q)


def numbers(page):
    table = page.findChild(QTableView, "jacobian_table")
    model = table.model()
    texts = [[model.index(r, c).data() for c in range(model.columnCount())] for r in range(model.rowCount())]
    return np.array([[float(text.replace("\u2212", "-")) for text in row] for row in texts])


@pytest.mark.parametrize(
    ("kind", "formula"),
    [
        ("base", jacobian),
        ("tool", tool_jacobian),
        ("rpy", lambda robot, q: analytic_jacobian(robot, q, "rpy")),
        ("zyz", lambda robot, q: analytic_jacobian(robot, q, "zyz")),
    ],
)
def test_the_table_is_the_jacobian_in_the_chosen_rows(page_of, kind, formula):
    page = page_of("rv-m1", POSE)
    page.kinds.setCurrentIndex(page.kinds.findData(kind))
    J = formula(page._session.robot, POSE)
    np.testing.assert_allclose(numbers(page)[:3], 1e3 * J[:3], atol=0.051)
    np.testing.assert_allclose(numbers(page)[3:], J[3:], atol=0.00051)


def test_it_follows_the_pose_and_the_unit_seen_or_not_but_draws_only_while_it_is_seen(page_of, preferences):
    page = page_of("rv-m1", POSE)
    page._session.move_to(POSE * 0.5, "Plot")
    np.testing.assert_allclose(numbers(page)[:3], 1e3 * jacobian(page._session.robot, POSE * 0.5)[:3], atol=0.051)
    preferences.set("length_unit", "m")
    assert page.table.model().index(0, 0).data(Qt.ItemDataRole.ToolTipRole).endswith("m/rad")
    preferences.set("length_unit", "mm")
    page.table.choose(0)
    page.set_seen(False)
    page._session.move_to(POSE, "Plot")
    np.testing.assert_allclose(numbers(page)[:3], 1e3 * jacobian(page._session.robot, POSE)[:3], atol=0.051)
    assert page._stage.layers[page.name] == ()


def test_a_sliding_joint_has_its_own_units_and_identity(page_of):
    page = page_of("rrrp")
    model = page.table.model()
    page.table.choose(3)
    slides = numbers(page)[:, 3]
    np.testing.assert_allclose(slides, jacobian(page._session.robot, page._session.q)[:, 3], atol=0.0006)
    assert model.index(0, 3).data(Qt.ItemDataRole.ToolTipRole).split()[-1] in ("unit/unit", "mm/mm")
    assert "×" not in page.equations.text()
    assert "sliding" in page.note.text()


def test_the_position_part_has_three_rows_and_its_own_rank(page_of):
    page = page_of("rv-m1", POSE)
    page.parts.setCurrentIndex(page.parts.findData("position"))
    assert numbers(page).shape == (3, 5)
    assert "3, full" in page.rank.text()
    page.parts.setCurrentIndex(0)
    assert "5, full" in page.rank.text()


def test_a_singular_pose_is_told_by_the_rank(page_of):
    page = page_of("planar", np.array([0.4, 0.0]))
    page.parts.setCurrentIndex(page.parts.findData("position"))
    assert ": 1, 2 is the most" in page.rank.text()


def test_the_check_is_live_and_small(page_of):
    text = page_of("ur5e", np.array([0.3, -1.2, 1.7, -2.0, -1.4, 0.2])).check.text()
    assert float(text.rsplit(" ", 1)[-1].rstrip(".").replace("\u2212", "-")) < 1e-8


def test_a_column_under_the_pointer_is_lit_in_the_scene_with_its_numbers(page_of, qtbot):
    page = page_of("rv-m1", POSE)
    cell = page.table.visualRect(page.table.model().index(2, 1)).center()
    qtbot.mouseMove(page.table.viewport(), cell - QPoint(3, 0))
    qtbot.mouseMove(page.table.viewport(), cell)
    items = page._stage.layers["inspect_jacobian"]
    (labels,) = [item for item in items if isinstance(item, Labels)]
    assert [label.text.split("   ")[0] for label in labels.labels] == ["z₁", "p − o₁", "z₁ × (p − o₁)"]
    J = jacobian(page._session.robot, POSE)
    assert f"{1e3 * J[2, 1]:.1f}" in page.equations.text()
    page.set_seen(False)
    assert page._stage.layers["inspect_jacobian"] == ()


def test_the_keyboard_chooses_a_column_too(page_of, qtbot):
    page = page_of("rv-m1", POSE)
    page.table.choose(1)
    qtbot.keyClick(page.table, Qt.Key.Key_Right)
    assert page.column.text() == "Column J3, elbow"


@pytest.mark.parametrize("name", ["text", "NumPy", "LaTeX"])
def test_copies_are_in_full_precision_with_rows_and_units(page_of, name):
    page = page_of("rv-m1", POSE)
    page.copy.copy_as(name)
    text = QGuiApplication.clipboard().text()
    assert "rows vx, vy, vz, wx, wy, wz; mm per rad" in text
    assert repr(float(page.shown[0, 1])) in text
    assert text.isascii()


def test_a_notation_that_is_singular_says_so(page_of):
    page = page_of("planar", np.array([0.4, 0.7]))
    page.kinds.setCurrentIndex(page.kinds.findData("zyz"))
    assert "the notation is singular there, not the arm" in page.meaning.text()
    assert page.table.model().index(3, 0).data() == "–"
    assert page.check.text() == page.rank.text() == ""


@pytest.mark.parametrize("name", ["rv-m1", "rrrp"])
def test_the_whole_of_J_is_worked_out_on_request(page_of, name):
    robot = load_robot(name)
    page = page_of(name, robot.home)
    assert not page.equations.isVisibleTo(page)
    page.whole.click()
    text = page.equations.text()
    J = jacobian(robot, robot.home)
    factor = 1e3 if robot.length_unit == "millimetre" else 1.0
    turning = [i for i, joint in enumerate(robot.joints) if joint.revolute]
    for joint in turning:
        assert f"J{'₁₂₃₄₅₆'[joint]} = z" in text
        assert f"{factor * np.abs(J[:3, joint]).max():.1f}".removesuffix(".0") in text
