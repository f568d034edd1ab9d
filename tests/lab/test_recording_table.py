"""A recorded motion as a table: units in the head, empty cells where nothing is known."""

from __future__ import annotations

import csv
import io

import numpy as np

from rvsim.files import load_robot
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
    head, first, second = csv.reader(io.StringIO(text.split("\n", 1)[1]))
    assert head[0] == "time [s]"
    assert head[1] == "wanted base [deg]"
    assert head[-1] == "measured wrist rotate [deg]"
    assert [float(cell) for cell in second[1:6]] == [10.0, 80.0, -80.0, 5.0, -5.0]
    assert first[-5:] == [""] * 5
    assert [float(cell) for cell in second[-5:]] == [11.0, 81.0, -79.0, 6.0, -4.0]
