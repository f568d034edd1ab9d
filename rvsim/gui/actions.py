"""Every command of the window as a table: menu, text, shortcut, what it says, whether it is a switch."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from rvsim.language import tr_later

Key = QKeySequence.StandardKey
_NATIVE = QKeySequence.SequenceFormat.NativeText


class ActionSpec(NamedTuple):
    """One command. `group` makes the commands of the same group exclude each other; `before` a separator before it."""

    name: str
    menu: str
    text: str
    tip: str
    shortcut: str | QKeySequence.StandardKey
    checkable: bool = False
    group: str = ""
    before: bool = False


ACTIONS: tuple[ActionSpec, ...] = (
    ActionSpec("new", tr_later("&File"), tr_later("New"), tr_later("Begin anew with this arm"), "Ctrl+N"),
    ActionSpec(
        "open",
        tr_later("&File"),
        tr_later("Open…"),
        tr_later("Open a session: arm, poses, paths, program, notes"),
        Key.Open,
    ),
    ActionSpec("save", tr_later("&File"), tr_later("Save"), tr_later("Save the session"), Key.Save),
    ActionSpec(
        "save_as",
        tr_later("&File"),
        tr_later("Save as…"),
        tr_later("Save the session under another name"),
        "Ctrl+Shift+S",
    ),
    ActionSpec(
        "open_robot",
        tr_later("&File"),
        tr_later("Open robot file…"),
        tr_later("Read an arm from a .toml file"),
        "Ctrl+Alt+F",
        before=True,
    ),
    ActionSpec(
        "save_robot",
        tr_later("&File"),
        tr_later("Save robot file as…"),
        tr_later("Write this arm as a .toml file"),
        "Ctrl+Alt+W",
    ),
    ActionSpec(
        "save_picture",
        tr_later("&File"),
        tr_later("Save picture…"),
        tr_later("Save the scene as a picture"),
        "Ctrl+Shift+P",
        before=True,
    ),
    ActionSpec(
        "save_csv",
        tr_later("&File"),
        tr_later("Save path as CSV…"),
        tr_later("Save the tracked path with its joints"),
        "Ctrl+Shift+E",
    ),
    ActionSpec(
        "save_motion",
        tr_later("&File"),
        tr_later("Save motion as CSV…"),
        tr_later("Joints, their rates and the tool, as shown"),
        "Ctrl+E",
    ),
    ActionSpec(
        "save_motion_si",
        tr_later("&File"),
        tr_later("Save motion as CSV in SI…"),
        tr_later("The same in radians and metres"),
        "Ctrl+Alt+E",
    ),
    ActionSpec(
        "save_script",
        tr_later("&File"),
        tr_later("Save as Python script…"),
        tr_later("Works it out anew with NumPy alone"),
        "Ctrl+Alt+P",
    ),
    ActionSpec(
        "save_animation",
        tr_later("&File"),
        tr_later("Save animation…"),
        tr_later("The motion as GIF, APNG or WebP"),
        "Ctrl+Alt+A",
    ),
    ActionSpec(
        "lab_report",
        tr_later("&File"),
        tr_later("Lab report…"),
        tr_later("A report of this experiment, as HTML and PDF"),
        "Ctrl+Alt+L",
    ),
    ActionSpec(
        "import_table",
        tr_later("&File"),
        tr_later("Import joints or points…"),
        tr_later("From a CSV file"),
        "Ctrl+Alt+I",
        before=True,
    ),
    ActionSpec(
        "open_program", tr_later("&File"), tr_later("Open program…"), tr_later("Read a program of moves"), "Ctrl+Alt+O"
    ),
    ActionSpec(
        "save_program",
        tr_later("&File"),
        tr_later("Save program as…"),
        tr_later("Write the program of moves"),
        "Ctrl+Alt+S",
    ),
    ActionSpec("quit", tr_later("&File"), tr_later("Quit"), tr_later("Close rvsim"), "Ctrl+Q", before=True),
    ActionSpec(
        "copy_pose_text",
        tr_later("&Edit"),
        tr_later("Copy pose as text"),
        tr_later("Joints and tool pose"),
        "Ctrl+Shift+C",
        before=True,
    ),
    ActionSpec(
        "copy_pose_numpy",
        tr_later("&Edit"),
        tr_later("Copy pose as NumPy"),
        tr_later("Joints and tool, full precision"),
        "Ctrl+Shift+N",
    ),
    ActionSpec(
        "copy_pose_latex",
        tr_later("&Edit"),
        tr_later("Copy pose as LaTeX"),
        tr_later("The tool's matrix"),
        "Ctrl+Shift+K",
    ),
    ActionSpec(
        "notes",
        tr_later("&Edit"),
        tr_later("Notes…"),
        tr_later("Your name and notes, saved with the session"),
        "Ctrl+Alt+N",
        before=True,
    ),
    ActionSpec("view_iso", tr_later("&View"), tr_later("Isometric"), tr_later("Look from the front corner"), "Ctrl+1"),
    ActionSpec("view_top", tr_later("&View"), tr_later("Top"), tr_later("Look straight down"), "Ctrl+2"),
    ActionSpec("view_front", tr_later("&View"), tr_later("Front"), tr_later("Look along −x"), "Ctrl+3"),
    ActionSpec("view_side", tr_later("&View"), tr_later("Side"), tr_later("Look along y"), "Ctrl+4"),
    ActionSpec(
        "view_source",
        tr_later("&View"),
        tr_later("As in the source: view(70, 10)"),
        tr_later("The RV-M1 report's direction"),
        "Ctrl+5",
    ),
    ActionSpec("fit", tr_later("&View"), tr_later("Fit"), tr_later("The whole arm in view"), "Ctrl+0"),
    ActionSpec(
        "box_zoom",
        tr_later("&View"),
        tr_later("Zoom to a box"),
        tr_later("Draw a box around what you want to see"),
        "Ctrl+B",
    ),
    ActionSpec(
        "orthographic",
        tr_later("&View"),
        tr_later("Orthographic"),
        tr_later("Parallel lines stay parallel"),
        "Ctrl+6",
        True,
    ),
    ActionSpec(
        "look_stick",
        tr_later("&View"),
        tr_later("Stick figure"),
        tr_later("Lines and joints only"),
        "Ctrl+7",
        True,
        "look",
        True,
    ),
    ActionSpec("look_solid", tr_later("&View"), tr_later("Solid"), tr_later("The arm's body"), "Ctrl+8", True, "look"),
    ActionSpec(
        "look_both",
        tr_later("&View"),
        tr_later("Solid and stick"),
        tr_later("The figure inside the body"),
        "Ctrl+9",
        True,
        "look",
    ),
    ActionSpec(
        "show_frames",
        tr_later("&View"),
        tr_later("Frames"),
        tr_later("Frames of base, joints and tool"),
        "Ctrl+F",
        True,
        before=True,
    ),
    ActionSpec(
        "show_labels", tr_later("&View"), tr_later("Labels"), tr_later("Names in the scene"), "Ctrl+Shift+B", True
    ),
    ActionSpec(
        "show_floor",
        tr_later("&View"),
        tr_later("Floor"),
        tr_later("The floor with its dimensions"),
        "Ctrl+Shift+G",
        True,
    ),
    ActionSpec(
        "show_trail",
        tr_later("&View"),
        tr_later("Tool trail"),
        tr_later("What the tool has drawn"),
        "Ctrl+Shift+T",
        True,
    ),
    ActionSpec(
        "show_plots",
        tr_later("&View"),
        tr_later("Curves"),
        tr_later("The motion over time, below the scene"),
        "Ctrl+P",
        True,
        before=True,
    ),
    ActionSpec(
        "dark",
        tr_later("&View"),
        tr_later("Dark"),
        tr_later("Light letters on a dark ground"),
        "Ctrl+Shift+D",
        True,
        before=True,
    ),
    ActionSpec(
        "presentation",
        tr_later("&View"),
        tr_later("Presentation size"),
        tr_later("Larger, for a projector"),
        "Ctrl+Shift+F",
        True,
    ),
    ActionSpec(
        "radians",
        tr_later("&View"),
        tr_later("Angles in radians"),
        tr_later("Instead of degrees"),
        "Ctrl+Shift+R",
        True,
        before=True,
    ),
    ActionSpec(
        "metres",
        tr_later("&View"),
        tr_later("Lengths in metres"),
        tr_later("Instead of millimetres"),
        "Ctrl+Shift+M",
        True,
    ),
    ActionSpec(
        "more_decimals", tr_later("&View"), tr_later("More decimals"), tr_later("One more decimal everywhere"), "Ctrl+."
    ),
    ActionSpec(
        "fewer_decimals",
        tr_later("&View"),
        tr_later("Fewer decimals"),
        tr_later("One decimal less everywhere"),
        "Ctrl+,",
    ),
    ActionSpec(
        "animated",
        tr_later("&View"),
        tr_later("Smooth moves"),
        tr_later("Camera and arm glide to where they go"),
        "Ctrl+Shift+A",
        True,
    ),
    ActionSpec("home", tr_later("&Robot"), tr_later("Home"), tr_later("The arm's home pose"), "Ctrl+H"),
    ActionSpec("zero", tr_later("&Robot"), tr_later("Zero"), tr_later("All joint variables 0"), "Ctrl+Shift+H"),
    ActionSpec("random", tr_later("&Robot"), tr_later("Random pose"), tr_later("Any pose within the limits"), "Ctrl+R"),
    ActionSpec(
        "plot", tr_later("&Robot"), tr_later("Plot"), tr_later("Draw the arm at the typed values"), "Ctrl+Return"
    ),
    ActionSpec(
        "save_pose", tr_later("&Robot"), tr_later("Save pose…"), tr_later("Remember this pose under a name"), "Ctrl+D"
    ),
    ActionSpec(
        "drag_tool",
        tr_later("&Robot"),
        tr_later("Drag the tool"),
        tr_later("Arrows, squares and rings to drag the tool by"),
        "G",
        True,
        before=True,
    ),
    ActionSpec(
        "tool_axes",
        tr_later("&Robot"),
        tr_later("Drag along the tool's axes"),
        tr_later("T in the scene; else the base's"),
        "Shift+G",
        True,
    ),
    ActionSpec(
        "live",
        tr_later("&Robot"),
        tr_later("Live"),
        tr_later("The arm follows each value at once"),
        "Ctrl+Shift+L",
        True,
    ),
    ActionSpec(
        "ignore_limits",
        tr_later("&Robot"),
        tr_later("Ignore limits"),
        tr_later("Let joints go beyond their limits"),
        "Ctrl+I",
        True,
    ),
    ActionSpec(
        "track_line", tr_later("&Path"), tr_later("Track line"), tr_later("Move the tool along the line"), "Ctrl+L"
    ),
    ActionSpec(
        "track_trajectory",
        tr_later("&Path"),
        tr_later("Track trajectory"),
        tr_later("Move the tool along the trajectory"),
        "Ctrl+T",
    ),
    ActionSpec(
        "run_program",
        tr_later("&Path"),
        tr_later("Run program"),
        tr_later("Do the moves of the program one after the other"),
        "Ctrl+Alt+R",
    ),
    ActionSpec(
        "clear_path",
        tr_later("&Path"),
        tr_later("Clear path"),
        tr_later("Take the path out of the scene"),
        "Ctrl+Shift+X",
    ),
    ActionSpec(
        "play", tr_later("&Path"), tr_later("Play or pause"), tr_later("Run or hold the motion"), "F5", before=True
    ),
    ActionSpec("stop", tr_later("&Path"), tr_later("Stop"), tr_later("Stop the motion where it is"), "Esc"),
    ActionSpec("step_forward", tr_later("&Path"), tr_later("Step forward"), tr_later("A little later"), "F7"),
    ActionSpec("step_back", tr_later("&Path"), tr_later("Step back"), tr_later("A little earlier"), "F6"),
    ActionSpec(
        "help",
        tr_later("&Help"),
        tr_later("Help on this panel"),
        tr_later("What the panel you are in shows, and an example"),
        "F1",
    ),
    ActionSpec(
        "help_contents",
        tr_later("&Help"),
        tr_later("Contents and search"),
        tr_later("All pages of the help"),
        "Shift+F1",
    ),
    ActionSpec(
        "quick_start",
        tr_later("&Help"),
        tr_later("Quick start"),
        tr_later("The first minute with rvsim"),
        "Ctrl+Shift+F1",
        before=True,
    ),
    ActionSpec("tour", tr_later("&Help"), tr_later("Tour"), tr_later("One minute through the window"), "Ctrl+F2"),
    ActionSpec("shortcuts", tr_later("&Help"), tr_later("Keyboard shortcuts"), tr_later("All of them"), "Ctrl+/"),
    ActionSpec(
        "about", tr_later("&Help"), tr_later("About rvsim"), tr_later("Version and diagnostics"), "Ctrl+F1", before=True
    ),
)

MENUS = (
    tr_later("&File"),
    tr_later("&Edit"),
    tr_later("&View"),
    tr_later("&Robot"),
    tr_later("&Path"),
    tr_later("&Help"),
)


def make_actions(window: QMainWindow) -> dict[str, QAction]:
    """The actions of the table, in the window's menus; what they do is connected by the window."""
    menus = {title: _menu(window, title) for title in MENUS}
    groups: dict[str, QActionGroup] = {}
    actions = {}
    for spec in ACTIONS:
        action = _action(window, spec)
        if spec.group:
            groups.setdefault(spec.group, QActionGroup(window)).addAction(action)
        if spec.before:
            menus[spec.menu].addSeparator()
        menus[spec.menu].addAction(action)
        actions[spec.name] = action
    return actions


