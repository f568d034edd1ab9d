"""The user's folder is always there; robot files saved in it are found again."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from rvsim import load_robot
from rvsim.files import find_user_folder, save_robot, user_folder, user_robot_files, user_robot_path


def test_the_folder_of_the_environment_is_made_and_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = tmp_path / "deep" / "down"
    monkeypatch.setenv("RVSIM_USER_FOLDER", str(wanted))
    assert find_user_folder() == (wanted, "")
    assert wanted.is_dir()


def test_without_it_the_system_names_the_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import platformdirs

    monkeypatch.delenv("RVSIM_USER_FOLDER")
    monkeypatch.setattr(platformdirs, "user_data_path", lambda name, appauthor: tmp_path / f"{name} {appauthor}")
    assert user_folder() == tmp_path / "rvsim False"


@pytest.mark.parametrize("name", ["file.txt", "file.txt/below"])
def test_a_folder_that_cannot_be_made_is_replaced_and_the_reason_told(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file.txt").write_text("in the way", encoding="utf-8")
    monkeypatch.setenv("RVSIM_USER_FOLDER", str(tmp_path / name))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    path, problem = find_user_folder()
    assert path.is_dir()
    assert "cannot be written" in problem
    assert find_user_folder() == (path, problem)


def test_saved_arms_are_found_by_name() -> None:
    assert user_robot_files() == ()
    for title in ("my RV-M1", "Arm/of: Ünal", "../.."):
        save_robot(load_robot("rv-m1").renamed("mine", title), user_robot_path(title))
    files = user_robot_files()
    assert [file.name for file in files] == ["arm-of-ünal.toml", "my-rv-m1.toml", "robot.toml"]
    assert {file.parent for file in files} == {user_folder() / "robots"}
    assert load_robot(files[1]).title == "my RV-M1"
