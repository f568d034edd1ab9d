"""Some pages of a report side by side, as a picture of it."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter

from rvsim.gui.report.pages import Page
from rvsim.gui.report.pdf import PAGE, Sheets
from rvsim.lab.report.values import Document

_COUNT, _SCALE, _GAP = 3, 0.74, 12  # pages, pixels a point, pixels between pages
_FINER = 2  # so much larger it is painted first: letters as small as these need it
_BOARD = QColor("#C8D1DD")
_KEEP, _SMOOTH = Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation


def pages_picture(document: Document) -> QImage:
    """The title page and the two of the others on which most is drawn."""
    sheets = Sheets(document)
    for _ in sheets.lay_out():
        pass
    pages = [_painted(sheets, number) for number in _shown(sheets.pages)]
    wide, high = pages[0].width() + _GAP, pages[0].height() + 2 * _GAP
    image = QImage(QSize(len(pages) * wide + _GAP, high), QImage.Format.Format_RGB32)
    image.fill(_BOARD)
    painter = QPainter(image)
    for place, page in enumerate(pages):
        painter.drawImage(_GAP + place * wide, _GAP, page)
    painter.end()
    return image


def _shown(pages: tuple[Page, ...]) -> list[int]:
    others = sorted(range(1, len(pages)), key=lambda number: -_drawn(pages[number]))
    return sorted([0, *others[: _COUNT - 1]])


def _drawn(page: Page) -> float:
    """The height of its figures."""
    return sum(strip.height for _, strip in page if strip.floats == "figure")


def _painted(sheets: Sheets, number: int) -> QImage:
    size = QSize(round(_SCALE * PAGE[0]), round(_SCALE * PAGE[1]))
    image = QImage(size * _FINER, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
    painter.scale(_FINER * _SCALE, _FINER * _SCALE)
    sheets.paint(painter, number)
    painter.end()
    smaller: QImage = image.scaled(size, _KEEP, _SMOOTH)
    return smaller
