"""The Points panel is source 000's Program 3: eleven rows for the RV-M1, origins and gripper for any arm."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QAbstractItemModelTester
from PySide6.QtWidgets import QTableView

from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.points import PointsPanel
from rvsim.scene.points import source_points

POSE = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def panel(session_with, preferences, shown):
    session = session_with("rv-m1")
    session.move_to(POSE, "Plot")
    return shown(PointsPanel(session, preferences))


def cells(panel):
    model = panel.findChild(QTableView, "points_table").model()
    return [[model.index(row, column).data() for column in range(4)] for row in range(model.rowCount())]


def test_the_rv_m1_has_the_eleven_points_of_the_source(panel):
    table = cells(panel)
    assert [row[0] for row in table] == [
        "O₀  base",
        "O₁  waist",
        "O₂  shoulder",
        "O₃  elbow",
        "O₄  wrist pitch",
        "O₅  wrist roll",
        *(f"grip {i}" for i in range(1, 6)),
    ]
    assert table[5][1:] == ["363.7", "210.0", "297.4"]
    shown = [[float(cell.replace("\u2212", "-")) for cell in row[1:]] for row in table]
    np.testing.assert_allclose(shown, 1e3 * source_points(panel._session.robot, POSE), atol=0.051)


def test_the_header_names_the_unit_and_follows_it(panel, preferences):
    model = panel.model
    assert [model.headerData(i, Qt.Orientation.Horizontal) for i in range(4)] == ["point", "x mm", "y mm", "z mm"]
    preferences.set("length_unit", "m")
    assert model.headerData(1, Qt.Orientation.Horizontal) == "x m"
    assert cells(panel)[5][1] == "0.3637"


def test_it_follows_the_pose_and_the_arm(panel, session_with):
    panel._session.move_to(np.zeros(5), "Zero")
    assert cells(panel)[5][1:] == ["482.0", "0.0", "152.0"]
    panel._session.use_robot(session_with("rrrp").robot)
    assert len(cells(panel)) == 5
    assert panel.model.headerData(1, Qt.Orientation.Horizontal) == "x unit"


def test_the_copies_hold_the_whole_table_in_full_precision(panel):
    wanted = 1e3 * source_points(panel._session.robot, POSE)
    copy = panel.findChild(CopyButton, "points_copy")
    copy.copy_as("NumPy")
    np.testing.assert_array_equal(eval(QGuiApplication.clipboard().text(), {"np": np}), wanted)
    copy.copy_as("text")
    lines = [line.split("\t") for line in QGuiApplication.clipboard().text().split("\n")]
    assert lines[0] == ["point", "x [mm]", "y [mm]", "z [mm]"]
    assert lines[1][0] == "O0 base"
    np.testing.assert_array_equal([[float(cell) for cell in line[1:]] for line in lines[1:]], wanted)


def test_the_keyboard_copies_the_table(panel, qtbot):
    panel.activateWindow()  # shortcuts are for the active window and what has the focus in it
    panel.table.setFocus()
    qtbot.waitUntil(panel.table.hasFocus)
    qtbot.keyClick(panel.table, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text().startswith("point\tx [mm]")


def test_it_keeps_the_rules_of_qt_models(panel, session_with):
    QAbstractItemModelTester(panel.model, QAbstractItemModelTester.FailureReportingMode.Warning)
    panel._session.move_to(np.zeros(5), "Zero")
    panel._session.use_robot(session_with("ur5e").robot)
    assert panel.model.rowCount() == 7


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_no_name_is_cut_where_there_is_room(panel, preferences, unit):
    preferences.set("length_unit", unit)
    assert panel.table.columnWidth(0) >= panel.table.sizeHintForColumn(0)
