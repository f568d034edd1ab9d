"""Which renderer is chosen, for what reason, and what happens when OpenGL breaks later."""

from __future__ import annotations

import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.renderers.base import Renderer
from rvsim.gui.renderers.choose import (
    PLATFORMS_WITHOUT_OPENGL,
    SOFTWARE_NAMES,
    Choice,
    choose_renderer,
    is_software,
    renderer_factory,
)
from rvsim.gui.renderers.opengl_context import OpenGLProbe
from rvsim.scene import Camera, Color, Scene

CARD = OpenGLProbe(True, True, (4, 6), "NVIDIA GeForce RTX 3050/PCIe/SSE2")
LLVMPIPE = OpenGLProbe(True, True, (4, 5), "llvmpipe (LLVM 15.0.6, 256 bits)")
SCENE = Scene((), Color(0.2, 0.4, 0.6), np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]))


def asked(probe: OpenGLProbe = CARD, wanted: str = "auto", platform: str = "xcb") -> Choice:
    return choose_renderer(wanted, platform, lambda: probe)


@pytest.mark.parametrize(
    ("probe", "obstacle"),
    [
        (OpenGLProbe(), "no OpenGL context"),
        (OpenGLProbe(created=True), "cannot be used"),
        (OpenGLProbe(True, True, (1, 4), "Old Card"), "older than 2.1"),
        (OpenGLProbe(True, True, (2, 0), "Old Card"), "older than 2.1"),
        (OpenGLProbe(True, True, (4, 6), "GDI Generic"), "no graphics driver"),
        (OpenGLProbe(True, True, (3, 2), "V3D 4.2", embedded=True), "OpenGL ES"),
    ],
)
def test_where_opengl_cannot_be_used_the_painter_draws_even_against_the_wish(probe: OpenGLProbe, obstacle: str) -> None:
    calm, forced = asked(probe), asked(probe, wanted="gl")
    assert (calm.name, forced.name) == ("painter", "painter")
    assert obstacle in calm.reason
    assert obstacle in forced.reason
    assert "wished" in forced.reason
    assert "wished" not in calm.reason


@pytest.mark.parametrize("platform", sorted(PLATFORMS_WITHOUT_OPENGL))
@pytest.mark.parametrize("wanted", ["auto", "gl", "painter"])
def test_a_platform_without_opengl_is_never_asked_for_it(platform: str, wanted: str) -> None:
    def refuse() -> OpenGLProbe:
        raise AssertionError("asking may abort the program on this platform")

    assert choose_renderer(wanted, platform, refuse).name == "painter"


def test_a_wish_for_the_painter_asks_nothing() -> None:
    def refuse() -> OpenGLProbe:
        raise AssertionError("no need to ask")

    assert choose_renderer("painter", "xcb", refuse).name == "painter"


def test_a_graphics_card_draws_with_smooth_edges() -> None:
    for wanted in ("auto", "gl"):
        choice = asked(wanted=wanted)
        assert (choice.name, choice.samples) == ("gl", 4)
        assert choice.details == "OpenGL 4.6, NVIDIA GeForce RTX 3050/PCIe/SSE2"


@pytest.mark.parametrize("software", SOFTWARE_NAMES)
def test_software_opengl_draws_only_when_wished_and_then_without_multisampling(software: str) -> None:
    probe = OpenGLProbe(True, True, (4, 5), f"Mesa {software.title()} 1.0")
    assert is_software(probe)
    assert asked(probe).name == "painter"
    assert "faster" in asked(probe).reason
    assert (asked(probe, wanted="gl").name, asked(probe, wanted="gl").samples) == ("gl", 0)


def test_each_reason_is_a_sentence() -> None:
    for probe in (CARD, LLVMPIPE, OpenGLProbe()):
        for wanted in ("auto", "gl", "painter"):
            for platform in ("xcb", "offscreen"):
                reason = asked(probe, wanted, platform).reason
                assert reason[0].isupper()
                assert reason.endswith(".")


