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
from rvsim.language import tr, tr_later

COLUMNS = (
    tr_later("Source"),
    tr_later("Item"),
    tr_later("Printed"),
    tr_later("Its formula"),
    tr_later("Right"),
    tr_later("Verdict"),
)
VERDICTS = {
    "confirmed": tr_later("The source is right here."),
    "misprint": tr_later("The printed formula is not right."),
    "contradiction": tr_later("The source contradicts itself."),
    "undefined": tr_later("The printed formula has no value here."),
    "ignored": tr_later("What the source asks for is not used."),
    "outside limits": tr_later("The source's own limits do not allow it."),
    "partly reached": tr_later("The arm reaches only some of the points."),
    "cannot be reached": tr_later("The arm reaches none of it."),
    "computed": tr_later("The source prints no number; this is ours."),
}
_LATEX = {
    "&": r"\&", "%": r"\%", "_": r"\_", MINUS: "$-$", "°": r"$^\circ$", "²": "$^2$", "“": "``", "”": "''", "–": "--",
    "θ\u0308": r"$\ddot\theta$", "α": r"$\alpha$", "β": r"$\beta$", "γ": r"$\gamma$", "θ": r"$\theta$",
    "Ĵ": r"$\hat{J}$", "∂": r"$\partial$",
}  # fmt: skip
_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def shown_cells(row: Reproduction, digits: int = 6) -> tuple[str, ...]:
    """The texts of `COLUMNS`; an empty one where the source has no such number."""
    numbers = ("" if value is None else shown_value(value, digits) for value in (row.printed, row.formula, row.ours))
    return (row.source, row.item, *numbers, row.verdict)


def row_sentence(row: Reproduction, experiment: SourceExperiment) -> str:
    """All that there is to say about a row."""
    numbers = ((tr("Printed"), row.printed), (tr("its formula gives"), row.formula), (tr("right is"), row.ours))
    said = ", ".join(f"{name} {shown_value(value)}" for name, value in numbers if value is not None)
    return f"{experiment.title}. {row.item}: {said[:1].lower()}{said[1:]}. {VERDICTS[row.verdict]} {experiment.shows}"


def reproduction_csv(rows: Sequence[Reproduction]) -> str:
    """A line each, with a header; several numbers of a cell are separated by spaces, in full precision."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        numbers = (_plain(value) for value in (row.printed, row.formula, row.ours))
        writer.writerow((row.source, row.item, *numbers, row.verdict))
    return text.getvalue()


def reproduction_latex(rows: Sequence[Reproduction]) -> str:
    r"""A `longtable` with the rules of booktabs."""
    head = " & ".join(COLUMNS)
    lines = [" & ".join(_latex(cell) for cell in shown_cells(row)) + r" \\" for row in rows]
    begin = [r"\begin{longtable}{lp{5cm}rrrl}", r"\toprule", rf"{head} \\", r"\midrule"]
    return "\n".join([*begin, *lines, r"\bottomrule", r"\end{longtable}"])


def _plain(value: Numbers | None) -> str:
    if value is None:
        return ""
    return " ".join(map(number_text, value if isinstance(value, tuple) else (value,)))


def _latex(text: str) -> str:
    for written, latex in _LATEX.items():
        text = text.replace(written, latex)
    return re.sub("[₀-₉]+", lambda found: f"$_{{{found[0].translate(_SUBSCRIPTS)}}}$", text)
