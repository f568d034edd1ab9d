"""What the sources of this arm print that is not right: the formula, ours, why, and both at the pose of the report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rvsim.lab.report.figures import PLAIN, Measure, Measures, scientific
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Block, Formula, Paragraph, Section, with_indices
from rvsim.lab.sources import Comparison, Erratum, errata
from rvsim.language import listed, tr
from rvsim.robot.arrays import FloatArray

_TINY = 5e-4
_FEW = 6  # numbers that still fit into a sentence


def sources_section(study: Study, measures: Measures) -> Section:
    """One entry an erratum."""
    found = errata(study.robot)
    sources = listed(list(dict.fromkeys(tr("source {source}", source=entry.source) for entry in found)))
    lead = tr(
        "Where {sources} of this arm prints what is not right: the formula as printed, what this report computes with "
        "instead, the reason, and both worked out at the pose of this report (with nothing bolted to the flange).",
        sources=sources,
    )
    return Section(
        tr("What the sources print, and what is right"),
        (Paragraph(lead), *(block for entry in found for block in _entry(study, entry, measures))),
    )


def _entry(study: Study, entry: Erratum, measures: Measures) -> Iterator[Block]:
    head = tr("Source {source}, {where}: {title}.", source=entry.source, where=tr(entry.where), title=tr(entry.title))
    yield Paragraph((*with_indices(head, "bold"), *with_indices(f" {tr(entry.why)}")))
    for label, formulas in ((tr("printed"), entry.printed_latex), (tr("correct"), entry.right_latex)):
        for number, latex in enumerate(formulas):
            yield Formula("", (latex,), label if number == 0 else " ")
    sentence = _numbers(study, entry, measures)
    if sentence:
        yield Paragraph(sentence, "note")


def _numbers(study: Study, entry: Erratum, measures: Measures) -> str:
    found = entry.compare(study.robot, study.q)
    if found is None:
        return ""
    if np.isnan(found.printed).any():
        return tr("At this pose: {sentence}", sentence=tr(entry.undefined))
    if found.agree:
        return tr("At this pose the printed formula happens to give the right value.")
    if found.right.size <= _FEW and found.right.ndim < 2:
        return tr(
            "At this pose: printed {printed}, right {right}.",
            printed=_few(found.printed, found, measures),
            right=_few(found.right, found, measures),
        )
    return tr(
        "At this pose {wrong} of {count} entries differ; the largest difference is {worst}.",
        wrong=int(found.differs.sum()),
        count=found.right.size,
        worst=_worst(found, measures),
    )


def _few(values: FloatArray, found: Comparison, measures: Measures) -> str:
    texts = [
        _amount(float(value), str(kind), measures)
        for value, kind in zip(np.atleast_1d(values), np.atleast_1d(found.kinds), strict=True)
    ]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def _worst(found: Comparison, measures: Measures) -> str:
    parts = []
    for kind in dict.fromkeys(found.kinds[found.differs].ravel()):
        gap = float(np.abs(found.difference[found.kinds == kind]).max())
        parts.append(_amount(gap, str(kind), measures))
    return listed(parts)


def _amount(value: float, kind: str, measures: Measures) -> str:
    if kind == "number":
        return scientific(value) if 1e-9 < abs(value) < _TINY else PLAIN.text(value)
    measure = _measure(kind, measures)
    return measure.amount(value)


def _measure(kind: str, measures: Measures) -> Measure:
    angle, length = measures.angle, measures.length
    return {
        "angle": angle,
        "length": length,
        "lever": length.per("/rad"),
        "rate": angle.per("/s"),
        "acceleration": angle.per("/s²"),
        "torque": Measure(1.0, "N m", 3),
    }[kind]
