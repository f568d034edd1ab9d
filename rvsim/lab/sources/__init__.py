"""What the sources print, and what is right: every erratum with both formulas, worked out at any pose of its arm."""

from rvsim.lab.sources.collection import errata, erratum_of, topics
from rvsim.lab.sources.erratum import TOPICS, Comparison, Erratum, Kind, Quantity, Topic

__all__ = [
    "TOPICS",
    "Comparison",
    "Erratum",
    "Kind",
    "Quantity",
    "Topic",
    "errata",
    "erratum_of",
    "topics",
]
