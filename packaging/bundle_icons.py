"""rvsim's icon in the formats of every system, drawn from its SVG: `bundle_icons.py FOLDER` writes them there."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path

from PIL import Image

SIZES = (16, 24, 32, 48, 64, 128, 256, 512)
_IN_ICO = tuple(size for size in SIZES if size <= 256)


def drawn(svg: Path, size: int) -> Image.Image:
    """The drawing as a square picture with a transparent ground."""
    from PySide6.QtCore import QBuffer, QIODevice, Qt
    from PySide6.QtGui import QImage, QPainter
    from PySide6.QtSvg import QSvgRenderer

    image = QImage(size, size, QImage.Format.Format_ARGB32)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    QSvgRenderer(str(svg)).render(painter)
    painter.end()
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")
    return Image.open(io.BytesIO(bytes(buffer.data().data())))


def write_icons(svg: Path, folder: Path) -> None:
    """rvsim-16.png … rvsim-512.png, rvsim.ico and rvsim.icns."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = {size: drawn(svg, size) for size in SIZES}
    for size, picture in pictures.items():
        picture.save(folder / f"rvsim-{size}.png")
    small = [pictures[size] for size in _IN_ICO]
    small[-1].save(folder / "rvsim.ico", sizes=[(size, size) for size in _IN_ICO], append_images=small[:-1])
    pictures[512].save(folder / "rvsim.icns", append_images=[pictures[size] for size in (32, 64, 128, 256)])


if __name__ == "__main__":
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtGui import QGuiApplication

    application = QGuiApplication([])
    write_icons(Path(__file__).resolve().parent.parent / "resources" / "icons" / "rvsim.svg", Path(sys.argv[1]))
