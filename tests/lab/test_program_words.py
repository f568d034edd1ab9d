"""Moves in words: places in the units of the screen, and a reason for whatever cannot be done."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.lab.program_words import move_words, plan_sentence
from rvsim.lab.sentences import Units
from rvsim.motion.program import plan_program

RVM1 = load_robot("rv-m1")
TURNED = tuple(np.radians([10.0, 20.0, -30.0, 0.0, 0.0]))


@pytest.mark.parametrize(
    ("move", "words"),
    [
        (JointMove(pose="home"), "joints to “home”, 50 %"),
        (JointMove(TURNED, speed=1.0), "joints to (10°, 20°, −30°, 0°, 0°), 100 %"),
        (JointMove((*TURNED[:4], 0.5)), "joints to (10.0°, 20.0°, −30.0°, 0.0°, 28.6°), 50 %"),
        (LineMove((0.3, -0.1, 0.2), "free"), "line to (300.0, −100.0, 200.0) mm, tool free, 50 %"),
        (ArcMove((0.3, 0, 0.3), (0.3, 0.1, 0)), "arc over (300.0, 0.0, 300.0) mm to (300.0, 100.0, 0.0) mm, 50 %"),
        (Wait(1.5), "wait 1.5 s"),
        (Gripper(0.0), "close the gripper"),
        (Gripper(0.25), "gripper 25 % open"),
    ],
)  # fmt: skip
def test_a_move_is_one_line(move: Move, words: str) -> None:
    assert move_words(move, RVM1).replace("\N{NO-BREAK SPACE}%", " %") == words
    assert " %" not in move_words(move, RVM1)  # a line of the list must not break there


def test_other_units_and_arms_without_one() -> None:
    words = move_words(LineMove((0.3, 0.0, 0.2)), RVM1, Units("rad", "m"))
    assert words == "line to (0.300, 0.000, 0.200) m, 50\N{NO-BREAK SPACE}%"
    assert "units" in move_words(LineMove((1.0, 0.0, 2.0)), load_robot("rrrp"))


@pytest.mark.parametrize(
    ("move", "why"),
    [
        (JointMove(pose="gone"), "No pose is remembered as “gone”"),
        (JointMove((9.0, 0.0, 0.0, 0.0, 0.0)), "The waist would go to 515.7° and stops at 150°"),
        (JointMove((1.0,)), "an arm with other joints"),
        (LineMove((3.0, 0.0, 0.2)), "out of reach"),
    ],
)
def test_what_cannot_be_done_has_a_reason(move: Move, why: str) -> None:
    plan = plan_program(RVM1, RVM1.home, [Wait(), move, Wait()])
    sentence = plan_sentence(plan)
    assert sentence.startswith("Move 2 of 3 cannot be done.")
    assert why in sentence


def test_a_program_that_can_be_done_says_how_long_it_takes() -> None:
    assert plan_sentence(plan_program(RVM1, RVM1.home, [Wait(1.5), Wait(2.0)])) == "All 2 moves can be done, in 3.5 s."
    assert plan_sentence(plan_program(RVM1, RVM1.home, ())).startswith("No move yet")
