"""What a report is made of: sections of paragraphs, lists, formulas, tables and figures. Nothing is drawn here."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import count
from typing import Literal, NamedTuple

from rvsim.lab.report.air import airy
from rvsim.lab.report.chart import Chart
from rvsim.language import tr
from rvsim.scene import Camera, Scene

Style = Literal["", "bold", "math", "code", "good", "warning", "bad", "muted", "index"]
ASSUMED = "†"  # behind a number that no source gives
Role = Literal["body", "note", "lead", "own"]
Align = Literal["left", "right", "center"]


class Run(NamedTuple):
    """A piece of text in one style; in the style "math" it is LaTeX, in "index" a letter, "_" and its index."""

    text: str
    style: Style = ""


Runs = tuple[Run, ...]
Words = str | Run | Runs


def runs(words: Words) -> Runs:
    """Any text as runs."""
    if isinstance(words, Run):
        return (words,)
    return (Run(words),) if isinstance(words, str) else words


_INDEXED = re.compile(r"(?<![A-Za-z\d_])([^\W\d_]_[^\W_]{1,2})(?!\w)")


def with_indices(text: str, style: Style = "") -> Runs:
    """Words in which "n_z" is a letter with an index, for what Unicode has no small letters."""
    pieces = _INDEXED.split(text)
    return tuple(Run(piece, "index" if number % 2 else style) for number, piece in enumerate(pieces) if piece)


_UNITS = r"%|[nµm]?m|[mµ]?s|k?g|N|rad"
_BOUND = re.compile(rf" (?=[=≥≤≈] [^(])|(?<=[=≥≤≈]) (?!\()|(?<=\d) (?=(?:{_UNITS})(?!\w))|(?<=\d N) (?=m(?!\w))")


def unbroken(text: str) -> str:
    """What is compared stays on one line, but for a long bracket, and a number with its unit."""
    return _BOUND.sub("\u00a0", text)


def plain(words: Words) -> str:
    """Its letters alone."""
    return "".join(run.text for run in runs(words))


def is_marked(words: Words) -> bool:
    """Whether it is a number that no source gives."""
    return plain(words).endswith(ASSUMED)


@dataclass(frozen=True)
class Paragraph:
    """A paragraph; what somebody has typed ("own") may be in any script."""

    words: Words
    role: Role = "body"


@dataclass(frozen=True)
class Subheading:
    """A title inside a section."""

    words: Words


@dataclass(frozen=True)
class Items:
    """A list; `marks` stand before the items, one each, or () for dots."""

    items: tuple[Words, ...]
    marks: tuple[Run, ...] = ()


@dataclass(frozen=True)
class Formula:
    """Left side = right side = right side …, LaTeX; whoever draws it breaks it before a sign of equality.

    Args:
        label: a word before it, for instance "printed", "" for none.
    """

    left: str
    rights: tuple[str, ...]
    label: str = ""

    @property
    def parts(self) -> tuple[str, ...]:
        """The left side with the first right side, then one part each."""
        first = f"{self.left} = {self.rights[0]}" if self.left else self.rights[0]
        return tuple(map(airy, (first, *(f"{{}} = {right}" for right in self.rights[1:]))))


@dataclass(frozen=True)
class Formulas:
    """Short formulas, as many on a line as there is room for."""

    latex: tuple[str, ...]

    @property
    def parts(self) -> tuple[str, ...]:
        """One a formula."""
        return tuple(map(airy, self.latex))


@dataclass(frozen=True)
class Column:
    """Of a table: its head, and how its cells stand; `wide` for one whose text may break."""

    head: Words
    align: Align = "right"
    wide: bool = False


@dataclass(frozen=True)
class Table:
    """Rows of cells; the last `totals` rows stand below a line. The note explains its signs."""

    caption: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Words, ...], ...]
    note: str = ""
    totals: int = 0

    @property
    def of_numbers(self) -> bool:
        """Whether most of its columns are numbers: those stand from left to right in every language."""
        return 2 * sum(column.align == "right" for column in self.columns) > len(self.columns)

    def hanging(self, column: int) -> bool:
        """Whether numbers of a column have a mark behind them, for which the others have to leave room."""
        return self.columns[column].align == "right" and any(is_marked(row[column]) for row in self.rows)


@dataclass(frozen=True, eq=False)
class ScenePicture:
    """The arm in its scene, and from where it is seen."""

    scene: Scene
    camera: Camera
    width: int = 900
    height: int = 560
    text: str = ""  # for who cannot see it


@dataclass(frozen=True, eq=False)
class Figure:
    """Pictures below each other under one caption."""

    caption: str
    pictures: tuple[ScenePicture | Chart, ...]


Block = Paragraph | Subheading | Items | Formula | Formulas | Table | Figure


@dataclass(frozen=True, eq=False)
class Section:
    """A section under its title; its number is given by the document."""

    title: str
    blocks: tuple[Block, ...]
    number: str = ""


@dataclass(frozen=True)
class Cover:
    """What stands above everything: the caller gives all of it."""

    title: str
    author: str = ""
    date: str = ""
    notes: str = ""


@dataclass(frozen=True, eq=False)
class Document:
    """The whole report: captions are numbered, and so are sections."""

    cover: Cover
    subject: str
    sections: tuple[Section, ...]

    def blocks(self) -> Iterable[Block]:
        """All of them, in order."""
        return (block for section in self.sections for block in section.blocks)


def numbered(document: Document) -> Document:
    """With "1 The robot", "Table 1: …", "Figure 1: …"."""
    tables, figures = count(1), count(1)

    def captioned(block: Block) -> Block:
        if isinstance(block, Table):
            return replace(block, caption=tr("Table {number}: {words}", number=next(tables), words=block.caption))
        if isinstance(block, Figure):
            return replace(block, caption=tr("Figure {number}: {words}", number=next(figures), words=block.caption))
        return block

    sections = tuple(
        replace(section, number=str(number), blocks=tuple(map(captioned, section.blocks)))
        for number, section in enumerate(document.sections, 1)
    )
    return replace(document, sections=sections)
