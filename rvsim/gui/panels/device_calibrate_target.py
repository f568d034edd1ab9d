"""The pose of a step in the scene: a dashed arm with its name beside its hand."""

from __future__ import annotations

from rvsim.device.calibrate import Step
from rvsim.device.calibration.words import brief_words, number_words
from rvsim.device.words import axis_name
from rvsim.kinematics import forward_kinematics
from rvsim.language import tr, without_isolates
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.ghosts import Ghost, ghost_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Item, Label, Labels

_SHORT = 32  # letters
_SIZE = 15.0


def target_items(robot: Robot, step: Step, palette: ScenePalette) -> tuple[Item, ...]:
    """The arm as a step of a joint wants it; at an end the pose beyond which it is to go."""
    assert step.joint is not None
    name = pose_name(robot, step.joint, step.posture)
    text = name if step.value is not None else tr("on past: {pose}", pose=name)
    place = forward_kinematics(robot, step.posture)[:3, 3]
    label = Labels("calibrate.name", (Label(place, text, palette.text, (12.0, 14.0), _SIZE),))
    return (*ghost_items(robot, [Ghost("calibrate", "", step.posture, False)], palette), label)


def pose_name(robot: Robot, joint: int, q: FloatArray) -> str:
    """A few words to stand beside the pose q (n,) [rad, m]: "upper arm stands straight up", "wrist at 60°"."""
    words = brief_words(robot, joint, q)
    if words and len(without_isolates(words)) <= _SHORT:
        return words
    return tr("{joint} at {number}", joint=axis_name(robot, joint), number=number_words(robot, joint, q[joint]))
