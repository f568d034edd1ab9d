"""The disk: robot files."""

from rvsim.files.robot_file import load_robot, robot_names, save_robot
from rvsim.files.robot_text import robot_text

__all__ = ["load_robot", "robot_names", "robot_text", "save_robot"]
