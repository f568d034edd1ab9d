"""What the driver can be asked to do, as values, and the answer "no" with its reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

from numpy.typing import ArrayLike

from rvsim.language import tr_later
from rvsim.robot import GripperServo, Servo
from rvsim.robot.arrays import FloatArray

Axis: TypeAlias = int | Literal["gripper"]
PRESSED = tr_later("The emergency stop was pressed.")


class Playable(Protocol):
    """Poses over a time: any trajectory."""

    @property
    def duration(self) -> float:
        """[s]."""
        ...

    def q(self, t: ArrayLike) -> FloatArray:
        """The pose (n,) at a time [s], or (k, n) at times (k,)."""
        ...


@dataclass(frozen=True)
class Refusal:
    """The driver does not do it; the sentence says why, and what would have worked."""

    sentence: str

    def __str__(self) -> str:
        return self.sentence


@dataclass(frozen=True)
class Connect:
    """Open the port and ask the board for its name. Nothing moves."""


@dataclass(frozen=True)
class Disconnect:
    """Close the port; what moves is stopped first. The servos hold where they are."""


@dataclass(frozen=True)
class Wake:
    """The first move of an axis, which cannot be slow: for use after a person has seen `value` and said yes.

    Args:
        axis: the joint (from 0), or "gripper".
        value: where it jumps to: q [rad, m], or the opening 0…1.
    """

    axis: Axis
    value: float


@dataclass(frozen=True, eq=False)
class MoveTo:
    """All joints together to q (n,) [rad, m]; in `seconds`, or calmly. Never quicker than the joints may."""

    q: ArrayLike
    seconds: float | None = None


@dataclass(frozen=True, eq=False)
class Stream:
    """Follow: q (n,) is where the arm should be by now. The newest counts; steps are held to the calm speed."""

    q: ArrayLike


@dataclass(frozen=True, eq=False)
class Run:
    """Follow a trajectory; the driver is the master of time.

    Args:
        approach: go to its start calmly first; without it a start away from the arm's pose is refused.
    """

    trajectory: Playable
    approach: bool = False


@dataclass(frozen=True)
class Hold:
    """End what moves without latching anything: set-points end, a timed move ends where it is."""


@dataclass(frozen=True)
class Grip:
    """The gripper to an opening, 0 closed … 1 open, in `seconds` or calmly."""

    opening: float
    seconds: float | None = None


@dataclass(frozen=True)
class JogPulse:
    """One awake channel to a pulse [µs], within all that the controller can: for calibration only."""

    channel: int
    pulse_us: float
    seconds: float | None = None


@dataclass(frozen=True)
class Limp:
    """Switch an axis off: it falls under its weight and is asleep then."""

    axis: Axis


@dataclass(frozen=True)
class StopAll:
    """The emergency stop: latches, and only `Reset` leads out."""

    reason: str = PRESSED


@dataclass(frozen=True)
class Reset:
    """Leave the latched stop, deliberately. Nothing moves."""


@dataclass(frozen=True)
class UseServos:
    """Another calibration from now on; pulses stay as they are, only what they mean changes."""

    servos: Sequence[Servo]
    gripper_servo: GripperServo | None = None


Action: TypeAlias = (
    Connect | Disconnect | Wake | MoveTo | Stream | Run | Hold | Grip | JogPulse | Limp | StopAll | Reset | UseServos
)
