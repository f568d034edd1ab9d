"""The checks that need a screen: Qt, what draws with it, and what only Qt can read."""

from __future__ import annotations

import io
import json
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rvsim.resources import resource
from rvsim.self_test.arithmetic import every_arm, some_pose
from rvsim.self_test.outcome import Check, SkippedError, expect, outcome_of

if TYPE_CHECKING:
    from PySide6.QtGui import QImage

    from rvsim.gui.main_window import MainWindow

_CANCEL = {"de": "Abbrechen", "ar": "إلغاء", "en": "Cancel"}  # a word of Qt's dialogs that rvsim says too


class Screen:
    """The checks of one screen, in the order in which they are made."""

    def __init__(self) -> None:
        self._window: MainWindow | None = None
        self.painted_at = 0.0  # when the window had been painted first, seconds since the epoch

    def checks(self) -> Mapping[str, Check]:
        """By name."""
        return {
            "window": self.window,
            "every panel": self.panels,
            "painter": self.painter,
            "OpenGL": self.opengl,
            "formulas and help": self.texts,
            "languages": self.languages,
            "animation": self.animation,
            "report": self.report,
        }

    def window(self) -> str:
        """As a student's first start has it, until it has been painted."""
        from rvsim.gui.app import build_window, make_application
        from rvsim.gui.preferences import Preferences

        self._application = make_application(["rvsim"])  # it lives as long as this
        self._window = window = build_window(Preferences(), robot="rv-m1")
        painted: list[float] = []
        window.scene_view.painted.connect(painted.append)
        window.show()
        _until(lambda: bool(painted))
        self.painted_at = time.time()
        _settle(0.2)
        _expect_colours(window.picture().toImage(), "the window")
        return f"{window.width()} × {window.height()} px, drawn by the {window.scene_view.renderer.name}"

    def panels(self) -> str:
        """Each one seen, after a path has been tracked, with plots: what is imported late is there too."""
        window = self._whole_window()
        window.tracker.track_line()
        _until(lambda: window.session.tracking is not None and not window.tracker.busy)
        window.motion.pause()
        window.plots.setVisible(True)
        names = _panel_names(window)
        for name in names:
            expect(window.docks.show_panel(name), f"the panel {name} cannot be shown")
            _settle(0.05)
        return f"{len(names)} panels, and the plots of a tracked line"

    def _whole_window(self) -> MainWindow:
        if self._window is None:
            raise SkippedError("there is no window")
        return self._window

    def painter(self) -> str:
        """Every arm, drawn without a window."""
        from rvsim.gui.renderers.painter import scene_image
        from rvsim.scene import Camera
        from rvsim.scene.build import compose, scene_bounds
        from rvsim.scene.palette import LIGHT

        for robot in every_arm():
            camera = Camera(np.zeros(3), 1.0).fitted(scene_bounds(robot), 480, 360)
            _expect_colours(scene_image(compose(robot, robot.home, LIGHT), camera, 480, 360), f"{robot.name} painted")
        return "every arm"

    def opengl(self) -> str:
        """A window of its own, as `--renderer gl` makes it."""
        from PySide6.QtGui import QGuiApplication

        from rvsim.gui.app import build_window
        from rvsim.gui.preferences import Preferences
        from rvsim.gui.renderers.choose import choose_renderer
        from rvsim.gui.renderers.opengl_context import probe_opengl

        choice = choose_renderer("gl", QGuiApplication.platformName(), probe_opengl)
        if choice.name != "gl":
            raise SkippedError(choice.reason)
        window = build_window(Preferences(), robot="ur5e", renderer="gl")
        with _shown(window):
            _expect_colours(window.scene_view.renderer.image(), "the scene by OpenGL")
            drawn_by = window.scene_view.renderer
            expect(drawn_by.name == "opengl", drawn_by.description)
        return choice.details

    def texts(self) -> str:
        """What only Qt can read: formulas, help pages, icons, fonts."""
        from PySide6.QtGui import QFontDatabase, QIcon, QTextDocument

        from rvsim.gui.formula import typeset

        formula = typeset(r"\theta_2 = \arctan\frac{w}{u} - \sqrt{1 - c_3^2}")
        expect(formula is not None and not formula.path.isEmpty(), "a formula cannot be typeset")
        for page in resource("help").rglob("*.md"):
            document = QTextDocument()
            document.setMarkdown(page.read_text(encoding="utf-8"))
            expect(not document.isEmpty(), f"the help page {page.name} is empty")
        for icon in resource("icons").glob("*.svg"):
            expect(not QIcon(str(icon)).pixmap(32, 32).isNull(), f"the icon {icon.name} cannot be drawn")
        for font in resource("fonts").glob("*.[ot]tf"):
            expect(QFontDatabase.addApplicationFont(str(font)) >= 0, f"the font {font.name} cannot be used")
        return "a formula typeset, every help page and icon drawn"

    def languages(self) -> str:
        """Each with rvsim's words and Qt's own: a bundle brings those from another folder."""
        from rvsim.gui.languages import wear_language
        from rvsim.language import LANGUAGES, tr

        if self._window is None:
            raise SkippedError("there is no application")
        try:
            for code, cancel in _CANCEL.items():
                wear_language(self._application, code)
                found = self._application.translate("QPlatformTheme", "Cancel")
                expect(found == tr("Cancel") == cancel, f"in {LANGUAGES[code].name} “Cancel” is “{found}”")
        finally:
            wear_language(self._application, "en")
        return ", ".join(LANGUAGES[code].name for code in _CANCEL)

    def animation(self) -> str:
        """Painted by Qt, written and read back by Pillow."""
        from PIL import Image

        from rvsim import load_robot
        from rvsim.gui.animation import FORMATS, Animation, AnimationSettings, Picturing
        from rvsim.motion import joint_move
        from rvsim.scene import Camera
        from rvsim.scene.build import SceneOptions
        from rvsim.scene.palette import LIGHT

        robot = load_robot("rv-m1")
        picturing = Picturing(robot, Camera(np.zeros(3), 2.5), LIGHT, SceneOptions())
        motion = joint_move(robot, robot.home, some_pose(robot), seconds=1.0)
        made = Animation(motion, picturing, AnimationSettings(160, 90, 5, 1.0))
        while made.step():
            pass
        for ending in FORMATS:
            file = Image.open(io.BytesIO(made.encode(ending)))
            frames = getattr(file, "n_frames", 1)
            expect(frames == made.total, f"{ending} has {frames} frames instead of {made.total}")
        return f"{made.total} frames as {', '.join(FORMATS)}"

    def report(self) -> str:
        """As a student hands it in: pages, tables, pictures, script; on one screen, for it takes seconds."""
        from PySide6.QtGui import QGuiApplication

        from rvsim import load_robot
        from rvsim.gui.report.bundle import Order, write_bundle
        from rvsim.lab import default_experiment
        from rvsim.lab.report import Cover, Study

        if QGuiApplication.platformName() != "offscreen":
            raise SkippedError("it is made off-screen")
        study = Study(default_experiment(load_robot("rv-m1")))
        with tempfile.TemporaryDirectory(prefix="rvsim-self-test-") as folder:
            for _ in write_bundle(study, Order(Path(folder) / "report", Cover("Self-test", "", "", ""))):
                pass
            files = sorted((Path(folder) / "report").iterdir())
            pages = [file.read_bytes()[:5] for file in files if file.suffix == ".pdf"]
        expect(pages == [b"%PDF-"], f"there is no PDF among {', '.join(file.name for file in files)}")
        return f"{len(files)} files, a PDF among them"

    def close(self) -> None:
        """End what runs."""
        if self._window is not None:
            self._window.close()


