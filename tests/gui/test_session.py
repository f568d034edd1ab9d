"""The owner of the experiment: what is one undo step, what is refused, and that nothing is held on to."""

from __future__ import annotations

import gc

import numpy as np
import pytest

from rvsim.experiment import Experiment
from rvsim.files import load_robot
from rvsim.gui.session import Session
from rvsim.lab.lines import default_experiment

READY = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def session(qtbot: object) -> Session:
    return Session(default_experiment(load_robot("rv-m1")), default_experiment)


def turn_waist(session: Session, degrees: float) -> None:
    q = np.array(session.q)
    q[0] = np.radians(degrees)
    session.move_to(q, "Move waist", merge="joint 0")


def test_a_stroke_is_one_undo_step_and_the_next_stroke_another(session: Session) -> None:
    for degrees in range(1, 30):
        turn_waist(session, degrees)
    session.end_stroke()
    turn_waist(session, 50.0)
    assert session.undo_stack.count() == 2
    session.undo_stack.undo()
    assert session.q[0] == np.radians(29.0)
    session.undo_stack.undo()
    assert session.q[0] == 0.0
    session.undo_stack.redo()
    assert session.q[0] == np.radians(29.0)


def test_after_an_undo_the_same_stroke_begins_anew(session: Session) -> None:
    turn_waist(session, 10.0)
    session.end_stroke()
    turn_waist(session, 20.0)
    session.undo_stack.undo()
    turn_waist(session, 30.0)
    session.undo_stack.undo()
    assert session.q[0] == np.radians(10.0)


def test_a_pose_outside_the_limits_is_refused_with_a_sentence(session: Session) -> None:
    said: list[tuple[str, str]] = []
    session.said.connect(lambda text, level: said.append((text, level)))
    assert not session.move_to(np.radians([0.0, 0.0, 90.0, 0.0, 0.0]), "Go")
    assert session.undo_stack.count() == 0
    assert "elbow" in said[-1][0]
    assert said[-1][1] == "warning"


def test_a_long_stroke_holds_on_to_no_pose_between(session: Session) -> None:
    turn_waist(session, 1.0)
    gc.collect()
    before = sum(isinstance(thing, Experiment) for thing in gc.get_objects())
    for number in range(500):
        turn_waist(session, number % 90)
    gc.collect()
    assert sum(isinstance(thing, Experiment) for thing in gc.get_objects()) <= before + 1


def test_an_arm_is_found_as_it_was_left(session: Session) -> None:
    rv_m1 = session.robot
    session.move_to(READY, "Go")
    session.use_robot(load_robot("ur5e"))
    session.use_robot(rv_m1)
    np.testing.assert_array_equal(session.q, READY)
