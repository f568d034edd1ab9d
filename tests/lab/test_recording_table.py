"""A recorded motion as a table: units in the head, empty cells where nothing is known."""

from __future__ import annotations

import csv
import io

import numpy as np

from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics
from rvsim.lab.recording_table import recording_csv
from rvsim.playback.recording import Recording

AL5B = load_robot("al5b")


def test_every_moment_is_a_row_with_units_in_the_head() -> None:
    t = np.array([0.0, 0.5])
    desired = np.radians([[0, 90, -90, 0, 0], [10, 80, -80, 5, -5]])
    measured = np.full((2, 5), np.nan)
    measured[1] = desired[1] + np.radians(1.0)
    text = recording_csv(AL5B, Recording(t, desired, desired, measured, "encoders"))
    assert text.startswith("# measured: encoders\n")
    head, first, second = (row for row in csv.reader(io.StringIO(text)) if not row[0].startswith("#"))
    assert head[0] == "time [s]"
    assert head[1] == "wanted base [deg]"
    assert head[15] == "measured wrist rotate [deg]"
    assert head[16:19] == [f"wanted tool {letter} [mm]" for letter in "xyz"]
    assert head[-1] == "measured tool z [mm]"
    assert [float(cell) for cell in second[1:6]] == [10.0, 80.0, -80.0, 5.0, -5.0]
    assert first[11:16] == [""] * 5
    assert [float(cell) for cell in second[11:16]] == [11.0, 81.0, -79.0, 6.0, -4.0]
    tool = forward_kinematics(AL5B, measured[1])[:3, 3]
    np.testing.assert_allclose([float(cell) for cell in second[-3:]], 1e3 * tool, atol=1e-6)


def test_pulses_that_are_reported_are_not_called_measured_and_the_truth_of_a_virtual_arm_is_there() -> None:
    t = np.array([0.0, 0.5])
    q = np.tile(AL5B.home, (2, 1))
    recording = Recording(t, q, q, q, "commanded pulse", planned=3.0).with_true(t, q + 0.1)
    text = recording_csv(AL5B, recording)
    assert text.startswith("# reported: commanded pulse (no measurement")
    assert "# stopped at 0.5 of 3.0 s\n" in text
    assert "reported base [deg]" in text
    assert "really base [deg]" in text
    assert "measured" not in text
