"""Typed numbers: 12.5, 12,5, −3, pi/4, 2*30, sqrt(2)/2. Never `eval`: the library knows only the names given here."""

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
