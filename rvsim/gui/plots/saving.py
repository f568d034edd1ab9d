"""A plot as a picture: PNG at twice the size of the screen, SVG as lines and letters, or on the clipboard."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QFontMetrics, QGuiApplication, QImage, QImageWriter, QPainter, QPen
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QFileDialog, QMenu, QMessageBox, QWidget

from rvsim.errors import FileWriteError
from rvsim.files.atomic import write_atomically
from rvsim.language import tr, tr_later

if TYPE_CHECKING:
    from rvsim.gui.plots.time_plot import TimePlot

_FINER = 2  # pixels of a PNG for one of the screen
_MARGIN, _STROKE, _LEFT = 5, 18, 52  # [pixels] of the legend
_KINDS = tr_later("Picture (*.png);;Drawing (*.svg)")


def plot_image(plot: TimePlot) -> QImage:
    """The plot without its cursor, `_FINER` times as fine as on the screen."""
    image = QImage(_size(plot) * _FINER, QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.white)
    with QPainter(image) as painter:
        painter.scale(_FINER, _FINER)
        _draw(plot, painter)
    return image


def save_plot(plot: TimePlot, path: str | Path) -> None:
    """Write it as .png or .svg, whole or not at all.

    Raises:
        FileWriteError: another ending, or the file cannot be written.
    """
    file = Path(path)
    makers: dict[str, Callable[[TimePlot], bytes]] = {".png": _png, ".svg": _svg}
    if file.suffix.lower() not in makers:
        raise FileWriteError(
            file,
            tr(
                "“{ending}” is no ending of a picture of curves. Known: {known}",
                ending=file.suffix,
                known=", ".join(makers),
            ),
        )
    try:
        write_atomically(file, makers[file.suffix.lower()](plot))
    except OSError as problem:
        raise FileWriteError(file, (problem.strerror or str(problem)).lower()) from None


def copy_plot(plot: TimePlot) -> None:
    """Put it on the clipboard as a picture."""
    QGuiApplication.clipboard().setImage(plot_image(plot))


def plot_menu(plot: TimePlot) -> QMenu:
    """What can be done with a plot; it goes when it is closed."""
    menu = QMenu(plot)
    menu.setObjectName("plot_menu")
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    menu.addAction(tr("Save as…"), lambda: ask_save_plot(plot)).setObjectName("plot_save")
    menu.addAction(tr("Copy"), lambda: copy_plot(plot)).setObjectName("plot_copy")
    return menu


def ask_save_plot(plot: TimePlot, parent: QWidget | None = None) -> None:
    """Ask for a place and save it there."""
    name = plot.drawing.title.replace(" ", "-") or "curves"
    start = str(Path.home() / f"{name}.png")
    file, kind = QFileDialog.getSaveFileName(parent or plot.window(), tr("Save curves"), start, tr(_KINDS))
    if not file:
        return
    path = Path(file) if Path(file).suffix else Path(file).with_suffix(".svg" if "svg" in kind else ".png")
    try:
        save_plot(plot, path)
    except FileWriteError as problem:
        box = QMessageBox(QMessageBox.Icon.Warning, "rvsim", tr("Nothing was written."), parent=plot.window())
        box.setObjectName("file_problem")
        box.setInformativeText(str(problem))
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.open()


def _size(plot: TimePlot) -> QSize:
    """As on the screen, and a line for the names where there are several curves."""
    return QSize(plot.width(), plot.height() + _legend_height(plot))


def _legend_height(plot: TimePlot) -> int:
    entries = _legend(plot)
    return round(entries[-1].at.y()) + QFontMetrics(plot.font()).height() + _MARGIN if entries else 0


class _Entry(NamedTuple):
    """A curve's name and pen, and where its stroke begins, from the left end of the legend."""

    name: str
    pen: QPen
    at: QPointF


def _legend(plot: TimePlot) -> list[_Entry]:
    """The names of several curves in rows."""
    metrics = QFontMetrics(plot.font())
    names = [name for name, _, _ in plot.value_texts()]
    pens = [item.opts["pen"] for item in plot.plot.listDataItems()]
    solid = [pen for pen in pens if pen.style() == Qt.PenStyle.SolidLine]
    entries: list[_Entry] = []
    x, y = float(_LEFT), float(_MARGIN)
    for name, pen in zip(names, solid, strict=False):
        width = _STROKE + _MARGIN + metrics.horizontalAdvance(name)
        if x + width > plot.width() and x > _LEFT:
            x, y = float(_LEFT), y + metrics.height() + _MARGIN
        entries.append(_Entry(name, pen, QPointF(x, y)))
        x += width + 3 * _MARGIN
    return entries if len(entries) > 1 else []


def _draw(plot: TimePlot, painter: QPainter) -> None:
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(QRectF(QPointF(), QSizeF(_size(plot))), plot.plot.backgroundBrush())
    plot.plot.render(painter, QRectF(0.0, 0.0, plot.width(), plot.height()), plot.plot.viewport().rect())
    _draw_legend(plot, painter)


def _draw_legend(plot: TimePlot, painter: QPainter) -> None:
    """A stroke in its colour and the name of each curve, below the plot."""
    metrics = QFontMetrics(plot.font())
    painter.setFont(plot.font())
    for name, pen, at in _legend(plot):
        middle = plot.height() + at.y() + 0.5 * metrics.height()
        painter.setPen(QPen(pen.color(), 2.5))
        painter.drawLine(QPointF(at.x(), middle), QPointF(at.x() + _STROKE, middle))
        painter.setPen(plot.plot.getAxis("left").textPen())
        painter.drawText(QPointF(at.x() + _STROKE + _MARGIN, middle + 0.35 * metrics.ascent()), name)


def _png(plot: TimePlot) -> bytes:
    kept = QByteArray()
    buffer = QBuffer(kept)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    QImageWriter(buffer, QByteArray(b"png")).write(plot_image(plot))
    return bytes(kept.data())


def _svg(plot: TimePlot) -> bytes:
    kept = QByteArray()
    buffer = QBuffer(kept)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    made = QSvgGenerator()
    made.setOutputDevice(buffer)
    made.setResolution(plot.plot.logicalDpiX())  # the axes are recorded on the screen: at another one they would shrink
    made.setSize(_size(plot))
    made.setViewBox(QRectF(QPointF(), QSizeF(_size(plot))))
    made.setTitle(plot.accessibleName())
    with QPainter(made) as painter:
        _draw(plot, painter)
    return bytes(kept.data())
