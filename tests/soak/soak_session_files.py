"""Spoil session files in thousands of ways: each mutant is a sound session or one `SessionFileError`.

    python tests/soak/soak_session_files.py [--count 20000] [--seed 0]

A sound one saves, opens again with the same bytes, and its experiment can be worked with. Prints how many were read and
refused, the refusals by kind, and leaves with 1 at any other exception, naming its seed.
tests/files/test_session_file.py runs a slice of the same mutants.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
import traceback
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np

from rvsim import forward_kinematics, load_robot, robot_names
from rvsim.errors import SessionFileError
from rvsim.experiment import (
    SHAPE_KINDS,
    CameraView,
    DeviceSettings,
    Load,
    Notes,
    Placement,
    SessionState,
    TrajectoryTask,
    View,
)
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Wait
from rvsim.files.session_file import session_bytes, session_of
from rvsim.lab.lines import default_experiment
from rvsim.lab.shape_paths import shape_of

_LARGE_TEXT = "z" * 5000
VALUES: tuple[Any, ...] = (
    *(0, 1, -1, 7, -0.0, 1e-9, 1e6, 1e308, -1e308, 1.5708, 10**30, 10**400, True, False, None),
    *("", "x", "90", "\u0000", "\U0001f916", _LARGE_TEXT, "../x.csv", "/etc/passwd", "__import__('os')", "rv-m1"),
    *([], {}, [[]], [1, 2], [1, 2, 3], [0] * 6, [True], [None], {"value": 1}, [{}], {"name": "ur5e"}, {"file": {}}),
    *({"kind": "circle"}, {"kind": "wait", "seconds": 1}, [[1, 2, 3]] * 3, [_LARGE_TEXT] * 3),
)
SCRAPS = (
    *(b"NaN", b"Infinity", b"-Infinity", b"1e999", b"9" * 5000, b"null", b'"\\ud800"', b'"\\u0000"', b"0x1F", b"+1"),
    *(b"[" * 5000, b"]", b"{", b"}", b",", b":", b'"', b"\x00", b"\xff", b"\xef\xbb\xbf", b"\r\n", b"/*", b"'"),
    *(b'"version": 2,', b'"version": 0,', b'"format": 1,', b'"q": [0],', b'"experiment": {', b'"robot": "rv-m1"'),
)
TOKEN = re.compile(rb'"[^"\n]*"|[+-]?[\w.]+|[^\s\w]')


def _sessions() -> Iterator[SessionState]:
    """One for each built-in arm, with something in every corner; every third arm is a copy of the user's own."""
    kinds = sorted(SHAPE_KINDS)
    for number, name in enumerate(robot_names()):
        robot = load_robot(name)
        if number % 3 == 0:
            robot = robot.with_joint(0, d=robot.joints[0].d + 0.0123).renamed(f"my-{name}", f"my {robot.title}")
        start = default_experiment(robot)
        kind = kinds[number % len(kinds)]
        shape = shape_of(robot, TrajectoryTask(kind))
        place = Placement(np.array([0.1, 0.2, 0.3]), np.array([0.4, 0.5, 0.6]), 0.5)
        point = (0.1, 0.2, 0.3)
        experiment = replace(
            start.with_pose("a").with_pose("b"),
            trajectory=TrajectoryTask(kind, "turn", 0.3, shape, place, point, point, 0.1),
            target=forward_kinematics(robot, robot.home),
            law="trapezoid",
            path_seconds=3.25,
            program=(
                JointMove(tuple(map(float, start.q)), speed=0.3),
                JointMove(pose="a"),
                LineMove(point, "turn", point),
                ArcMove(point, point),
                Wait(0.5),
                Gripper(0.5),
            ),
            load=Load(np.arange(6.0), "tool", 0.3, True),
            ease=True,
            notes=Notes("Ada", "first line\nsecond line"),
            typed=start.q,
        )
        camera = CameraView(0.1, 0.2, 0.6, False, (0.1, 0.2, 0.3), 2.0)  # type: ignore[arg-type]
        view = View(camera, "both", "lab", 2.0, True)
        yield SessionState(experiment, (start,), DeviceSettings("al5b://?seed=2", 38400, "bridge"), view)


