"""Pictures reach the disk, or the person is told why not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtGui import QImage

from rvsim.errors import FileWriteError
from rvsim.gui.picture import save_picture
from rvsim.scene import Camera, Scene
from rvsim.scene.palette import LIGHT

pytestmark = pytest.mark.usefixtures("qapp")
SCENE = Scene((), LIGHT.background, np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]))
CAMERA = Camera(np.zeros(3), 3.0)


@pytest.mark.parametrize("name", ["arm.png", "arm.PNG", "arm.jpg"])
def test_a_picture_has_the_size_that_was_asked_for(tmp_path: Path, name: str) -> None:
    save_picture(SCENE, CAMERA, tmp_path / name, 320, 200)
    image = QImage(str(tmp_path / name))
    assert (image.width(), image.height()) == (320, 200)


def test_a_folder_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileWriteError, match="missing"):
        save_picture(SCENE, CAMERA, tmp_path / "missing" / "arm.png", 32, 20)


@pytest.mark.parametrize(("name", "reason"), [("arm.xyz", r"“\.xyz” is no picture format"), ("arm", "no ending")])
def test_an_ending_that_is_no_picture_is_refused_with_those_that_are(tmp_path: Path, name: str, reason: str) -> None:
    with pytest.raises(FileWriteError, match=rf"{reason}.*png"):
        save_picture(SCENE, CAMERA, tmp_path / name, 32, 20)
