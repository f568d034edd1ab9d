"""What a program is made of: moves, each a frozen value. Lengths in metres, angles in radians, base axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Triple = tuple[float, float, float]
ToolRule = Literal["keep", "turn", "free"]

DEFAULT_SPEED = 0.5


@dataclass(frozen=True)
class JointMove:
    """All joints together to q (n,), or to the remembered pose of that name.

    `speed` of this and the other moves is the share 0…1 of what the joints may do.
    """

    q: tuple[float, ...] = ()
    pose: str = ""
    speed: float = DEFAULT_SPEED


@dataclass(frozen=True)
class LineMove:
    """The tool straight to a place.

    Args:
        to: (3,) where the tool ends.
        tool: "keep" as it is turned when the move begins (a 5R arm's tool goes round with its waist), "turn" evenly to
            `rpy`, or "free": only the place matters.
        rpy: roll, pitch, yaw at the end, for "turn".
    """

    to: Triple
    tool: ToolRule = "keep"
    rpy: Triple = (0.0, 0.0, 0.0)
    speed: float = DEFAULT_SPEED


@dataclass(frozen=True)
class ArcMove:
    """The tool on the circle through where it is, `via` (3,) and `to` (3,); the rest as in `LineMove`."""

    via: Triple
    to: Triple
    tool: ToolRule = "keep"
    rpy: Triple = (0.0, 0.0, 0.0)
    speed: float = DEFAULT_SPEED


@dataclass(frozen=True)
class Wait:
    """Stay for so long [s]."""

    seconds: float = 1.0


@dataclass(frozen=True)
class Gripper:
    """Open it to a share: 0 closed, 1 wide open; the arm stays meanwhile for so long [s]."""

    opening: float = 0.0
    seconds: float = 0.5


Move = JointMove | LineMove | ArcMove | Wait | Gripper

# What each kind is called in a file.
MOVE_KINDS: dict[str, type[Move]] = {
    "joint": JointMove,
    "line": LineMove,
    "arc": ArcMove,
    "wait": Wait,
    "gripper": Gripper,
}


def kind_of(move: Move) -> str:
    """What its kind is called."""
    return next(name for name, kind in MOVE_KINDS.items() if isinstance(move, kind))
