"""The menu of the sources: every experiment of each, and the table of all their numbers."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMenu

from rvsim.gui.sources_dialog import sources_dialog
from rvsim.gui.sources_show import show_experiment
from rvsim.lab.sources.experiment import SourceExperiment
from rvsim.lab.sources.experiments import SOURCE_TITLES, experiments
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

KEYS = "Ctrl+Shift+O"
_NEW_GROUPS = ("000-P1", "004-4.7")  # experiments with which a menu of their own begins


def make_sources_menu(window: MainWindow) -> QMenu:
    """ "All experiments…" and a menu a source; an entry sets the window up for its experiment."""
    menu = QMenu(tr("&Sources"), window)
    menu.setObjectName("sources_menu")
    every = menu.addAction(tr("All experiments…"))
    every.setObjectName("action_all_experiments")
    every.setShortcut(KEYS)
    every.setStatusTip(tr("Every number that the sources print, what its formula gives, and what is right"))
    every.triggered.connect(lambda _checked=False: sources_dialog(window).show_source(""))
    menu.addSeparator()
    for source, title in SOURCE_TITLES.items():
        menu.addMenu(_menu_of(window, source, title))
    return menu


def _menu_of(window: MainWindow, source: str, title: str) -> QMenu:
    menu = QMenu(f"{source}  {tr(title)}", window)
    menu.setObjectName(f"source_{source}_menu")
    table = menu.addAction(tr("Its numbers…"))
    table.setObjectName(f"action_source_{source}_numbers")
    table.setStatusTip(tr("The numbers of source {source} as a table", source=source))
    table.triggered.connect(lambda _checked=False: sources_dialog(window).show_source(source))
    menu.addSeparator()
    groups = _groups(source)
    for group in groups:
        inside = menu if len(groups) == 1 else menu.addMenu(_from_to(group))
        for experiment in group:
            _add(inside, window, experiment)
    return menu


def _from_to(group: list[SourceExperiment]) -> str:
    return tr("{first} to {last}", first=tr(group[0].item), last=tr(group[-1].item))


def _groups(source: str) -> list[list[SourceExperiment]]:
    """A source's experiments in their order, few enough for a menu each."""
    groups: list[list[SourceExperiment]] = [[]]
    for experiment in experiments():
        if experiment.key in _NEW_GROUPS:
            groups.append([])
        if experiment.source == source:
            groups[-1].append(experiment)
    return [group for group in groups if group]


def _add(menu: QMenu, window: MainWindow, experiment: SourceExperiment) -> None:
    action = menu.addAction(f"{tr(experiment.item)}: {tr(experiment.title)}".replace("&", "&&"))
    action.setObjectName(f"action_experiment_{experiment.key}")
    action.setStatusTip(tr(experiment.shows))
    action.triggered.connect(partial(_show, window, experiment))


def _show(window: MainWindow, experiment: SourceExperiment, _checked: bool = False) -> None:
    show_experiment(window, experiment)
