"""The command line as a shell uses it: results, JSON, files, exit status, one sentence for what is wrong."""

from __future__ import annotations

import csv
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rvsim import __version__, forward_kinematics, jacobian, load_robot, robot_names
from rvsim.cli import BAD_INPUT, DONE, FAILED, main
from rvsim.files import example_names, save_robot, user_robot_path

Capture = pytest.CaptureFixture[str]
LINE_000 = ["--from-mm", "110,0,130", "--to-mm", "230,0,333", "--samples", "11"]


def run(capsys: Capture, *arguments: str, status: int = DONE) -> str:
    found = main(list(arguments))
    out, err = capsys.readouterr()
    assert found == status, err
    assert (err == "") == (status != BAD_INPUT)
    return err if status == BAD_INPUT else out


def run_json(capsys: Capture, *arguments: str, status: int = DONE) -> Any:
    def refuse(constant: str) -> None:
        raise AssertionError(f"{constant} is no JSON")

    return json.loads(run(capsys, *arguments, "--json", status=status), parse_constant=refuse)


def test_the_pose_of_source_000s_worked_example(capsys: Capture) -> None:
    assert run(capsys, "fk", "rv-m1", "--deg", "30,40,-50,20,60").startswith("(363.7, 210.0, 297.4) mm\n")


def test_an_arm_without_a_unit_of_length_is_asked_and_shown_in_units(capsys: Capture, tmp_path: Path) -> None:
    assert run(capsys, "fk", "rrrp", "--deg", "0,0,0,1").startswith("(5.000, 4.000, 4.000) units\n")
    assert run_json(capsys, "fk", "rrrp", "--deg", "0,0,0,1 unit")["xyz_unit"] == pytest.approx([5, 4, 4])
    assert "unit/rad" in run(capsys, "jacobian", "rrrp", "--deg", "0,0,0,1")
    branch = run_json(capsys, "ik", "rrrp", "--xyz-mm", "5,4,4", "--near-deg", "0,0,0,1")["branches"][0]
    assert branch["q"][3] == pytest.approx(1.0, abs=1e-9)
    table = tmp_path / "units.csv"
    line = ("--from-mm", "4.8,3.2,4.5", "--to-mm", "4.8,20,4.5", "--samples", "3", "--csv", str(table))
    record = run_json(capsys, "track", "rrrp", *line)
    assert {"joint": "l6", "limit": 4.0, "unit": "unit"}.items() <= record["unreached"][0].items()
    assert record["rms_unit"] == pytest.approx(record["rms_mm"] / 1e3)
    assert table.read_text(encoding="utf-8").startswith("index,x_unit,y_unit,z_unit,reached,")
    assert run_json(capsys, "track", "rrrp", "--path", str(table))["reached"] == 1
    assert "wanted is a length without a unit" in run(capsys, "fk", "rrrp", "--deg", "0,0,0,5 mm", status=BAD_INPUT)


def test_a_typed_value_may_say_its_unit(capsys: Capture) -> None:
    plain = run(capsys, "fk", "scara", "--deg", "45,20,105,-45")
    assert run(capsys, "fk", "scara", "--deg", "pi/4 rad, 20°, 10.5 cm, -45deg") == plain


def test_a_jacobian_shows_no_negative_zero(capsys: Capture) -> None:
    for robot in ("rv-m1", "ur5e", "planar"):
        assert "-0.00000" not in run(capsys, "jacobian", robot, "--deg", ",".join(["0"] * load_robot(robot).dof))


def test_joints_are_degrees_and_millimetres_and_may_be_expressions_and_begin_with_a_minus(capsys: Capture) -> None:
    record = run_json(capsys, "fk", "scara", "--deg", "-2*30, sqrt(400); 10,5 ; -45".replace(", ", ";"))
    q = [np.radians(-60.0), np.radians(20.0), 0.0105, np.radians(-45.0)]
    assert np.allclose(record["T_base_tool"], forward_kinematics(load_robot("scara"), q), atol=1e-12)
    assert record["xyz_mm"] == pytest.approx(np.array(record["T_base_tool"])[:3, 3] * 1e3)


