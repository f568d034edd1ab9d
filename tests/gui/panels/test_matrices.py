"""The Matrices panel shows every A_i and product of the present pose, with the formula that made it."""

import math

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLabel, QToolButton

from rvsim.gui.matrix_view import MatrixView
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.matrices import MatricesPanel
from rvsim.kinematics import forward_kinematics, joint_transforms, link_transforms

POSE = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def panel(session_with, preferences, shown):
    session = session_with("rv-m1")
    session.move_to(POSE, "Plot")
    return shown(MatricesPanel(session, preferences))


def child(panel, kind, name):
    found = panel.findChild(kind, name)
    assert found is not None, name
    return found


def numbers(panel, name):
    text = child(panel, MatrixView, f"{name}_matrix").text().replace("\u2212", "-")
    return np.array([[float(cell) for cell in line.split()] for line in text.split("\n")])


def in_millimetres(T):
    shown = np.array(T)
    shown[:3, 3] *= 1e3
    return shown


@pytest.mark.parametrize("joint", [1, 2, 3, 4, 5])
def test_each_step_shows_the_link_and_the_product_up_to_it(panel, qtbot, joint):
    qtbot.mouseClick(child(panel, QToolButton, f"matrix_step_{joint}"), Qt.MouseButton.LeftButton)
    robot = panel._session.robot
    np.testing.assert_allclose(
        numbers(panel, "link"), in_millimetres(joint_transforms(robot, POSE)[joint - 1]), atol=0.051
    )
    np.testing.assert_allclose(
        numbers(panel, "product"), in_millimetres(link_transforms(robot, POSE)[joint]), atol=0.051
    )


def test_the_last_step_is_the_tool(panel, session_with):
    panel.choose(6)
    T = forward_kinematics(panel._session.robot, POSE)
    np.testing.assert_allclose(numbers(panel, "product"), in_millimetres(T), atol=0.051)


def test_the_formula_names_the_convention_and_the_numbers_put_in(panel, session_with, preferences, shown):
    panel.choose(3)
    formula = child(panel, QLabel, "link_formula").text()
    assert formula.startswith("A₃ = Rz(θ₃) · Tz(d₃) · Tx(a₃) · Rx(α₃)")
    assert "Rz(\u221250.0°) · Tz(0.0 mm) · Tx(160.0 mm) · Rx(0.0°)" in formula
    assert "standard DH" in child(panel, QLabel, "link_note").text()
    craig = shown(MatricesPanel(session_with("al5b"), preferences))
    craig.choose(3)
    assert child(craig, QLabel, "link_formula").text().startswith("A₃ = Rx(α₂) · Tx(a₂) · Tz(d₃) · Rz(θ₃)")
    assert "modified DH (Craig)" in child(craig, QLabel, "link_note").text()


def test_it_follows_the_pose_the_units_and_the_arm(panel, session_with, preferences):
    session = panel._session
    panel.choose(1)
    session.move_to(np.zeros(5), "Zero")
    np.testing.assert_allclose(numbers(panel, "link")[:3, 3], [0, 0, 152.0])
    preferences.set("length_unit", "m")
    preferences.set("angle_unit", "rad")
    np.testing.assert_allclose(numbers(panel, "link")[:3, 3], [0, 0, 0.152])
    assert "Rx(1.571 rad)" in child(panel, QLabel, "link_formula").text()
    session.use_robot(session_with("rrrp").robot)
    assert panel.findChild(QToolButton, "matrix_step_0") is not None, "an arm with a base transform shows it"
    panel.choose(0)
    np.testing.assert_allclose(numbers(panel, "link")[:3, 3], [4, 4, 1])


def test_a_hidden_panel_does_nothing_and_catches_up_when_shown(panel):
    panel.choose(1)
    panel.hide()
    before = numbers(panel, "link")
    panel._session.move_to(np.zeros(5), "Zero")
    np.testing.assert_array_equal(numbers(panel, "link"), before)
    panel.show()
    assert not np.array_equal(numbers(panel, "link"), before)


def test_the_arrow_keys_step_and_stop_at_the_ends(panel):
    panel.choose(5)
    for _ in range(3):
        panel.step(1)
    assert panel.chosen == 6
    for _ in range(9):
        panel.step(-1)
    assert panel.chosen == 1


def test_a_copy_holds_every_digit_and_says_its_unit(panel):
    panel.choose(2)
    child(panel, CopyButton, "product_copy").copy_as("NumPy")
    text = QGuiApplication.clipboard().text()
    assert text.isascii()
    assert text.startswith("# 0T2 = A1 * A2, lengths in mm\n")
    wanted = in_millimetres(link_transforms(panel._session.robot, POSE)[2])
    np.testing.assert_array_equal(eval(text, {"np": np}), wanted)
    assert ("Copied running product as NumPy.", "info") in panel._session.sentences


def test_no_number_is_shown_as_minus_zero(panel):
    panel._session.move_to(np.array([math.pi / 2, 0, 0, 0, math.pi / 2]), "Plot")
    panel.choose(5)
    assert "\u22120.0000" not in child(panel, MatrixView, "product_matrix").text()
