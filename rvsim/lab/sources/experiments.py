"""Every experiment of the five sources, in the order of their texts."""

from __future__ import annotations

from functools import lru_cache

from rvsim.errors import UnknownNameError
from rvsim.lab.sources.collection import erratum_of
from rvsim.lab.sources.erratum import Erratum
from rvsim.lab.sources.experiment import Setup, SourceExperiment
from rvsim.lab.sources.experiments_000 import EXPERIMENTS_000
from rvsim.lab.sources.experiments_others import (
    EXPERIMENTS_001,
    EXPERIMENTS_002,
    EXPERIMENTS_003,
    EXPERIMENTS_004,
)
from rvsim.language import tr_later

SOURCE_TITLES = {
    "000": "Mitsubishi RV-M1",
    "001": "Mitsubishi RV-1A",
    "002": "Universal Robots UR5e",
    "003": "RRRP arm",
    "004": "Lynxmotion AL5B",
}
_LISTS = (EXPERIMENTS_000, EXPERIMENTS_001, EXPERIMENTS_002, EXPERIMENTS_003, EXPERIMENTS_004)


@lru_cache(maxsize=1)
def experiments() -> tuple[SourceExperiment, ...]:
    """All of them. An erratum that is no experiment of its own is one: its formulas at its own pose."""
    return tuple(_of(entry) for entries in _LISTS for entry in entries)


def experiment_of(key: str) -> SourceExperiment:
    """The experiment that a row of the reproduction or an erratum of that key belongs to.

    Raises:
        UnknownNameError: no such experiment.
    """
    by_key = _by_key()
    if key not in by_key:
        raise UnknownNameError(tr_later("experiment"), key, tuple(by_key))
    return by_key[key]


def keys_in_order() -> tuple[str, ...]:
    """All keys that rows of the reproduction may have, in the order of the experiments."""
    return tuple(_by_key())


@lru_cache(maxsize=1)
def _by_key() -> dict[str, SourceExperiment]:
    return {key: entry for entry in experiments() for key in entry.keys}


def _of(entry: str | SourceExperiment) -> SourceExperiment:
    return entry if isinstance(entry, SourceExperiment) else _from_erratum(erratum_of(entry))


def _from_erratum(entry: Erratum) -> SourceExperiment:
    setup = Setup("source", entry.pose, erratum=entry.key)
    return SourceExperiment(
        entry.key, entry.source, entry.where, entry.title, entry.robot, entry.why, setup, (entry.key,)
    )
