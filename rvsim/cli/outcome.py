"""What a command says with its exit status, and that its input is wrong."""

from __future__ import annotations

from rvsim.errors import RvsimError

DONE, FAILED, BAD_INPUT = 0, 1, 2


class InputError(RvsimError):
    """What was typed cannot be used."""
