"""Plots are saved as sharp pictures and as drawings, and copied."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication, QImage
from pytestqt.qtbot import QtBot

from rvsim.errors import FileWriteError
from rvsim.gui.plots.catalogue import Drawing, Line
from rvsim.gui.plots.saving import plot_image, plot_menu, save_plot
from rvsim.gui.plots.time_plot import TimePlot
from rvsim.gui.preferences import Preferences


@pytest.fixture
def plot(qtbot: QtBot) -> TimePlot:
    made = TimePlot(Preferences())
    qtbot.addWidget(made)
    made.resize(400, 200)
    made.show()
    times = np.linspace(0.0, 2.0, 50)
    line = Line("J1", "#e69f00", np.sin(3.0 * times))
    made.show_drawing(Drawing("Joint angles", "°", (line,)), times, ())
    return made


def test_a_png_has_twice_the_pixels_and_the_curve_in_it(plot: TimePlot, tmp_path: Path) -> None:
    save_plot(plot, tmp_path / "p.png")
    image = QImage(str(tmp_path / "p.png"))
    assert (image.width(), image.height()) == (800, 400)
    colors = {image.pixelColor(x, y).hue() // 10 for x in range(120, 790, 3) for y in range(40, 360, 3)}
    assert 3 in colors or 4 in colors


def test_an_svg_is_made_of_lines_and_letters(plot: TimePlot, tmp_path: Path) -> None:
    save_plot(plot, tmp_path / "p.svg")
    tree = ElementTree.parse(tmp_path / "p.svg")
    tags = {element.tag.rpartition("}")[2] for element in tree.iter()}
    assert {"polyline", "text"} <= tags or {"path", "text"} <= tags
    assert "image" not in tags


def test_another_ending_or_folder_is_refused(plot: TimePlot, tmp_path: Path) -> None:
    for name in ("p.bmp", "none/p.png"):
        with pytest.raises(FileWriteError):
            save_plot(plot, tmp_path / name)


def test_the_menu_copies_the_plot(plot: TimePlot) -> None:
    actions = {action.objectName(): action for action in plot_menu(plot).actions()}
    assert set(actions) == {"plot_save", "plot_copy"}
    actions["plot_copy"].trigger()
    assert QGuiApplication.clipboard().image().width() == 800


def test_several_curves_get_a_line_with_their_names(plot: TimePlot, tmp_path: Path) -> None:
    times = np.linspace(0.0, 2.0, 50)
    lines = tuple(Line(name, "#0072b2", times) for name in ("waist", "elbow"))
    plot.show_drawing(Drawing("Joint angles", "°", lines), times, ())
    save_plot(plot, tmp_path / "p.svg")
    text = (tmp_path / "p.svg").read_text(encoding="utf-8")
    assert ">waist<" in text
    assert ">elbow<" in text
    assert plot_image(plot).height() > 400
