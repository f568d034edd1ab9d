"""Typed numbers: 12.5, 12,5, −3, 2*30, sqrt(2)/2, with or without a unit behind: pi/4 rad, 12 cm.

Never `eval`: the library knows only the names given here.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import ExpressionError
from rvsim.language import tr, tr_later

_NAMES = {"pi": math.pi, "π": math.pi, "e": math.e, "tau": math.tau}
_FUNCTION_NAMES = ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "radians", "degrees")
_FUNCTIONS = {name: getattr(math, name) for name in _FUNCTION_NAMES}
_LONGEST = 200
# The comma is a decimal separator when it stands between digits outside a function's arguments.
_DECIMAL_COMMA = re.compile(r"^\s*[-+]?\d*,\d+\s*$")
_TYPOGRAPHY = str.maketrans(
    {
        "\u2212": "-",
        "\u2013": "-",
        "×": "*",
        "·": "*",
        "÷": "/",
        "\u00a0": " ",
        "\u202f": " ",
        "\u066b": ".",
        "\u066c": "",
    }
)

# The kind of each unit that may stand behind a number, and how much one of it is in radians, metres, or units.
_UNITS = {
    **dict.fromkeys(("°", "deg", "degree", "degrees"), (tr_later("an angle"), math.pi / 180.0)),
    **dict.fromkeys(("rad", "radian", "radians"), (tr_later("an angle"), 1.0)),
    "mm": (tr_later("a length"), 1e-3),
    "cm": (tr_later("a length"), 1e-2),
    "m": (tr_later("a length"), 1.0),
    **dict.fromkeys(("unit", "units"), (tr_later("a length without a unit"), 1.0)),
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
    wanted, wanted_size = _UNITS.get(unit, (tr_later("a plain number"), 1.0))
    if kind != wanted:
        raise ExpressionError(
            text,
            tr("“{unit}” makes it {kind}, and wanted is {wanted}", unit=match[2], kind=tr(kind), wanted=tr(wanted)),
        )
    return value * (size / wanted_size)


def evaluate(text: str) -> float:
    """The finite number that a typed text means.

    Accepts decimals with a point or a comma (Arabic ones too), the digits of any script, + - * / ** ( ), pi and the
    usual functions.

    Raises:
        ExpressionError: the text is empty, too long, no expression, or not a finite number.
    """
    cleaned = _cleaned(text)
    try:
        return _finite(text, float(cleaned))
    except ValueError as problem:
        if isinstance(problem, ExpressionError):
            raise
    return _finite(text, _evaluated(text, cleaned))


def _cleaned(text: str) -> str:
    """As Python writes it: no typographic signs, points for decimal commas; neither empty nor too long."""
    cleaned = text.strip().translate(_TYPOGRAPHY)
    if not cleaned:
        raise ExpressionError(text, tr("it is empty"))
    if len(cleaned) > _LONGEST:
        raise ExpressionError(text[:20] + "…", tr("it is longer than {longest} characters", longest=_LONGEST))
    return cleaned.replace(",", ".") if _DECIMAL_COMMA.match(cleaned) else cleaned


def _evaluated(text: str, cleaned: str) -> float:
    from simpleeval import DEFAULT_OPERATORS, SimpleEval  # imported when first needed: most numbers are plain

    reader = SimpleEval({**DEFAULT_OPERATORS, ast.Pow: _float_power}, dict(_FUNCTIONS), dict(_NAMES))
    try:
        value = reader.eval("", _one_expression(cleaned))
    except ZeroDivisionError:
        raise ExpressionError(text, tr("it divides by zero")) from None
    except OverflowError:
        raise ExpressionError(text, tr("it is too large")) from None
    except Exception:
        # The library raises SyntaxError, its own InvalidExpression, TypeError, OverflowError, RecursionError …:
        # to the person who typed it they all mean the same.
        raise ExpressionError(text, tr("it cannot be read")) from None
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ExpressionError(text, tr("it is not a single number"))
    try:
        return float(value)
    except OverflowError:
        raise ExpressionError(text, tr("it is too large")) from None


def _one_expression(cleaned: str) -> ast.expr:
    """The parsed text; the library itself would take "x = 5" for 5 and "1; 2" for 1."""
    return ast.parse(cleaned.replace("^", "**"), mode="eval").body


def _float_power(base: float, exponent: float) -> Any:
    """In floating point: a whole number of millions of digits takes seconds."""
    return float(base) ** float(exponent)


def evaluate_formula(text: str, t: NDArray[np.float64]) -> NDArray[np.float64]:
    """A formula of t, for instance "4 + sin(pi/2*t)", at all moments t (m,) at once: (m,).

    Accepts what `evaluate` does, and abs, sinh, cosh, tanh, floor, ceil, min and max of two; angles in radians.

    Raises:
        ExpressionError: the text is empty, too long, no formula, or not finite everywhere.
    """
    cleaned = _cleaned(text)
    value = _formula_value(text, cleaned, t)
    try:
        values = np.broadcast_to(np.asarray(value, dtype=np.float64), t.shape)
    except (TypeError, ValueError):
        raise ExpressionError(text, tr("it is not a number at each moment")) from None
    bad = np.flatnonzero(~np.isfinite(values))
    if len(bad):
        raise ExpressionError(text, tr("it is not finite at t = {t:g}", t=t[bad[0]]))
    return np.array(values)


def _formula_value(text: str, cleaned: str, t: NDArray[np.float64]) -> Any:
    from simpleeval import FunctionNotDefined, NameNotDefined, SimpleEval

    reader = SimpleEval(_FORMULA_OPERATORS, dict(_FORMULA_FUNCTIONS), {**_NAMES, "t": t})
    reader.nodes = {kind: reader.nodes[kind] for kind in _FORMULA_NODES}
    try:
        with np.errstate(all="ignore"):
            return reader.eval("", _one_expression(cleaned))
    except NameNotDefined as problem:
        raise ExpressionError(text, tr("there is no “{name}”, only t, pi, e and tau", name=problem.name)) from None
    except FunctionNotDefined as problem:
        raise ExpressionError(text, tr("there is no function “{function}”", function=problem.func_name)) from None
    except ZeroDivisionError:
        raise ExpressionError(text, tr("it divides by zero")) from None
    except Exception:
        raise ExpressionError(text, tr("it cannot be read")) from None  # as above: whatever the library raises


def _power(base: Any, exponent: Any) -> Any:
    """In floating point, so that no tower of whole numbers holds everything up."""
    return np.power(np.asarray(base, dtype=np.float64), np.asarray(exponent, dtype=np.float64))


def _of(count: int, function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of exactly that many numbers, without what numpy's own can be told besides."""

    def called(*values: Any) -> Any:
        if len(values) != count:
            raise TypeError(f"wanted are {count} numbers")
        return function(*values)

    return called


