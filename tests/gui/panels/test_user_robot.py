"""The user's own arm: saved under a name it is that arm from then on, and a new copy hides no saved one."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.files import user_robot_path
from rvsim.gui.panels.user_robot import is_own, own_copy, saved
from rvsim.gui.robot_library import RobotLibrary
from rvsim.lab.named_paths import path_names
from rvsim.robot.edits import original_name, with_dh_value


@pytest.fixture
def session(session_with):
    made = session_with("rv-m1")
    own = with_dh_value(own_copy(made.robot), 1, "a", 0.3)
    made.edit("Edit", made.experiment.with_robot(own))
    return made


def test_the_session_goes_on_with_the_saved_arm(session):
    q = session.q
    assert saved(session, user_robot_path("longarm"))[0]
    assert (session.robot.name, session.robot.title) == ("longarm", "longarm (my RV-M1)")
    assert np.array_equal(session.q, q)
    assert is_own(session.robot)
    assert own_copy(session.robot) is session.robot
    assert original_name(session.robot) == "rv-m1"
    assert "letter-board" in path_names(load_robot("longarm"))


def test_two_saved_copies_and_a_third_unsaved_one_are_all_on_offer(session):
    assert saved(session, user_robot_path("my RV-M1"))[0]
    assert saved(session, user_robot_path("second"))[0]
    library = RobotLibrary()
    third = own_copy(load_robot("rv-m1"))
    library.remember(third)
    titles = list(library.titles.values())
    assert titles[-3:] == ["my RV-M1", "second (my RV-M1)", "my RV-M1 (2)"]
    assert original_name(third) == "rv-m1"
    assert len(titles) == len(set(titles))


def test_what_cannot_be_saved_keeps_its_name(session, tmp_path):
    before = session.robot
    done, sentence = saved(session, tmp_path / "no folder" / "longarm.toml")
    assert not done
    assert "cannot be written" in sentence
    assert session.robot is before
