"""Draws for the page of HTML: formulas as SVG whose letters are outlined once, scenes as pictures inside the page."""

from __future__ import annotations

from base64 import b64encode
from functools import lru_cache
from html import escape

from PySide6.QtCore import QBuffer, QByteArray, QIODevice
from PySide6.QtGui import QImage, QImageWriter, QPainterPath

from rvsim.gui.formula import Pieces, pieces, plain_text
from rvsim.gui.renderers.painter import scene_image
from rvsim.lab.report.values import ScenePicture

_ELEMENTS = QPainterPath.ElementType
_SHARPER = 2.2  # pixels of a picture for one that is asked for


class PageArtist:
    """An `Artist` for one page: it counts its formulas, so that the names of their letters are their own."""

    def __init__(self) -> None:
        self._count = 0

    def formula(self, latex: str) -> str:
        """The formula as SVG in which each letter is outlined once, or as text where it cannot be set."""
        found = pieces(latex)
        words = escape(plain_text(latex), quote=True)
        if found is None:
            return f"<i>{words}</i>"
        self._count += 1
        box = found.box
        return (
            f'<svg class="math" role="img" aria-label="{words}" width="{box.width():.1f}" height="{box.height():.1f}" '
            f'viewBox="{box.x():.2f} {box.y():.2f} {box.width():.2f} {box.height():.2f}">{self._drawn(found)}</svg>'
        )

    def _drawn(self, found: Pieces) -> str:
        """Outlines, the letters that use them, and bars. The pieces keep the outlines, so their ids stay theirs."""
        names: dict[int, str] = {}
        outlines, letters = [], []
        for outline, at in found.letters:
            if id(outline) not in names:
                names[id(outline)] = f"f{self._count}g{len(names)}"
                outlines.append(f'<path id="{names[id(outline)]}" d="{path_data(outline)}"/>')
            place = f"matrix({at.m11():.4g} 0 0 {at.m22():.4g} {at.dx():.2f} {at.dy():.2f})"
            letters.append(f'<use href="#{names[id(outline)]}" transform="{place}"/>')
        rules = (
            f'<rect x="{rule.x():.2f}" y="{rule.y():.2f}" width="{rule.width():.2f}" height="{rule.height():.2f}"/>'
            for rule in found.rules
        )
        return f"<defs>{''.join(outlines)}</defs>{''.join(letters)}{''.join(rules)}"

    def picture(self, picture: ScenePicture) -> str:
        """A PNG as a data URI."""
        return f"data:image/png;base64,{b64encode(painted_png(picture)).decode()}"


@lru_cache(maxsize=8)
def painted(picture: ScenePicture) -> QImage:
    """The picture, as fine as paper wants it; the page and the sheets of a report share it."""
    return scene_image(picture.scene, picture.camera, picture.width, picture.height, _SHARPER)


@lru_cache(maxsize=8)
def painted_png(picture: ScenePicture) -> bytes:
    """The same as the bytes of a PNG file; this may be done in a thread."""
    return png(painted(picture))


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
        parts.append(f"{letter.get(element.type, ' ')}{element.x:.4g} {element.y:.4g}")
    return "".join(parts)