def _menu(window: QMainWindow, title: str) -> QMenu:
    menu = window.menuBar().addMenu(title)
    menu.setObjectName(title.replace("&", "").lower() + "_menu")
    menu.setToolTipsVisible(True)
    return menu


def _action(window: QMainWindow, spec: ActionSpec) -> QAction:
    action = QAction(spec.text, window)
    action.setObjectName(f"action_{spec.name}")
    action.setCheckable(spec.checkable)
    action.setStatusTip(spec.tip)
    action.setShortcut(QKeySequence(spec.shortcut))
    if spec.name == "help":  # in dialogs too
        action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
    keys = action.shortcut().toString(_NATIVE)
    action.setToolTip(f"{spec.tip} ({keys})" if keys else spec.tip)
    return action


def shortcut_table(window: QMainWindow) -> list[tuple[str, str, str]]:
    """Menu, command and keys of everything in the window's menus that has keys."""
    rows = []
    for entry in window.menuBar().actions():
        menu = entry.menu()
        if isinstance(menu, QMenu):
            rows += [(entry.text().replace("&", ""), text, keys) for text, keys in _keys_in(menu)]
    return rows


def _keys_in(menu: QMenu) -> list[tuple[str, str]]:
    found = []
    for action in menu.actions():
        inner = action.menu()
        if isinstance(inner, QMenu):
            found += _keys_in(inner)
        elif not action.shortcut().isEmpty():
            found.append((action.text().replace("&", ""), action.shortcut().toString(_NATIVE)))
    return found
