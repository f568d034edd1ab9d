"""Robot files: what is saved reads back the same, and what is wrong is named, never more than one clear error."""

from __future__ import annotations

import math
import os
import re
import runpy
import string
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from rvsim import load_robot, robot_names
from rvsim.errors import RobotDefinitionError, RobotFileError, UnknownRobotError
from rvsim.files import robot_text, save_robot
from rvsim.files.kinds import Items, Table
from rvsim.files.robot_file import robot_from_bytes
from rvsim.files.robot_format import ROBOT
from rvsim.resources import resource
from rvsim.robot import BoxShape, CapsuleShape, Datum, Gripper, Joint, LinkMass, Robot, Tool
from rvsim.spatial import rotation_from_rpy, transform

SOAK = runpy.run_path(str(Path(__file__).parents[1] / "soak" / "soak_robot_files.py"))
RV_M1 = resource("robots", "rv-m1.toml").read_text(encoding="utf-8")


# --- what is saved reads back the same -----------------------------------------------------------------------------


def assert_same(one: Robot, other: Robot) -> None:
    words = ("name", "title", "family", "convention", "length_unit", "source", "notes", "tool_name")
    assert [getattr(one, word) for word in words] == [getattr(other, word) for word in words]
    assert one.joint_names == other.joint_names
    for mine, theirs in zip(one.joints, other.joints, strict=True):
        assert_same_fields(mine, theirs)
    assert_allclose(other.T_base_0, one.T_base_0, rtol=0, atol=1e-12)
    groups = [(robot.tools, robot.masses, shapes(robot), (robot.gripper,)) for robot in (one, other)]
    for mine_group, theirs_group in zip(*groups, strict=True):
        for mine, theirs in zip(mine_group, theirs_group, strict=True):
            assert_same_fields(mine, theirs)


def assert_same_fields(one: Any, other: Any) -> None:
    assert type(one) is type(other)
    for name, value in vars(one).items() if one else ():
        theirs = getattr(other, name)
        if isinstance(value, float | np.ndarray):
            assert_allclose(theirs, value, rtol=1e-14, atol=1e-12)
        elif isinstance(value, Datum):
            assert theirs == value._replace(value=pytest.approx(value.value, rel=1e-14))
        else:
            assert theirs == value


def shapes(robot: Robot) -> list[Any]:
    return sorted(robot.shapes, key=lambda shape: isinstance(shape, BoxShape))


@pytest.mark.parametrize("name", robot_names())
def test_a_shipped_arm_is_saved_and_read_back(name: str, tmp_path: Path) -> None:
    robot, path = load_robot(name), tmp_path / "copy.toml"
    save_robot(robot, path)
    assert_same(robot, load_robot(path))
    assert robot_text(load_robot(str(path))) == path.read_text(encoding="utf-8")


numbers = st.floats(-900.0, 900.0)
angles = st.floats(-7.0, 7.0)
words = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=30).map(str.strip).filter(bool)
places = st.builds(
    lambda rpy, p: transform(rotation_from_rpy(rpy), p), st.tuples(*[angles] * 3), st.tuples(*[numbers] * 3)
)
points = st.tuples(numbers, numbers, numbers)
colors = st.text(string.hexdigits, min_size=6, max_size=6).map("#{}".format)
data = st.none() | st.builds(Datum, st.floats(1e-3, 900.0), st.just(True), words)


@st.composite
def joints(draw: st.DrawFn, name: str) -> Joint:
    home = draw(st.floats(-100.0, 100.0))
    below, above = draw(st.floats(1e-3, 90.0) | st.just(math.inf)), draw(st.floats(1e-3, 90.0) | st.just(math.inf))
    return Joint(
        name,
        draw(st.sampled_from(["revolute", "prismatic"])),
        *(draw(angles), draw(numbers), draw(st.floats(0.01, 900.0)), draw(angles)),
        lower=home - below,
        upper=home + above,
        home=home,
        color=draw(colors),
        max_speed=draw(data),
        dh_assumed=draw(st.booleans()),
    )


