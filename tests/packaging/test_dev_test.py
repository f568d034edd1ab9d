"""What the checks say at the end: nothing that failed or was left out is passed over in silence."""

from __future__ import annotations

import pytest

GOOD, FAILED, EMPTY = 0, 1, 5


@pytest.mark.parametrize(
    ("lint", "off_screen", "opengl", "selected", "status"),
    [
        (GOOD, GOOD, GOOD, False, GOOD),
        (FAILED, GOOD, GOOD, False, FAILED),
        (GOOD, FAILED, GOOD, False, FAILED),
        (GOOD, GOOD, EMPTY, False, EMPTY),
        (GOOD, GOOD, EMPTY, True, GOOD),
        (GOOD, EMPTY, FAILED, True, FAILED),
        (GOOD, EMPTY, EMPTY, True, EMPTY),
    ],
)
def test_the_whole_is_good_only_if_every_leg_is(
    lint: int, off_screen: int, opengl: int, selected: bool, status: int
) -> None:
    from dev_test import Outcome, exit_status

    tested = [Outcome("tests off-screen", off_screen), Outcome("tests with OpenGL", opengl)]
    assert exit_status([Outcome("ruff", lint)], tested, selected=selected) == status


def test_the_summary_is_one_line_that_says_what_failed_and_what_was_left_out() -> None:
    from dev_test import Outcome, summary

    line = summary([Outcome("mypy", 1), Outcome("tests off-screen", 5)], selected=False, has_opengl_leg=False)
    assert line == "mypy: FAILED (1) | tests off-screen: FAILED, no tests found | OpenGL tests: on Linux only"
    selection = summary([Outcome("tests off-screen", 0)], selected=True, has_opengl_leg=True)
    assert selection == "tests off-screen: ok | linters and coverage: only without arguments"
