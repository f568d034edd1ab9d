"""Findings in words: one sentence each, in the units asked for, that says where."""

from __future__ import annotations

import pytest

from rvsim import load_robot
from rvsim.lab import named_path
from rvsim.lab.findings import finding_sentence, summary_sentence
from rvsim.lab.sentences import Units
from rvsim.motion import track, trajectory_of
from rvsim.motion.honesty import FindingKind, Report, check


def report_of(name: str, path: str) -> Report:
    robot = load_robot(name)
    tracking = track(robot, named_path(path, robot))
    return check(tracking, trajectory_of(tracking, robot.home))


@pytest.fixture(scope="module")
def ellipse() -> Report:
    return report_of("ur5e", "ellipse")


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("reach", "62 %: 114 of 184 points reached."),
        ("missed", "Points 77–146: in reach, but not in this orientation."),
        ("table", "Link 5 (behind wrist 2) is 278 mm below it on the way to the path."),
    ],
)
def test_of_the_ellipse_as_printed(ellipse: Report, kind: FindingKind, sentence: str) -> None:
    assert finding_sentence(ellipse, ellipse.of(kind)[0], Units()) == sentence


def test_the_singularity_has_its_name(ellipse: Report) -> None:
    text = finding_sentence(ellipse, ellipse.of("singular")[0], Units())
    assert text.endswith("as good as singular: the shoulder singularity.")
    assert "·10⁻⁵" in text


def test_the_units_are_those_asked_for(ellipse: Report) -> None:
    speed, table = ellipse.of("speed")[0], ellipse.of("table")[0]
    assert "°/s" in finding_sentence(ellipse, speed, Units())
    assert "rad/s" in finding_sentence(ellipse, speed, Units("rad", "m"))
    assert "0.278 m below" in finding_sentence(ellipse, table, Units("rad", "m"))


@pytest.mark.parametrize(("ease", "words"), [(False, "all of it is slowed down"), (True, "where a joint needs it")])
def test_a_time_too_short_names_the_joint_the_place_and_both_times(ease: bool, words: str) -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, named_path("letter-board", robot))
    motion = trajectory_of(tracking, robot.home, path_seconds=3.0, ease=ease)
    assert motion is not None
    report = check(tracking, motion)
    (late,) = report.of("pace")
    assert late.severity == ("good" if ease else "warning")
    assert late.value == pytest.approx(motion.duration - motion.path_start)
    text = finding_sentence(report, late, Units())
    assert words in text
    assert "3.00 s asked for" in text
    assert f"at point {late.index + 1}" in text
    assert not check(tracking, trajectory_of(tracking, robot.home, path_seconds=30.0)).of("pace")


@pytest.mark.parametrize(
    ("name", "path"), [("rrrp", "spiral"), ("scara", "star"), ("planar", "star"), ("rv-m1", "line")]
)
def test_every_finding_of_every_kind_of_arm_is_a_sentence(name: str, path: str) -> None:
    report = report_of(name, path)
    for finding in report.findings:
        text = finding_sentence(report, finding, Units())
        assert text.endswith(".")
        assert text[0].isupper() or not text[0].isalpha() or text.startswith("σ")
        assert "nan" not in text


def test_the_verdict_counts_what_is_wrong(ellipse: Report) -> None:
    assert summary_sentence(ellipse) == "Not as it is: 3 things are wrong."
    assert summary_sentence(report_of("al5b", "star")) == "Nothing speaks against running it."
