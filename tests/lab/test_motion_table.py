"""A motion as CSV: units in the header, the same numbers in SI and on the screen, and it can be read back."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.lab.motion_table import motion_csv
from rvsim.motion import joint_move
from rvsim.playback.curves import Curves, curves_of


def moving(name: str) -> Curves:
    robot = load_robot(name)
    return curves_of(robot, joint_move(robot, robot.home, robot.home + 0.2), samples=9)


def parsed(text: str) -> tuple[list[str], np.ndarray]:
    rows = list(csv.reader(io.StringIO("".join(text.splitlines(keepends=True)[1:]))))
    return rows[0], np.array(rows[1:], dtype=float)


@pytest.mark.parametrize("name", ["rv-m1", "scara", "rrrp"])
def test_si_is_exact_and_the_screen_differs_by_its_units_alone(name: str) -> None:
    curves = moving(name)
    n = curves.robot.dof
    header, si = parsed(motion_csv(curves, "si"))
    assert len(header) == si.shape[1] == 1 + 3 * n + 6
    np.testing.assert_array_equal(si[:, 1 : 1 + n], curves.q)
    np.testing.assert_array_equal(si[:, 1 + 2 * n : 1 + 3 * n], curves.qdd)
    np.testing.assert_array_equal(si[:, -6:-3], curves.place)
    names, screen = parsed(motion_csv(curves))
    factors = {"deg": 180 / np.pi, "mm": 1e3, "s": 1.0, "unit": 1.0}
    scale = [factors[name.partition("[")[2].rstrip("]").split("/")[0]] for name in names]
    np.testing.assert_allclose(screen, si * scale, rtol=1e-14, atol=1e-300)


def test_the_header_names_each_column_with_its_unit() -> None:
    text = motion_csv(moving("rv-m1"))
    assert "q1 = waist" in text.splitlines()[0]
    header, _ = parsed(text)
    assert header[:2] == ["t [s]", "q1 [deg]"]
    assert {"qd5 [deg/s]", "qdd5 [deg/s^2]", "x [mm]", "yaw [deg]"} <= set(header)
    assert parsed(motion_csv(moving("rrrp"), "si"))[0][-4] == "z [unit]"
