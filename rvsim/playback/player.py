"""Which moment is shown: a tape deck for trajectories. It reads no clock; whoever owns one passes the time elapsed."""

from __future__ import annotations

from typing import Literal, Protocol

from numpy.typing import ArrayLike

from rvsim.robot.arrays import FloatArray

PlayerState = Literal["empty", "stopped", "playing", "paused", "finished"]

SLOWEST, FASTEST = 0.1, 10.0


class Playable(Protocol):
    """What a player can show: poses over a time."""

    @property
    def duration(self) -> float:
        """[s]."""
        ...

    def q(self, t: ArrayLike) -> FloatArray:
        """The pose (n,) at a time [s]."""
        ...


class Player:
    """Plays, pauses, stops, seeks, steps, repeats, faster or slower.

    "stopped" is at rest at the start, "finished" at rest at the end; `play` starts again from there.
    """

    def __init__(self) -> None:
        self._trajectory: Playable | None = None
        self._time = 0.0
        self._state: PlayerState = "empty"
        self._speed = 1.0
        self.loop = False

    @property
    def trajectory(self) -> Playable | None:
        """What is loaded."""
        return self._trajectory

    @property
    def state(self) -> PlayerState:
        """What it is doing."""
        return self._state

    @property
    def time(self) -> float:
        """The moment shown, 0…duration [s]."""
        return self._time

    @property
    def duration(self) -> float:
        """Of what is loaded, 0 when empty [s]."""
        return self._trajectory.duration if self._trajectory is not None else 0.0

    @property
    def playing(self) -> bool:
        """Whether time passes."""
        return self._state == "playing"

    @property
    def q(self) -> FloatArray | None:
        """The pose (n,) shown, None when empty."""
        return self._trajectory.q(self._time) if self._trajectory is not None else None

    @property
    def speed(self) -> float:
        """Seconds of the trajectory in a second of time, 0.1…10."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._speed = min(max(speed, SLOWEST), FASTEST)

    def load(self, trajectory: Playable | None) -> None:
        """Put a trajectory in, stopped at its start; None takes it out."""
        self._trajectory = trajectory
        self._time = 0.0
        self._state = "empty" if trajectory is None else "stopped"

    def play(self) -> None:
        """Let time pass, from the start again when it had finished."""
        if self._state == "finished":
            self._time = 0.0
        if self._state != "empty":
            self._state = "playing"

    def pause(self) -> None:
        """Hold the moment."""
        if self._state == "playing":
            self._state = "paused"

    def stop(self) -> None:
        """Back to the start, at rest."""
        self._time = 0.0
        if self._state != "empty":
            self._state = "stopped"

    def seek(self, t: float) -> None:
        """Show the moment t [s], clamped. A playing tape plays on from there; a resting one is paused there."""
        self._time = min(max(t, 0.0), self.duration)
        if self._state in ("stopped", "finished"):
            self._state = "paused"

    def step(self, seconds: float) -> None:
        """Pause, and go forward (or back, if negative) by so much [s]."""
        self.pause()
        self.seek(self._time + seconds)

    def advance(self, dt: float) -> bool:
        """Let dt ≥ 0 seconds pass, exactly, however long; True when the moment shown has changed."""
        if self._state != "playing" or dt <= 0.0:
            return False
        before, end = self._time, self._time + dt * self._speed
        if end < self.duration:
            self._time = end
        elif self.loop and self.duration > 0.0:
            self._time = end % self.duration
        else:
            self._time, self._state = self.duration, "finished"
        return self._time != before
