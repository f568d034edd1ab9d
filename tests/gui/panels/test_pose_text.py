"""Which text is a whole pose, and which is one number."""

from __future__ import annotations

import pytest

from rvsim.gui.panels.pose_text import pose_values

DEGREES = ["°"] * 5


@pytest.mark.parametrize(
    "text",
    ["30, 40, -50, 20, 60", "30,40,-50,20,60", "30; 40; −50; 20; 60", "30\t40\t-50\t20\t60", "30 40 -50 20 60",
     "[30, 40, -50, 20, 60]", "(30,0; 40,0; -50,0; 20,0; 60,0)", " 30°, 40°, -50°, 20°, 60°\n",
     "30, 2*20, -50, 20, 60"],
)  # fmt: skip
def test_a_pose_is_read_however_it_is_separated(text: str) -> None:
    assert pose_values(text, DEGREES) == (30.0, 40.0, -50.0, 20.0, 60.0)


@pytest.mark.parametrize("text", ["", "30", "60,5", "30 °", "2 * 30", "pi/4 rad", "30 degrees", "abc, def", "30, x"])
def test_one_number_or_a_word_is_no_pose(text: str) -> None:
    assert pose_values(text, DEGREES) == ()


def test_each_joint_has_its_own_unit() -> None:
    assert pose_values("30 0.1m", ["°", "mm"]) == (30.0, 100.0)
    assert pose_values("1 2 3", ["°", "mm"]) == (1.0, 2.0, 3.0), "too many are counted, not lost"


def test_a_clipboard_full_of_numbers_is_no_pose() -> None:
    assert pose_values("1,5 " * 1_000_000, DEGREES) == ()
