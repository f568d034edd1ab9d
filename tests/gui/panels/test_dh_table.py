"""The DH panel: a table that says its convention, edited live on a copy, and never loses what was typed."""

import math

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QWheelEvent
from PySide6.QtTest import QAbstractItemModelTester
from PySide6.QtWidgets import QApplication, QFileDialog, QLabel, QLineEdit, QPushButton, QTableView

from rvsim.files import load_robot
from rvsim.gui.panels.dh_model import column_of_key
from rvsim.gui.panels.dh_table import DHTablePanel
from rvsim.gui.panels.user_robot import own_copy

ELBOW, SHOULDER = 2, 1


@pytest.fixture
def panel(session_with, preferences, shown):
    return shown(DHTablePanel(session_with("rv-m1"), preferences))


def table_of(panel, key):
    name = "limits_table" if key in ("lower", "upper", "home") else "dh_table"
    return panel.findChild(QTableView, name)


def cell(panel, joint, key):
    return panel.model.index(joint, column_of_key(key))


def editor(panel, joint, key):
    table = table_of(panel, key)
    table.setCurrentIndex(cell(panel, joint, key))
    table.edit(cell(panel, joint, key))
    return table.findChildren(QLineEdit, "dh_cell_editor")[-1]  # an older one may not be deleted yet


def type_into(panel, qtbot, joint, key, text):
    line = editor(panel, joint, key)
    line.selectAll()
    QGuiApplication.clipboard().setText(text)  # pasted: Qt's key simulation knows Latin letters only
    line.paste()
    press_return(qtbot, line)
    return line


def press_return(qtbot, line):
    qtbot.keyClick(line, Qt.Key.Key_Return)
    QApplication.processEvents()  # Qt closes the editor only then


def message(panel):
    label = panel.findChild(QLabel, "dh_message")
    return label.text() if label.isVisible() else ""


# --- what it shows ----------------------------------------------------------------------------------------------------


def test_the_table_shows_the_rows_and_where_q_is_added(panel):
    shown = [[cell(panel, joint, key).data() for key in ("theta", "d", "a", "alpha")] for joint in range(5)]
    assert shown == [
        ["q₁", "152.0", "0.0", "90.0°"],
        ["q₂", "0.0", "250.0", "0.0°"],
        ["q₃", "0.0", "160.0", "0.0°"],
        ["q₄ + 90.0°", "0.0", "0.0", "90.0°"],
        ["q₅ \u2212 90.0°", "72.0", "0.0", "0.0°"],
    ]
    assert [cell(panel, ELBOW, key).data() for key in ("lower", "upper", "home")] == ["\u2212110.0°", "0.0°", "0.0°"]


@pytest.mark.parametrize(("name", "words", "header"), [("rv-m1", "Standard DH", "a mm"), ("al5b", "Craig", "aᵢ₋₁ mm")])
def test_the_convention_is_said(session_with, preferences, shown, name, words, header):
    panel = shown(DHTablePanel(session_with(name), preferences))
    assert words in panel.findChild(QLabel, "dh_convention").text()
    assert panel.model.headerData(column_of_key("a"), Qt.Orientation.Horizontal) == header


def test_a_prismatic_joint_and_missing_limits_are_shown_as_they_are(session_with, preferences, shown):
    panel = shown(DHTablePanel(session_with("rrrp"), preferences))
    assert cell(panel, 3, "d").data() == "q₄"
    assert cell(panel, 3, "type").data() == "P"
    assert cell(panel, 0, "upper").data() == "none"
    assert panel.model.headerData(column_of_key("d"), Qt.Orientation.Horizontal) == "d unit"


# --- editing ----------------------------------------------------------------------------------------------------------


def test_the_first_edit_makes_a_copy_and_the_arm_follows_at_once(panel, qtbot):
    session = panel._session
    original = session.robot
    type_into(panel, qtbot, SHOULDER, "a", "2*150,5".replace(",", "."))
    assert (session.robot.name, session.robot.title) == ("my-rv-m1", "my RV-M1")
    assert session.robot.joints[SHOULDER].a == pytest.approx(0.301)
    assert original.joints[SHOULDER].a == 0.25
    assert "Edited copy of the Mitsubishi RV-M1." in panel.findChild(QLabel, "dh_convention").text()
    assert session.undo_stack.undoText() == "Edit a₂ of “shoulder” of my RV-M1"
    session.undo_stack.undo()
    assert session.robot is original
    assert cell(panel, SHOULDER, "a").data() == "250.0"


