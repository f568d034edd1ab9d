"""The lab report as a value: it says what the kernel computes, for every arm of the sources."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from rvsim import forward_kinematics, jacobian, joint_torques, load_robot, robot_names
from rvsim.experiment import Load, Placement, TrajectoryTask
from rvsim.experiment.shapes import TextShape
from rvsim.lab import default_experiment
from rvsim.lab.motion_table import motion_csv
from rvsim.lab.repairs import motion_of, path_of
from rvsim.lab.report import PARTS, Cover, Document, Study, build, html_page, parts_of, title_of
from rvsim.lab.report.chart import Chart, Curve, Limit, axis, thinned
from rvsim.lab.report.chart_svg import chart_svg
from rvsim.lab.report.figures import Measures, lined_up, with_minus
from rvsim.lab.report.section_motion import between
from rvsim.lab.report.values import (
    Column,
    Figure,
    Formula,
    Formulas,
    Paragraph,
    ScenePicture,
    Table,
    plain,
    unbroken,
    with_indices,
)
from rvsim.lab.script import tracking_script
from rvsim.lab.sentences import Units
from rvsim.lab.sources import errata
from rvsim.lab.tables import tracking_csv
from rvsim.language import speak
from rvsim.motion import track
from rvsim.playback.recording import Recording

COVER = Cover("Title <1> & more", 'Zoë "Z" O’Neil <script>', "1 May 2026", "First line.\n<b>Second</b> & last.")
SOURCE_ARMS = ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b")


def study_of(name: str, *, on_path: bool = True) -> Study:
    robot = load_robot(name)
    experiment = default_experiment(robot)
    bent = np.clip(robot.home + 0.2, robot.limits[:, 0], robot.limits[:, 1])
    experiment = experiment.at(bent).with_load(Load(np.array([1.0, -2.0, 3.0, 0.1, 0.2, -0.3]), payload=0.5))
    if not on_path:
        return Study(experiment)
    tracking = track(robot, path_of("line", experiment), near=experiment.q)
    return Study(experiment, tracking, motion_of(tracking, experiment))


def numbers_of(latex: str) -> np.ndarray:
    """The matrix of numbers that LaTeX says."""
    body = re.findall(r"\\begin\{bmatrix\}(.*?)\\end\{bmatrix\}", latex)[-1]
    body = re.sub(r"\\phantom\{[-0]\}|\{\}|_|\\,", "", body).replace("{-}", "-")
    return np.array([[float(cell) for cell in row.split("&")] for row in body.split("\\\\")])


def formula(document: Document, left: str) -> Formula:
    return next(block for block in document.blocks() if isinstance(block, Formula) and block.left == left)


def table(document: Document, words: str) -> Table:
    return next(block for block in document.blocks() if isinstance(block, Table) and words in block.caption)


@pytest.mark.parametrize("name", SOURCE_ARMS)
def test_the_report_of_a_source_arm_says_what_the_kernel_computes(name: str) -> None:
    study = study_of(name)
    robot, q = study.robot, study.q
    document = build(study, COVER)
    T, J = forward_kinematics(robot, q), jacobian(robot, q)
    shown = numbers_of(formula(document, "{}^{b}T_t").rights[-1])
    np.testing.assert_allclose(shown[:3, :3], T[:3, :3], atol=5.1e-5)
    length = 1.0 if robot.length_unit == "unit" else 1e3
    np.testing.assert_allclose(shown[:3, 3], length * T[:3, 3], atol=5.1e-3)
    above, below = np.split(numbers_of(formula(document, "J").rights[0]), 2)  # lengths as they are shown
    np.testing.assert_allclose(above / length, J[:3], atol=5.1e-4 if length == 1.0 else 5.1e-6)
    np.testing.assert_allclose(below, J[3:], atol=5.1e-5)
    wrench = np.add(study.experiment.load.wrench, (0.0, 0.0, 0.5 * 9.80665, 0.0, 0.0, 0.0))
    torques = numbers_of(formula(document, "\\tau").rights[-1])[:, 0]
    np.testing.assert_allclose(torques, joint_torques(robot, q, wrench), atol=5.1e-4)
    assert study.inverse is not None
    assert len(table(document, "All branches").rows) == len(study.inverse.branches)
    heads = [plain(b.words) for b in document.blocks() if isinstance(b, Paragraph)]
    assert sum(head.startswith("Source 00") for head in heads) >= len(errata(robot))


@pytest.mark.parametrize("name", sorted(set(robot_names()) - set(SOURCE_ARMS)))
def test_every_other_arm_has_a_report_too(name: str) -> None:
    study = study_of(name, on_path=False)
    document = build(study, COVER)
    assert "path" not in parts_of(study)
    assert [section.number for section in document.sections] == [str(n + 1) for n in range(len(document.sections))]


def test_captions_are_numbered_without_a_gap() -> None:
    document = build(study_of("rv-m1"), COVER)
    for kind, block_type in (("Table", Table), ("Figure", Figure)):
        captions = [block.caption for block in document.blocks() if isinstance(block, block_type)]
        assert captions
        assert [caption.split(":")[0] for caption in captions] == [f"{kind} {n}" for n in range(1, len(captions) + 1)]
        assert all(caption.endswith(".") for caption in captions)


def test_only_the_parts_that_are_wanted_are_there() -> None:
    study = study_of("rv-m1", on_path=False)
    titles = [section.title for section in build(study, COVER, ("jacobian", "motion")).sections]
    assert titles == ["Summary", "The Jacobian", "How this was computed"]
    assert {part.name for part in PARTS} >= set(parts_of(study))


def words(document: Document, title: str) -> str:
    section = next(section for section in document.sections if section.title == title)
    return " ".join(plain(block.words) for block in section.blocks if isinstance(block, Paragraph))


def test_a_text_is_described_by_what_it_writes_and_where() -> None:
    experiment = default_experiment(load_robot("rv-m1"))
    shape = TextShape(0.06, "AB", lift=0.015, spacing=0.005)
    level = Placement(np.array([0.3, 0.0, 0.16]), np.array([0.0, 0.0, np.pi / 2]))
    experiment = replace(experiment, trajectory=TrajectoryTask("text", shape=shape, placement=level))
    tracking = track(experiment.robot, path_of("trajectory", experiment), near=experiment.q)
    study = Study(experiment, tracking)
    told = words(build(study, COVER), "The path")
    assert "“AB” in letters 60 mm high" in told
    assert "lifted by 15 mm" in told
    assert "level plane" in told
    assert "160.0) mm" in told
    assert title_of(study).endswith("writing “AB”")
    changed = replace(experiment, trajectory=replace(experiment.trajectory, shape=replace(shape, text="C")))
    assert "C" not in title_of(replace(study, experiment=changed))


def test_a_line_is_described_by_its_ends_and_the_summary_tells_the_deviation_between_the_points() -> None:
    study = study_of("al5b")
    start, end = (1e3 * study.tracking.path.points[row] for row in (0, -1))
    document = build(study, COVER)
    for point in (start, end):
        assert ",\u00a0".join(f"{value:.1f}" for value in point).replace("-", "−") in words(document, "The path")
    between = str(table(document, "in numbers").rows[-1][1])
    assert f"at most {between} " in words(document, "Summary")


def test_numbers_keep_their_units_and_comparisons_their_sides() -> None:
    assert unbroken("x = (1 N m, 2)") == "x = (1\u00a0N\u00a0m, 2)"
    assert unbroken("62 % of 5 mm and 3 more, w ≥ 0") == "62\u00a0% of 5\u00a0mm and 3 more, w\u00a0≥\u00a00"
    assert with_minus("q1 - q4, -x and a - b") == "q1 − q4, −x and a - b"


def test_the_points_of_a_column_stand_below_each_other_and_marks_beside_it() -> None:
    rows = lined_up([("1", "0.94 †", "18 %"), ("2", "−11", "4 of 5"), ("3", "–", "")])
    assert rows == (("1", "0.94 †", "18 %"), ("2", "−11.00", "4 of 5"), ("3", "–", ""))
    table = Table("", (Column("i", "center"), Column("limit"), Column("share")), rows)
    assert [table.hanging(column) for column in range(3)] == [False, True, False]


def test_a_small_deviation_in_units_that_nobody_knows_is_no_zero() -> None:
    deviation, measures = np.array([np.nan, 3.2e-5]), Measures(load_robot("rrrp"), Units())
    assert between(deviation, measures) == ("3.2·10⁻⁵", "units")


@pytest.mark.parametrize("counted", [True, False])
def test_own_weight_is_in_the_share_where_the_student_counts_it(counted: bool) -> None:
    study = study_of("ur5e", on_path=False)
    load = replace(study.experiment.load, own_weight=counted)
    study = replace(study, experiment=study.experiment.with_load(load))
    shown = table(build(study, COVER), "Torques")
    heads = [column.head for column in shown.columns]
    assert ("together" in heads) == counted
    row = dict(zip(heads, shown.rows[1], strict=True))
    outer, weight = (float(row[name].replace("−", "-")) for name in ("from F", "own weight"))
    rated = study.robot.joints[1].max_torque.value
    assert row["share"] == f"{100.0 * abs(outer + counted * weight) / rated:.0f} %"


def test_a_letter_with_an_index_is_told_from_a_name() -> None:
    assert [run.text for run in with_indices("n_z and Desired_tr") if run.style == "index"] == ["n_z"]
    assert plain(with_indices("n_z and Desired_tr")) == "n_z and Desired_tr"
    assert with_indices("\u0648o_z")[1].style == "index"  # “and” is one with what follows it


def test_what_ran_on_an_arm_is_compared_with_what_was_wanted() -> None:
    study = study_of("al5b")
    wanted = np.linspace(study.robot.home, study.q, 50)
    measured = np.where(np.arange(50)[:, None] % 5 == 0, wanted + np.radians(2.0), np.nan)
    ran = replace(study, recording=Recording(np.linspace(0.0, 2.0, 50), wanted, wanted, measured), measured="By eye.")
    rows = table(build(ran, COVER), "Deviations").rows
    assert len(rows) == study.robot.dof + 1
    assert rows[0][2] == "0.000"
    assert rows[0][4] == rows[0][5] == "2.000"


def test_what_a_controller_reports_of_its_pulses_is_not_called_measured() -> None:
    study = study_of("al5b")
    t, q = np.linspace(-1.0, 1.0, 21), np.linspace(study.robot.home, study.q, 21)
    recording = Recording(t, q, q, q + np.radians(1.0), "commanded pulse", planned=4.0).with_true(t, q + 0.01)
    document = build(replace(study, recording=recording, run="It ran on rvsim’s virtual arm."), COVER, ("measured",))
    section = next(section for section in document.sections if section.title.startswith("On the arm"))
    words = [plain(block.words) for block in section.blocks if isinstance(block, Paragraph)]
    assert section.title.endswith("reported")
    assert "stopped at 1.0 of 4.0 s" in words[0]
    assert "It ran on rvsim’s virtual arm." in words[0]
    shown = table(document, "Deviations")
    assert [column.head for column in shown.columns][2::2] == ["sent RMS", "reported RMS", "really RMS"]
    assert "measured" not in shown.note
    curves = next(block for block in section.blocks if isinstance(block, Figure)).pictures[0].curves
    assert [curve.name for curve in curves] == ["desired", "commanded", "reported", "really"]
    assert min(curve.x.min() for curve in curves) >= 0.0


def test_an_arm_with_servos_shows_how_they_are_calibrated() -> None:
    study = study_of("al5b", on_path=False)
    rows = table(build(study, COVER, ("robot",)), "Calibration").rows
    servo = study.robot.servos[0]
    assert rows[0][1] == str(servo.channel)
    assert float(str(rows[0][3])) == pytest.approx(servo.us_per_rad * np.pi / 180.0, abs=6e-4)
    assert len(rows) == study.robot.dof + 1


class _Plain:
    """An artist that draws nothing."""

    def formula(self, latex: str) -> str:
        return f"<i>{len(latex)}</i>"

    def picture(self, picture: ScenePicture) -> str:
        return f"data:,{picture.width}"


def test_the_page_is_well_formed_and_what_was_typed_stays_text() -> None:
    page = html_page(build(study_of("rrrp"), COVER), _Plain())
    root = ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))
    assert root.findtext("head/title") == COVER.title
    assert COVER.author in "".join(root.itertext())
    assert "<b>Second</b>" in "".join(root.itertext())
    assert root.find(".//script") is None
    assert "http" not in page


@pytest.fixture
def arabic() -> Iterator[None]:
    speak("ar")
    yield
    speak("en")


def test_a_report_in_arabic_is_read_from_the_right_but_for_its_numbers(arabic: None) -> None:
    document = build(study_of("rv-m1"), COVER)
    root = ElementTree.fromstring(html_page(document, _Plain()).removeprefix("<!DOCTYPE html>"))
    assert (root.get("lang"), root.get("dir")) == ("ar", "rtl")
    tables = [block for block in document.blocks() if isinstance(block, Table)]
    assert [element.get("dir") == "ltr" for element in root.iter("table")] == [each.of_numbers for each in tables]
    assert {each.of_numbers for each in tables} == {True, False}
    assert all(element.get("direction") == "ltr" for element in root.iter("svg"))
    formulas = [element for element in root.iter("span") if element.get("class") == "parts"]
    assert len(formulas) == sum(isinstance(block, Formula | Formulas) for block in document.blocks())
    assert {element.get("dir") for element in formulas} == {"ltr"}


def test_what_is_written_for_machines_is_the_same_in_every_language(arabic: None) -> None:
    study = study_of("rv-m1")
    told = (tracking_csv(study.tracking), motion_csv(study.curves), tracking_script(study.tracking))
    speak("en")
    assert told == (tracking_csv(study.tracking), motion_csv(study.curves), tracking_script(study.tracking))


def test_axes_have_round_numbers_that_lie_on_them() -> None:
    for low, high in ((0.0, 1.0), (-157.3, 12.1), (1e-15, 3e-15), (5.0, 5.0), (-1e7, 2e7)):
        found = axis(low, high)
        assert found.low <= low <= high <= found.high
        assert 2 <= len(found.ticks) <= 8
        assert len(set(found.texts)) == len(found.texts) == len(found.ticks)


def test_a_chart_is_a_drawing_of_its_own() -> None:
    t = np.linspace(0.0, 2.0, 5000)
    wave = np.where((t > 1.0) & (t < 1.1), np.nan, np.sin(9.0 * t))
    few = thinned(Curve("wave", "#0072B2", t, wave))
    assert len(few.x) < 700
    assert np.nanmax(few.y) == np.nanmax(wave)
    assert np.nanmin(few.y) == np.nanmin(wave)
    assert np.isnan(few.y).any()
    chart = Chart("A < B", "t [s]", "[°]", (few, few), (Limit(1.0, "#D55E00", 1),), (1.0,))
    root = ElementTree.fromstring(chart_svg(chart))
    assert root.findtext("{http://www.w3.org/2000/svg}title") == "A < B"
    assert "nan" not in chart_svg(chart)
