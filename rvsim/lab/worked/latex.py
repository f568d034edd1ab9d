"""A worked solution as a LaTeX document that compiles with amsmath alone."""

from __future__ import annotations

from rvsim.lab.worked.values import Equation, Path, Step, WorkedBranch, WorkedSolution
from rvsim.language import in_english

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
    """The whole solution, or the way to one end of it: a document of align environments; in English, ASCII."""
    steps = solution.steps if path is None else solution.along(path)
    parts = [f"\\section*{{{prose(solution.title)}}}", *(_step(i, step) for i, step in enumerate(steps, 1))]
    parts += ["\\subsection*{Branches}", _table(solution.branches)]
    return _HEAD + "\n\n".join(parts) + "\n\\end{document}\n"


def prose(text: str) -> str:
    """A sentence as LaTeX text, in English: LaTeX sets no Arabic without more packages."""
    return "".join(_SIGNS.get(sign, sign) for sign in in_english(text))


def _step(number: int, step: Step) -> str:
    where = f" ({', '.join(step.path)})" if step.path else ""
    parts = [f"\\subsection*{{{number}. {prose(step.title)}{prose(where)}}}", prose(step.text)]
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
    rows = [f"{prose(branch.label)} & {prose(_verdict(branch))}" for branch in branches]
    return "\\begin{tabular}{lp{0.6\\linewidth}}\n" + " \\\\\n".join(rows) + "\n\\end{tabular}"


def _verdict(branch: WorkedBranch) -> str:
    if branch.q is None:
        return branch.reason
    return "within the limits" if branch.within_limits else f"outside the limits: {in_english(branch.reason)}"
