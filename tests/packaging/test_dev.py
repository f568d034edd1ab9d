"""The door: which Pythons are let in, and what the others are told."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest


@pytest.mark.parametrize("version", [(3, 11), (3, 12), (4, 0)])
def test_a_new_enough_python_is_let_in(version: tuple[int, int]) -> None:
    import dev

    assert dev.refusal(version, None) is None


def test_an_old_python_is_told_what_it_is_what_is_needed_and_what_to_type() -> None:
    import dev

    sentence = dev.refusal((3, 9), "python3.13")
    assert sentence is not None
    for part in ("Python 3.11", "Python 3.9", "python3.13 packaging/dev.py run"):
        assert part in sentence


def test_an_old_python_can_read_the_door() -> None:
    import dev

    ast.parse(Path(str(dev.__file__)).read_text(encoding="utf-8"), feature_version=(3, 6))


def test_the_help_names_every_command() -> None:
    import dev
    import dev_commands

    assert [line.split()[0] for line in dev.USAGE.splitlines() if line.startswith("  ")] == [*dev_commands.COMMANDS]
