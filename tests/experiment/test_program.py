"""Edits of programs: each gives the program that a list would be, and leaves the one before as it was."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rvsim.experiment.program import Program, Wait, duplicated, inserted, removed, replaced, shifted

programs = st.lists(st.integers(0, 99).map(lambda s: Wait(float(s))), min_size=1, max_size=8).map(tuple)


@given(programs, st.data())
def test_edits_are_those_of_a_list(program: Program, data: st.DataObject) -> None:
    index = data.draw(st.integers(0, len(program) - 1))
    before, new = program, Wait(1000.0)
    as_list = list(program)
    as_list.insert(index, new)
    assert inserted(program, index, new) == tuple(as_list)
    assert removed(inserted(program, index, new), index) == program
    assert replaced(program, index, new)[index] == new
    assert duplicated(program, index)[index : index + 2] == (program[index],) * 2
    assert program is before


@given(programs, st.data())
def test_a_shifted_move_goes_as_far_as_there_are_places_and_back(program: Program, data: st.DataObject) -> None:
    index = data.draw(st.integers(0, len(program) - 1))
    by = data.draw(st.integers(-10, 10))
    goal = min(max(index + by, 0), len(program) - 1)
    there = shifted(program, index, by)
    assert there[goal] == program[index]
    assert shifted(there, goal, index - goal) == program
