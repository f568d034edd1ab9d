"""A motion that would hurt an arm is told before it runs: where, when, and by how much."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import ArrayLike

from rvsim.files import load_robot
from rvsim.lab.before_running import objections
from rvsim.lab.sentences import Units
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import within_servos

AL5B = within_servos(load_robot("al5b"))


@dataclass(frozen=True)
class Straight:
    """Evenly from one pose to the next [degrees, s]."""

    start: tuple[float, ...]
    end: tuple[float, ...]
    duration: float

    def q(self, t: ArrayLike) -> FloatArray:
        share = np.asarray(t, dtype=np.float64)[..., None] / self.duration
        return np.radians(self.start) + share * (np.radians(self.end) - np.radians(self.start))


HOME = (0.0, 90.0, -90.0, 0.0, 0.0)


def test_a_calm_motion_may_run() -> None:
    assert objections(AL5B, Straight(HOME, (40.0, 100.0, -80.0, 10.0, 30.0), 2.0), Units()) == ()


@pytest.mark.parametrize(
    ("end", "seconds", "what"),
    [
        ((0.0, 90.0, -90.0, 0.0, 100.0), 2.0, r"2\.00 s wrist rotate would be at 100.*stop at 8[23]"),
        ((80.0, 90.0, -90.0, 0.0, 0.0), 0.2, r"base would turn at 190 ?% of its top speed"),
        ((0.0, 10.0, -50.0, 0.0, 0.0), 2.0, r"the arm would touch the table, \d+ mm deep"),
        ((0.0, 130.0, -160.0, -90.0, 0.0), 4.0, r"the arm would touch itself"),
    ],
)
def test_what_would_hurt_is_said(end: tuple[float, ...], seconds: float, what: str) -> None:
    said = " ".join(objections(AL5B, Straight(HOME, end, seconds), Units()))
    assert re.search(what, said), said


def test_without_a_table_none_is_touched() -> None:
    low = Straight(HOME, (0.0, 10.0, -50.0, 0.0, 0.0), 2.0)
    assert not any("table" in sentence for sentence in objections(AL5B, low, Units(), table=None))
