"""Draws for the page of HTML: formulas as SVG whose letters are outlined once, scenes as pictures inside the page."""

from __future__ import annotations

from base64 import b64encode
from functools import lru_cache
from html import escape

from PySide6.QtCore import QBuffer, QByteArray, QIODevice
from PySide6.QtGui import QImage, QImageWriter, QPainterPath

from rvsim.gui.formula import Letter, pieces, plain_text
from rvsim.gui.renderers.painter import scene_image
from rvsim.lab.report.values import ScenePicture

_ELEMENTS = QPainterPath.ElementType
_SHARPER = 2.2  # pixels of a picture for one that is asked for


class PageArtist:
    """An `Artist` for one page: it remembers which letters the page has."""

    def __init__(self) -> None:
        self._outlines: dict[int, tuple[str, QPainterPath]] = {}  # the paths are kept, so that their ids stay theirs

    def formula(self, latex: str) -> str:
        """The formula as SVG, or as text where it cannot be set."""
        found = pieces(latex)
        words = escape(plain_text(latex), quote=True)
        if found is None:
            return f"<i>{words}</i>"
        box = found.box
        letters = "".join(map(self._letter, found.letters))
        rules = "".join(
            f'<rect x="{r.x():.2f}" y="{r.y():.2f}" width="{r.width():.2f}" height="{r.height():.2f}"/>'
            for r in found.rules
        )
        return (
            f'<svg class="math" role="img" aria-label="{words}" width="{box.width():.1f}" height="{box.height():.1f}" '
            f'viewBox="{box.x():.2f} {box.y():.2f} {box.width():.2f} {box.height():.2f}">{letters}{rules}</svg>'
        )

    def _letter(self, letter: Letter) -> str:
        name, _ = self._outlines.setdefault(id(letter.outline), (f"g{len(self._outlines)}", letter.outline))
        at = letter.at
        return (
            f'<use href="#{name}" transform="matrix({at.m11():.4g} 0 0 {at.m22():.4g} {at.dx():.2f} {at.dy():.2f})"/>'
        )

    def symbols(self) -> str:
        """The outlines of all letters of the page."""
        paths = "".join(f'<path id="{name}" d="{path_data(outline)}"/>' for name, outline in self._outlines.values())
        return f'<svg class="shapes" aria-hidden="true"><defs>{paths}</defs></svg>' if paths else ""

    def picture(self, picture: ScenePicture) -> str:
        """A PNG as a data URI."""
        return f"data:image/png;base64,{b64encode(png(painted(picture))).decode()}"


@lru_cache(maxsize=8)
def painted(picture: ScenePicture) -> QImage:
    """The picture, as fine as paper wants it; the page and the sheets of a report share it."""
    return scene_image(picture.scene, picture.camera, picture.width, picture.height, _SHARPER)


def png(image: QImage) -> bytes:
    """A picture as the bytes of a PNG file."""
    kept = QByteArray()
    buffer = QBuffer(kept)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QImageWriter(buffer, QByteArray(b"png"))
    writer.setCompression(80)
    writer.write(image)
    return bytes(kept.data())


def path_data(path: QPainterPath) -> str:
    """The outline as the data of an SVG path."""
    parts = []
    for index in range(path.elementCount()):
        element = path.elementAt(index)
        letter = {_ELEMENTS.MoveToElement: "M", _ELEMENTS.LineToElement: "L", _ELEMENTS.CurveToElement: "C"}
        parts.append(f"{letter.get(element.type, ' ')}{element.x:.6g} {element.y:.6g}")
    return "".join(parts)