@st.composite
def robots(draw: st.DrawFn) -> Robot:
    arm = [draw(joints(f"joint {number}")) for number in range(draw(st.integers(1, 4)))]
    tools = [Tool(f"tool {i}", draw(words), draw(places)) for i in range(draw(st.integers(1, 2)))]
    frames = st.integers(0, len(arm) + 1)
    bodies = st.builds(CapsuleShape, frames, points, points, st.floats(1e-3, 1.0), colors) | st.builds(
        BoxShape, frames, points, st.tuples(*[st.floats(1e-3, 9.0)] * 3), st.just("")
    )
    bodies |= st.builds(CapsuleShape, st.just(len(arm)), points, points, st.just(0.01), colors, st.booleans())
    link = st.builds(LinkMass, st.floats(0, 99), points, st.just(np.diag([1.5, 2.5, 3.5])), st.booleans(), words)
    return Robot(
        name="drawn",
        title=draw(words),
        convention=draw(st.sampled_from(["standard", "modified"])),
        joints=tuple(arm),
        T_base_0=draw(places),
        tools=tuple(tools),
        tool_name=tools[-1].name,
        gripper=draw(st.none() | st.builds(Gripper, st.lists(points, min_size=2, max_size=5), colors, points)),
        shapes=tuple(draw(st.lists(bodies, max_size=4))),
        masses=tuple(draw(st.just([]) | st.lists(link, min_size=len(arm), max_size=len(arm)))),
        length_unit=draw(st.sampled_from(["millimetre", "unit"])),
        notes=draw(st.lists(words, max_size=3).map("\n".join)),
    )


@given(robots())
@settings(max_examples=150)
def test_any_arm_is_written_and_read_back(robot: Robot) -> None:
    assert_same(robot, robot_from_bytes(robot_text(robot).encode(), "drawn.toml"))


@given(st.integers(-3_600_000, 3_600_000))
def test_a_number_typed_in_degrees_or_millimetres_is_saved_as_it_was_typed(thousandths: int) -> None:
    value = f"{thousandths / 1000:g}"
    typed = RV_M1.replace("alpha = 90", f"alpha = {value}", 1).replace("d = 152", f"d = {value}", 1)
    saved = robot_text(robot_from_bytes(typed.encode(), "typed.toml"))
    assert f"\nalpha = {value}  #" in saved
    assert f"\nd = {value}  #" in saved


# --- writing -------------------------------------------------------------------------------------------------------


def test_a_failed_write_leaves_the_old_file_and_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "mine.toml"
    save_robot(load_robot("planar"), path)
    before = path.read_bytes()

    def full(*_: Any) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="disk full"):
        save_robot(load_robot("scara"), path)
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["mine.toml"]


def test_an_arm_that_no_file_may_hold_is_not_written(tmp_path: Path) -> None:
    robot, path = load_robot("planar"), tmp_path / "mine.toml"
    skewed = np.diag([1.0, 2.0, 1.0, 1.0])
    for bad, reason in [
        (robot.with_joint(0, a=1e9), "joint 1, key 'a'"),
        (robot.with_joint(0, a=1e-4).with_joint(1, a=1e-4), "0.2"),
        (robot.with_joint(1, name="theta1"), "joint 2, key 'name'"),
        (replace(robot, T_base_0=skewed), "skewed"),
    ]:
        with pytest.raises(RobotDefinitionError, match=reason):
            save_robot(bad, path)
    assert not path.exists()


# --- what is wrong is named ----------------------------------------------------------------------------------------

