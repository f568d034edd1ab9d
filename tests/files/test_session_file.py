"""Session files: the same numbers back, the same bytes again, and one clear error for everything else."""

from __future__ import annotations

import errno
import json
import os
import runpy
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim import load_robot, robot_names
from rvsim.errors import FileWriteError, SessionFileError
from rvsim.experiment import (
    SHAPE_KINDS,
    CameraView,
    DeviceSettings,
    Experiment,
    LineTask,
    Load,
    NamedPose,
    Notes,
    Placement,
    SessionState,
    TrackedFrom,
    TrajectoryTask,
    View,
)
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Program, Wait
from rvsim.experiment.shapes import Shape
from rvsim.files import robot_text
from rvsim.files.session_file import load_session, save_session, session_bytes, session_of
from rvsim.lab.lines import default_experiment
from rvsim.lab.shape_paths import shape_of
from rvsim.motion.trajectory import LAW_TITLES
from rvsim.robot import Robot
from rvsim.spatial import rotation_from_rpy, transform

# --- experiments of every kind -------------------------------------------------------------------------------------

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
SMALL = st.floats(-1e3, 1e3)
POINT = st.tuples(SMALL, SMALL, SMALL)
TEXT = st.text(st.characters(exclude_categories=("Cs",), exclude_characters="<"), max_size=30)
SPEED = st.floats(0.01, 1.0)


@st.composite
def robots(draw: st.DrawFn) -> Robot:
    """A built-in arm, one of its tools in use, or a copy with other numbers."""
    robot = load_robot(draw(st.sampled_from(robot_names())))
    robot = robot.with_tool(draw(st.sampled_from([tool.name for tool in robot.tools])))
    if draw(st.booleans()):
        joint = draw(st.integers(0, robot.dof - 1))
        length = draw(st.floats(0.01, 10.0))
        robot = robot.with_joint(joint, a=length, theta=draw(st.floats(-3.0, 3.0)))
        robot = robot.renamed(draw(st.sampled_from((robot.name, "my-arm"))), "My arm")
    return robot


@st.composite
def programs(draw: st.DrawFn, robot: Robot) -> Program:
    q = st.tuples(*[st.floats(-100.0, 100.0)] * robot.dof)
    turned = {"tool": st.sampled_from(("keep", "turn", "free")), "rpy": POINT.map(lambda rpy: tuple(np.divide(rpy, 9)))}
    moves = st.one_of(
        st.builds(JointMove, q=q, speed=SPEED),
        st.builds(JointMove, pose=st.just("a"), speed=SPEED),
        st.builds(LineMove, to=POINT, speed=SPEED, **turned),
        st.builds(ArcMove, via=POINT, to=POINT, speed=SPEED, **turned),
        st.builds(Wait, seconds=st.floats(0.0, 1e4)),
        st.builds(Gripper, opening=st.floats(0.0, 1.0), seconds=st.floats(0.0, 10.0)),
    )
    return tuple(draw(st.lists(moves, max_size=4)))


@st.composite
def trajectories(draw: st.DrawFn, robot: Robot) -> TrajectoryTask:
    kind = draw(st.sampled_from(sorted(SHAPE_KINDS)))
    shape: Shape | None = draw(st.sampled_from((None, shape_of(robot, TrajectoryTask(kind)))))
    place = Placement(np.array(draw(POINT)), np.array(draw(POINT)), draw(st.floats(1e-3, 1e3)))
    turn = draw(st.none() | POINT)
    orientation = draw(st.sampled_from(("down", "free", "keep", "source", "turn", "normal", "pitch")))
    placement = draw(st.sampled_from((None, place)))
    return TrajectoryTask(kind, orientation, draw(SMALL), shape, placement, turn, turn, draw(SMALL))


