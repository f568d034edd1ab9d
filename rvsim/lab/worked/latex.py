"""A worked solution as a LaTeX document that compiles with amsmath alone."""

from __future__ import annotations

from rvsim.kinematics.inverse import branch_title
from rvsim.lab.worked.values import Equation, Path, Step, WorkedBranch, WorkedSolution
from rvsim.language import tr

_HEAD = """\\documentclass{article}
\\usepackage{amsmath}
\\setcounter{MaxMatrixCols}{12}
\\begin{document}
"""
_GREEK = {"α": "alpha", "β": "beta", "γ": "gamma", "θ": "theta", "λ": "lambda", "π": "pi", "φ": "varphi", "ψ": "psi"}
_MATHEMATICS = {
    "°": "^\\circ",
    "\u2212": "-",
    "±": "\\pm",
    "ᵀ": "^T",
    "⊥": "_\\perp",
    **{sign: f"_{digit}" for digit, sign in enumerate("₀₁₂₃₄₅₆₇₈₉")},
    **{sign: f"^{power}" for sign, power in zip("¹²³", "123", strict=True)},
    **{sign: f"\\{name}" for sign, name in _GREEK.items()},
}
_SIGNS = {sign: f"\\ensuremath{{{latex}}}" for sign, latex in _MATHEMATICS.items()} | {
    sign: f"\\{sign}" for sign in "&%#_${}"
}
# What a user may have in the name of an arm or a joint.
_SIGNS |= {"\\": "\\textbackslash{}", "~": "\\textasciitilde{}", "^": "\\textasciicircum{}"}


def worked_latex(solution: WorkedSolution, path: Path | None = None) -> str:
    """The whole solution, or the way to one end of it: a document of align environments; in English it is ASCII."""
    steps = solution.steps if path is None else solution.along(path)
    parts = [f"\\section*{{{prose(solution.title)}}}", *(_step(i, step) for i, step in enumerate(steps, 1))]
    parts += [f"\\subsection*{{{prose(tr('Branches'))}}}", _table(solution.branches)]
    body = "\n\n".join(parts)
    return _head(body) + body + "\n\\end{document}\n"


def _head(body: str) -> str:
    """Letters with accents, and quotes of other languages, are in the font encoding T1 only."""
    return (
        _HEAD
        if body.isascii()
        else _HEAD.replace("\\usepackage{amsmath}", "\\usepackage[T1]{fontenc}\n\\usepackage{amsmath}")
    )


def prose(text: str) -> str:
    """A sentence as LaTeX text."""
    return "".join(_SIGNS.get(sign, sign) for sign in text)


def _step(number: int, step: Step) -> str:
    where = f" ({branch_title(', '.join(step.path))})" if step.path else ""
    parts = [f"\\subsection*{{{number}. {prose(step.title + where)}}}", prose(step.text)]
    if step.equations:
        parts.append("\\begin{align*}\n" + " \\\\\n".join(map(_equation, step.equations)) + "\n\\end{align*}")
    parts += [prose(note) for note in (step.failure, step.source_note) if note]
    return "\n".join(parts)


def _equation(equation: Equation) -> str:
    rights = [
        part.replace("\\phantom{0}", "") for part in (equation.formula, equation.substituted, equation.result) if part
    ]
    return equation.left + " &= " + " \\\\\n &= ".join(rights)


def _table(branches: tuple[WorkedBranch, ...]) -> str:
    rows = [f"{prose(branch.title)} & {prose(_verdict(branch))}" for branch in branches]
    return "\\begin{tabular}{lp{0.6\\linewidth}}\n" + " \\\\\n".join(rows) + "\n\\end{tabular}"


def _verdict(branch: WorkedBranch) -> str:
    if branch.q is None:
        return branch.reason
    return tr("within the limits") if branch.within_limits else tr("outside the limits: {reason}", reason=branch.reason)
