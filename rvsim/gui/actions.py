"""Every command of the window as a table: menu, text, shortcut, what it says, whether it is a switch."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

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
    ActionSpec("new", "&File", "New", "Begin anew with this arm", "Ctrl+N"),
    ActionSpec("open", "&File", "Open…", "Open a session: arm, poses, paths, program, notes", Key.Open),
    ActionSpec("save", "&File", "Save", "Save the session", Key.Save),
    ActionSpec("save_as", "&File", "Save as…", "Save the session under another name", "Ctrl+Shift+S"),
    ActionSpec("open_robot", "&File", "Open robot file…", "Read an arm from a .toml file", "Ctrl+Alt+F", before=True),
    ActionSpec("save_robot", "&File", "Save robot file as…", "Write this arm as a .toml file", "Ctrl+Alt+W"),
    ActionSpec("save_picture", "&File", "Save picture…", "Save the scene as a picture", "Ctrl+Shift+P", before=True),
    ActionSpec("save_csv", "&File", "Save path as CSV…", "Save the tracked path with its joints", "Ctrl+Shift+E"),
    ActionSpec("save_motion", "&File", "Save motion as CSV…", "Joints, their rates and the tool, as shown", "Ctrl+E"),
    ActionSpec("save_motion_si", "&File", "Save motion as CSV in SI…", "The same in radians and metres", "Ctrl+Alt+E"),
    ActionSpec("save_script", "&File", "Save as Python script…", "Works it out anew with NumPy alone", "Ctrl+Alt+P"),
    ActionSpec("save_animation", "&File", "Save animation…", "The motion as GIF, APNG or WebP", "Ctrl+Alt+A"),
    ActionSpec("lab_report", "&File", "Lab report…", "A report of this experiment, as HTML and PDF", "Ctrl+Alt+L"),
    ActionSpec("import_table", "&File", "Import joints or points…", "From a CSV file", "Ctrl+Alt+I", before=True),
    ActionSpec("open_program", "&File", "Open program…", "Read a program of moves", "Ctrl+Alt+O"),
    ActionSpec("save_program", "&File", "Save program as…", "Write the program of moves", "Ctrl+Alt+S"),
    ActionSpec("quit", "&File", "Quit", "Close rvsim", "Ctrl+Q", before=True),
    ActionSpec("copy_pose_text", "&Edit", "Copy pose as text", "Joints and tool pose", "Ctrl+Shift+C", before=True),
    ActionSpec("copy_pose_numpy", "&Edit", "Copy pose as NumPy", "Joints and tool, full precision", "Ctrl+Shift+N"),
    ActionSpec("copy_pose_latex", "&Edit", "Copy pose as LaTeX", "The tool's matrix", "Ctrl+Shift+K"),
    ActionSpec("notes", "&Edit", "Notes…", "Your name and notes, saved with the session", "Ctrl+Alt+N", before=True),
    ActionSpec("view_iso", "&View", "Isometric", "Look from the front corner", "Ctrl+1"),
    ActionSpec("view_top", "&View", "Top", "Look straight down", "Ctrl+2"),
    ActionSpec("view_front", "&View", "Front", "Look along −x", "Ctrl+3"),
    ActionSpec("view_side", "&View", "Side", "Look along y", "Ctrl+4"),
    ActionSpec("view_source", "&View", "As in the source: view(70, 10)", "The RV-M1 report's direction", "Ctrl+5"),
    ActionSpec("fit", "&View", "Fit", "The whole arm in view", "Ctrl+0"),
    ActionSpec("box_zoom", "&View", "Zoom to a box", "Draw a box around what you want to see", "Ctrl+B"),
    ActionSpec("orthographic", "&View", "Orthographic", "Parallel lines stay parallel", "Ctrl+6", True),
    ActionSpec("look_stick", "&View", "Stick figure", "Lines and joints only", "Ctrl+7", True, "look", True),
    ActionSpec("look_solid", "&View", "Solid", "The arm's body", "Ctrl+8", True, "look"),
    ActionSpec("look_both", "&View", "Solid and stick", "The figure inside the body", "Ctrl+9", True, "look"),
    ActionSpec("show_frames", "&View", "Frames", "Frames of base, joints and tool", "Ctrl+F", True, before=True),
    ActionSpec("show_labels", "&View", "Labels", "Names in the scene", "Ctrl+Shift+B", True),
    ActionSpec("show_floor", "&View", "Floor", "The floor with its dimensions", "Ctrl+Shift+G", True),
    ActionSpec("show_trail", "&View", "Tool trail", "What the tool has drawn", "Ctrl+Shift+T", True),
    ActionSpec("show_plots", "&View", "Curves", "The motion over time, below the scene", "Ctrl+P", True, before=True),
    ActionSpec("dark", "&View", "Dark", "Light letters on a dark ground", "Ctrl+Shift+D", True, before=True),
    ActionSpec("presentation", "&View", "Presentation size", "Larger, for a projector", "Ctrl+Shift+F", True),
    ActionSpec("radians", "&View", "Angles in radians", "Instead of degrees", "Ctrl+Shift+R", True, before=True),
    ActionSpec("metres", "&View", "Lengths in metres", "Instead of millimetres", "Ctrl+Shift+M", True),
    ActionSpec("more_decimals", "&View", "More decimals", "One more decimal everywhere", "Ctrl+."),
    ActionSpec("fewer_decimals", "&View", "Fewer decimals", "One decimal less everywhere", "Ctrl+,"),
    ActionSpec("animated", "&View", "Smooth moves", "Camera and arm glide to where they go", "Ctrl+Shift+A", True),
    ActionSpec("home", "&Robot", "Home", "The arm's home pose", "Ctrl+H"),
    ActionSpec("zero", "&Robot", "Zero", "All joint variables 0", "Ctrl+Shift+H"),
    ActionSpec("random", "&Robot", "Random pose", "Any pose within the limits", "Ctrl+R"),
    ActionSpec("plot", "&Robot", "Plot", "Draw the arm at the typed values", "Ctrl+Return"),
    ActionSpec("save_pose", "&Robot", "Save pose…", "Remember this pose under a name", "Ctrl+D"),
    ActionSpec(
        "drag_tool", "&Robot", "Drag the tool", "Arrows, squares and rings to drag the tool by", "G", True, before=True
    ),
    ActionSpec("tool_axes", "&Robot", "Drag along the tool's axes", "T in the scene; else the base's", "Shift+G", True),
    ActionSpec("live", "&Robot", "Live", "The arm follows each value at once", "Ctrl+Shift+L", True),
    ActionSpec("ignore_limits", "&Robot", "Ignore limits", "Let joints go beyond their limits", "Ctrl+I", True),
    ActionSpec("track_line", "&Path", "Track line", "Move the tool along the line", "Ctrl+L"),
    ActionSpec("track_trajectory", "&Path", "Track trajectory", "Move the tool along the trajectory", "Ctrl+T"),
    ActionSpec("run_program", "&Path", "Run program", "Do the moves of the program one after the other", "Ctrl+Alt+R"),
    ActionSpec("clear_path", "&Path", "Clear path", "Take the path out of the scene", "Ctrl+Shift+X"),
    ActionSpec("play", "&Path", "Play or pause", "Run or hold the motion", "F5", before=True),
    ActionSpec("stop", "&Path", "Stop", "Stop the motion where it is", "Esc"),
    ActionSpec("step_forward", "&Path", "Step forward", "A little later", "F7"),
    ActionSpec("step_back", "&Path", "Step back", "A little earlier", "F6"),
    ActionSpec("help", "&Help", "Help on this panel", "What the panel you are in shows, and an example", "F1"),
    ActionSpec("help_contents", "&Help", "Contents and search", "All pages of the help", "Shift+F1"),
    ActionSpec("quick_start", "&Help", "Quick start", "The first minute with rvsim", "Ctrl+Shift+F1", before=True),
    ActionSpec("tour", "&Help", "Tour", "One minute through the window", "Ctrl+F2"),
    ActionSpec("shortcuts", "&Help", "Keyboard shortcuts", "All of them", "Ctrl+/"),
    ActionSpec("about", "&Help", "About rvsim", "Version and diagnostics", "Ctrl+F1", before=True),
)

MENUS = ("&File", "&Edit", "&View", "&Robot", "&Path", "&Help")


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
