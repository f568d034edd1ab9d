"""Where one is in a session file, so that a refusal can name the culprit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

from rvsim.errors import SessionFileError
from rvsim.files.place import Place, hint_words, step_words
from rvsim.language import tr


@dataclass(frozen=True)
class SessionPlace(Place):
    """A place in a session file: what robot files and programs refuse inside of it is refused with its whole path."""

    def refuse(self, found: str, expected: str, suggestion: str = "") -> NoReturn:
        """Raise the `SessionFileError` of this place."""
        where = tr(", ").join(map(step_words, self.steps)) or tr("the file")
        raise SessionFileError(self.path, where, found, expected, suggestion or hint_words(self.hint))
