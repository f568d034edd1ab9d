"""The disk: robot files, the user's folder."""

from rvsim.files.robot_file import example_names, load_robot, robot_names, save_robot
from rvsim.files.robot_writer import robot_text
from rvsim.files.user_arms import UserRobots, named_after, open_robot, user_robots
from rvsim.files.user_folder import find_user_folder, user_folder, user_robot_files, user_robot_path

__all__ = [
    "UserRobots",
    "example_names",
    "find_user_folder",
    "load_robot",
    "named_after",
    "open_robot",
    "robot_names",
    "robot_text",
    "save_robot",
    "user_folder",
    "user_robot_files",
    "user_robot_path",
    "user_robots",
]