def _panel_names(window: MainWindow) -> list[str]:
    from rvsim.gui.page_stack import PageStack

    names: list[str] = []
    for dock in window.docks.right:
        pages = dock.widget()
        alone = [dock.objectName().removesuffix("_dock")]
        names += [page.name for page in pages.pages] if isinstance(pages, PageStack) else alone
    return names


@contextmanager
def _shown(window: MainWindow) -> Iterator[None]:
    """Until the window has been painted, and closed in the end."""
    painted: list[float] = []
    window.scene_view.painted.connect(painted.append)
    try:
        window.show()
        _until(lambda: bool(painted))
        yield
    finally:
        window.close()


def _expect_colours(image: QImage, what: str, least: int = 8) -> None:
    """More than an empty picture has."""
    small = image.scaled(64, 64)
    found = len({small.pixel(x, y) for x in range(small.width()) for y in range(small.height())})
    expect(found >= least, f"{what} shows {found} colours only")


def _settle(seconds: float) -> None:
    """Let the window live for a while."""
    over = time.monotonic() + seconds
    _until(lambda: time.monotonic() > over)


def _until(condition: Callable[[], bool], patience: float = 30.0) -> None:
    from PySide6.QtCore import QCoreApplication, QEventLoop

    end = time.monotonic() + patience
    while not condition():
        expect(time.monotonic() < end, f"nothing has happened for {patience:.0f} s")
        QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 20)
        time.sleep(0.001)


def check_screen(report: Path) -> int:
    """Make the checks of the screen that this process has, a line of JSON in the file for each; 0 if all are good."""
    screen = Screen()
    failed = False
    with report.open("a", encoding="utf-8") as file:
        for name, check in screen.checks().items():
            outcome = outcome_of(name, check)
            failed |= outcome.verdict == "FAILED"
            file.write(json.dumps(outcome) + "\n")
            file.flush()
    screen.close()
    return int(failed)


def time_start(report: Path, launched: float) -> int:
    """Write into the file how long it took [s] from `launched`, since the epoch, until the window was painted."""
    screen = Screen()
    screen.window()
    report.write_text(f"{screen.painted_at - launched:.3f}", encoding="utf-8")
    screen.close()
    return 0
