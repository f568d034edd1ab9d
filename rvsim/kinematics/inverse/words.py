"""The branches' names, in the field's words: English as data, and as `branch_title` in the language that is spoken."""

from __future__ import annotations

from itertools import product

from rvsim.kinematics.inverse.chain import Chain
from rvsim.language import tr, tr_later

ELBOW = (tr_later("elbow up"), tr_later("elbow down"))
WRIST = (tr_later("wrist no-flip"), tr_later("wrist flip"))
SIDES = (tr_later("front"), tr_later("back"))
SHOULDERS = (tr_later("left shoulder"), tr_later("right shoulder"))
EXTENSION = (tr_later("extended ahead"), tr_later("extended behind"))
FACING = (tr_later("facing"), tr_later("turned away"))
ELBOW_SIDES = (tr_later("elbow left"), tr_later("elbow right"))
ONLY = tr_later("the only solution")


def combine(*choices: tuple[str, ...]) -> tuple[str, ...]:
    """Every combination, the last choice changing fastest."""
    return tuple(", ".join(words) for words in product(*choices))


def branch_title(label: str) -> str:
    """A branch's name, for instance "front, elbow up", as the screen says it."""
    return tr(", ").join(tr(word) for word in label.split(", "))


def side_names(chain: Chain, names: tuple[str, str] = SIDES) -> tuple[str, ...]:
    """The two sides of joint 1: facing the target with the first axis x1 of the DH table, or turned away from it."""
    return names if chain.sine_sign(0) > 0.0 else names[::-1]


def wrist_names(chain: Chain, i: int) -> tuple[str, ...]:
    """The two sides of wrist joint i (from 0), for a positive and a negative sine in the normal form.

    The wrist is not flipped while the sine of its DH angle is positive.
    """
    return WRIST if chain.sine_sign(i) > 0.0 else WRIST[::-1]
