r"""Formulas set as in a book: LaTeX becomes a painter path that is sharp at every size and wears any colour.

Setting a formula takes 10 to 20 ms, too long for numbers that change with every step of a drag. All digits are equally
wide, though, so a formula is set once for its shape, and other digits are put in their places: that takes 0.1 ms.
In a matrix `{-}` and `\phantom{-}`, `\phantom{0}` are places too, which may stay empty; a minus closes up.
"""

from __future__ import annotations

import re
import warnings
from collections import deque
from collections.abc import Callable, Iterator
from functools import lru_cache
from threading import RLock
from typing import NamedTuple
from xml.etree import ElementTree

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainterPath, QTransform

SIZE = 16.0  # the font size formulas are set at; they are scaled from there
_DIGIT = 7.92  # how wide every digit is at that size
_KEPT = 1500  # formulas and shapes that are remembered
_one_at_a_time = RLock()  # reports set theirs in a thread, for which the library is not made

_PLACE = re.compile(r"\\phantom\{-\}|\{-\}|\\phantom\{0\}|\d+\.\d+")
_SIGN = re.compile(r"\\[a-zA-Z]+|\d|-")
_UNARY = re.compile(r"(^|[(=,{&] *|\\, *|\\equiv *)-")
_SVG = "{http://www.w3.org/2000/svg}"


class Typeset(NamedTuple):
    """A formula as a path: x from 0 to `width`, y from −`ascent` to `descent` about the baseline [px]."""

    path: QPainterPath
    width: float
    ascent: float
    descent: float


class Letter(NamedTuple):
    """One sign of a formula: its outline, which all signs of its kind share, and where it stands."""

    outline: QPainterPath
    at: QTransform


class Pieces(NamedTuple):
    """A formula in pieces, for who draws each letter's outline once: letters, bars, and its box as in `Typeset`."""

    letters: tuple[Letter, ...]
    rules: tuple[QRectF, ...]
    box: QRectF


class _Glyph(NamedTuple):
    """One sign of a layout: its outline, where it stands, and the index of the place it fills (−1: none)."""

    outline: QPainterPath
    at: QTransform
    place: int


class _Layout(NamedTuple):
    glyphs: tuple[_Glyph, ...]
    rules: tuple[QRectF, ...]
    box: QRectF


def typeset(latex: str) -> Typeset | None:
    """A formula at a font size of 16 px, or None if it cannot be set; the result is remembered."""
    shape, signs = _shape(latex)
    return _filled(shape, signs)


def pieces(latex: str) -> Pieces | None:
    """The same formula in pieces, or None if it cannot be set."""
    shape, signs = _shape(latex)
    layout = _layout(shape)
    return None if layout is None else Pieces(tuple(_letters(layout, signs)), layout.rules, layout.box)


def is_set(latex: str) -> bool:
    """Whether `typeset` has this shape already, and takes no time."""
    return _shape(latex)[0] in _seen


def plain_text(latex: str) -> str:
    """A formula as readable text: for screen readers, and where it cannot be set (yet)."""
    text = _PLAIN_FRACTION.sub(r"(\1)/(\2)", latex)
    text = re.sub(r"\\sqrt\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}", r"√(\1)", text)
    text = re.sub(r"\\phantom\{[^{}]*\}", "", text)
    text = re.sub(r"\\(?:operatorname|mathrm|text)\{([^{}]*)\}", r"\1", text)
    text = re.sub(r"\\(?:begin|end)\{[a-z]+\}", " ", text)
    text = text.replace("^\\circ", "°").replace("\\\\", ";").replace("&", " ")
    text = re.sub(r"\^(\d)", lambda m: _SUPERSCRIPTS[int(m[1])], text)
    text = re.sub(r"_\{?(\d+)\}?", lambda m: "".join(_SUBSCRIPTS[int(d)] for d in m[1]), text)
    text = re.sub(r"\\(dot|ddot|hat)\{\\?(\w+)\}", lambda m: _WORDS.get(m[2], m[2]) + _ACCENTS[m[1]], text)
    text = re.sub(r"\\([a-zA-Z]+|[,;]) ?", lambda m: _WORDS.get(m[1], m[1] + " "), text)
    text = text.replace("{", "").replace("}", "").replace("_", "").replace("-", "\u2212")
    return re.sub(r"\s+", " ", text.replace("=", " = ")).strip()


