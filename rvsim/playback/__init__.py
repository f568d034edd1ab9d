"""Which moment is shown: the player, and the moment that a pose belongs to."""

from rvsim.playback.moments import moment_of
from rvsim.playback.player import FASTEST, SLOWEST, Playable, Player, PlayerState

__all__ = ["FASTEST", "SLOWEST", "Playable", "Player", "PlayerState", "moment_of"]