def test_a_pose_outside_the_limits_is_computed_and_told(capsys: Capture) -> None:
    assert "Outside its limits: elbow." in run(capsys, "fk", "rv-m1", "--deg", "0,30,90,60,0")
    assert run_json(capsys, "fk", "rv-m1", "--deg", "0,30,90,60,0")["outside_limits"] == ["elbow"]


def test_all_arms_are_listed_and_a_missing_limit_is_null(capsys: Capture) -> None:
    records = run_json(capsys, "robots")
    assert tuple(record["name"] for record in records) == (*robot_names(), *example_names())
    rrrp = next(record for record in records if record["name"] == "rrrp")
    assert rrrp["limits"][0] == [None, None]
    assert len(run(capsys, "robots").splitlines()) == len(records)


def test_saved_arms_are_listed_and_found_by_name_and_a_spoilt_file_is_told(capsys: Capture) -> None:
    save_robot(load_robot("scara").renamed("mine", "Mine"), user_robot_path("mine"))
    assert "Mine" in run(capsys, "robots").splitlines()[-1]
    assert run(capsys, "fk", "mine", "--deg", "1,2,3,4") == run(capsys, "fk", "scara", "--deg", "1,2,3,4")
    assert "al5b, " in run(capsys, "fk", "mein", "--deg", "1", status=BAD_INPUT)
    user_robot_path("spoilt").write_text("name = 3", encoding="utf-8")
    assert main(["robots"]) == DONE
    assert "spoilt.toml" in capsys.readouterr().err


def test_the_jacobian(capsys: Capture) -> None:
    record = run_json(capsys, "jacobian", "ur5e", "--deg", "0,-60,90,-120,-90,30")
    J = jacobian(load_robot("ur5e"), np.radians([0, -60, 90, -120, -90, 30]))
    assert np.allclose(record["J"], J, atol=1e-12)
    assert record["sigma_min"] == pytest.approx(np.linalg.svd(J, compute_uv=False)[-1])


def test_inverse_kinematics_gives_every_branch_or_the_reason(capsys: Capture) -> None:
    record = run_json(capsys, "ik", "ur5e", "--xyz-mm", "400,100,300", "--rpy-deg", "180,0,0")
    assert len(record["branches"]) == 8
    assert record["failure"] is None
    for branch in record["branches"]:
        T = forward_kinematics(load_robot("ur5e"), np.radians(branch["q"]))
        assert np.allclose(T[:3, 3], [0.4, 0.1, 0.3], atol=1e-9)
    failed = run_json(capsys, "ik", "rv-m1", "--xyz-mm", "110,0,130", "--rpy-deg", "180,0,0", status=FAILED)
    assert (failed["failure"]["kind"], failed["failure"]["joint"]) == ("limits", "elbow")
    assert len(failed["branches"]) == 4


def test_a_place_is_enough_where_the_arm_can_do_without_an_orientation(capsys: Capture) -> None:
    assert "within the limits" in run(capsys, "ik", "rv-m1", "--xyz-mm", "300,100,200")
    assert "within the limits" in run(capsys, "ik", "ur5e", "--xyz-mm", "300,100,200")
    problem = run(capsys, "ik", "scara", "--xyz-mm", "300,100,200", status=BAD_INPUT)
    assert "needs an orientation as well: --rpy-deg" in problem


def test_tracking_as_json_has_exactly_the_documented_keys(capsys: Capture) -> None:
    record = run_json(capsys, "track", "rv-m1", "--path", "line", *LINE_000)
    assert list(record) == ["points", "reached", "unreached", "rms_mm", "max_mm", "jumps", "ik_ms"]
    assert (record["points"], record["reached"], record["jumps"]) == (11, 4, 0)
    first = record["unreached"][0]
    assert (first["index"], first["kind"], first["joint"], first["limit"]) == (
        0,
        "limits",
        "elbow",
        pytest.approx(-110),
    )
    assert first["unit"] == "deg"
    assert first["value"] == pytest.approx(-156.744, abs=1e-3)
    assert record["rms_mm"] < 1e-12
    assert record["ik_ms"] > 0.0