@pytest.mark.parametrize(
    ("joint", "key", "text", "value"),
    [
        (ELBOW, "a", "0,2", 0.0002),
        (ELBOW, "alpha", "\u221245", math.radians(-45)),
        (ELBOW, "theta", "degrees(pi/4)", math.radians(45)),
        (ELBOW, "upper", "60°", math.radians(60)),
        (ELBOW, "upper", "none", math.inf),
        (ELBOW, "lower", "∞", -math.inf),
        (ELBOW, "d", "١٢", 0.012),
        (0, "d", "160 mm", 0.16),
    ],
)
def test_a_cell_takes_what_people_type(panel, qtbot, joint, key, text, value):
    type_into(panel, qtbot, joint, key, text)
    assert getattr(panel._session.robot.joints[joint], key) == pytest.approx(value)


@pytest.mark.parametrize(
    ("joint", "key", "text", "words"),
    [
        (SHOULDER, "a", "25o", ("a₂ of “shoulder”", "“25o” is no number", "pi/4")),
        (SHOULDER, "a", "none", ("a₂ of “shoulder”", "only a limit can be none")),
        (SHOULDER, "a", "1e9", ("too large",)),
        (ELBOW, "upper", "-120", ("upper limit of “elbow”", "above the lower limit, \u2212110.0°")),
        (ELBOW, "home", "10", ("home of “elbow”", "\u2212110.0° … 0.0°")),
    ],
)
def test_a_bad_value_is_named_explained_and_not_lost(panel, qtbot, joint, key, text, words):
    robot = panel._session.robot
    line = type_into(panel, qtbot, joint, key, text)
    assert panel._session.robot is robot
    assert line.isVisible(), "the editor stays open"
    assert line.text() == text, "with what was typed"
    for word in words:
        assert word in message(panel)


def test_stepping_with_the_keys_is_live_and_one_undo_step(panel, qtbot):
    session = panel._session
    line = editor(panel, SHOULDER, "a")
    for key, modifier in (
        (Qt.Key.Key_Up, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier),
        (Qt.Key.Key_Down, Qt.KeyboardModifier.ControlModifier),
    ):
        qtbot.keyClick(line, key, modifier)
    assert session.robot.joints[SHOULDER].a == pytest.approx(0.2609)
    assert line.text() == "260.9"
    press_return(qtbot, line)
    assert session.undo_stack.count() == 1
    session.undo_stack.undo()
    assert session.robot.name == "rv-m1"


def test_the_wheel_steps_as_well(panel):
    line = editor(panel, SHOULDER, "d")
    none = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase
    line.wheelEvent(QWheelEvent(QPointF(2, 2), QPointF(2, 2), QPoint(), QPoint(0, 240), *none, False))
    assert panel._session.robot.joints[SHOULDER].d == pytest.approx(0.002)


def test_an_edit_that_is_opened_and_left_changes_nothing(panel, qtbot):
    robot = panel._session.robot
    press_return(qtbot, editor(panel, 3, "alpha"))
    line = editor(panel, SHOULDER, "a")
    qtbot.keyClicks(line, "999")
    qtbot.keyClick(line, Qt.Key.Key_Escape)
    assert panel._session.robot is robot
    assert panel._session.undo_stack.count() == 0


def test_limits_that_leave_the_pose_or_the_home_outside_say_so(panel, qtbot):
    type_into(panel, qtbot, ELBOW, "upper", "-30")
    assert panel._session.robot.joints[ELBOW].home == math.radians(-30)
    assert "The home of “elbow” moved to \u221230.0°" in message(panel)
    assert "“elbow” now stands at 0.0°, outside its limit \u221230.0°" in message(panel)


def test_an_edited_link_keeps_its_mass_and_says_so(session_with, preferences, shown):
    panel = shown(DHTablePanel(session_with("ur5e"), preferences))
    panel.edit_value(1, "a", -0.5)
    assert panel._session.robot.masses[1].assumed
    assert "keeps its mass" in message(panel)


def test_going_back_to_the_original_is_undoable(panel, qtbot):
    back = panel.findChild(QPushButton, "original_robot_button")
    original = panel._session.robot
    assert not back.isEnabled()
    panel.edit_value(SHOULDER, "a", 0.3)
    panel.edit_value(ELBOW, "a", 0.2)
    qtbot.mouseClick(back, Qt.MouseButton.LeftButton)
    assert panel._session.robot is original
    assert not back.isEnabled()
    panel._session.undo_stack.undo()
    assert [joint.a for joint in panel._session.robot.joints[1:3]] == [0.3, 0.2]


def test_what_was_edited_is_bold_and_its_tooltip_says_what_it_was(panel):
    panel.edit_value(SHOULDER, "a", 0.3)
    assert cell(panel, SHOULDER, "a").data(Qt.ItemDataRole.FontRole).bold()
    assert "It was 250.0 mm." in cell(panel, SHOULDER, "a").data(Qt.ItemDataRole.ToolTipRole)
    assert cell(panel, ELBOW, "a").data(Qt.ItemDataRole.FontRole) is None


