"""The Singular page judges the present pose, says and draws what is lost, and takes the arm into each family."""

import numpy as np
import pytest
from PySide6.QtWidgets import QCheckBox, QLabel, QPushButton

from rvsim import load_robot
from rvsim.gui.panels.inspect_singular import SingularPage
from rvsim.gui.panels.user_robot import own_copy
from rvsim.kinematics import singular_families, singularity
from rvsim.robot.edits import with_dh_value

CLEAR_UR5E = np.radians([20.0, -70.0, 100.0, -50.0, 60.0, 35.0])
STRETCHED = np.radians([20.0, 40.0, 0.0, 30.0, 20.0])
ARMS_OF_EACH_KIND = ["rv-m1", "rv-1a", "ur5e", "rrrp", "planar", "scara", "cartesian"]


@pytest.fixture
def page_of(inspecting):
    return lambda name, q=None: inspecting(SingularPage, name, q)


def text(page, name):
    return page.findChild(QLabel, name).text()


def drawn(page):
    return [item.key for item in page._stage.layers.get("inspect_singular", ())]


def click(page, name):
    page.findChild(QPushButton, name).click()


def test_a_clear_pose_has_a_green_light_and_its_numbers(page_of):
    page = page_of("ur5e", CLEAR_UR5E)
    found = singularity(load_robot("ur5e"), CLEAR_UR5E)
    assert text(page, "singular_light") == "●"
    assert text(page, "singular_verdict") == "Clear of singularities"
    assert text(page, "singular_measure_1") == f"{found.sigma_min:.4f}"
    assert text(page, "singular_measure_3") == f"{found.condition:.1f}"
    assert text(page, "singular_measure_4") == f"{found.manipulability:.4f}"
    assert text(page, "singular_measure_5") == "6 of 6"
    assert not page.lost.isVisible()
    assert drawn(page) == []


def test_a_stretched_rv_m1_is_singular_and_shows_what_it_lost(page_of):
    page = page_of("rv-m1", STRETCHED)
    assert text(page, "singular_light") == "✖"
    assert text(page, "singular_verdict") == "Singular: elbow"
    assert text(page, "singular_measure_5") == "4 of 5"
    assert text(page, "singular_state_elbow") == "✖ active"
    assert text(page, "singular_state_coaxial") == ""
    assert page.lost.text() == "Cannot move along (0.72, 0.26, 0.64) on the dashed line, 36.0 mm beside the tip."
    assert any("lost0" in key for key in drawn(page))


def test_the_light_follows_the_threshold_and_the_pose(page_of):
    page = page_of("ur5e", CLEAR_UR5E)
    page.threshold.setValue(0.5)
    assert text(page, "singular_light") == "▲"
    page.threshold.setValue(0.01)
    page._session.move_to(np.where(np.arange(6) == 2, 0.003, CLEAR_UR5E), "Plot")
    assert text(page, "singular_verdict") == "Close to a singularity"
    assert text(page, "singular_state_elbow") == "▲ near"


@pytest.mark.parametrize("name", ARMS_OF_EACH_KIND)
def test_take_me_there_enters_each_family_within_the_limits_undoably(page_of, name):
    page = page_of(name)
    session, home = page._session, page._session.q
    for family in singular_families(session.robot):
        slug = family.name.replace(" ", "_")
        before = session.q
        click(page, f"singular_go_{slug}")
        if session.q is before:
            level = session.sentences[-1]
            assert level[1] == "warning"
            assert level[0].startswith("Outside the limits")
            continue
        assert text(page, f"singular_state_{slug}") == "✖ active"
        assert text(page, "singular_light") in ("✖", "▲")
        assert drawn(page)
        session.undo_stack.undo()
        np.testing.assert_array_equal(session.q, home)


def test_a_family_beyond_the_limits_says_so_with_numbers(page_of):
    page = page_of("rv-1a")
    click(page, "singular_go_elbow")
    said = "Outside the limits: elbow would need −60.6°, but has −30.0° to 65.0°."
    assert page._session.sentences[-1] == (said, "warning")
    assert any(row.problem.text() == said for row in page.families.rows)


