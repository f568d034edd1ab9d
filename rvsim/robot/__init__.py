"""What an arm is: DH rows, joints, limits, tools, shapes, masses. Values only; no disk, no units, no algorithms."""

from rvsim.robot.robot import Convention, Datum, Gripper, Joint, JointType, LinkMass, Robot, Tool
from rvsim.robot.servo import GripperServo, Servo
from rvsim.robot.shape import BoxShape, CapsuleShape, Shape

__all__ = [
    "BoxShape",
    "CapsuleShape",
    "Convention",
    "Datum",
    "Gripper",
    "GripperServo",
    "Joint",
    "JointType",
    "LinkMass",
    "Robot",
    "Servo",
    "Shape",
    "Tool",
]