@st.composite
def experiments(draw: st.DrawFn) -> Experiment:
    robot = draw(robots())
    q = st.tuples(*[FLOATS] * robot.dof).map(np.array)
    names = draw(st.lists(TEXT.filter(bool), max_size=3, unique=True))
    target = transform(rotation_from_rpy(draw(POINT)), draw(POINT))
    return Experiment(
        robot,
        draw(q),
        LineTask(np.array(draw(POINT)), np.array(draw(POINT)), draw(st.floats(0.001, 1.0))),
        draw(trajectories(robot)),
        draw(st.booleans()),
        tuple(NamedPose(name, draw(q)) for name in names),
        draw(st.sampled_from((None, target))),
        draw(st.sampled_from(sorted(LAW_TITLES))),
        draw(st.none() | st.floats(0.0, 3600.0)),
        draw(programs(robot)),
        Load(np.array(draw(POINT) * 2), draw(st.sampled_from(("base", "tool"))), draw(st.floats(0.0, 1e4))),
        draw(st.booleans()),
        draw(st.none() | q),
    )


CAMERAS = st.builds(
    CameraView, SMALL, st.floats(-1.5, 1.5), st.floats(0.1, 2.0), st.booleans(), st.none() | POINT, st.none() | SPEED
)
STATES = st.builds(
    lambda experiment, left, notes, device, view, lifts: SessionState(
        replace(experiment, notes=notes),
        tuple(replace(one, notes=notes) for one in left),
        device,
        replace(view, tracked="line", tracked_from=TrackedFrom(experiment.q, -experiment.q, lifts)) if lifts else view,
    ),
    experiments(),
    st.lists(experiments(), max_size=1),
    st.builds(Notes, TEXT, TEXT),
    st.builds(DeviceSettings, TEXT, st.integers(1, 10**6), st.sampled_from(("ssc32", "bridge"))),
    st.builds(View, st.none() | CAMERAS, st.sampled_from(("stick", "both")), TEXT, SPEED, st.booleans()),
    st.lists(st.integers(1, 99), max_size=2).map(tuple),
)


def assert_same(found: Any, wanted: Any, where: str = "") -> None:
    """Two values with the same words and the same numbers, within 1e-12."""
    if isinstance(wanted, Robot):
        assert_same(tomllib.loads(robot_text(found)), tomllib.loads(robot_text(wanted)), where)
    elif isinstance(wanted, dict):
        assert list(found) == list(wanted), where
        for key, value in wanted.items():
            assert_same(found[key], value, f"{where}.{key}")
    elif isinstance(wanted, np.ndarray | float) or type(wanted) is int:
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-12, err_msg=where)
    elif hasattr(wanted, "__dataclass_fields__"):
        assert type(found) is type(wanted)
        for name in wanted.__dataclass_fields__:
            assert_same(getattr(found, name), getattr(wanted, name), f"{where}.{name}")
    elif isinstance(wanted, tuple | list):
        assert len(found) == len(wanted), where
        for index, pair in enumerate(zip(found, wanted, strict=True)):
            assert_same(*pair, f"{where}[{index}]")
    else:
        assert found == wanted, where


@settings(max_examples=60)
@given(STATES)
def test_a_session_comes_back_the_same_within_1e_12_and_saved_again_it_has_the_same_bytes(state: SessionState) -> None:
    data = session_bytes(state)
    opened = session_of(data, "again.rvsim")
    assert (opened.notice, opened.read_only) == ("", False)
    assert_same(opened.state, state)
    assert session_bytes(opened.state) == data


# --- a file that can be read by people -----------------------------------------------------------------------------


def _default() -> SessionState:
    robot = load_robot("rv-m1")
    return SessionState(default_experiment(robot).at([0.1, -0.2, -0.30000000000000004, 0.4, 1e-17]))


def test_a_built_in_arm_stands_there_by_its_name_and_numbers_with_all_digits_one_value_a_line() -> None:
    lines = session_bytes(_default()).decode().splitlines()
    assert '      "name": "rv-m1"' in lines
    assert '    "q": [0.1, -0.2, -0.30000000000000004, 0.4, 1e-17],' in lines
    held = replace(_default().experiment, robot=load_robot("rv-m1").with_tool("standard hand"))
    assert '      "tool": "standard hand"' in session_bytes(SessionState(held)).decode().splitlines()