FILES = [session_bytes(state) for state in _sessions()]


def mutant(seed: int) -> bytes:
    """A session file, spoilt one to three times: as text, or as values in a document that stays JSON."""
    dice = random.Random(seed)
    data = dice.choice(FILES)
    if dice.random() < 0.6:
        document = json.loads(data)
        for _ in range(dice.choice((1, 1, 1, 2, 3))):
            _spoil_value(document, dice)
        return json.dumps(document, ensure_ascii=dice.random() < 0.5).encode("utf-8", "surrogatepass")
    for _ in range(dice.randint(1, 3)):
        data = dice.choice((_replaced_bytes, _truncated, _doubled, _other_token))(data, dice)
    return data


def outcome(data: bytes) -> str:
    """What becomes of a file: "sound", or the kind of its refusal; anything else raises."""
    try:
        opened = session_of(data, "mutant.rvsim")
    except SessionFileError as problem:
        return _kind(problem)
    _assert_sound(opened.state)
    return "sound"


def _kind(problem: SessionFileError) -> str:
    assert problem.where, "an error without a place"
    assert len(str(problem)) < 2500, "an endless message"
    if problem.expected == "JSON":
        return "no JSON"
    return re.sub(r"'.*'", "…", re.sub(r"\d+", "N", problem.where))


def _assert_sound(state: SessionState) -> None:
    experiment = state.experiment
    for values in (experiment.q, experiment.line.start, experiment.load.wrench):
        assert np.isfinite(values).all()
    forward_kinematics(experiment.robot, experiment.q)
    assert 2 <= experiment.line.samples < 30_000
    data = session_bytes(state)
    assert session_bytes(session_of(data, "again.rvsim").state) == data


def _spoil_value(document: Any, dice: random.Random) -> None:
    """Walk down some way, and put something else there, take it away, or put it under another name."""
    here = document
    while True:
        keys: list[Any] = list(here) if isinstance(here, dict) else list(range(len(here)))
        if not keys:
            return
        key = dice.choice(keys)
        inner = here[key]
        if not isinstance(inner, dict | list) or not inner or dice.random() < 0.1:
            break
        here = inner
    deed = dice.random()
    if deed < 0.75:
        scaled = isinstance(inner, float) and dice.random() < 0.7
        here[key] = inner * dice.choice((0.5, -1.0, 1.01, 1e5)) if scaled else deepcopy(dice.choice(VALUES))
    elif deed < 0.9 or isinstance(here, list):
        del here[key]
    else:
        here[dice.choice((f"{key}s", str(key)[:-1], "kind", "name"))] = here.pop(key)


def _replaced_bytes(data: bytes, dice: random.Random) -> bytes:
    start = dice.randrange(len(data) + 1)
    return data[:start] + dice.randbytes(dice.randint(0, 3)) + data[start + dice.choice((0, 1, 1, 2, 40)) :]


def _truncated(data: bytes, dice: random.Random) -> bytes:
    return data[: dice.randrange(len(data) + 1)]


def _doubled(data: bytes, dice: random.Random) -> bytes:
    start = dice.randrange(len(data) + 1)
    piece = data[start : start + dice.choice((1, 10, 200, 2000))]
    return data[:start] + piece * dice.choice((2, 2, 2, 300)) + data[start + len(piece) :]


def _other_token(data: bytes, dice: random.Random) -> bytes:
    tokens = list(TOKEN.finditer(data))
    if not tokens:
        return data
    token = dice.choice(tokens)
    new = dice.choice((*SCRAPS, dice.choice(tokens).group()))
    return data[: token.start()] + new + data[token.end() :]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    kinds: Counter[str] = Counter()
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        try:
            kinds[outcome(mutant(seed))] += 1
        except Exception:
            traceback.print_exc()
            print(f"mutant {seed} broke the rule: a sound session or one SessionFileError")
            return 1
    print(f"{arguments.count} mutants: {kinds['sound']} sound sessions, {arguments.count - kinds['sound']} refused")
    for kind, number in kinds.most_common(25):
        print(f"{number:7d}  {kind}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
