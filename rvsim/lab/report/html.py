"""The report as one page of HTML that needs nothing else: styles, formulas, curves and pictures are inside."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape
from typing import Protocol

from rvsim.lab.report.chart import Chart
from rvsim.lab.report.chart_svg import chart_svg
from rvsim.lab.report.html_style import STYLE
from rvsim.lab.report.values import (
    Block,
    Document,
    Figure,
    Formula,
    Formulas,
    Items,
    Paragraph,
    Run,
    ScenePicture,
    Section,
    Subheading,
    Table,
    Words,
    is_marked,
    runs,
    unbroken,
)
from rvsim.language import has_right_to_left, in_its_order, language, signs_in_order, tr

_TOTAL = ' class="total"'


class Artist(Protocol):
    """Who draws what letters cannot say."""

    def formula(self, latex: str) -> str:
        """A formula as an SVG element."""
        ...

    def picture(self, picture: ScenePicture) -> str:
        """A picture as a data URI."""
        ...


def html_page(document: Document, artist: Artist) -> str:
    """The whole page."""
    return "".join(html_parts(document, artist))


def html_parts(document: Document, artist: Artist) -> Iterator[str]:
    """The same, one block at a time: drawing takes a while."""
    cover, spoken = document.cover, language()
    direction = ' dir="rtl"' if spoken.right_to_left else ""
    yield (
        f'<!DOCTYPE html>\n<html lang="{spoken.code}"{direction}>\n<head>\n<meta charset="utf-8"/>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
        f"<title>{escape(cover.title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n"
    )
    yield _head(document)
    for section in document.sections:
        yield from _section(section, artist)
    yield "</main>\n</body>\n</html>\n"


def _head(document: Document) -> str:
    cover = document.cover
    who = " · ".join(f'<span dir="auto">{escape(text)}</span>' for text in (cover.author, cover.date) if text)
    notes = "".join(f'<p class="own" dir="auto">{escape(line)}</p>\n' for line in _lines(signs_in_order(cover.notes)))
    return (
        f'<header>\n<p class="kind">{escape(tr("Laboratory report"))}</p>\n'
        f"<h1{_own_direction(cover.title)}>{escape(cover.title)}</h1>\n"
        f'<p class="who">{who}</p>\n{notes}</header>\n'
    )


def _own_direction(text: str) -> str:
    """That of a text that somebody may have typed in any script; on a page from right to left one mixed of both."""
    return "" if language().right_to_left and has_right_to_left(text) else ' dir="auto"'


def _lines(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines() if line.strip()]


def _section(section: Section, artist: Artist) -> Iterator[str]:
    number = f'<span class="number">{section.number}</span>'
    yield f"<section>\n<h2>{number} {escape(section.title)}</h2>\n"
    for block in section.blocks:
        yield _BLOCKS[type(block)](block, artist)
    yield "</section>\n"


def _words(words: Words, artist: Artist) -> str:
    return "".join(_run(run, artist) for run in runs(words))


def _run(run: Run, artist: Artist) -> str:
    if run.style == "math":
        return artist.formula(run.text)
    if run.style == "index":
        letter, _, index = run.text.partition("_")
        return f'<span dir="ltr">{escape(letter)}<sub>{escape(index)}</sub></span>'
    tag = {"": "", "bold": "b", "code": "code"}.get(run.style)
    text = escape(in_its_order(run.text if run.style == "code" else unbroken(run.text)))
    if tag is None:
        return f'<span class="{run.style}">{text}</span>'
    return f"<{tag}>{text}</{tag}>" if tag else text


def _paragraph(block: Paragraph, artist: Artist) -> str:
    name = "" if block.role == "body" else f' class="{block.role}"'
    return f"<p{name}>{_words(block.words, artist)}</p>\n"


def _subheading(block: Subheading, artist: Artist) -> str:
    return f"<h3>{_words(block.words, artist)}</h3>\n"


def _items(block: Items, artist: Artist) -> str:
    if not block.marks:
        return "<ul>" + "".join(f"<li>{_words(item, artist)}</li>" for item in block.items) + "</ul>\n"
    rows = zip(block.marks, block.items, strict=True)
    inside = "".join(f"<li>{_run(mark, artist)} {_words(item, artist)}</li>" for mark, item in rows)
    return f'<ul class="marked">{inside}</ul>\n'


def _formula(block: Formula, artist: Artist) -> str:
    label = f'<span class="label">{escape(block.label)}</span>' if block.label else ""
    return f'<div class="formula">{label}{_parts(block, artist)}</div>\n'


def _formulas(block: Formulas, artist: Artist) -> str:
    return f'<div class="formula">{_parts(block, artist)}</div>\n'


def _parts(block: Formula | Formulas, artist: Artist) -> str:
    """Formulas are written from left to right, also on a page that is not."""
    parts = " ".join(artist.formula(part) for part in block.parts)
    return f'<span class="parts" dir="ltr">{parts}</span>' if language().right_to_left else parts


def _table(block: Table, artist: Artist) -> str:
    head = "".join(f'<th class="{column.align}">{_words(column.head, artist)}</th>' for column in block.columns)
    first_total = len(block.rows) - block.totals
    rows = "".join(
        f"<tr{_TOTAL if number == first_total else ''}>{_cells(row, block, artist)}</tr>\n"
        for number, row in enumerate(block.rows)
    )
    note = f'<p class="note">{escape(block.note)}</p>\n' if block.note else ""
    return (
        f'<figure class="table"><figcaption>{_caption(block.caption)}</figcaption>'
        f'<div class="scroll"><table{_direction(block)}>'
        f"<thead><tr>{head}</tr></thead>\n<tbody>{rows}</tbody></table></div>{note}</figure>\n"
    )


def _direction(block: Table) -> str:
    return ' dir="ltr"' if block.of_numbers and language().right_to_left else ""


def _cells(row: tuple[Words, ...], block: Table, artist: Artist) -> str:
    return "".join(
        f'<td class="{_class(block, number, cell)}">{_words(cell, artist)}</td>' for number, cell in enumerate(row)
    )


def _class(block: Table, number: int, cell: Words) -> str:
    """How a cell stands; "bare" is a number that leaves room for the mark that others of its column have."""
    column = block.columns[number]
    bare = block.hanging(number) and not is_marked(cell)
    return f"{column.align}{' wide' * column.wide}{' bare' * bare}"


def _caption(caption: str) -> str:
    name, colon, text = caption.partition(": ")
    return f"<b>{escape(name)}{colon}</b>{escape(text)}" if colon else escape(caption)


def _figure(block: Figure, artist: Artist) -> str:
    pictures = "".join(_picture(picture, artist) for picture in block.pictures)
    return f"<figure>{pictures}<figcaption>{_caption(block.caption)}</figcaption></figure>\n"


def _picture(picture: ScenePicture | Chart, artist: Artist) -> str:
    if isinstance(picture, Chart):
        return chart_svg(picture).replace(' xmlns="http://www.w3.org/2000/svg"', "")
    return f'<img alt="{escape(picture.text)}" src="{artist.picture(picture)}"/>'


_BLOCKS: dict[type[Block], Callable[..., str]] = {
    Paragraph: _paragraph,
    Subheading: _subheading,
    Items: _items,
    Formula: _formula,
    Formulas: _formulas,
    Table: _table,
    Figure: _figure,
}
