"""The exported script needs NumPy alone and comes to the same numbers."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot
from rvsim.errors import ShapeError
from rvsim.lab import named_path
from rvsim.lab.script import motion_script, tracking_script
from rvsim.motion import joint_move, track, trajectory_of
from rvsim.robot import Robot

# Whatever is imported beside NumPy and what it needs itself ends the script.
_GUARD = """
import sys
class Guard:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("rvsim", "scipy", "PySide6", "ruckig"):
            raise ImportError(name)
sys.meta_path.insert(0, Guard())
"""


def run(script: str, folder: Path) -> tuple[np.ndarray, dict[str, float]]:
    file = folder / "motion.py"
    file.write_text(_GUARD + script, encoding="utf-8")
    done = subprocess.run([sys.executable, "-I", str(file)], capture_output=True, text=True, check=True, timeout=60)
    header, *lines = done.stdout.splitlines()
    rows = [line.split(",") for line in lines]
    table = [[float(cell) for cell in row] for row in rows if len(row) == len(header.split(","))]
    return np.array(table), {row[0].split(" ")[0]: float(row[1]) for row in rows if len(row) == 2}


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "rrrp", "cylindrical"])
def test_the_script_of_a_motion_has_the_same_tool_points(name: str, tmp_path: Path) -> None:
    robot = load_robot(name)
    motion = joint_move(robot, robot.home, robot.home + 0.3)
    times = np.linspace(0.0, motion.duration, 12)
    table, totals = run(motion_script(robot, times, motion.q(times)), tmp_path)
    points = forward_kinematics(robot, motion.q(times))[:, :3, 3]
    np.testing.assert_allclose(table[:, 0], times, atol=1e-12)
    np.testing.assert_allclose(table[:, 1:], points, atol=1e-12)
    assert totals["way"] == pytest.approx(np.linalg.norm(np.diff(points, axis=0), axis=1).sum(), abs=1e-12)


def test_the_script_of_a_tracked_path_has_the_same_deviation(tmp_path: Path) -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, named_path("letter-scaled", robot))
    assert not tracking.complete
    motion = trajectory_of(tracking, robot.home)
    table, totals = run(tracking_script(tracking, motion), tmp_path)
    assert motion.path_start <= table[0, 0] < table[-1, 0] <= motion.duration
    assert (np.diff(table[:, 0]) > 0.0).all()
    np.testing.assert_allclose(motion.q(table[:, 0]), tracking.q[tracking.reached], atol=1e-9)
    np.testing.assert_allclose(table[:, 1:4], tracking.actual[tracking.reached], atol=1e-12)
    assert totals["rms"] == pytest.approx(tracking.rms, abs=1e-12)
    assert totals["max"] == pytest.approx(tracking.max_deviation, abs=1e-12)


def test_what_is_printed_has_its_units_and_points_without_a_motion_are_numbered(tmp_path: Path) -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, named_path("letter-scaled", robot))
    script = tracking_script(tracking, joint_move(robot, robot.home, robot.home + 0.1))
    table, _ = run(script, tmp_path)
    assert table[:, 0].tolist() == np.flatnonzero(tracking.reached).tolist()
    assert '"point", "x [m]"' in script
    assert '"t [s]", "x [m]"' in tracking_script(tracking, trajectory_of(tracking, robot.home))
    unitless = load_robot("rrrp")
    assert unitless.length_unit == "unit"
    assert '"t [s]", "x [unit]"' in motion_script(unitless, [0.0], unitless.home[None])


def craig(robot: Robot) -> Robot:
    return replace(robot, convention="modified")


def test_craigs_convention_and_odd_names_are_written_too(tmp_path: Path) -> None:
    robot = craig(load_robot("planar")).renamed("odd", 'an """odd""" \\ arm')
    q = np.linspace(0.1, 0.9, 2 * robot.dof).reshape(2, -1)
    table, _ = run(motion_script(robot, [0.0, 1.0], q), tmp_path)
    np.testing.assert_allclose(table[:, 1:], forward_kinematics(robot, q)[:, :3, 3], atol=1e-12)


def test_a_motion_without_poses_is_refused() -> None:
    robot = load_robot("planar")
    with pytest.raises(ShapeError):
        motion_script(robot, [], np.empty((0, robot.dof)))