# What a formula is made of; no attributes, subscripts, comparisons or texts.
_FORMULA_NODES = (ast.Expr, ast.BinOp, ast.UnaryOp, ast.Call, ast.Name, ast.Constant)
# The library's own operators guard against long strings, which arrays are not.
_FORMULA_OPERATORS: dict[type[ast.AST], Any] = {
    ast.Add: lambda a, b: np.add(a, b, dtype=np.float64),
    ast.Sub: lambda a, b: np.subtract(a, b, dtype=np.float64),
    ast.Mult: lambda a, b: np.multiply(a, b, dtype=np.float64),
    ast.Div: lambda a, b: np.divide(a, b, dtype=np.float64),
    ast.Mod: lambda a, b: np.mod(a, b, dtype=np.float64),
    ast.Pow: _power,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_ONE = (
    *((name, getattr(np, name)) for name in ("sqrt", "sin", "cos", "tan", "exp", "log", "radians", "degrees")),
    *((name, getattr(np, name)) for name in ("abs", "sinh", "cosh", "tanh", "floor", "ceil")),
    *(("asin", np.arcsin), ("acos", np.arccos), ("atan", np.arctan)),
)
_TWO = (("atan2", np.arctan2), ("min", np.minimum), ("max", np.maximum))
_FORMULA_FUNCTIONS: dict[str, Any] = {
    **{name: _of(1, function) for name, function in _ONE},
    **{name: _of(2, function) for name, function in _TWO},
}


def _finite(text: str, value: float) -> float:
    if not math.isfinite(value):
        raise ExpressionError(text, tr("it is not finite"))
    return value
