"""Spoil the shipped robot files in thousands of ways: each mutant is a sound arm or one `RobotFileError`.

    python tests/soak/soak_robot_files.py [--count 10000] [--seed 0]

Prints how many were read and refused, the refusals by kind, and leaves with 1 at any other exception, naming its seed.
tests/files/test_robot_file.py runs a slice of the same mutants.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import traceback
from collections import Counter
from collections.abc import Callable

import numpy as np

from rvsim import forward_kinematics, robot_names
from rvsim.errors import RobotFileError
from rvsim.files.robot_file import robot_from_bytes
from rvsim.files.robot_writer import robot_text
from rvsim.resources import resource
from rvsim.robot import Robot

FILES = [resource("robots", f"{name}.toml").read_bytes() for name in robot_names()]
# Values that TOML can read, and scraps that it mostly cannot.
NUMBERS = ("nan", "inf", "-inf", "-0.0", "0", "1", "-1", "7", "1e-9", "1e6", "1e7", "1e308", "1e999", "1.5708", "0x1F")
VALUES = (
    *NUMBERS,
    *("9" * 400, "9" * 5000, "1_000", "true", "false", "2024-01-01", "07:32:00"),
    *('""', '"x"', "'y'", '"90"', '"\\u0000"', f'"{"z" * 5000}"', '"unit"', '"prismatic"', '"modified"', '"#E69F00"'),
    *("[]", "{}", "[[]]", "[1, 2]", "[1, 2, 3]", "[1, nan, 3]", "[true, 2, 3]", "{ value = 1 }", "[" * 60 + "]" * 60),
)
SCRAPS = (
    *('"""', "'''", "[" * 3000, "]", "[[joint]]", "[base]", "2024-13-99", "+", "..", "#", "=", ","),
    *("joint", "alpha", "alhpa", "home = 3", "a.b.c = 1", "\x00", "\ufeff", "é", "\r\n", "\t"),
)
VALUE = re.compile(r"= (\[[^\]]*\]|\"[^\"]*\"|[^\s,}]+)")
TOKEN = re.compile(r"[+-]?[\w.]+|\"[^\"\n]*\"|[^\s\w]")


def mutant(seed: int) -> bytes:
    """A shipped file, spoilt one to three times."""
    dice = random.Random(seed)
    data = dice.choice(FILES)
    spoilers = dice.choice((SPOILERS, VALUE_SPOILERS))
    for _ in range(dice.randint(1, 3)):
        data = dice.choice(spoilers)(data, dice)
    return data


def outcome(data: bytes) -> str:
    """What becomes of a file: "sound", or the kind of its refusal; anything else raises."""
    try:
        robot = robot_from_bytes(data, "mutant.toml")
    except RobotFileError as problem:
        return _kind(problem)
    _assert_sound(robot)
    return "sound"


def _kind(problem: RobotFileError) -> str:
    assert problem.where, "an error without a place"
    assert len(str(problem)) < 2000, "an endless message"
    place = re.sub(r"\d+", "N", re.sub(r"^line \d+, ", "", problem.where))
    if problem.expected == "TOML":
        return "no TOML"
    return re.sub(r"'.*'", "…", place) if "unknown key" in problem.found else place


def _assert_sound(robot: Robot) -> None:
    assert np.all(np.isfinite(robot.dh))
    assert np.all(robot.limits[:, 0] < robot.limits[:, 1])
    assert np.all((robot.limits[:, 0] <= robot.home) & (robot.home <= robot.limits[:, 1]))
    assert np.all(np.isfinite(forward_kinematics(robot, robot.home)))
    again = robot_from_bytes(robot_text(robot).encode(), "again.toml")
    np.testing.assert_allclose(again.dh, robot.dh, rtol=1e-14, atol=1e-15)


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
    text = data.decode(errors="surrogateescape")
    tokens = list(TOKEN.finditer(text))
    if not tokens:
        return data
    token = dice.choice(tokens)
    new = dice.choice((*VALUES, *SCRAPS, dice.choice(tokens).group()))
    return (text[: token.start()] + new + text[token.end() :]).encode(errors="surrogateescape")


def _by_line(change: Callable[[list[str], int, random.Random], None]) -> Callable[[bytes, random.Random], bytes]:
    def spoil(data: bytes, dice: random.Random) -> bytes:
        lines = data.decode(errors="surrogateescape").split("\n")
        change(lines, dice.randrange(len(lines)), dice)
        return "\n".join(lines).encode(errors="surrogateescape")

    return spoil


def _other_value(lines: list[str], index: int, dice: random.Random) -> None:
    index = dice.choice([i for i, line in enumerate(lines) if "=" in line] or [index])
    values = list(VALUE.finditer(lines[index]))
    if values:
        value = dice.choice(values)
        lines[index] = lines[index][: value.start(1)] + dice.choice(VALUES) + lines[index][value.end(1) :]


def _other_key(lines: list[str], index: int, dice: random.Random) -> None:
    key, equals, value = lines[index].partition("=")
    lines[index] = (key.strip()[:-1] if dice.random() < 0.5 else dice.choice(SCRAPS)) + equals + value


def _no_line(lines: list[str], index: int, dice: random.Random) -> None:
    del lines[index : index + dice.choice((1, 1, 1, 13))]


def _swapped_lines(lines: list[str], index: int, dice: random.Random) -> None:
    other = dice.randrange(len(lines))
    lines[index], lines[other] = lines[other], lines[index]


# Half of the mutants stay TOML, so that what a value means is tried as often as how it is written.
VALUE_SPOILERS = (_by_line(_other_value),)
SPOILERS = (
    *(_replaced_bytes, _truncated, _doubled, _other_token),
    *(_by_line(change) for change in (_other_value, _other_key, _no_line, _swapped_lines)),
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    kinds: Counter[str] = Counter()
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        try:
            kinds[outcome(mutant(seed))] += 1
        except Exception:
            traceback.print_exc()
            print(f"mutant {seed} broke the rule: a sound arm or one RobotFileError")
            return 1
    print(f"{arguments.count} mutants: {kinds['sound']} sound arms, {arguments.count - kinds['sound']} refused")
    for kind, number in kinds.most_common(25):
        print(f"{number:7d}  {kind}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
