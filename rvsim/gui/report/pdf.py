"""The report as a PDF: A4, a title block, headers and footers with page numbers; letters and formulas stay outlines."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QPointF
from PySide6.QtGui import QPageLayout, QPageSize, QPainter, QPdfWriter, QPen

from rvsim.errors import FileWriteError
from rvsim.gui.report import typography as faces
from rvsim.gui.report.pages import Page, paginated
from rvsim.gui.report.strips import Strip, section_strips, text_strips
from rvsim.gui.report.typography import MUTED, RULE, Text, aside, text_width
from rvsim.lab.report.values import Cover, Document
from rvsim.language import signs_in_order, tr, without_isolates

PAGE = (595.0, 842.0)  # A4 [pt]
MARGIN = (71.0, 74.0, 71.0, 70.0)  # left, top, right, bottom
WIDTH = PAGE[0] - MARGIN[0] - MARGIN[2]
HEIGHT = PAGE[1] - MARGIN[1] - MARGIN[3]
_RESOLUTION = 600
_ISOLATE, _AGAIN = "\u2068", "\u2069"  # a name from right to left leaves the date beside it alone
_TITLE_RAISED = 14.0  # the title begins above the margin: there is no header over it


class Sheets:
    """A document on its pages, which are painted one at a time on anything that is measured in points."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.pages: tuple[Page, ...] = ()

    def lay_out(self) -> Iterator[None]:
        """Set it section by section; then `pages` is there."""
        strips = list(_title_strips(self.document.cover))
        for section in self.document.sections:
            for strip in section_strips(section, WIDTH):
                strips.append(strip)
                yield
        self.pages = paginated(strips, HEIGHT, -_TITLE_RAISED)

    def paint(self, painter: QPainter, number: int) -> None:
        """One page, from 0; the painter's unit is a point."""
        for y, strip in self.pages[number]:
            strip.draw(painter, MARGIN[0], MARGIN[1] + y)
        if number:
            self._header(painter)
        self._footer(painter, number)

    def _header(self, painter: QPainter) -> None:
        cover, y = self.document.cover, MARGIN[1] - 34.0
        author = Text(_shortened(cover.author, 0.4 * WIDTH), faces.SMALL, WIDTH)
        room = WIDTH - author.width - 20.0
        title = Text(_shortened(cover.title, room), faces.SMALL, WIDTH)
        title.draw(painter, MARGIN[0], y)
        self._at_the_end(painter, author, y)
        painter.setPen(QPen(MUTED, 0.4))
        painter.drawLine(QPointF(MARGIN[0], y + 14.0), QPointF(MARGIN[0] + WIDTH, y + 14.0))

    def _footer(self, painter: QPainter, number: int) -> None:
        y = PAGE[1] - MARGIN[3] + 26.0
        page = Text(tr("Page {number} of {count}", number=number + 1, count=len(self.pages)), faces.SMALL, 100.0)
        self._at_the_end(painter, page, y)
        Text(self.document.cover.date, faces.SMALL, WIDTH).draw(painter, MARGIN[0], y)

    @staticmethod
    def _at_the_end(painter: QPainter, text: Text, y: float) -> None:
        """On the side of the page where lines end."""
        left = aside(WIDTH, WIDTH - text.width, text.width)
        text.draw(painter, MARGIN[0] + left - text.left, y)


def _shortened(text: str, width: float) -> str:
    if text_width(text, faces.SMALL) <= width:
        return text
    while text and text_width(f"{text}…", faces.SMALL) > width:
        text = text[:-1]
    return f"{text.rstrip()}…"


def _title_strips(cover: Cover) -> Iterator[Strip]:
    yield from text_strips(tr("LABORATORY REPORT"), faces.SMALL, WIDTH, above=0.0)
    yield from text_strips(cover.title, faces.TITLE, WIDTH, above=3.0)
    date = cover.date.replace(" ", "\u00a0")
    who = " · ".join(f"{_ISOLATE}{text}{_AGAIN}" for text in (cover.author, date) if text)
    if who:
        yield from text_strips(who, faces.LEAD._replace(sans=True, size=10.5, color=MUTED), WIDTH, above=4.0)
    yield Strip(1.2, _title_rule, 9.0)
    for line in signs_in_order(cover.notes).splitlines():
        if line.strip():
            yield from text_strips(line.strip(), faces.BODY, WIDTH, above=6.0, justified=True)


def _title_rule(painter: QPainter, x: float, y: float) -> None:
    painter.setPen(QPen(RULE, 1.2))
    painter.drawLine(QPointF(x, y), QPointF(x + WIDTH, y))


def write_pdf(sheets: Sheets, path: Path) -> Iterator[None]:
    """Paint the pages into a file, one at a time.

    Raises:
        FileWriteError: the file cannot be written.
    """
    buffer = QBuffer()  # Qt itself says nothing of a disk that is full
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    cover = sheets.document.cover
    writer.setTitle(without_isolates(cover.title))
    writer.setAuthor(cover.author)
    writer.setCreator("rvsim")
    writer.setResolution(_RESOLUTION)
    writer.setPageLayout(
        QPageLayout(QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
    )
    painter = QPainter(writer)
    try:
        for number in range(len(sheets.pages)):
            if number:
                writer.newPage()
            painter.save()
            painter.scale(_RESOLUTION / 72.0, _RESOLUTION / 72.0)
            sheets.paint(painter, number)
            painter.restore()
            yield
    finally:
        painter.end()
    try:
        path.write_bytes(bytes(buffer.data().data()))
    except OSError as problem:
        raise FileWriteError(path, (problem.strerror or str(problem)).lower()) from None
