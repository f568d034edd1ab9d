"""Plays trajectories in the window: a timer lets time pass, the session shows each moment, one undo step leads back."""

from __future__ import annotations

from collections.abc import Callable
from weakref import WeakKeyDictionary

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.language import again
from rvsim.playback import Player, moment_of
from rvsim.playback.player import Playable

_FRAME_MS = 16
_LONGEST_STEP = 0.25  # [s]: after a hang the motion goes on from where it was seen, it does not leap


Opening = Callable[[float], float]  # how far the gripper is open at a moment [s], 0 (closed) … 1


def _open(_: float) -> float:
    return 1.0


class MotionControl(QObject):
    """The player of the window; `opening_at` is what the gripper does meanwhile.

    Signals:
        moved(time): another moment is shown [s].
        state_changed(state): a `rvsim.playback.player.PlayerState`.
        loaded(): another trajectory, or none, is in the player.
    """

    moved = Signal(float)
    state_changed = Signal(str)
    loaded = Signal()

    def __init__(self, session: Session, preferences: Preferences, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._preferences = session, preferences
        self.player = Player()
        self.player.speed = preferences["speed"]
        self._text = ""
        self._motion = 0  # counts what was loaded: all of one motion is one undo step
        self._showing = False
        self._moments: WeakKeyDictionary[Experiment, float] = WeakKeyDictionary()  # [s] that were shown with them
        self.opening_at: Opening = _open
        self._said_state = self.player.state
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(_FRAME_MS)
        self._timer.timeout.connect(self._on_tick)
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)

    def load(self, trajectory: Playable | None, text: str, opening_at: Opening | None = None) -> None:
        """Put a trajectory in; `text` names its undo step, for instance "Track line".

        Without `opening_at` the gripper stays as it is.
        """
        left = self.opening
        self.opening_at = opening_at or (lambda _: left)
        self._timer.stop()
        self.player.load(trajectory)
        self._text = text
        self._motion += 1
        self.loaded.emit()
        self._tell()

    def take_over(self, other: MotionControl) -> None:
        """Go on with the motion of a window that this one takes the place of, held where it is, in its undo step."""
        trajectory, time = other.player.trajectory, other.player.time
        if trajectory is not None:
            self.load(trajectory, again(other._text), other.opening_at)
            self.wait_at(time)
        self._motion, self._moments = other._motion, other._moments

    def wait_at(self, time: float) -> None:
        """Hold a moment [s] in which the arm stands already."""
        if self.player.trajectory is not None and time != self.player.time:
            self.player.seek(time)
            self.moved.emit(self.player.time)
            self._tell()

    def wait_for(self, experiment: Experiment) -> None:
        """Hold the moment in which the motion passes its pose, in which the arm stands already.

        Where the motion never passes it, that which was shown with it, or the present one.
        """
        if self.player.trajectory is None:
            return
        shown = self._moments.get(experiment, self.player.time)
        time = moment_of(self.player.trajectory, experiment.q, (shown, self.player.time))
        self._moments[experiment] = shown if time is None else time
        self.wait_at(self._moments[experiment])

    @property
    def opening(self) -> float:
        """How far the gripper is open at the moment that is shown, 0 (closed) … 1."""
        return self.opening_at(self.player.time)

    def play(self) -> None:
        """Let the motion run."""
        if self.player.trajectory is None:
            return
        self.player.play()
        self._clock.start()
        self._timer.start()
        self._show()
        self._tell()

    def pause(self) -> None:
        """Hold where it is."""
        self.player.pause()
        self._timer.stop()
        self._tell()

    def toggle(self) -> None:
        """Play or pause."""
        if self.player.playing:
            self.pause()
        else:
            self.play()

    def stop(self) -> None:
        """Stop the motion; the arm goes back to its beginning."""
        self.player.stop()
        self._timer.stop()
        self._show()
        self._tell()

    def seek(self, time: float) -> None:
        """Show another moment [s]."""
        if self.player.trajectory is None:
            return
        self.player.seek(time)
        self._show()
        self._tell()

    def step(self, seconds: float) -> None:
        """Pause and go on, or back, by a little."""
        self.seek(self.player.time + seconds)
        self.pause()

    def set_loop(self, on: bool) -> None:
        """Start again at the end."""
        self.player.loop = on

    def advance(self, dt: float) -> None:
        """Let time pass [s]; the timer calls this."""
        if self.player.advance(dt):
            self._show()
        if not self.player.playing:
            self._timer.stop()
        self._tell()

    # --- inside ----------------------------------------------------------------------------------------------------

    def _on_tick(self) -> None:
        self.advance(min(self._clock.restart() / 1000.0, _LONGEST_STEP))

    def _show(self) -> None:
        q = self.player.q
        if q is None:
            return
        self._showing = True
        try:
            self._session.show_moment(q, self._text, self._motion)
        finally:
            self._showing = False
        self.moved.emit(self.player.time)

    def _tell(self) -> None:
        if self.player.state != self._said_state:
            self._said_state = self.player.state
            self.state_changed.emit(self._said_state)

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        """Somebody else edits, or undoes: hold the motion; another arm: take the trajectory out.

        What the arm has to hold may change while it moves, and notes may be written.
        """
        if after.robot.name != before.robot.name:
            self.opening_at = _open
        if self._showing:
            self._moments[after] = self.player.time
        if self._showing or self.player.trajectory is None:
            return
        if after.robot is not before.robot:
            self.load(None, "")
        elif not _is_beside(before, after):
            self.pause()
            if not self._session.continuing:
                self.wait_for(after)
        else:
            self._moments[after] = self.player.time

    def _on_preference(self, name: str) -> None:
        if name == "speed":
            self.player.speed = self._preferences["speed"]


def _is_beside(before: Experiment, after: Experiment) -> bool:
    """Whether the load or the notes have changed, and not the pose."""
    others = after.load is not before.load or after.notes is not before.notes
    return others and after.q is before.q
