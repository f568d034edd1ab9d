"""What machines read is the same in every language: files, tables and scripts."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import rvsim.language
from rvsim import load_robot
from rvsim.experiment import SessionState
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Wait
from rvsim.files.program_file import program_text
from rvsim.files.robot_writer import robot_text
from rvsim.files.session_file import session_bytes
from rvsim.lab import named_path
from rvsim.lab.lines import default_experiment
from rvsim.lab.motion_table import motion_csv
from rvsim.lab.recording_table import recording_csv
from rvsim.lab.script import motion_script
from rvsim.lab.sources.collection import erratum_of
from rvsim.lab.sources.reproduce import Reproduction, _of_erratum
from rvsim.lab.sources.reproduction_texts import reproduction_csv, reproduction_latex
from rvsim.lab.tables import tracking_csv
from rvsim.language import LANGUAGES, Catalogue
from rvsim.motion import joint_move, track
from rvsim.playback.curves import curves_of
from rvsim.playback.recording import Recording
from rvsim.robot.edits import copied_source, with_dh_value
from rvsim.robot.mass_edits import with_guessed_masses, with_mass_value
from rvsim.robot.rating_edits import with_guessed_ratings

RV_M1, AL5B, PLANAR = (load_robot(name) for name in ("rv-m1", "al5b", "planar"))
TIMES = np.array([0.0, 0.5])
Q = np.tile(AL5B.home, (2, 1))


class Strange(dict[str, tuple[str, ...]]):
    """A catalogue that has every text, and none as it is."""

    def get(self, key: str, default: object = None) -> tuple[str, ...]:
        return (f"⟦{key}⟧",)


@pytest.fixture
def strange(monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """Speaks, from when it is called, a language that is written from right to left."""
    return lambda: monkeypatch.setattr(
        rvsim.language, "_spoken", (LANGUAGES["ar"], Catalogue(Strange(), lambda number: 0))
    )


def edited_arm() -> str:
    robot = with_dh_value(with_mass_value(RV_M1, 1, "mass", 2.0), 2, "a", 0.2)
    return robot_text(with_guessed_ratings(robot)) + robot_text(with_guessed_masses(PLANAR)) + copied_source(RV_M1)


def program() -> str:
    place = (0.2, 0.0, 0.1)
    moves = (JointMove(pose="up"), LineMove(place, "free"), ArcMove(place, place), Wait(1.0), Gripper(0.5))
    return program_text(moves, AL5B)


def session() -> bytes:
    robot = with_mass_value(RV_M1, 1, "mass", 2.0)
    return session_bytes(SessionState(default_experiment(robot)))


def recordings() -> str:
    kinds = ("commanded pulse", "encoders")
    return "".join(recording_csv(AL5B, Recording(TIMES, Q, Q, Q, kind, planned=3.0)) for kind in kinds)


def rows() -> tuple[Reproduction, ...]:
    return tuple(_of_erratum(erratum_of(key)) for key in ("000-P6", "000-3", "000-4", "002-spacing", "002-R", "003-l6"))


WRITTEN: dict[str, Callable[[], object]] = {
    "robot file": edited_arm,
    "program": program,
    "session": session,
    "recording": recordings,
    "motion": lambda: motion_csv(curves_of(RV_M1, joint_move(RV_M1, RV_M1.home, RV_M1.home + 0.1), samples=3)),
    "tracking": lambda: tracking_csv(track(RV_M1, named_path("line", RV_M1, samples=5))),
    "script": lambda: motion_script(RV_M1, [0.0], RV_M1.home[None]) + motion_script(PLANAR, [0.0], PLANAR.home[None]),
    "numbers": lambda: reproduction_csv(rows()),
    "numbers in LaTeX": lambda: reproduction_latex(rows()),
}


@pytest.mark.parametrize("kind", WRITTEN)
def test_it_has_the_same_bytes_whatever_is_spoken(kind: str, strange: Callable[[], None]) -> None:
    english = WRITTEN[kind]()
    strange()
    assert WRITTEN[kind]() == english
