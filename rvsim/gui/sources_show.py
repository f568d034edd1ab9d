"""Sets the window up so that an experiment of a source can be seen."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QToolButton

from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.lab.sources.experiment import Move, Setup, SourceExperiment
from rvsim.language import tr
from rvsim.motion.trajectory import joint_move
from rvsim.robot import Robot
from rvsim.robot.robot import NO_TOOL

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_CURVES = ("plot_q_button", "plot_qd_button", "plot_qdd_button")


def show_experiment(window: MainWindow, experiment: SourceExperiment) -> None:
    """Take its arm, its pose and its tasks as one undo step, bring its panel to the front, and let it run."""
    window.motion.pause()
    window.tracker.cancel()
    _set_up(window, experiment)
    setup = experiment.setup
    item, shows = tr(experiment.item), tr(experiment.shows)
    window.session.say(tr("Source {source}, {item}: {shows}", source=experiment.source, item=item, shows=shows))
    _prepare_pages(window, setup)
    window.docks.show_panel(setup.panel)
    _run(window, setup, tr("Source {source}, {item}", source=experiment.source, item=item))


def _set_up(window: MainWindow, experiment: SourceExperiment) -> None:
    session = window.session
    with session.one_step(tr("Show source {source}, {item}", source=experiment.source, item=tr(experiment.item))):
        window.document.set_aside()
        session.use_robot(_bare(window.library[experiment.robot]))
        session.edit(tr("Set up"), experiment.setup.applied(session.experiment))


def _bare(robot: Robot) -> Robot:
    """The arm without a tool, as the sources have it."""
    return robot if robot.tool_name == NO_TOOL.name else replace(robot, tool_name=NO_TOOL.name)


def _prepare_pages(window: MainWindow, setup: Setup) -> None:
    source = window.findChild(SourcePage)
    if setup.erratum and source is not None:
        source.choose(setup.erratum)
    if setup.lab:
        pages = window.laboratory
        pages.pages.setCurrentWidget(pages.source_002 if setup.lab == "source 002" else pages.contest)


def _run(window: MainWindow, setup: Setup, text: str) -> None:
    tracks = {"line": window.tracker.track_line, "trajectory": window.tracker.track_trajectory}
    if setup.track:
        tracks[setup.track]()
    if setup.move is not None:
        _play(window, setup.move, text)


def _play(window: MainWindow, move: Move, text: str) -> None:
    """A motion without a path: what its law is like is in the curves."""
    session = window.session
    window.tracker.clear()
    for made in window.plots.findChildren(QToolButton):
        if made.isCheckable():
            made.setChecked(made.objectName() in _CURVES)
    window.preferences.set("show_plots", True)
    window.motion.load(joint_move(session.robot, session.q, move.end, seconds=move.seconds, law=move.law), text)
    window.motion.play()
