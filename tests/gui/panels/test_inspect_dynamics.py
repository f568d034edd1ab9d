"""The Dynamics page: the parts of the torques, the energies, M, and mass data that can be typed."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QTableView

from rvsim.dynamics import dynamics_parts, gravity_torques, kinetic_energy, mass_matrix
from rvsim.experiment import Load
from rvsim.gui.app import build_window
from rvsim.gui.panels.inspect_dynamics import DynamicsPage
from rvsim.gui.quantity_box import QuantityBox
from rvsim.motion import joint_move
from rvsim.robot.mass_edits import with_guessed_masses


@pytest.fixture
def page_of(qtbot, preferences):
    def make(name):
        window = build_window(preferences, robot=name, renderer="painter")
        qtbot.addWidget(window)
        page = DynamicsPage(window.session, preferences, window.stage, window)
        page.set_seen(True)
        return page

    return make


def enter(page, name, value):
    page.findChild(QuantityBox, name).setValue(value)


def test_the_table_shows_the_parts_and_their_sum(page_of):
    page = page_of("ur5e")
    enter(page, "qd_2", 30.0)
    enter(page, "qdd_3", -90.0)
    session = page._session
    qd, qdd = np.zeros(6), np.zeros(6)
    qd[1], qdd[2] = np.radians(30.0), np.radians(-90.0)
    parts = dynamics_parts(session.robot, session.q, qd, qdd)
    np.testing.assert_allclose(page.model.values, np.stack([*parts, parts.total], axis=-1), atol=1e-12)
    assert page.torques_title.text() == "Joint torques, N m"
    T = kinetic_energy(session.robot, session.q, qd)
    assert page.energy.text().startswith(f"Kinetic {T:.2f} J, potential ")
    page.at_rest.click()
    np.testing.assert_allclose(page.model.values[:, 1:3], 0.0, atol=1e-12)


def test_gravity_and_payload_count(page_of):
    page = page_of("rv-m1")
    page.place.setCurrentIndex(page.place.findText("Moon"))
    page.place.activated.emit(page.place.currentIndex())
    enter(page, "dynamics_payload", 1.2)
    session = page._session
    expected = gravity_torques(session.robot, session.q, gravity=1.62, payload=1.2)
    np.testing.assert_allclose(page.model.values[:, 0], expected, atol=1e-12)
    session.edit("Set", session.experiment.with_load(Load(payload=0.5)))  # on another page
    assert page.payload.quantity == 0.5
    enter(page, "gravity", 5.0)
    assert page.place.currentText() == "own value"


def test_a_motion_that_is_shown_brings_its_own_rates(page_of):
    page = page_of("ur5e")
    session, motion = page._session, page._stage.motion
    move = joint_move(session.robot, session.q, session.q + 0.5)
    motion.load(move, "Move")
    motion.play()
    motion.pause()
    motion.seek(0.4 * move.duration)
    motion.pause()
    moment = move.at(motion.player.time)
    parts = dynamics_parts(session.robot, moment.q, moment.qd, moment.qdd)
    np.testing.assert_allclose(page.model.values[:, 3], parts.total, atol=1e-9)
    assert "From the motion" in page.note.text()
    assert page.findChild(QuantityBox, "qd_1").isReadOnly()
    beside = session.q + 0.1 * (np.arange(session.robot.dof) == 0)
    assert session.move_to(beside, "Plot")  # by hand: no longer a pose of the motion
    assert not page.findChild(QuantityBox, "qd_1").isReadOnly()


def test_an_arm_without_masses_says_so_and_can_be_given_some(page_of):
    page = page_of("rrrp")
    assert page.known.isHidden()
    assert "No mass data" in page.missing.text()
    page.guess.click()
    robot = page._session.robot
    assert robot.name == "my-rrrp"
    assert not page.known.isHidden()
    assert page.missing.isHidden()
    np.testing.assert_allclose(page._M, mass_matrix(robot, page._session.q), atol=1e-12)
    assert page.model.index(3, 4).data().endswith(" N")
    page._session.undo_stack.undo()
    assert page._session.robot.name == "rrrp"


def type_into(page, qtbot, table_name, row, column, text):
    table = page.findChild(QTableView, table_name)
    index = table.model().index(row, column)
    table.edit(index)
    editor = table.findChildren(QLineEdit, "mass_cell_editor")[-1]  # an earlier one may still be on its way out
    editor.selectAll()
    qtbot.keyClicks(editor, text)
    qtbot.keyClick(editor, Qt.Key.Key_Return)
    QApplication.processEvents()  # Qt hands the text over a moment later


def test_a_typed_mass_goes_to_a_copy_and_counts_as_assumed(page_of, qtbot):
    page = page_of("ur5e")
    page.show()
    type_into(page, qtbot, "mass_table", 1, 1, "2*4")
    robot = page._session.robot
    assert robot.name == "my-ur5e"
    assert robot.masses[1].mass == 8.0
    assert robot.masses[1].assumed
    assert "Italic: assumed" in page.mass_note.text()
    type_into(page, qtbot, "mass_table", 1, 2, "250")
    assert page._session.robot.masses[1].com[0] == pytest.approx(0.25)
    type_into(page, qtbot, "inertia_table", 0, 6, "0.02")
    assert page._session.robot.masses[0].inertia[1, 1] == pytest.approx(0.02)
    type_into(page, qtbot, "mass_table", 1, 1, "-1")
    assert page._session.robot.masses[1].mass == 8.0
    assert "no mass is negative" in page.message.text()


def test_what_is_no_number_is_refused_with_a_sentence(page_of):
    page = page_of("ur5e")
    assert not page.masses.setData(page.masses.index(0, 1), "heavy")
    assert "heavy" in page.message.text()
    assert page._session.robot.name == "ur5e"


def test_another_arm_gets_its_own_rows(page_of):
    page = page_of("ur5e")
    page._session.use_robot(
        with_guessed_masses(page._session.robot.renamed("other", "Other")).with_joint(0, name="hip")
    )
    assert page.findChild(QuantityBox, "qd_6") is not None
    assert page.masses.rowCount() == 6


def test_a_rate_that_is_half_typed_goes_with_its_arm(qtbot, preferences):
    window = build_window(preferences, robot="ur5e", renderer="painter")
    qtbot.addWidget(window)
    window.docks.show_panel("dynamics")
    with qtbot.waitExposed(window):
        window.show()
    box = window.findChild(QuantityBox, "qd_2")
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, "100")
    window.session.use_robot(window.library["rv-m1"])
    assert not window.findChild(DynamicsPage).rates.values[0].any()


def test_copies_hold_all_parts(page_of):
    page = page_of("rv-m1")
    page.copy.copy_as("NumPy")
    text = QGuiApplication.clipboard().text()
    np.testing.assert_allclose(eval(text.split("\n", 1)[1], {"np": np}), page.model.values)
    page.copy_matrix.copy_as("text")
    assert len(QGuiApplication.clipboard().text().splitlines()) == 5


def test_a_page_that_goes_takes_its_weights_along(page_of):
    page = page_of("rv-m1")
    assert page._stage._layers["inspect_dynamics"]
    page.set_seen(False)
    assert page._stage._layers["inspect_dynamics"] == ()
