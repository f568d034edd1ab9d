"""Typed numbers: 12.5, 12,5, −3, 2*30, sqrt(2)/2, with or without a unit behind: pi/4 rad, 12 cm.

Never `eval`: the library knows only the names given here.
"""

from __future__ import annotations

import math
import re

from rvsim.errors import ExpressionError

_NAMES = {"pi": math.pi, "π": math.pi, "e": math.e, "tau": math.tau}
_FUNCTION_NAMES = ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "radians", "degrees")
_FUNCTIONS = {name: getattr(math, name) for name in _FUNCTION_NAMES}
_LONGEST = 200
# The comma is a decimal separator when it stands between digits outside a function's arguments.
_DECIMAL_COMMA = re.compile(r"^\s*[-+]?\d*,\d+\s*$")
_TYPOGRAPHY = str.maketrans({"\u2212": "-", "\u2013": "-", "×": "*", "·": "*", "÷": "/", "\u00a0": " ", "\u202f": " "})

# The kind of each unit that may stand behind a number, and how much one of it is in radians, metres, or units.
_UNITS = {
    **dict.fromkeys(("°", "deg", "degree", "degrees"), ("an angle", math.pi / 180.0)),
    **dict.fromkeys(("rad", "radian", "radians"), ("an angle", 1.0)),
    "mm": ("a length", 1e-3),
    "cm": ("a length", 1e-2),
    "m": ("a length", 1.0),
    **dict.fromkeys(("unit", "units"), ("a length without a unit", 1.0)),
}
_WITH_UNIT = re.compile(rf"(.*?)\s*({'|'.join(sorted(_UNITS, key=len, reverse=True))})", re.DOTALL)


def evaluate_in(unit: str, text: str) -> float:
    """The number in `unit` that a typed text means: plain numbers are in `unit`, others say theirs behind.

    In "deg" is 45 what "pi/4 rad" means, in "mm" 120 what "12 cm" means.

    Args:
        unit: "°", "deg", "rad", "mm", "cm", "m" or "unit"; "" where no unit may be said.
        text: an expression as in `evaluate`.

    Raises:
        ExpressionError: no expression, or a unit of another kind.
    """
    match = _WITH_UNIT.fullmatch(text.strip())
    if match is None:
        return evaluate(text)
    try:
        value = evaluate(match[1])
    except ExpressionError as problem:
        raise ExpressionError(text, problem.reason) from None
    kind, size = _UNITS[match[2]]
    wanted, wanted_size = _UNITS.get(unit, ("a plain number", 1.0))
    if kind != wanted:
        raise ExpressionError(text, f"“{match[2]}” makes it {kind}, and wanted is {wanted}")
    return value * (size / wanted_size)


def evaluate(text: str) -> float:
    """The finite number that a typed text means.

    Accepts decimals with a point or a comma, the digits of any script, + - * / ** ( ), pi and the usual functions.

    Raises:
        ExpressionError: the text is empty, too long, no expression, or not a finite number.
    """
    cleaned = text.strip().translate(_TYPOGRAPHY)
    if not cleaned:
        raise ExpressionError(text, "it is empty")
    if len(cleaned) > _LONGEST:
        raise ExpressionError(text[:20] + "…", f"it is longer than {_LONGEST} characters")
    if _DECIMAL_COMMA.match(cleaned):
        cleaned = cleaned.replace(",", ".")
    try:
        return _finite(text, float(cleaned))
    except ValueError as problem:
        if isinstance(problem, ExpressionError):
            raise
    return _finite(text, _evaluated(text, cleaned))


def _evaluated(text: str, cleaned: str) -> float:
    from simpleeval import SimpleEval  # imported when first needed: most numbers are plain

    try:
        value = SimpleEval(names=dict(_NAMES), functions=dict(_FUNCTIONS)).eval(cleaned.replace("^", "**"))
    except ZeroDivisionError:
        raise ExpressionError(text, "it divides by zero") from None
    except Exception:
        # The library raises SyntaxError, its own InvalidExpression, TypeError, OverflowError, RecursionError …:
        # to the person who typed it they all mean the same.
        raise ExpressionError(text, "it cannot be read") from None
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ExpressionError(text, "it is not a single number")
    try:
        return float(value)
    except OverflowError:
        raise ExpressionError(text, "it is too large") from None


def _finite(text: str, value: float) -> float:
    if not math.isfinite(value):
        raise ExpressionError(text, "it is not finite")
    return value
