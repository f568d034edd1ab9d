"""The paths that have names are the sources' own, number by number."""

from __future__ import annotations

import json
from pathlib import Path as FilePath

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.errors import UnknownNameError
from rvsim.kinematics import forward_kinematics
from rvsim.lab import named_path, path_entry, path_names
from rvsim.lab.orientations import down_rotation

ORACLE = json.loads((FilePath(__file__).parents[1] / "oracles" / "oracle.json").read_text())["trajectories"]


def points_of(key: str) -> np.ndarray:
    return np.array([point["p"] if isinstance(point, dict) else point for point in ORACLE[key]["points"]])


@pytest.mark.parametrize(
    ("name", "robot", "key", "every"),
    [
        ("letter-raw", "rv-m1", "rvm1_D_program9", 1),
        ("letter-flat", "rv-m1", "rvm1_D_horizontal", 1),
        ("ellipse", "ur5e", "ur5e_ellipse", 1),
        ("spiral", "rrrp", "rrrp_path", None),
    ],
)
def test_points_are_those_of_the_oracle(name: str, robot: str, key: str, every: int | None) -> None:
    path, wanted = named_path(name, load_robot(robot)), points_of(key)
    found = path.points if every else path.points[:: (path.samples - 1) // (len(wanted) - 1)]
    assert np.allclose(found, wanted, atol=1e-13)


def test_the_letter_is_scaled_and_placed_as_documented() -> None:
    robot, curve = load_robot("rv-m1"), ORACLE["D_spline_raw"]
    x, y = np.array(curve["xx"]), np.array(curve["yy"])
    scaled = named_path("letter-scaled", robot, height=0.25).points
    assert np.allclose(scaled, np.column_stack([x / 400, y / 400, np.full(50, 0.25)]))
    board = named_path("letter-board", robot).points
    upright = np.column_stack([np.full(50, 3.4), (x - 25.55) / 40, 1.8 + (y - 34.75) / 40]) / 10
    assert np.allclose(board, upright, atol=1e-13)


def test_orientations_are_those_of_the_sources_unless_asked_otherwise() -> None:
    ur5e, rv_m1 = load_robot("ur5e"), load_robot("rv-m1")
    ellipse = named_path("ellipse", ur5e)
    assert ellipse.rotations is not None
    assert np.allclose(ellipse.rotations, ORACLE["ur5e_ellipse"]["orientation"], atol=1e-12)
    board = named_path("letter-board", rv_m1)
    assert board.rotations is not None
    assert np.allclose(board.rotations[:, 2, 2], 0.0)
    flat = named_path("letter-flat", rv_m1)
    assert flat.rotations is not None
    assert np.array_equal(flat.rotations[7], np.diag([1.0, -1.0, -1.0]))
    assert named_path("letter-flat", rv_m1, orientation="free").rotations is None
    assert named_path("star", load_robot("rrrp"), orientation="source").rotations is None
    assert named_path("line", load_robot("articulated"), orientation="down").rotations is None


def test_keep_keeps_the_orientation_of_the_pose_and_turns_with_a_5r_arms_waist() -> None:
    for name in ("ur5e", "rv-m1"):
        robot = load_robot(name)
        q = np.array([0.4, 0.3, -0.8, 0.2, 0.7, 0.1])[: robot.dof]
        T = forward_kinematics(robot, q)
        turned = T[:3, 3] * (0.5, -1.0, 1.0)
        path = named_path("line", robot, orientation="keep", start=T[:3, 3], end=turned, q=q)
        assert path.rotations is not None
        assert np.allclose(path.rotations[0], T[:3, :3])
        assert np.allclose(path.rotations[-1][2], T[2, :3])
        assert np.allclose(path.rotations[-1], T[:3, :3]) == (name == "ur5e")


def test_samples_ends_and_names() -> None:
    robot = load_robot("rv-m1")
    line = named_path("line", robot, samples=7, start=(0.3, 0.0, 0.2), end=(0.3, 0.1, 0.2))
    assert line.samples == 7
    assert np.array_equal(line.points[[0, -1]], [[0.3, 0.0, 0.2], [0.3, 0.1, 0.2]])
    assert named_path("letter-flat", robot, samples=200).samples == 200
    assert "letter-board" in path_names(robot)
    assert "ellipse" not in path_names(robot)
    assert all(path_entry(name).title and path_entry(name).citation for name in path_names())
    with pytest.raises(UnknownNameError, match="Did you mean 'letter-flat'"):
        named_path("leter-flat", robot)
    with pytest.raises(UnknownNameError, match="No orientation 'up'"):
        named_path("line", robot, orientation="up")  # type: ignore[arg-type]


def test_tool_down_is_down_for_every_arm_and_as_its_wrist_is_made() -> None:
    for name in ("rv-m1", "rv-1a", "ur5e", "al5b", "scara"):
        assert down_rotation(load_robot(name))[2, 2] == -1.0
    assert np.array_equal(down_rotation(load_robot("rv-m1")), np.diag([1.0, -1.0, -1.0]))
    assert np.array_equal(down_rotation(load_robot("al5b")), np.diag([-1.0, 1.0, -1.0]))