def test_an_arm_without_families_says_so(page_of):
    page = page_of("cartesian")
    assert page.families.rows == []
    assert page.families.note.text().startswith("This arm has no singularity")
    page._session.use_robot(load_robot("rrrp"))
    assert page.families.note.text().startswith("Of its pose this arm has none")
    page._session.use_robot(load_robot("ur5e").with_joint(3, alpha=0.7))
    assert page.families.note.text().startswith("No family is known")


def test_the_ellipsoids_are_drawn_with_their_scale(page_of):
    page = page_of("ur5e", CLEAR_UR5E)
    for name, word in (("velocity", "Velocity"), ("force", "Force")):
        page.findChild(QCheckBox, f"singular_{name}").setChecked(True)
        assert any(key.startswith(f"ellipsoid.{name}") for key in drawn(page))
        assert f"{word} for joint" in text(page, "singular_scale")
    page.set_seen(False)
    assert drawn(page) == []


def test_source_000_is_held_against_the_arm(page_of):
    page = page_of("rv-m1", STRETCHED)
    assert len(page.block.grid.text().splitlines()) == 3
    assert text(page, "singular_minor_1") != "0 dm³"
    assert text(page, "singular_barrier_verdict_1").startswith("Singular")
    assert text(page, "singular_barrier_verdict_2").startswith("Not singular: σ = 0.470, 0.217, 0.112 m. A barrier")
    click(page, "singular_barrier_1")
    assert [text(page, f"singular_minor_{row}") for row in (1, 2, 3)] == ["0 dm³"] * 3
    assert text(page, "singular_state_stretched") == "✖ active"
    page._session.move_to(np.append(0.7, page._session.q[1:]), "Plot")
    click(page, "singular_barrier_2")
    assert page._session.q[0] == 0.7
    assert text(page, "singular_light") == "●"


def test_the_determinant_of_the_rv_1a_is_a_product(page_of):
    page = page_of("rv-1a")
    arm, wrist, product, whole = (text(page, f"singular_split_{row}") for row in (1, 2, 3, 4))
    assert product == whole
    assert float(wrist.replace("\u2212", "-")) == pytest.approx(-np.sin(page._session.q[4]), abs=1e-4)
    assert arm != "0"


def test_the_planar_arm_shows_figure_4_1(page_of):
    page = page_of("planar")
    click(page, "singular_figure")
    assert page.findChild(QCheckBox, "singular_ellipses").isChecked()
    assert sum(key.startswith("ellipsoid.bend") and key.endswith(".0") for key in drawn(page)) == 5
    assert page._session.q[1] == 0.0
    assert text(page, "singular_verdict") == "Singular: elbow"


def test_another_arm_brings_its_own_families_and_block(page_of):
    page = page_of("rv-m1")
    page._session.use_robot(load_robot("ur5e"))
    assert [row.family.name for row in page.families.rows] == ["elbow", "shoulder", "wrist"]
    assert page.block is None


@pytest.mark.parametrize("name", ARMS_OF_EACH_KIND)
def test_nothing_needs_more_than_the_panels_width(page_of, name):
    page = page_of(name)
    assert page.light.parentWidget().layout().minimumSize().width() <= 320


@pytest.mark.parametrize("name", ["rv-m1", "rv-1a", "planar"])
def test_an_edited_copy_keeps_the_block_of_its_arm(page_of, name):
    page = page_of(name)
    kind = type(page.block)
    copy = with_dh_value(own_copy(page._session.robot), 1, "a", 0.9 * page._session.robot.joints[1].a)
    page._session.use_robot(copy)
    assert type(page.block) is kind
    page._session.use_robot(with_dh_value(copy, 0, "lower", -np.inf))  # where there is no stop there is no barrier
    assert page.light.word.text()