def test_an_edit_of_one_value_changes_one_line() -> None:
    state = _default()
    other = replace(state, experiment=replace(state.experiment, notes=Notes("Ada", "one\ntwo\nthree")))
    third = replace(state, experiment=replace(state.experiment, notes=Notes("Ada", "one\nTWO\nthree")))
    before, after = (session_bytes(one).decode().splitlines() for one in (other, third))
    changed = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
    assert changed == [('      "two",', '      "TWO",')]


# --- versions ------------------------------------------------------------------------------------------------------


def _document(**changes: Any) -> bytes:
    return json.dumps({**json.loads(session_bytes(_default())), **changes}).encode()


def test_an_older_file_goes_through_each_migration_in_turn_and_says_so() -> None:
    def named(document: dict[str, Any]) -> dict[str, Any]:
        return {**document, "notes": {"student": document["notes"]["author"], "text": []}}

    def split(document: dict[str, Any]) -> dict[str, Any]:
        return {**document, "notes": {**document["notes"], "text": ["migrated"]}}

    old = _document(notes={"author": "Ada"})
    opened = session_of(old, "old.rvsim", migrations={1: named, 2: split}, current=3)
    assert opened.state.experiment.notes == Notes("Ada", "migrated")
    assert "older rvsim" in opened.notice
    assert not opened.read_only
    with pytest.raises(SessionFileError, match="version 1 that cannot be understood"):
        session_of(_document(notes={}), "old.rvsim", migrations={1: named}, current=2)


def test_a_newer_file_opens_read_only_with_a_sentence_and_without_what_is_unknown() -> None:
    experiment = {**json.loads(session_bytes(_default()))["experiment"], "gravity": [0, 0, -9.81]}
    opened = session_of(_document(version=7, experiment=experiment, camera_path=[1]), "new.rvsim")
    assert opened.read_only
    assert "newer rvsim (version 7" in opened.notice
    assert_same(opened.state, _default())


# --- what is no session --------------------------------------------------------------------------------------------

BROKEN = {
    b"": "is empty",
    b" \n": "is empty",
    b"{" + b" " * (16 * 1024 * 1024): "at most 16 MB are read",
    b'{\n  "format": "rvsim session",\n': "ends in line 2 .* may be cut off",
    b'{\n  "format": "rvsim ses': "ends in line 2 .* may be cut off",
    b'{"format": 1} and more': "line 1, column 15.*Extra data",
    b'{"format": 1, "version" 2}': "line 1, column 25.*Expecting ':'",
    b"\xff\xfe{": "byte 0xff",
    b"[" * 100_000: "nested too deeply",
    b"[" * 300_000: "hundreds of thousands",
    b'{"format": "rvsim session", "format": "x"}': "the key 'format' twice",
    b'{"a": NaN}': "the number NaN",
    b'{"a": "\\ud800"}': "half of a character",
    b'{"a": ' + b"9" * 5000 + b"}": "thousands of digits",
    b"[[1, 2]]": "a list of 1",
    b'{"format": "rvsim session", "version": true}': "version: found true",
    b'{"format": "rvsim session", "version": 1}': "experiment: found nothing",
}


@pytest.mark.parametrize(("data", "said"), BROKEN.items(), ids=range(len(BROKEN)))
def test_what_is_no_session_is_refused_with_the_place_and_what_was_found(data: bytes, said: str) -> None:
    with pytest.raises(SessionFileError, match=r"broken\.rvsim.*" + said):
        session_of(data, "broken.rvsim")


