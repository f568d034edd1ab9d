"""The rows of the reproduction in words, and as tables to paste elsewhere."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence

from rvsim.lab.sources.experiment import SourceExperiment
from rvsim.lab.sources.figures import MINUS, Numbers, shown_value
from rvsim.lab.sources.reproduce import Reproduction
from rvsim.lab.texts import number_text
from rvsim.language import in_english, tr, tr_later

COLUMNS = (
    tr_later("Source"),
    tr_later("Item"),
    tr_later("Printed"),
    tr_later("Its formula"),
    tr_later("Right"),
    tr_later("Verdict"),
)
VERDICTS = {
    tr_later("confirmed"): tr_later("The source is right here."),
    tr_later("misprint"): tr_later("The printed formula is not right."),
    tr_later("contradiction"): tr_later("The source contradicts itself."),
    tr_later("undefined"): tr_later("The printed formula has no value here."),
    tr_later("ignored"): tr_later("What the source asks for is not used."),
    tr_later("outside limits"): tr_later("The source's own limits do not allow it."),
    tr_later("partly reached"): tr_later("The arm reaches only some of the points."),
    tr_later("cannot be reached"): tr_later("The arm reaches none of it."),
    tr_later("computed"): tr_later("The source prints no number; this is ours."),
}
_LATEX = {
    "&": r"\&", "%": r"\%", "_": r"\_", MINUS: "$-$", "°": r"$^\circ$", "²": "$^2$", "“": "``", "”": "''", "–": "--",
    "θ\u0308": r"$\ddot\theta$", "α": r"$\alpha$", "β": r"$\beta$", "γ": r"$\gamma$", "θ": r"$\theta$",
    "Ĵ": r"$\hat{J}$", "∂": r"$\partial$",
}  # fmt: skip
_DIGITS = 6
_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def shown_cells(row: Reproduction, digits: int = _DIGITS) -> tuple[str, ...]:
    """The texts of `COLUMNS`; an empty one where the source has no such number."""
    return (row.source, row.item, *_shown_numbers(row, digits), tr(row.verdict))


def _shown_numbers(row: Reproduction, digits: int) -> tuple[str, ...]:
    return tuple("" if value is None else shown_value(value, digits) for value in (row.printed, row.formula, row.ours))


def row_sentence(row: Reproduction, experiment: SourceExperiment) -> str:
    """All that there is to say about a row."""
    numbers = (
        (tr_later("printed {number}"), row.printed),
        (tr_later("its formula gives {number}"), row.formula),
        (tr_later("right is {number}"), row.ours),
    )
    said = tr(", ").join(tr(text, number=shown_value(value)) for text, value in numbers if value is not None)
    return f"{tr(experiment.title)}. {row.item}: {said}. {tr(VERDICTS[row.verdict])} {tr(experiment.shows)}"


def reproduction_csv(rows: Sequence[Reproduction]) -> str:
    """A line each, with a header; several numbers of a cell are separated by spaces, in full precision. In English."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        numbers = (_plain(value) for value in (row.printed, row.formula, row.ours))
        writer.writerow((row.source, in_english(row.item), *numbers, row.verdict))
    return text.getvalue()


def reproduction_latex(rows: Sequence[Reproduction]) -> str:
    r"""A `longtable` with the rules of booktabs, in English."""
    head = " & ".join(COLUMNS)
    lines = [" & ".join(map(_latex, _english_cells(row))) + r" \\" for row in rows]
    begin = [r"\begin{longtable}{lp{5cm}rrrl}", r"\toprule", rf"{head} \\", r"\midrule"]
    return "\n".join([*begin, *lines, r"\bottomrule", r"\end{longtable}"])


def _english_cells(row: Reproduction) -> tuple[str, ...]:
    return (row.source, in_english(row.item), *_shown_numbers(row, _DIGITS), row.verdict)


def _plain(value: Numbers | None) -> str:
    if value is None:
        return ""
    return " ".join(map(number_text, value if isinstance(value, tuple) else (value,)))


def _latex(text: str) -> str:
    for written, latex in _LATEX.items():
        text = text.replace(written, latex)
    return re.sub("[₀-₉]+", lambda found: f"$_{{{found[0].translate(_SUBSCRIPTS)}}}$", text)