@pytest.mark.parametrize(
    ("arguments", "reached", "points"),
    [
        (["rv-m1", *LINE_000, "--ignore-limits"], 11, 11),
        (["rv-m1", *LINE_000, "--orientation", "free"], 6, 11),
        (["rv-m1", "--path", "letter-board"], 50, 50),
        (["rv-m1", "--path", "letter-scaled", "--height-mm", "250"], 5, 50),
        (["ur5e", "--path", "ellipse"], 114, 184),
        (["ur5e", "--path", "ellipse-moved"], 184, 184),
        (["rrrp", "--path", "spiral"], 2001, 2001),
        (["al5b"], 51, 51),
    ],
)
def test_the_sources_paths(capsys: Capture, arguments: list[str], reached: int, points: int) -> None:
    record = run_json(capsys, "track", *arguments)
    assert (record["reached"], record["points"]) == (reached, points)


def test_nothing_reached_is_a_failure_told_without_numbers_that_do_not_exist(capsys: Capture) -> None:
    record = run_json(capsys, "track", "rv-m1", "--path", "letter-raw", status=FAILED)
    assert record["rms_mm"] is record["max_mm"] is None
    assert {point["kind"] for point in record["unreached"]} == {"reach"}
    assert "None of 50 points reached" in run(capsys, "track", "rv-m1", "--path", "letter-raw", status=FAILED)


def test_tracking_writes_a_table_that_can_be_read_back(capsys: Capture, tmp_path: Path) -> None:
    table = tmp_path / "line.csv"
    assert "Written:" in run(capsys, "track", "rv-m1", *LINE_000, "--csv", str(table))
    rows = list(csv.DictReader(table.read_text(encoding="utf-8").splitlines()))
    assert [row["reached"] for row in rows] == list("00000011110")
    assert rows[0]["elbow_deg"] == rows[0]["deviation_mm"] == ""
    names = [name for name in rows[0] if name.endswith("_deg")]
    q = np.radians([float(rows[7][name]) for name in names])
    wanted = [float(rows[7][f"{axis}_mm"]) for axis in "xyz"]
    assert np.allclose(forward_kinematics(load_robot("rv-m1"), q)[:3, 3] * 1e3, wanted, atol=1e-9)
    again = run_json(capsys, "track", "rv-m1", "--path", str(table), "--orientation", "down")
    assert (again["points"], again["reached"]) == (11, 4)


def test_tracking_draws_a_picture(capsys: Capture, tmp_path: Path, qapp: object) -> None:
    from PySide6.QtGui import QImage

    file = tmp_path / "letter.png"
    run(capsys, "track", "rv-m1", "--path", "letter-board", "--png", str(file))
    image = QImage(str(file))
    assert (image.width(), image.height()) == (1280, 960)
    colors = {image.pixelColor(x, y).name() for x in range(0, 1280, 8) for y in range(0, 960, 8)}
    assert len(colors) > 50


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["fk", "rvm1", "--deg", "0"], "No robot 'rvm1', and no such file. Did you mean 'rv-m1'?"),
        (["--theme", "dark", "readme.md"], "readme.md is not a session file (*.rvsim). Type rvsim --help."),
        (["mine.toml"], "mine.toml is not a session file (*.rvsim). To open a robot file: rvsim --robot mine.toml."),
        (["fkk"], "invalid choice: 'fkk'"),
        (["fk", "rv-m1", "--deg", "1,2"], "--deg needs 5 values (waist, shoulder, elbow, wrist pitch, wrist roll)"),
        (["fk", "rv-m1", "--deg", "1,2,3,4,five"], "“five” is no number"),
        (["fk", "rv-m1"], "The following arguments are required: --deg."),
        (["fk", "rv-m1", "--deg"], "Argument --deg: expected one argument."),
        (["track", "rv-m1", "--path", "leter-flat"], "No path 'leter-flat'. Did you mean 'letter-flat'?"),
        (["track", "rv-m1", "--path", "nowhere.csv"], "nowhere.csv: No such file or directory."),
        (["track", "rv-m1", "--samples", "1"], "“1” is no number of points"),
        (["track", "rv-m1", "--orientation", "up"], "Argument --orientation: invalid choice: 'up'"),
        (["track", "rv-m1", "--from-mm", "1,2"], "--from-mm needs 3 values (x, y, z)"),
        (["jump"], "Argument COMMAND: invalid choice: 'jump'"),
        (
            ["track", "rv-m1", "--csv", "no such folder/a.csv"],
            "there is no folder “no such folder” to write “a.csv” into",
        ),
        (["track", "rv-m1", "--png", "no such folder/a.png"], "there is no folder “no such folder”"),
        (["--screenshot", "no such folder/a.png"], "there is no folder “no such folder”"),
        (["--size", "big", "--screenshot", "x.png"], "“big” is no size; write it like 1366x768"),
        (["--robot", "hal"], "No robot 'hal'"),
    ],
)
def test_bad_input_is_one_sentence_and_status_2(capsys: Capture, arguments: list[str], sentence: str) -> None:
    problem = run(capsys, *arguments, status=BAD_INPUT)
    assert sentence in problem
    assert problem.startswith("rvsim: ")
    assert problem.count("\n") == 1