JOINT, TOP, TOOL, LOOK = "joint 1, ", "", "tool 2, ", "look, "
NO_NUMBER = [
    ("true", "true"),
    ('"90"', "'90'"),
    ("nan", "nan"),
    ("inf", "inf"),
    ("1e9", "1000000000.0"),
    ("[[[9]]]", "list"),
]
BAD_FILES = [
    # what stands in the RV-M1's file, what is written instead, the place that is named, a word of the message
    *(("alpha = 90", f"alpha = {bad}", "joint 1, key 'alpha'", found) for bad, found in NO_NUMBER),
    *(("d = 152", f"d = {bad}", "joint 1, key 'd'", found) for bad, found in NO_NUMBER),
    ("alpha = 90", "alpha = 1.5708", "joint 1, key 'alpha'", "write 90"),
    ("theta = -90", "theta = -1.570796", "joint 5, key 'theta'", "write -90"),
    ("alpha = 90", "alhpa = 90", "joint 1, key 'alhpa'", "Did you mean 'alpha'?"),
    ("alpha = 90\n", "", "joint 1, key 'alpha'", "alpha is in degrees"),
    ("d = 152", 'd = "152 mm"', "joint 1, key 'd'", "[millimetres]"),
    ("d = 152", "d = 2024-01-01", "joint 1, key 'd'", "a date"),
    ("d = 152", "d = {}", "joint 1, key 'd'", "a table"),
    ("home = 0", "home = 151", "joint 1, key 'home'", "-150 to 150"),
    ("lower = -150", "lower = 170", "joint 1, key 'lower'", "upper limit 150"),
    ("lower = -150", "lower = -inf", "joint 1, key 'lower'", "leave the key out"),
    ('color = "#E69F00"', 'color = "orange"', "joint 1, key 'color'", "#rrggbb"),
    ('type = "revolute"', 'type = "revolvte"', "joint 1, key 'type'", "Did you mean 'revolute'?"),
    ('name = "shoulder"', 'name = "waist"', "joint 2, key 'name'", "joint 1"),
    ('name = "shoulder"', 'name = ""', "joint 2, key 'name'", "1 to 40"),
    ("value = 120, assumed = true", "value = -3, assumed = true", "joint 1, max_speed, key 'value'", "-3"),
    ("{ value = 120, ", "{ val = 120, ", "joint 1, max_speed, key 'val'", "Did you mean 'value'?"),
    (
        'assumed = true, source = "typical of the arm; no source gives it"',
        'source = ""',
        "joint 1, max_speed",
        "origin",
    ),
    ('convention = "standard"', 'convention = "craig"', "key 'convention'", "'modified'"),
    ('title = "Mitsubishi RV-M1"\n', "", "key 'title'", "required"),
    ("[[joint]]", "[[joints]]", "key 'joints'", "Did you mean 'joint'?"),
    ("[[joint]]", "[joint]", "line 35", "TOML"),
    ('tool_name = "flange"', 'tool_name = "flang"', "key 'tool_name'", "Did you mean 'flange'?"),
    ("xyz = [0, 0, 107]", "xyz = [0, 107]", "tool 2, key 'xyz'", "[x, y, z]"),
    ("xyz = [0, 0, 107]", 'xyz = [0, 0, "107"]', "tool 2, key 'xyz', z", "without quotes"),
    ("[-35, 0, 0],", "[-35, 0, nan],", "gripper, point 1, z", "nan"),
    ("frame = 3", "frame = 7", "look, capsule 3, key 'frame'", "5 joints"),
    ('color = "#8B96A5" }', "finger = true }", "look, box 3, key 'finger'", "frame 5, the flange"),
    ("closing = [32, 0, 0]", "closing = [32, 0]", "gripper, key 'closing'", "[x, y, z]"),
    ("frame = 3", "frame = 2.5", "look, capsule 3, key 'frame'", "whole number"),
    ("radius = 30", "radius = 0", "look, capsule 1, key 'radius'", "1e-06"),
    ("[gripper]", "[gripper", "line 10", "TOML"),
    ('convention = "standard"', "convention = 3", "key 'convention'", "found 3"),
    ("points = [", "points = 3\ncolour = [", "gripper, key 'colour'", "Did you mean 'color'?"),
    ("boxes = [", "boxes = 3\nx = [", "look, key 'x'", "unknown key"),
    ("[gripper]", "[[mass]]\nmass = 1\ncom = [0, 0, 0]\n[gripper]", "mass", "one for each of the 5 links"),
    ("[gripper]", "[[mass]]\nmass = -1\ncom = [0, 0, 0]\n[gripper]", "mass 1, key 'mass'", "0 to 1000000"),
    ("d = 152", f"d = {'9' * 400}", "joint 1, key 'd'", "99…"),
    ("alpha = 90", "alpha = 90°", "line 26, column 11", "TOML"),
    ("alpha = 90", "alpha = 90, 0", "line 26", "TOML"),
    ("d = 152", f"d = {'9' * 5000}", "the file", "thousands of digits"),
    ("d = 152", f"d = {'[' * 9000}", "the file", "nested too deeply"),
]


@pytest.mark.parametrize(("before", "after", "place", "word"), BAD_FILES)
def test_the_culprit_is_named(before: str, after: str, place: str, word: str) -> None:
    assert before in RV_M1
    with pytest.raises(RobotFileError) as caught:
        robot_from_bytes(RV_M1.replace(before, after, 1).encode(), "mine.toml")
    assert place in caught.value.where
    assert word in str(caught.value)
    assert str(caught.value).startswith("mine.toml: ")


