"""A recording: what it says of two motions, and that it stays as it was and as small as it was."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot
from rvsim.errors import ShapeError
from rvsim.playback.recording import Recorder, Recording

T = np.linspace(0.0, 2.0, 201)


@pytest.fixture
def recording() -> Recording:
    desired = np.stack([np.sin(T + joint) for joint in range(5)], axis=1) * 0.3 + np.array([0.0, 1.5, -1.5, 0.0, 0.0])
    measured = desired + np.array([0.01, -0.02, 0.0, 0.03, 0.0])
    measured[::2] = np.nan
    return Recording(T, desired, desired + 0.001, measured, "encoders")


def test_errors_are_those_of_the_moments_that_are_known(recording) -> None:
    errors = recording.joint_errors()
    for found in (errors.rms, errors.max, errors.mean):
        assert found == pytest.approx([0.01, 0.02, 0.0, 0.03, 0.0], abs=1e-12)
    assert recording.joint_errors("commanded").rms == pytest.approx(np.full(5, 0.001))
    assert recording.measured_rows.tolist() == list(range(1, 201, 2))


def test_the_tools_error_is_the_distance_of_the_two_tools(recording) -> None:
    arm = load_robot("al5b")
    rows = recording.measured_rows
    places = [forward_kinematics(arm, q[rows])[:, :3, 3] for q in (recording.measured, recording.desired)]
    apart = np.linalg.norm(places[0] - places[1], axis=1)
    errors = recording.tool_errors(arm)
    assert float(errors.rms) == pytest.approx(np.sqrt(np.mean(apart**2)))
    assert float(errors.max) == pytest.approx(apart.max())
    assert float(errors.mean) == pytest.approx(apart.mean())
    assert np.isnan(recording.tool_path(arm, "measured")[::2]).all()


def test_nothing_measured_is_no_number_and_no_warning(recording) -> None:
    nothing = Recording(T, recording.desired, recording.commanded, np.full_like(recording.desired, np.nan))
    assert np.isnan(nothing.joint_errors().rms).all()
    assert np.isnan(nothing.tool_errors(load_robot("al5b")).rms)
    empty = Recorder(5).recording()
    assert empty.empty
    assert empty.duration == 0.0
    assert np.isnan(empty.joint_errors().max).all()


def test_arrays_that_do_not_fit_are_refused(recording) -> None:
    with pytest.raises(ShapeError):
        Recording(T[:-1], recording.desired, recording.commanded, recording.measured)
    with pytest.raises(ShapeError):
        Recording(T, recording.desired, recording.commanded[:, :4], recording.measured)


def test_a_snapshot_stays_as_it_was() -> None:
    recorder = Recorder(2)
    recorder.add(0.0, np.zeros(2), np.zeros(2))
    before = recorder.recording()
    recorder.add(1.0, np.ones(2), np.ones(2), np.ones(2))
    recorder.clear()
    assert before.t.tolist() == [0.0]
    assert not before.desired.flags.writeable


@pytest.mark.parametrize("count", [1, 7, 8, 9, 1000, 4097])
def test_a_long_motion_is_kept_as_a_whole_in_the_same_memory(count) -> None:
    recorder = Recorder(1, rows=8)
    for index in range(count):
        measured = np.array([float(index)]) if index % 2 else None
        recorder.add(float(index), np.array([float(index)]), np.array([0.0]), measured)
    kept = recorder.recording()
    assert len(recorder) <= 8
    assert kept.t[0] == 0.0
    assert kept.duration >= 0.4 * (count - 1)
    assert np.array_equal(kept.t, kept.desired[:, 0])
    assert (np.diff(kept.t) > 0.0).all()
    assert count == 1 or len(kept.measured_rows)


def test_moments_come_out_in_their_order() -> None:
    recorder = Recorder(1)
    for t in (0.0, 0.06, 0.04, 0.12):
        recorder.add(t, np.array([t]), np.array([t]))
    assert recorder.recording().t.tolist() == [0.0, 0.04, 0.06, 0.12]


def test_the_way_to_the_start_is_not_part_of_the_trajectory_and_a_stop_is_seen() -> None:
    q = np.zeros((5, 2))
    whole = Recording(np.array([-2.0, 0.0, 1.0, 2.0, 2.8]), q, q, q, planned=2.0).with_true(
        np.array([0.0, 2.0]), np.array([[0.0, 0.0], [1.0, 2.0]])
    )
    part = whole.on_trajectory()
    np.testing.assert_array_equal(part.t, [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(part.true, [[0.0, 0.0], [0.5, 1.0], [1.0, 2.0]])
    assert np.isnan(whole.true[[0, -1]]).all()
    assert whole.stopped_at is None
    assert Recording(whole.t, q, q, q, planned=4.0).stopped_at == 2.8
    assert Recording(whole.t, q, q, q).stopped_at is None
