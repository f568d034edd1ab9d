"""Room in matrices: the typesetter puts rows and columns of numbers too close to each other to be read at ease."""

from __future__ import annotations

import re

_MATRIX = re.compile(r"(\\begin\{bmatrix\})(.*?)(\\end\{bmatrix\})", re.DOTALL)
_STRUT = "{}_{\\phantom{0}}"  # an index that is not seen makes its row higher
_FIRST_MINUS = re.compile(r"^-")  # a sign, although something stands before it
_GAP = " & \\,\\,"


def airy(latex: str) -> str:
    """The same formula with more room between the rows and columns of its matrices."""
    return _MATRIX.sub(lambda found: f"{found[1]} {_spread(found[2])} {found[3]}", latex)


def _spread(body: str) -> str:
    rows = [row.strip() for row in body.split("\\\\")]
    if len(rows) < 2 or "\\frac" in body:
        return body
    return " \\\\ ".join(_STRUT + re.sub(r" *& *", lambda _: _GAP, _FIRST_MINUS.sub(r"\\,-", row)) for row in rows)
