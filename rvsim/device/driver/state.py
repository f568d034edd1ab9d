"""What the driver knows and says, as values: a snapshot that any thread may read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rvsim.language import tr_later
from rvsim.robot.arrays import FloatArray

Phase = Literal[
    "disconnected",  # no port open
    "connecting",  # the port opens, the board is asked for its name
    "asleep",  # connected; no channel has been moved by us, nothing moves
    "ready",  # at least one channel is awake and nothing moves
    "moving",  # a timed move is under way
    "streaming",  # set-points are sent as they come
    "running",  # a trajectory is under way; the driver is the master of time
    "stopped",  # the emergency stop has latched; only `reset` leads out
    "lost",  # the port or the board has gone; only `connect` leads out
]
MeasuredKind = Literal["nothing", "commanded pulse", "potentiometers", "encoders"]

MEASURED_WORDS: dict[MeasuredKind, str] = {
    "nothing": tr_later("Nothing is measured: the board has not answered."),
    "commanded pulse": tr_later(
        "The pulses that the controller reports (QP) are those it sends, not a measurement: "
        "hobby servos do not tell where they are."
    ),
    "potentiometers": tr_later("Measured by potentiometers on the controller's analog inputs."),
    "encoders": tr_later("Measured by the encoders of the bridge."),
}


@dataclass(frozen=True, eq=False)
class DriverState:
    """A snapshot.

    Args:
        phase: see `Phase`.
        reason: why it is stopped or lost, or what is going on; a sentence, may be empty.
        board: what the board calls itself, or "".
        awake: (n,) one a joint: whether it has been woken and holds a pose that we know.
        gripper_awake: the same of the gripper.
        commanded_q: (n,) [rad] where the pulses sent so far should have brought the joints by now; NaN where asleep.
        measured_q: (n,) [rad] what came back; NaN where nothing did.
        measured_kind: what that is.
        gripper: 0 closed … 1 open as commanded, NaN where asleep.
        clamped: names of the joints whose last set-point was held at a limit.
        time, duration: of the trajectory that runs [s]; 0 where none does.
        latency: of the last answer [s], NaN without one.
        sent_bytes, received_bytes, dropped_setpoints: counted since the port was opened.
    """

    phase: Phase
    commanded_q: FloatArray
    measured_q: FloatArray
    awake: tuple[bool, ...]
    reason: str = ""
    board: str = ""
    gripper_awake: bool = False
    measured_kind: MeasuredKind = "nothing"
    gripper: float = float("nan")
    clamped: tuple[str, ...] = ()
    time: float = 0.0
    duration: float = 0.0
    latency: float = float("nan")
    sent_bytes: int = 0
    received_bytes: int = 0
    dropped_setpoints: int = 0

    @property
    def connected(self) -> bool:
        """Whether there is a port to talk to."""
        return self.phase not in ("disconnected", "connecting", "lost")

    @property
    def busy(self) -> bool:
        """Whether the arm may be moving on our behalf."""
        return self.phase in ("moving", "streaming", "running")