_PLAIN_FRACTION = re.compile(r"\\frac\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}")
_SUPERSCRIPTS, _SUBSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹", "₀₁₂₃₄₅₆₇₈₉"
_WORDS = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "theta": "θ", "lambda": "λ", "varphi": "φ", "psi": "ψ",
    "rho": "ρ", "Sigma": "Σ", "perp": "⊥", "cdot": " · ", "equiv": " ≡ ", ",": " ", "arcsin": "arcsin ", "cos": "cos ",
    "sin": "sin ", "times": " × ", "arccos": "arccos ", "quad": "  ", "pi": "π", "sigma": "σ", "zeta": "ζ",
    "omega": "ω", "tau": "τ", "Delta": "Δ", "leq": " ≤ ", "geq": " ≥ ", "pm": "±", "cdots": " ⋯ ", "ldots": "…",
    "sum": "Σ ", "prod": "Π ", "in": " ∈ ", "Rightarrow": " ⇒ ", "rightarrow": " → ", ";": " ",
    "vee": "∨ ", "wedge": "∧ ",
}  # fmt: skip
_ACCENTS = {"dot": "\u0307", "ddot": "\u0308", "hat": "\u0302"}  # combined with the letter before


# --- shapes ----------------------------------------------------------------------------------------------------------

_seen: set[str] = set()


def _shape(latex: str) -> tuple[str, str]:
    """A formula with every place marked and filled, 0 for a digit, and what belongs there: a space for nothing."""
    signs: list[str] = []

    def marked(place: re.Match[str]) -> str:
        text = place[0]
        if "-" in text:
            signs.append(" " if text.startswith("\\") else "-")
            return "{-}"
        signs.extend(" " if text.startswith("\\") else re.findall(r"\d", text))
        return "0" + _MARK if text.startswith("\\") else re.sub(r"\d", "0" + _MARK, text)

    return _PLACE.sub(marked, latex), "".join(signs)


_MARK = "\u2060"  # a sign that nobody writes: it follows each digit that is a place


@lru_cache(maxsize=_KEPT)
def _filled(shape: str, signs: str) -> Typeset | None:
    """The path of a shape with other signs in its places."""
    layout = _layout(shape)
    if layout is None:
        return None
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.WindingFill)
    for letter in _letters(layout, signs):
        path.addPath(letter.at.map(letter.outline))
    for rule in layout.rules:
        path.addRect(rule)
    box = layout.box
    return Typeset(path, box.right(), -box.top(), box.bottom())


def _letters(layout: _Layout, signs: str) -> Iterator[Letter]:
    """Every sign that is seen: those of the places put in, a minus close to its number."""
    for outline, at, place in layout.glyphs:
        sign = signs[place] if place >= 0 else ""
        if sign == "-":
            yield Letter(outline, at * QTransform.fromTranslate(_gap(signs, place), 0.0))
        elif sign != " ":
            yield Letter(_outline(sign) if sign.isdigit() else outline, at)


def _gap(signs: str, place: int) -> float:
    """How far a minus moves to the right over empty places, to stand close to its number."""
    behind = signs[place + 1 :]
    return _DIGIT * (len(behind) - len(behind.lstrip(" ")))


@lru_cache(maxsize=_KEPT)
def _layout(shape: str) -> _Layout | None:
    """What stands where, by ziamath; None if the formula is beyond it."""
    with _one_at_a_time:
        try:
            return _parsed(_svg(shape.replace(_MARK, "")), deque(_digits_and_signs(shape)))
        except Exception:  # a formula that cannot be set is shown as text: no formula is worth a window
            return None
        finally:
            _seen.add(shape)


def _svg(latex: str) -> ElementTree.Element:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the library's own import of a font, on some Pythons
        from ziamath.zmath import Latex

        return ElementTree.fromstring(Latex(_as_understood(latex), size=SIZE).svg())


