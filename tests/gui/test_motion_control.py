"""The player of the window, in virtual time: moments are shown, one undo step leads back, others may take over."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim.files import load_robot
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.lab.lines import default_experiment
from rvsim.motion import joint_move

GOAL = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def session(qtbot: object) -> Session:
    return Session(default_experiment(load_robot("rv-m1")), default_experiment)


@pytest.fixture
def motion(session: Session) -> MotionControl:
    control = MotionControl(session, Preferences())
    control.load(joint_move(session.robot, session.q, GOAL), "Go")
    return control


def test_a_motion_that_ran_to_its_end_is_one_undo_step(session: Session, motion: MotionControl) -> None:
    motion.play()
    for _ in range(1000):
        motion.advance(0.05)
    assert motion.player.state == "finished"
    np.testing.assert_array_equal(session.q, GOAL)
    assert session.undo_stack.count() == 1
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, np.zeros(5))
    session.undo_stack.redo()
    np.testing.assert_array_equal(session.q, GOAL)


def test_stop_goes_back_to_the_beginning_and_leaves_no_undo_step(session: Session, motion: MotionControl) -> None:
    motion.play()
    motion.advance(0.2)
    assert not np.array_equal(session.q, np.zeros(5))
    motion.stop()
    np.testing.assert_array_equal(session.q, np.zeros(5))
    assert session.undo_stack.count() == 0


def test_a_hand_on_a_joint_holds_the_motion(session: Session, motion: MotionControl) -> None:
    motion.play()
    motion.advance(0.2)
    session.move_to(np.radians([10.0, 0.0, -5.0, 0.0, 0.0]), "Move waist")
    assert motion.player.state == "paused"
    motion.advance(1.0)
    np.testing.assert_allclose(np.degrees(session.q), [10.0, 0.0, -5.0, 0.0, 0.0])


def test_undo_while_it_plays_goes_back_to_its_beginning_and_holds_it(session: Session, motion: MotionControl) -> None:
    begin = np.radians([10.0, 0.0, -5.0, 0.0, 0.0])
    session.move_to(begin, "Move waist")
    motion.play()
    motion.advance(0.2)
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, begin)
    assert motion.player.state == "paused"
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, np.zeros(5))


def test_an_edit_while_it_plays_leaves_a_way_back_to_its_beginning(session: Session, motion: MotionControl) -> None:
    motion.play()
    motion.advance(0.2)
    session.edit("Ignore limits", replace(session.experiment, ignore_limits=True))
    for _ in range(2):
        session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, np.zeros(5))
    assert not session.undo_stack.canUndo()


def test_another_arm_takes_the_motion_out(session: Session, motion: MotionControl) -> None:
    session.use_robot(load_robot("ur5e"))
    assert motion.player.trajectory is None
    assert session.q.shape == (6,)
    session.undo_stack.undo()
    assert session.robot.name == "rv-m1"


def test_scrubbing_shows_each_moment(session: Session, motion: MotionControl) -> None:
    half = motion.player.duration / 2
    motion.seek(half)
    np.testing.assert_allclose(session.q, GOAL / 2, atol=1e-12)


def test_scrubbing_to_and_fro_pausing_and_playing_on_are_one_undo_step(session: Session, motion: MotionControl) -> None:
    for time in (0.1, 0.3, 0.2):
        motion.seek(time)
    motion.play()
    motion.advance(0.1)
    motion.pause()
    assert session.undo_stack.count() == 1
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, np.zeros(5))


def test_undo_and_redo_show_the_moment_of_the_pose_that_they_lead_to(session: Session, motion: MotionControl) -> None:
    times = []
    for time in (0.11, 0.33, 0.52):
        motion.seek(time)
        times.append(time)
        session.undo_stack.setClean()  # it has been saved: what follows is another step
    for time in reversed(times[:-1]):
        session.undo_stack.undo()
        assert motion.player.time == time
        np.testing.assert_array_equal(motion.player.q, session.q)
    session.undo_stack.redo()
    assert motion.player.time == times[1]


def test_a_pose_that_comes_from_elsewhere_is_found_in_the_motion(session: Session, motion: MotionControl) -> None:
    session.move_to(motion.player.trajectory.q(0.4), "Recall the pose")
    assert motion.player.time == pytest.approx(0.4)
    session.move_to(np.radians([10.0, 0.0, -5.0, 0.0, 0.0]), "Move waist")
    assert motion.player.time == pytest.approx(0.4), "the motion never passes that"
