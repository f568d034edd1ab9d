"""What a student reads after tracking."""

from __future__ import annotations

import numpy as np

from rvsim import load_robot
from rvsim.lab import named_path
from rvsim.lab.sentences import (
    Units,
    advice_sentence,
    deviation_sentence,
    joint_amount,
    length_error,
    short_sentence,
    tracking_sentence,
)
from rvsim.motion import Tracking, track


def line_of_source_000(ignore_limits: bool = False) -> Tracking:
    robot = load_robot("rv-m1")
    path = named_path("line", robot, samples=11, start=(0.11, 0.0, 0.13), end=(0.23, 0.0, 0.333))
    return track(robot, path, ignore_limits=ignore_limits)


def test_the_line_of_source_000_in_words() -> None:
    assert tracking_sentence(line_of_source_000()) == (
        "4 of 11 points reached within the limits; 7 not: points 1–6: the elbow needs −156.7° … −116.9° and stops at "
        "−110°; point 11: the wrist pitch needs −94.7°, stops at −90°."
    )
    assert short_sentence(line_of_source_000()) == "4 of 11 points reached within the limits."
    assert advice_sentence(line_of_source_000()) == "Leave the pitch free, ignore the limits, or move the path."


def test_all_and_none() -> None:
    rv_m1, ur5e = load_robot("rv-m1"), load_robot("ur5e")
    every = line_of_source_000(ignore_limits=True)
    assert tracking_sentence(every) == "All 11 points reached without regard to the limits."
    assert advice_sentence(every) == ""
    none = track(rv_m1, named_path("letter-raw", rv_m1))
    assert tracking_sentence(none) == "None of 50 points reached within the limits: out of reach in any orientation."
    assert deviation_sentence(none) == "No point was reached: there is no deviation to tell."
    assert advice_sentence(none) == "Move the path nearer to where the arm can work."
    some = track(ur5e, named_path("ellipse", ur5e))
    assert tracking_sentence(some) == (
        "114 of 184 points reached within the limits; 70 not: points 77–146: in reach, but not in this orientation."
    )
    assert advice_sentence(some) == "Leave the orientation free, or move the path."


def test_deviations_are_never_rounded_to_nothing() -> None:
    sentence = deviation_sentence(line_of_source_000())
    assert sentence.startswith("RMS ")
    assert "e−1" in sentence
    assert " mm over the 4 points reached, largest " in sentence
    assert length_error(load_robot("rv-m1"), 0.0) == "0.0e+00 mm"


def test_amounts_have_the_units_of_the_screen() -> None:
    rv_m1, rrrp, scara = load_robot("rv-m1"), load_robot("rrrp"), load_robot("scara")
    assert joint_amount(rv_m1, "elbow", np.radians(-156.744)) == "−156.7°"
    assert joint_amount(rv_m1, "elbow", np.radians(-1e-9)) == "0°"
    assert joint_amount(scara, "d3", 0.0125) == "12.5 mm"
    assert joint_amount(rrrp, "l6", 4.25) == "4.25 units"


def test_radians_and_metres_where_they_are_preferred() -> None:
    rrrp, scara, units = load_robot("rrrp"), load_robot("scara"), Units("rad", "m")
    tracking = line_of_source_000()
    assert "the elbow needs −2.736 rad … −2.041 rad and stops at −1.92 rad" in tracking_sentence(tracking, units)
    assert "°" not in tracking_sentence(tracking, units)
    assert " m over the 4 points reached" in deviation_sentence(tracking, units)
    assert joint_amount(scara, "d3", 0.0125, units) == "0.0125 m"
    assert joint_amount(rrrp, "l6", 4.25, units) == "4.25 units"


def test_a_joint_with_a_symbol_for_a_name_gets_no_article() -> None:
    cartesian = load_robot("cartesian")
    path = named_path("line", cartesian, start=(0.3, 0.2, 0.15), end=(0.3, 0.5, 0.15), samples=4)
    assert "d2 needs 500 mm, stops at 400 mm" in tracking_sentence(track(cartesian, path))