def test_a_file_of_points_with_a_mistake_is_told_with_its_place(capsys: Capture, tmp_path: Path) -> None:
    file = tmp_path / "points.csv"
    file.write_text("300,0,200\n300,zero,200\n", encoding="utf-8")
    problem = run(capsys, "track", "rv-m1", "--path", str(file), status=BAD_INPUT)
    assert "row 2, column 2 (y): found “zero”, expected a number in millimetres." in problem


def test_a_table_can_be_read_by_whom_the_system_lets_read_new_files(capsys: Capture, tmp_path: Path) -> None:
    table, other = tmp_path / "line.csv", tmp_path / "other"
    run(capsys, "track", "rv-m1", "--csv", str(table))
    other.touch()
    assert table.stat().st_mode == other.stat().st_mode


def test_a_table_that_cannot_be_written_is_told_by_its_name(capsys: Capture, tmp_path: Path) -> None:
    assert run(capsys, "track", "rv-m1", "--csv", str(tmp_path), status=BAD_INPUT).startswith(f"rvsim: {tmp_path}: ")


def test_a_terminal_without_the_signs_keeps_the_numbers() -> None:
    program = [sys.executable, "-m", "rvsim", "track", "rv-m1", "--path", "line", *LINE_000]
    done = subprocess.run(program, capture_output=True, check=True, env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert b"points 1-6: the elbow needs -156.7 deg ... -116.9 deg and stops at -110 deg;" in done.stdout


def test_a_program_that_had_a_window_ends_at_once_and_its_words_arrive(tmp_path: Path) -> None:
    program = [sys.executable, "-m", "rvsim", "--screenshot", str(tmp_path / "window.png")]
    done = subprocess.run(program, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert (done.stdout, done.stderr) == (f"{tmp_path / 'window.png'}\n", "")


def test_what_was_set_is_kept_when_the_system_ends_the_program(tmp_path: Path) -> None:
    ends = """
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from rvsim.cli import run
from rvsim.gui import app
def begin(window, file):
    window.preferences.set("theme", "dark")
    QTimer.singleShot(0, QApplication.quit)
app._begin = begin
run()
"""
    folder = {**os.environ, "RVSIM_USER_FOLDER": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"}
    subprocess.run([sys.executable, "-c", ends], check=True, env=folder)
    assert "theme=dark" in (tmp_path / "settings.ini").read_text(encoding="utf-8")


def test_where_there_is_no_display_the_window_says_so(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    assert "There is no display for a window." in run(capsys, status=BAD_INPUT)


def test_the_version_is_printed(capsys: Capture) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out == f"rvsim {__version__}\n"


def test_headless_work_loads_neither_qt_nor_scipy() -> None:
    program = (
        "import sys; from rvsim.cli import main; main(['track', 'rv-m1', '--json']);"
        "print([m for m in sys.modules if m.split('.')[0] in ('PySide6', 'scipy', 'pyqtgraph')])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    assert math.isclose(json.loads(done.stdout.rsplit("\n[", 1)[0])["reached"], 51)


def test_a_thousand_missed_points_are_a_line_each(capsys: Capture) -> None:
    arguments = ("track", "rv-m1", "--path", "letter-raw", "--samples", "1000", "--json")
    text = run(capsys, *arguments, status=FAILED)
    record = json.loads(text)
    assert len(record["unreached"]) == 1000
    assert len(text.splitlines()) == 1000 + 2 + len(record) + 1