def test_the_line_is_named_where_the_table_and_the_key_stand() -> None:
    for number, line in enumerate(RV_M1.splitlines(), 1):
        key, equals, _ = line.partition(" = ")
        if equals and key in ("theta", "alpha", "upper", "xyz", "convention"):
            lines = RV_M1.splitlines()
            lines[number - 1] = f"{key} = [true]"
            with pytest.raises(RobotFileError, match=f"line {number}, "):
                robot_from_bytes("\n".join(lines).encode(), "mine.toml")


def test_lengths_in_metres_are_suspected() -> None:
    lines = [line if line[:4] not in ("d = ", "a = ") else f"{line[:4]}0.15" for line in RV_M1.splitlines()]
    with pytest.raises(RobotFileError, match="lengths in millimetres"):
        robot_from_bytes("\n".join(lines).encode(), "mine.toml")


def test_an_arm_has_no_more_than_32_joints() -> None:
    joint = '[[joint]]\nname = "{}"\ntype = "revolute"\ntheta = 0\nd = 9\na = 9\nalpha = 0\n'
    many = RV_M1.partition("[[joint]]")[0] + "".join(joint.format(number) for number in range(33))
    with pytest.raises(RobotFileError, match="found 33 of them, expected 1 to 32 joints"):
        robot_from_bytes(many.encode(), "mine.toml")


@pytest.mark.parametrize(
    ("data", "word"),
    [
        (RV_M1.encode("utf-16"), "UTF-16"),
        (RV_M1.replace("report", "répport").encode() + "# é".encode("latin-1"), "0xe9"),
        (b"#" * 300_000, "256 kB"),
        (b"", "is empty"),
        (b"\x89PNG\r\n\x1a\n", "UTF-8"),
        (b"{}", "TOML"),
    ],
)
def test_what_is_no_robot_file_at_all(data: bytes, word: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(data)
    with pytest.raises(RobotFileError, match=word):
        load_robot(path)


def test_what_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(RobotFileError, match="a folder"):
        load_robot(tmp_path)
    for missing in ("rv-m2", tmp_path / "nothing.toml", "a\0b", "x" * 9000):
        with pytest.raises(UnknownRobotError, match="no such file"):
            load_robot(missing)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no named pipes")
def test_a_pipe_does_not_block(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(RobotFileError, match="no file"):
        load_robot(tmp_path / "pipe")


@pytest.mark.parametrize("data", [b"\xef\xbb\xbf" + RV_M1.encode(), RV_M1.replace("\n", "\r\n").encode()])
def test_files_of_other_editors_are_read(data: bytes) -> None:
    assert_same(robot_from_bytes(data, "mine.toml"), load_robot("rv-m1"))


def test_a_file_without_a_name_gives_the_arm_its_own(tmp_path: Path) -> None:
    path = tmp_path / "my arm.toml"
    path.write_text(RV_M1.replace('name = "rv-m1"\n', "", 1), encoding="utf-8")
    assert load_robot(path).name == "my arm"


# --- and whatever else may stand there -----------------------------------------------------------------------------


@given(st.integers(1_000_000, 1_000_000_000))
@settings(max_examples=400)
def test_a_spoilt_file_is_a_sound_arm_or_one_clear_error(seed: int) -> None:
    SOAK["outcome"](SOAK["mutant"](seed))


@given(st.binary(max_size=200))
def test_any_bytes_are_refused_in_one_way(data: bytes) -> None:
    with pytest.raises(RobotFileError):
        robot_from_bytes(data, "mine.toml")


# --- the help page -------------------------------------------------------------------------------------------------

HELP = resource("help", "robot-file.md").read_text(encoding="utf-8")


def test_the_example_of_the_help_page_is_an_arm() -> None:
    example = HELP.partition("```toml\n")[2].partition("```")[0]
    robot = robot_from_bytes(example.encode(), "my-first.toml")
    assert (robot.name, robot.dof, robot.size) == ("my-first", 2, pytest.approx(0.55))


def test_the_help_page_explains_every_key() -> None:
    missing = {name for name in key_names(ROBOT) if not re.search(rf"\b{name}\b", HELP)}
    assert missing == set()


def key_names(kind: Any) -> set[str]:
    if isinstance(kind, Items):
        return key_names(kind.kind)
    keys = kind.keys if isinstance(kind, Table) else ()
    return {name for key in keys for name in {key.name} | key_names(key.kind)}