def _as_understood(latex: str) -> str:
    """Two things TeX knows and the library does not: a minus that is a sign stands close, a named function upright."""
    return _UNARY.sub(r"\1{-}", latex).replace("\\operatorname{", "\\mathrm{")


def _digits_and_signs(shape: str) -> Iterator[tuple[str, int]]:
    """Every digit and minus of a shape, with the index of the place it is (−1: it stays as it is)."""
    index = 0
    for found in _SIGN.finditer(shape):
        if found[0].startswith("\\"):
            continue
        before, behind = shape[found.start() - 1 : found.start()], shape[found.end() : found.end() + 1]
        is_place = behind == _MARK or (found[0] == "-" and before + behind == "{}")
        yield found[0], index if is_place else -1
        index += is_place


def _parsed(svg: ElementTree.Element, waiting: deque[tuple[str, int]]) -> _Layout:
    """The layout of a picture, its digits and signs matched in order with those of the formula."""
    symbols = {f"#{symbol.get('id')}": symbol for symbol in svg.iter(f"{_SVG}symbol")}
    glyphs = []
    for use in svg.iter(f"{_SVG}use"):
        name, place = use.get("href", ""), -1
        sign = _sign_names().get(name)
        if sign:
            wanted, place = waiting.popleft()
            if sign != wanted:
                raise ValueError(f"{wanted} expected, {sign} found")
        glyphs.append(_Glyph(_symbol_outline(symbols[name]), _placing(use, symbols[name]), place))
    rules = tuple(QRectF(*_numbers(rule, "x", "y", "width", "height")) for rule in svg.iter(f"{_SVG}rect"))
    return _Layout(tuple(glyphs), rules, QRectF(*map(float, svg.get("viewBox", "").split())))


def _placing(use: ElementTree.Element, symbol: ElementTree.Element) -> QTransform:
    """Where a symbol is put: its view box is mapped onto the rectangle of its use."""
    x, y, height = _numbers(use, "x", "y", "height")  # the width may be 0: there are invisible signs
    left, top, _, symbol_height = map(float, symbol.get("viewBox", "").split())
    scale = height / symbol_height
    return QTransform(scale, 0.0, 0.0, scale, x - left * scale, y - top * scale)


def _numbers(element: ElementTree.Element, *names: str) -> list[float]:
    return [float(element.get(name, "0")) for name in names]


@lru_cache(maxsize=1)
def _samples() -> tuple[dict[str, str], dict[str, QPainterPath]]:
    """The names of the symbols for digits and minus, upright and in indices; the outlines of the upright digits."""
    names: dict[str, str] = {}
    outlines: dict[str, QPainterPath] = {}
    for latex, signs in (("-0123456789", "-0123456789"), ("x_{0123456789-}", "x0123456789-")):
        svg = _svg(latex)
        symbols = {f"#{symbol.get('id')}": symbol for symbol in svg.iter(f"{_SVG}symbol")}
        for use, sign in zip(svg.iter(f"{_SVG}use"), signs, strict=True):
            names[use.get("href", "")] = sign
            outlines.setdefault(sign, _symbol_outline(symbols[use.get("href", "")]))
    return {name: sign for name, sign in names.items() if sign != "x"}, outlines


def _sign_names() -> dict[str, str]:
    return _samples()[0]


def _outline(digit: str) -> QPainterPath:
    return _samples()[1][digit]


def _symbol_outline(symbol: ElementTree.Element) -> QPainterPath:
    # A bracket that is taller than any the font has is put together from several pieces.
    return _painter_path(" ".join(drawn.get("d", "") for drawn in symbol.iter(f"{_SVG}path")))


@lru_cache(maxsize=_KEPT)
def _painter_path(d: str) -> QPainterPath:
    """A path of the commands M, L, Q, C and Z, which are all that outlines of letters have."""
    path = QPainterPath()
    draw: dict[str, Callable[..., None]] = {"M": path.moveTo, "L": path.lineTo, "Q": path.quadTo, "C": path.cubicTo}
    for command, numbers in re.findall(r"([MLQCZ])([^MLQCZ]*)", d):
        if command == "Z":
            path.closeSubpath()
        else:
            draw[command](*map(float, numbers.split()))
    return path
