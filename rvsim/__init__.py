"""rvsim: see, move, compute and understand a robot arm.

Radians, metres, seconds throughout; arrays are batch-first: q (..., n), T (..., 4, 4), J (..., 6, n).
The map of the house, from the ground up (each floor imports only floors below it):

    units, resources, errors, expressions    the ground
    spatial      rotations and transforms, no robots
    robot        what an arm is: DH rows, joints, limits, tools, shapes
    kinematics   where it is: forward, Jacobian, inverse
    dynamics     what it takes: torques that hold and move it, energies
    motion       where it goes and when: path, time law, tracking
    playback     which moment is shown
    experiment   the state a session stores, and the edits between states
    files        the disk
    scene        what is to be seen, no Qt
    lab          the experiments of the sources
    gui          the screen
    cli, __main__
"""

from rvsim.dynamics import gravity_torques, inverse_dynamics, joint_torques
from rvsim.files.robot_file import load_robot, robot_names
from rvsim.kinematics import (
    forward_kinematics,
    inverse_branches,
    inverse_kinematics,
    inverse_kinematics_batch,
    jacobian,
    link_transforms,
    singularity,
    solve_numeric,
    solve_numeric_batch,
)
from rvsim.robot import Robot

__version__ = "0.1.0"

__all__ = [
    "Robot",
    "__version__",
    "forward_kinematics",
    "gravity_torques",
    "inverse_branches",
    "inverse_dynamics",
    "inverse_kinematics",
    "inverse_kinematics_batch",
    "jacobian",
    "joint_torques",
    "link_transforms",
    "load_robot",
    "robot_names",
    "singularity",
    "solve_numeric",
    "solve_numeric_batch",
]
