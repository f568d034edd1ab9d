"""Pictures on disk. Nothing needs to be on the screen."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice
from PySide6.QtGui import QImage, QImageWriter, QPixmap

from rvsim.errors import FileWriteError
from rvsim.files.atomic import write_atomically
from rvsim.gui.renderers.painter import scene_image
from rvsim.language import tr
from rvsim.scene import Camera, Scene


def save_picture(scene: Scene, camera: Camera, path: str | Path, width: int, height: int) -> None:
    """Paints a scene and saves it; the picture's format is that of the file's name, for instance ".png".

    There must be a QGuiApplication, for its fonts.

    Raises:
        FileWriteError: the file cannot be written, or its ending is no picture format.
    """
    save_image(scene_image(scene, camera, width, height), path)


def save_image(image: QImage | QPixmap, path: str | Path) -> None:
    """Saves a picture in the format of the file's name, whole or not at all.

    Raises:
        FileWriteError: the file cannot be written, or its ending is no picture format.
    """
    ending = Path(path).suffix.lstrip(".").lower()
    if ending not in picture_formats():
        known = ", ".join(picture_formats())
        reason = (
            tr("“.{ending}” is no picture format. Known: {known}", ending=ending, known=known)
            if ending
            else tr("the name has no ending such as .png. Known: {known}", known=known)
        )
        raise FileWriteError(path, reason)
    buffer = QBuffer()  # Qt itself says nothing of a disk that is full
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QImageWriter(buffer, QByteArray(ending.encode()))
    picture = image.toImage() if isinstance(image, QPixmap) else image
    if not writer.write(picture):
        raise FileWriteError(path, writer.errorString())
    try:
        write_atomically(Path(path), bytes(buffer.data().data()))
    except OSError as problem:
        raise FileWriteError(path, (problem.strerror or str(problem)).lower()) from None


def picture_formats() -> tuple[str, ...]:
    """The endings that can be written."""
    return tuple(bytes(name.data()).decode() for name in QImageWriter.supportedImageFormats())
