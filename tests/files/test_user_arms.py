"""The user's arms: each file is found by a name of its own, and none hides another one."""

from __future__ import annotations

from pathlib import Path

import pytest

from rvsim import load_robot
from rvsim.errors import UnknownRobotError
from rvsim.files import named_after, open_robot, save_robot, user_folder, user_robots
from rvsim.robot import Robot
from rvsim.robot.edits import original_name


def saved(stem: str, robot: Robot | None = None) -> Path:
    path = user_folder() / "robots" / f"{stem}.toml"
    save_robot(robot or load_robot("rv-m1").renamed("my-rv-m1", "my RV-M1"), path)
    return path


def test_files_of_the_same_name_are_told_apart_by_their_files() -> None:
    for stem in ("first", "second", "third"):
        saved(stem)
    arms = user_robots().by_file.values()
    assert [robot.name for robot in arms] == ["my-rv-m1", "second", "third"]
    assert [robot.title for robot in arms] == ["my RV-M1", "my RV-M1 (second.toml)", "my RV-M1 (third.toml)"]


def test_a_saved_arm_is_loaded_by_its_name_and_never_instead_of_a_built_in_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saved("longarm", load_robot("rv-m1").renamed("longarm", "Long arm"))
    saved("rv-m1", load_robot("rv-m1").renamed("rv-m1", "Not the one"))
    assert load_robot(" LongArm ").title == "Long arm"
    assert load_robot("rv-m1-rv-m1").title == "Not the one (rv-m1.toml)"
    with pytest.raises(UnknownRobotError, match="Did you mean 'longarm'"):
        load_robot("longram")
    monkeypatch.setattr("rvsim.files.user_arms.user_robot_files", lambda: pytest.fail("looked at the user's files"))
    assert load_robot("rv-m1").title == "Mitsubishi RV-M1"


def test_a_file_that_makes_no_arm_hides_no_other() -> None:
    saved("good").with_name("bad.toml").write_text("name = 3", encoding="utf-8")
    arms, problems = user_robots()
    assert [file.stem for file in arms] == ["good"]
    assert len(problems) == 1
    assert "bad.toml" in problems[0]


def test_an_opened_file_takes_no_name_of_a_saved_arm(tmp_path: Path) -> None:
    mine, elsewhere = saved("longarm"), tmp_path / "other.toml"
    save_robot(load_robot("ur5e").renamed("my-rv-m1", "my RV-M1"), elsewhere)
    assert open_robot(mine).name == "my-rv-m1"
    assert (open_robot(elsewhere).name, open_robot(elsewhere).dof) == ("other", 6)


def test_a_file_names_its_arm_but_for_the_file_that_was_offered() -> None:
    rv_m1 = load_robot("rv-m1")
    mine = rv_m1.renamed("my-rv-m1", "my RV-M1")
    assert named_after(mine, Path("my-rv-m1.toml")) is mine
    long = named_after(mine, Path("longarm.toml"))
    assert (long.name, long.title) == ("longarm", "longarm (my RV-M1)")
    assert named_after(long, Path("longarm.toml")) is long
    assert named_after(long, Path("longer.toml")).title == "longer (my RV-M1)"
    assert named_after(mine, Path("my_rv-m1.toml")).title == "my_rv-m1", "not the same twice"
    copy = named_after(rv_m1, Path("rv-m1.toml"))
    assert (copy.name, original_name(copy)) == ("my-rv-m1", "rv-m1")


def test_only_the_users_folder_is_made(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        save_robot(load_robot("rv-m1"), tmp_path / "mistyped" / "a.toml")
    assert not (tmp_path / "mistyped").exists()
    assert saved("first").exists()