def test_who_draws_with_the_painter_never_waits_for_opengl() -> None:
    program = (
        "import sys\n"
        "from PySide6.QtWidgets import QApplication, QWidget\n"
        "app = QApplication([])\n"
        "from rvsim.gui.renderers.choose import *\n"
        "choice = choose_renderer('auto', app.platformName(), lambda: None)\n"
        "renderer_factory(choice)(QWidget())\n"
        "print(sorted(name for name in sys.modules if name.split('.')[0] in ('OpenGL', 'pyqtgraph')))\n"
    )
    plain = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    done = subprocess.run([sys.executable, "-c", program], env=plain, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


# --- OpenGL that breaks --------------------------------------------------------------------------------------------


class FakeOpenGL(QObject):
    """An OpenGL renderer that paints red until it fails."""

    failed = Signal(str)
    name, description = "opengl", "OpenGL 9.9, fake"

    def __init__(self, parent: QWidget, samples: int) -> None:
        super().__init__(parent)
        self._widget = QWidget(parent)

    def widget(self) -> QWidget:
        return self._widget

    def set_scene(self, scene: Scene) -> None: ...

    def set_camera(self, camera: Camera) -> None: ...

    def on_painted(self, report: object) -> None: ...

    def image(self) -> QImage:
        picture = QImage(8, 8, QImage.Format.Format_RGB32)
        picture.fill(QColor("red"))
        return picture


@pytest.fixture
def opengl(monkeypatch: pytest.MonkeyPatch) -> list[FakeOpenGL]:
    """The OpenGL renderers that were made, all of them fakes."""
    made: list[FakeOpenGL] = []

    def make(parent: QWidget, samples: int) -> FakeOpenGL:
        made.append(FakeOpenGL(parent, samples))
        return made[-1]

    monkeypatch.setitem(sys.modules, "rvsim.gui.renderers.opengl", SimpleNamespace(OpenGLRenderer=make))
    return made


@pytest.fixture
def window(qtbot: QtBot) -> QWidget:
    made = QWidget()
    qtbot.addWidget(made)
    return made


def started(window: QWidget) -> tuple[Renderer, list[str]]:
    """A renderer that shows the scene, and the sentences that it has said since."""
    sentences: list[str] = []
    renderer = renderer_factory(Choice("gl", "", ""), sentences.append)(window)
    renderer.widget().resize(60, 40)
    renderer.set_camera(Camera(np.zeros(3), 3.0))
    renderer.set_scene(SCENE)
    return renderer, sentences


def corner(renderer: Renderer) -> str:
    return renderer.image().pixelColor(1, 1).name()


def test_when_opengl_fails_the_painter_takes_over_with_the_same_scene(
    qtbot: QtBot, window: QWidget, opengl: list[FakeOpenGL]
) -> None:
    renderer, sentences = started(window)
    place = renderer.widget()
    assert (renderer.name, corner(renderer)) == ("opengl", "#ff0000")
    opengl[0].failed.emit("the driver is gone")
    qtbot.waitUntil(lambda: renderer.name == "painter")
    assert sentences == ["The painter draws: OpenGL failed (the driver is gone)."]
    assert renderer.widget() is place
    assert corner(renderer) == "#336699"


def test_a_picture_that_opengl_fails_to_make_is_made_by_the_painter(
    qtbot: QtBot, window: QWidget, opengl: list[FakeOpenGL]
) -> None:
    renderer, sentences = started(window)
    opengl[0].failed.emit("nothing painted")
    assert corner(renderer) == "#336699"
    qtbot.wait(1)
    assert len(sentences) == 1, "the failure is told once"


def test_opengl_whose_libraries_are_missing_leaves_the_painter(
    window: QWidget, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "rvsim.gui.renderers.opengl", None)
    renderer, sentences = started(window)
    assert renderer.name == "painter"
    assert len(sentences) == 1
    assert corner(renderer) == "#336699"
