"""The check before a motion: the sources' paths with what is known of them, and that each finding is where it says."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.kinematics import singularity
from rvsim.kinematics.clearance import clearance
from rvsim.lab import named_path
from rvsim.motion import Tracking, track, trajectory_of
from rvsim.motion.honesty import SEVERITIES, Report, check, time_of_index


def report_of(name: str, path: str, orientation: str | None = None, law: str = "quintic") -> Report:
    robot = load_robot(name)
    tracking = track(robot, named_path(path, robot, orientation=orientation))  # type: ignore[arg-type]
    return check(tracking, trajectory_of(tracking, robot.home, law=law))  # type: ignore[arg-type]


def test_of_the_ellipse_as_printed_114_of_184_points_are_reached_and_the_orientation_is_why() -> None:
    report = report_of("ur5e", "ellipse")
    (reach,), (missed,) = report.of("reach"), report.of("missed")
    assert report.severity == reach.severity == missed.severity == "bad"
    assert reach.value == pytest.approx(114 / 184)
    assert (missed.index, missed.last, missed.cause) == (76, 145, "orientation")
    assert report.of("singular")[0].family == "shoulder"


def test_a_clean_path_has_nothing_but_good_findings() -> None:
    report = report_of("al5b", "star")
    assert {finding.severity for finding in report.findings} == {"good"}
    assert {finding.kind for finding in report.findings} == {
        "reach", "speed", "acceleration", "singular", "table", "own",
    }  # fmt: skip


def test_the_worst_comes_first() -> None:
    order = [SEVERITIES.index(finding.severity) for finding in report_of("ur5e", "ellipse").findings]
    assert order == sorted(order)


@pytest.mark.parametrize("law", ["quintic", "trapezoid", "quickest"])
def test_no_law_breaks_a_limit_and_the_peaks_are_where_they_say(law: str) -> None:
    report = report_of("ur5e", "ellipse-moved", law=law)
    assert report.trajectory is not None
    for peak in report.speeds:
        assert peak.share <= 1.0 + 1e-6
        assert abs(report.trajectory.at(peak.time).qd[peak.joint]) == pytest.approx(peak.value, rel=1e-9)
    (worst,) = report.of("speed")
    assert worst.value / worst.limit == max(peak.share for peak in report.speeds)


def test_sigma_and_clearance_are_those_of_the_pose_at_that_moment() -> None:
    report = report_of("rv-m1", "letter-board", "source")
    assert report.trajectory is not None
    (singular,), (table,), (own,) = (report.of(kind) for kind in ("singular", "table", "own"))
    q = report.trajectory.q(singular.time or 0.0)
    assert singularity(report.robot, q).task.sigma_min == pytest.approx(singular.value, rel=1e-9)
    assert float(clearance(report.robot, report.trajectory.q(table.time or 0.0)).table) == pytest.approx(table.value)
    assert float(clearance(report.robot, report.trajectory.q(own.time or 0.0)).own) == pytest.approx(own.value)


def test_the_table_can_be_higher_and_can_be_missing() -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, named_path("letter-flat", robot))
    low, high = check(tracking, None), check(tracking, None, table=0.05)
    assert low.of("table")[0].value - high.of("table")[0].value == pytest.approx(0.05)
    assert not check(tracking, None, table=None).of("table")


def test_a_moment_of_a_point_is_when_the_tool_is_there() -> None:
    robot = load_robot("ur5e")
    tracking = track(robot, named_path("ellipse-moved", robot))
    trajectory = trajectory_of(tracking, robot.home)
    assert trajectory is not None
    for index in (0, 17, 100, 183):
        time = time_of_index(trajectory, index)
        np.testing.assert_allclose(trajectory.q(time), tracking.q[index], atol=1e-3)


def test_of_a_path_without_a_reached_point_the_missed_stretch_is_all_there_is_to_say() -> None:
    robot = load_robot("rv-m1")
    tracking: Tracking = track(robot, named_path("letter-raw", robot))
    report = check(tracking, None)
    assert {finding.kind for finding in report.findings} == {"reach", "missed"}
    assert report.of("missed")[0].cause == "reach"
