"""Which moment is shown: the player."""

from rvsim.playback.player import FASTEST, SLOWEST, Playable, Player, PlayerState

__all__ = ["FASTEST", "SLOWEST", "Playable", "Player", "PlayerState"]
