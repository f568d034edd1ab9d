"""Formulas recorded once for an arm, played for one pose or for a hundred thousand.

`terms` records, `program` is what is kept, `scalar` and `blocks` are the two ways to play it, `player` chooses.
"""

from rvsim.kinematics.tape.player import Player
from rvsim.kinematics.tape.terms import Number, Tape, snapped

__all__ = ["Number", "Player", "Tape", "snapped"]
