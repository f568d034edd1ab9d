"""What a link `rvsim:…` of a help page may do: a small table of verbs, and for each what it understands.

    rvsim:show/singular?robot=rv-m1&q=0,30,-60,30,0     an arm in a pose, and the page that shows it
    rvsim:source/000-P7                                 an experiment of a source
    rvsim:open/shortcuts                                a window that only tells something
    rvsim:point/track_line_button                       where a control is

Angles are degrees, lengths millimetres (for an arm without a unit: its units). Nothing else can be named: no file, no
port, no motion of an arm on a wire. What an example sets up is one undo step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import parse_qsl, unquote, urlsplit

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QDockWidget, QToolButton, QWidget

from rvsim.errors import UnknownNameError
from rvsim.gui.help.example_state import EDITS, example_experiment, one_of, without_tool
from rvsim.gui.page_stack import PageStack
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.sources_show import show_experiment
from rvsim.lab.sources.experiments import experiment_of
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

SCHEME = "rvsim"
# Buttons that only work something out or switch a drawing on; none moves an arm on a wire or writes a file.
_PRESSES = {
    "sample": "sample_workspace_button",
    "compare": "compare_run_button",
    "best way": "best_way_find",
    "solvers": "lab_run_button",
    "velocity ellipsoid": "singular_velocity",
    "force ellipsoid": "singular_force",
    "jog": "velocity_mode_jog",
    "tool to joints": "velocity_mode_tool",
    "joints to tool": "velocity_mode_joints",
}
_OPENS = ("shortcuts", "about", "tour", "all_experiments")


class Done(NamedTuple):
    """What came of a link: a sentence for the reader, and whether it is an undo step."""

    sentence: str
    undoable: bool = False


def follow(window: MainWindow, link: str) -> Done:
    """Do what a link says.

    Raises:
        RvsimError: it names something that is not in the tables, or a number that is none.
    """
    parts = urlsplit(link)
    verb, _, subject = parts.path.partition("/")
    one_of("kind of link", parts.scheme, (SCHEME,))
    one_of("verb", verb, tuple(VERBS))
    return VERBS[verb](window, unquote(subject), dict(parse_qsl(parts.query)))


# --- verbs ---------------------------------------------------------------------------------------------------------


def _show(window: MainWindow, panel: str, wishes: dict[str, str]) -> Done:
    """An arm, its pose and its tasks, and the page that shows them."""
    one_of("panel", panel, ("arm", *panel_names(window)))
    for name in wishes:
        one_of("setting", name, ("robot", *EDITS, *_DEEDS))
    changes = bool(set(wishes) & {"robot", *EDITS})
    if changes:
        _set_up(window, wishes)
    if not window.docks.show_panel(panel):
        window.docks.left.show()
    for name, deed in _DEEDS.items():
        if name in wishes:
            deed(window, wishes[name])
    return Done(tr("The window shows the example.") if changes else "", changes)


def panel_names(window: MainWindow) -> tuple[str, ...]:
    """The pages of all panels at the right."""
    stacks = [dock.widget() for dock in window.docks.right]
    return tuple(page.name for stack in stacks if isinstance(stack, PageStack) for page in stack.pages)


def _set_up(window: MainWindow, wishes: dict[str, str]) -> None:
    session = window.session
    name = one_of("robot", wishes.get("robot", session.robot.name), tuple(window.library.titles))
    robot = without_tool(window.library[name])
    wanted = example_experiment(robot, wishes)
    window.motion.pause()
    window.tracker.cancel()
    with session.one_step(tr("Show an example of the help")):
        window.document.set_aside()
        session.use_robot(robot)
        before = session.experiment
        program = wanted.program or before.program
        session.edit(tr("Set up"), replace(wanted, robot=before.robot, poses=before.poses, program=program))
    session.say(tr("An example of the help. Undo takes it back."))


def _source(window: MainWindow, key: str, _wishes: dict[str, str]) -> Done:
    experiment = experiment_of(key)
    show_experiment(window, experiment)
    item, shows = tr(experiment.item), tr(experiment.shows)
    return Done(tr("Source {source}, {item}: {shows}", source=experiment.source, item=item, shows=shows), undoable=True)


def _open(window: MainWindow, name: str, _wishes: dict[str, str]) -> Done:
    action = window.findChild(QAction, f"action_{one_of('window', name, _OPENS)}")
    if isinstance(action, QAction):
        action.trigger()
    return Done("")


def _point(window: MainWindow, name: str, _wishes: dict[str, str]) -> Done:
    """Bring a control to the front and give it the focus."""
    widget = _child(window, name)
    _bring_forward(window, widget)
    widget.setFocus(Qt.FocusReason.ShortcutFocusReason)
    return Done("")


def _child(window: MainWindow, name: str) -> QWidget:
    widget = window.findChild(QWidget, name)
    if not isinstance(widget, QWidget):
        raise UnknownNameError("control", name, ("those of the window",))
    return widget


def _bring_forward(window: MainWindow, widget: QWidget) -> None:
    for stack in window.findChildren(PageStack):
        for page in stack.pages:
            if page.widget.isAncestorOf(widget):
                window.docks.show_panel(page.name)
    parent: QWidget | None = widget
    while parent is not None and not isinstance(parent, QDockWidget):
        parent = parent.parentWidget()
    if isinstance(parent, QDockWidget):
        parent.show()
        parent.raise_()


VERBS: dict[str, Callable[[MainWindow, str, dict[str, str]], Done]] = {
    "show": _show,
    "source": _source,
    "open": _open,
    "point": _point,
}


# --- what an example does besides ------------------------------------------------------------------------------------


def _track(window: MainWindow, kind: str) -> None:
    tracks = {"line": window.tracker.track_line, "trajectory": window.tracker.track_trajectory}
    tracks[one_of("path to track", kind, tuple(tracks))]()


def _curves(window: MainWindow, names: str) -> None:
    wanted = [f"plot_{name}_button" for name in names.split(",")]
    made = {one.objectName(): one for one in window.plots.findChildren(QToolButton) if one.isCheckable()}
    for name in wanted:
        one_of("curve", name, tuple(made))
    for name, one in made.items():
        one.setChecked(name in wanted)
    window.preferences.set("show_plots", True)


def _erratum(window: MainWindow, key: str) -> None:
    window.findChild(SourcePage).choose(key)  # type: ignore[union-attr]  # every window has one


def _lab(window: MainWindow, page: str) -> None:
    pages = window.laboratory
    shown = {"solvers": pages.contest, "source 002": pages.source_002}
    pages.pages.setCurrentWidget(shown[one_of("page", page, tuple(shown))])


def _press(window: MainWindow, names: str) -> None:
    for name in names.split(","):
        made = window.findChild(QAbstractButton, _PRESSES[one_of("button", name, tuple(_PRESSES))])
        if isinstance(made, QAbstractButton) and made.isCheckable():
            made.setChecked(True)
        elif isinstance(made, QAbstractButton):
            made.click()


_DEEDS: dict[str, Callable[[MainWindow, str], None]] = {
    "track": _track,
    "curves": _curves,
    "erratum": _erratum,
    "lab": _lab,
    "press": _press,
}
