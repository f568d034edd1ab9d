"""Program files: what is written reads back, and a mistake is named with line and key."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.errors import ProgramFileError
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.files.program_file import load_program, program_of, program_text, save_program

ROBOTS = {name: load_robot(name) for name in ("rv-m1", "scara", "planar")}
share = st.integers(1, 100).map(lambda percent: percent / 100.0)
length = st.floats(-3.0, 3.0)
triple = st.tuples(length, length, length)
tool = st.sampled_from(["keep", "turn", "free"])
seconds = st.floats(0.0, 100.0)


def moves(dof: int) -> st.SearchStrategy[Move]:
    q = st.tuples(*[length] * dof)
    return st.one_of(
        st.builds(JointMove, q, st.just(""), share),
        st.builds(JointMove, st.just(()), st.text("abc é\"'", min_size=1).map(str.strip).filter(bool), share),
        st.builds(LineMove, triple, tool, triple, share),
        st.builds(ArcMove, triple, triple, tool, triple, share),
        st.builds(Wait, seconds),
        st.builds(Gripper, share, seconds),
    )


def flat(move: Move) -> list[object]:
    return [item for value in vars(move).values() for item in (value if isinstance(value, tuple) else (value,))]


def named_program(name: str) -> st.SearchStrategy[tuple[str, list[Move]]]:
    return st.tuples(st.just(name), st.lists(moves(ROBOTS[name].dof)))


@given(st.sampled_from(sorted(ROBOTS)).flatmap(named_program))
def test_a_program_reads_back_as_it_was(made: tuple[str, list[Move]]) -> None:
    name, program = made
    again = program_of(program_text(tuple(program), ROBOTS[name]), ROBOTS[name], "p.toml")
    assert [type(move) for move in again] == [type(move) for move in program]
    for before, after in zip(program, again, strict=True):
        for one, other in zip(flat(before), flat(after), strict=True):
            assert one == other if isinstance(one, str) else one == pytest.approx(other, rel=1e-14, abs=1e-300)


def test_a_file_is_written_in_degrees_and_millimetres_and_read_from_disk(tmp_path: Path) -> None:
    robot = ROBOTS["rv-m1"]
    program = (JointMove(tuple(np.radians([10, 20, -30, 0, 0]))), LineMove((0.1, -0.05, 0.3), speed=0.25), Wait(2.0))
    save_program(program, robot, tmp_path / "p.toml")
    text = (tmp_path / "p.toml").read_text(encoding="utf-8")
    assert "joints = [10, 20, -30, 0, 0]" in text
    assert "to = [100, -50, 300]" in text
    assert "speed = 25" in text
    again = load_program(tmp_path / "p.toml", robot)
    assert again[1:] == program[1:]
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == ["p.toml"]


@pytest.mark.parametrize(
    ("text", "where", "found"),
    [
        ("version = 2\n", "line 1, key 'version'", "2"),
        ("version = 1\n[[move]]\nkind = 'jump'\n", "line 3, move 1, key 'kind'", "jump"),
        ("version = 1\n[[move]]\nkind = 'wait'\n", "line 2, move 1, key 'seconds'", "nothing"),
        ("version = 1\n[[move]]\nkind = 'wait'\nsecond = 1\n", "line 4, move 1, key 'second'", "unknown"),
        (
            "version = 1\n[[move]]\nkind='wait'\nseconds=1\n[[move]]\nkind = 'line'\nto = [1, 'x', 3]\n",
            "line 7, move 2, key 'to', y",
            "'x'",
        ),
        ("version = 1\n[[move]]\nkind = 'joint'\njoints = [1, 2]\n", "line 4, move 1, key 'joints'", "2 numbers"),
        ("version = 1\n[[move]]\nkind = 'joint'\n", "line 2, move 1", "neither"),
        ("version = 1\nmove = 3\n", "move", "3"),
        ("version = \n", "line 1, column 11", "mistake"),
        ("", "key 'version'", "nothing"),
    ],
)
def test_a_spoilt_file_names_its_line_and_key(text: str, where: str, found: str) -> None:
    with pytest.raises(ProgramFileError) as refused:
        program_of(text, ROBOTS["rv-m1"], "p.toml")
    assert refused.value.where == where
    assert found in str(refused.value)


def test_a_file_that_is_not_there_says_so(tmp_path: Path) -> None:
    with pytest.raises(ProgramFileError, match="There is no file"):
        load_program(tmp_path / "none.toml", ROBOTS["rv-m1"])
