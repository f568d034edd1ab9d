"""The value `Notes`: what a student writes beside an experiment."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Notes:
    """Who did it, and what there is to be said about it."""

    student: str = ""
    text: str = ""


NO_NOTES = Notes()
