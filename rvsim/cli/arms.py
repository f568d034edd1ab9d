"""What an arm is and where its joints bring its tool: `robots`, `fk`, `jacobian`, `ik`."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from rvsim.cli.arguments import MM_NOTE, Command, add_arm, add_arm_and_joints, add_near, no_options
from rvsim.cli.outcome import DONE, FAILED, InputError
from rvsim.cli.output import number_row, print_result
from rvsim.cli.values import near_joints, typed_joints, typed_lengths, typed_numbers
from rvsim.files import example_names, load_robot, robot_names, user_robots
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_rpy, transform
from rvsim.units import radians_from_degrees

if TYPE_CHECKING:
    from rvsim.kinematics import InverseResult


def _add_pose_options(parser: argparse.ArgumentParser) -> None:
    add_arm(parser)
    parser.add_argument("--xyz-mm", required=True, metavar='"x,y,z"', help=f"where the tool should be {MM_NOTE}")
    parser.add_argument(
        "--rpy-deg", metavar='"roll,pitch,yaw"', help="how it should be turned: Rz(yaw) Ry(pitch) Rx(roll)"
    )
    parser.add_argument("--task", help='what of the pose counts, for instance "position"; the arm\'s own if not given')
    add_near(parser)


def _robots(options: argparse.Namespace) -> int:
    own = user_robots()
    robots = [*(load_robot(name) for name in (*robot_names(), *example_names())), *own.by_file.values()]
    name, title = (max(12, *map(len, words)) for words in zip(*((one.name, one.title) for one in robots), strict=True))
    lines = [f"{one.name:{name}} {one.dof} joints  {one.title:{title}}  {one.family}".rstrip() for one in robots]
    for problem in own.problems:
        print(f"rvsim: left out: {problem}", file=sys.stderr)
    print_result(options, [_robot_record(robot) for robot in robots], "\n".join(lines))
    return DONE


def _robot_record(robot: Robot) -> dict[str, Any]:
    from rvsim.lab.tables import length_unit, shown_joints

    return {
        "name": robot.name,
        "title": robot.title,
        "dof": robot.dof,
        "convention": robot.convention,
        "joint_names": robot.joint_names,
        "joint_types": robot.joint_types,
        "limits": shown_joints(robot, robot.limits.T).T,
        "home": shown_joints(robot, robot.home),
        "length_unit": length_unit(robot),
        "source": robot.source,
    }


def _fk(options: argparse.Namespace) -> int:
    from rvsim.lab.tables import pose_record

    robot = load_robot(options.arm)
    q = typed_joints(robot, "--deg", options.deg)
    T = forward_kinematics(robot, q)
    pose, outside = pose_record(robot, T), _outside(robot, q)
    record = {"robot": robot.name, **pose, "T_base_tool": T, "outside_limits": outside}
    text = f"{_place_text(robot, T)}\nroll, pitch, yaw: ({number_row(pose['rpy_deg'])})°"
    if outside:
        text += f"\nOutside its limits: {', '.join(outside)}."
    print_result(options, record, text)
    return DONE


def _place_text(robot: Robot, T: FloatArray) -> str:
    from rvsim.lab.tables import length_unit, shown_length

    place = shown_length(robot, T[:3, 3])
    return f"({number_row(place)}) mm" if length_unit(robot) == "mm" else f"({number_row(place, 3)}) units"


def _outside(robot: Robot, q: FloatArray) -> list[str]:
    from rvsim.experiment import limit_violations

    return [robot.joint_names[violation.joint] for violation in limit_violations(robot, q)]


def _jacobian(options: argparse.Namespace) -> int:
    robot = load_robot(options.arm)
    J = jacobian(robot, typed_joints(robot, "--deg", options.deg))
    sigma = np.linalg.svd(J, compute_uv=False)
    rounded = np.round(J, 5) + 0.0  # no −0.00000
    rows = (
        f"{name:3} {'  '.join(f'{value:9.5f}' for value in row)}" for name, row in zip(_TWIST, rounded, strict=True)
    )
    length = "m" if robot.length_unit == "millimetre" else "unit"
    text = "\n".join([_JACOBIAN_HEADER.format(length), *rows, f"smallest singular value {sigma[-1]:.3e}"])
    print_result(options, {"robot": robot.name, "J": J + 0.0, "sigma_min": sigma[-1]}, text)
    return DONE


_JACOBIAN_HEADER = "linear rows in {0}/rad ({0}/{0}), angular rows in rad/rad (rad/{0}); base axes, at the tool origin"
_TWIST = ("vx", "vy", "vz", "wx", "wy", "wz")


def _ik(options: argparse.Namespace) -> int:
    from rvsim.kinematics import forward_kinematics, inverse_kinematics, inverse_tasks
    from rvsim.lab.tables import inverse_record

    robot = load_robot(options.arm)
    task = options.task
    if options.rpy_deg is None and task is None:
        task = next((name for name in inverse_tasks(robot) if name in _PLACE_TASKS), None)
        if task is None:
            raise InputError(f"{robot.title} needs an orientation as well: --rpy-deg roll,pitch,yaw.")
    near = near_joints(robot, options)
    rotation = forward_kinematics(robot, near)[:3, :3]  # what is not asked for stays as it is, where it can
    if options.rpy_deg is not None:
        rpy_deg = typed_numbers("--rpy-deg", options.rpy_deg, ("roll", "pitch", "yaw"), 3 * ["deg"])
        rotation = rotation_from_rpy(radians_from_degrees(rpy_deg))
    place = typed_lengths(robot, "--xyz-mm", options.xyz_mm, "xyz")
    assert place is not None  # the option is required
    result = inverse_kinematics(robot, transform(rotation, place), task=task, near=near)
    print_result(options, inverse_record(robot, result), _inverse_text(robot, result))
    return DONE if result.failure is None else FAILED


_PLACE_TASKS = ("position", "x,y")


def _inverse_text(robot: Robot, result: InverseResult) -> str:
    from rvsim.lab.tables import shown_joints

    width = max((len(branch.label) for branch in result.branches), default=0)
    lines = [
        f"{branch.label:{width}}  ({number_row(shown_joints(robot, branch.q))})  "
        f"{'within the limits' if branch.within_limits else 'outside the limits'}  residual {branch.residual:.1e}"
        for branch in result.branches
    ]
    return "\n".join([*lines, *([] if result.failure is None else [result.failure.reason])])


COMMANDS = (
    Command("robots", _robots, "list the arms", no_options),
    Command("fk", _fk, "where the tool is", add_arm_and_joints),
    Command("jacobian", _jacobian, "how the tool moves with the joints", add_arm_and_joints),
    Command("ik", _ik, "which joints bring the tool to a pose", _add_pose_options),
)