@pytest.mark.parametrize(
    ("keys", "value", "said"),
    [
        (("experiment", "q"), [0, 0], "experiment, q: found a list of 2, expected a list of 5 numbers"),
        (("experiment", "q"), [0, 0, "1", 0, 0], "experiment, q, number 3: found the text '1'"),
        (("experiment", "q"), [0, 0, 10**400, 0, 0], "experiment, q, number 3"),
        (("experiment", "robot"), {"name": "../../etc/passwd"}, "experiment, robot, name: .* a built-in arm"),
        (("experiment", "robot"), {"name": "rv-m1", "tool": "hammer"}, "tool: found the text 'hammer'"),
        (("experiment", "robot"), {"file": {"name": "x"}}, "experiment, robot, file, key 'title': found nothing"),
        (("experiment", "trajectory", "name"), "../secret.csv", "expected the name of a path"),
        (("experiment", "line", "resolution"), 1e-9, "experiment, line, resolution"),
        (("experiment", "target"), [[1] * 4] * 4, "turns nothing rigidly"),
        (("experiment", "poses"), [{"name": "a", "q": [0] * 5}] * 2, "pose 2: found the name 'a' again"),
        (("experiment", "program"), [{"kind": "fly"}], "experiment, program.*kind"),
        (("experiment", "load", "payload"), -1, "payload: found -1, expected a finite number at least 0"),
        (("view", "tracked_from"), {"near": [0] * 5, "start": [0] * 4}, "start of the tracked path"),
        (("view", "Camera"), None, "an unknown key, expected a known one. Did you mean 'camera'"),
    ],
)
def test_a_wrong_value_is_refused_with_its_path_in_the_document(keys: tuple[str, ...], value: Any, said: str) -> None:
    document = json.loads(session_bytes(_default()))
    table = document
    for key in keys[:-1]:
        table = table[key]
    table[keys[-1]] = value
    with pytest.raises(SessionFileError, match=said):
        session_of(json.dumps(document).encode(), "wrong.rvsim")


def test_no_text_of_a_file_is_markup_that_makes_the_window_read_another_file() -> None:
    evil = '<img src="/dev/zero">'
    robot = load_robot("rv-m1")
    joints = tuple(replace(joint, name=f"{evil}{number}") for number, joint in enumerate(robot.joints))
    robot = replace(robot, name="own", title=evil, notes=evil, source=evil, joints=joints)
    experiment = replace(default_experiment(robot), poses=(NamedPose(evil, robot.home),))
    data = session_bytes(SessionState(experiment))
    for read in (data, data.replace("‹".encode(), b"<")):
        opened = session_of(read, "x.rvsim").state
        found = opened.experiment
        texts = (
            found.robot.title,
            found.robot.notes,
            found.robot.source,
            *found.robot.joint_names,
            found.poses[0].name,
        )
        assert all(text.startswith('‹img src="/dev/zero">') for text in texts)
        assert session_bytes(opened) == data
    assert "a < 3 and 2 <= b" in str(SessionFileError("x", "y", "a < 3 and 2 <= b", ""))
    for broken in ({"format": evil}, {"format": "rvsim session", "version": 1, evil: 1}):
        with pytest.raises(SessionFileError) as refused:
            session_of(json.dumps(broken).encode(), "x.rvsim")
        assert "<" not in str(refused.value)


def test_a_session_that_no_file_may_hold_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    state = _default()
    wrong = replace(state, experiment=state.experiment.at(np.full(5, np.nan)))
    with pytest.raises(SessionFileError, match="q, number 1: found nan"):
        save_session(wrong, tmp_path / "a.rvsim")
    assert not list(tmp_path.glob("*"))


# --- the disk ------------------------------------------------------------------------------------------------------


def test_a_full_disk_is_told_in_a_sentence_and_the_old_file_stays_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "work.rvsim"
    save_session(_default(), file)
    before = file.read_bytes()

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(FileWriteError, match=r"work\.rvsim cannot be written: no space left on device"):
        save_session(SessionState(_default().experiment.with_pose("a")), file)
    assert file.read_bytes() == before
    assert [path.name for path in tmp_path.glob("*")] == ["work.rvsim"]
    assert_same(load_session(file).state, _default())


def test_a_folder_and_a_missing_file_are_told_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(SessionFileError, match="found a folder"):
        load_session(tmp_path)
    with pytest.raises(SessionFileError, match=r"There is no file .*gone\.rvsim"):
        load_session(tmp_path / "gone.rvsim")
    with pytest.raises(FileWriteError, match="cannot be written"):
        save_session(_default(), tmp_path / "no" / "folder.rvsim")


# --- spoilt files --------------------------------------------------------------------------------------------------


def test_a_spoilt_file_is_a_sound_session_or_one_clear_error() -> None:
    soak = runpy.run_path(str(Path(__file__).parents[1] / "soak" / "soak_session_files.py"))
    outcomes = [soak["outcome"](soak["mutant"](seed)) for seed in range(300)]
    assert 20 < outcomes.count("sound") < 280
