"""Which moment is shown: the player."""
