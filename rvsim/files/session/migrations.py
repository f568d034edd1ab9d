"""Session files of older versions: each step leads from one version of the document to the next."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rvsim.files.place import Place, shown
from rvsim.language import tr

Document = dict[str, Any]
Migration = Callable[[Document], Document]

VERSION = 1
# From a version to the next one. A step gets the document as it was parsed, and may raise LookupError, TypeError or
# ValueError at what it cannot understand: what it hands over is read as strictly as any other file.
MIGRATIONS: Mapping[int, Migration] = {}


def version_of(document: Document, place: Place) -> int:
    """The version that a document says it has."""
    version = document.get("version")
    if isinstance(version, bool) or not isinstance(version, int) or not 1 <= version <= 1_000_000:
        place.at("version").refuse(shown(version), tr("the version of the format: 1, 2 …"))
    return version


def migrated(
    document: Document, place: Place, migrations: Mapping[int, Migration] = MIGRATIONS, current: int = VERSION
) -> Document:
    """The document as the current version would have written it; a newer one as it is."""
    for version in range(version_of(document, place), current):
        try:
            document = {**migrations[version](document), "version": version + 1}
        except (LookupError, TypeError, ValueError) as problem:
            place.refuse(
                tr(
                    "a document of version {version} that cannot be understood ({problem})",
                    version=version,
                    problem=problem,
                ),
                tr("a session"),
            )
    return document