def test_it_follows_another_arm_and_the_units(panel, session_with, preferences):
    panel._session.use_robot(session_with("ur5e").robot)
    assert panel.model.rowCount() == 6
    preferences.set("length_unit", "m")
    assert cell(panel, SHOULDER, "a").data() == "\u22120.4250"


def test_it_keeps_the_rules_of_qt_models(panel, session_with):
    QAbstractItemModelTester(panel.model, QAbstractItemModelTester.FailureReportingMode.Warning)
    panel.edit_value(SHOULDER, "a", 0.3)
    panel._session.use_robot(session_with("ur5e").robot)


# --- files and copies -------------------------------------------------------------------------------------------------


def test_a_saved_arm_opens_as_the_same_arm(panel, tmp_path, monkeypatch, qtbot):
    panel.edit_value(SHOULDER, "a", 0.3125)
    file = tmp_path / "mine.toml"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(file), ""))
    qtbot.mouseClick(panel.findChild(QPushButton, "save_robot_button"), Qt.MouseButton.LeftButton)
    assert message(panel) == f"Saved mine (my RV-M1) as {file}."
    edited = panel._session.robot
    panel.go_back()
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(file), ""))
    qtbot.mouseClick(panel.findChild(QPushButton, "open_robot_button"), Qt.MouseButton.LeftButton)
    assert (panel._session.robot.name, panel._session.robot.title) == ("mine", "mine (my RV-M1)")
    np.testing.assert_allclose(panel._session.robot.dh, edited.dh, atol=1e-15)
    assert "edited copy of Mitsubishi RV-M1" in panel._session.robot.source


def test_the_offered_file_lies_in_the_users_folder(panel, monkeypatch, tmp_path):
    offered = []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *arguments: offered.append(arguments[2]) or ("", ""))
    panel.edit_value(SHOULDER, "a", 0.3)
    panel.ask_and_save()
    assert offered == [str(tmp_path / "rvsim-user" / "robots" / "my-rv-m1.toml")]


def test_another_arm_under_a_known_name_is_its_own_original(panel, session_with):
    panel.edit_value(SHOULDER, "a", 0.3)
    panel._session.use_robot(session_with("ur5e").robot.renamed("my-rv-m1", "my RV-M1"))
    assert panel.original is panel._session.robot
    assert not panel.findChild(QPushButton, "original_robot_button").isEnabled()


def test_an_arm_of_the_same_joints_under_a_known_name_is_its_own_original_too(panel):
    other = panel._session.robot.with_joint(1, a=0.3)
    panel._session.use_robot(other)
    assert panel.original is other
    assert not panel.model.is_edited(1, "a")


def test_what_cannot_be_saved_or_opened_is_said_and_changes_nothing(panel, tmp_path):
    robot = panel._session.robot
    (tmp_path / "a file").write_text("no folder")
    panel.save_to(tmp_path / "a file" / "x.toml")
    assert "cannot be written" in message(panel)
    broken = tmp_path / "broken.toml"
    broken.write_text("name = 3")
    panel.open_from(broken)
    assert str(broken) in message(panel)
    panel.open_from(tmp_path / "missing.toml")
    assert "no such file" in message(panel)
    assert panel._session.robot is robot


def test_the_copy_holds_every_number_of_the_table(panel):
    panel.copy.copy_as("NumPy")
    table = eval(QGuiApplication.clipboard().text(), {"np": np})
    robot = panel._session.robot
    np.testing.assert_allclose(table[:, 1:3], 1e3 * robot.dh[:, 1:3])
    np.testing.assert_allclose(table[:, 4:6], np.degrees(robot.limits))
    panel.copy.copy_as("text")
    assert QGuiApplication.clipboard().text().split("\n")[2].startswith("shoulder\trevolute\t0.0\t0.0\t250.0")


@pytest.mark.parametrize(
    ("name", "title"),
    [("ur5e", "my UR5e"), ("planar", "my planar arm (RR)"), ("scara", "my SCARA arm (RRP + R)")],
)
def test_an_own_copy_has_the_short_title_and_stays_itself_when_copied_again(name, title):
    own = own_copy(load_robot(name))
    assert own.title == title
    assert own_copy(own) is own


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_every_column_shows_its_header_and_its_numbers(panel, preferences, unit):
    preferences.set("length_unit", unit)
    table, header = panel.rows, panel.rows.horizontalHeader()
    for column in range(table.model().columnCount()):
        if not table.isColumnHidden(column):
            needed = max(header.sectionSizeHint(column), table.sizeHintForColumn(column))
            assert table.columnWidth(column) >= needed, table.model().headerData(column, Qt.Orientation.Horizontal)
