"""Every command of the window as a table: menu, text, shortcut, what it says, whether it is a switch."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtGui import QKeySequence

from rvsim.language import tr_later

Key = QKeySequence.StandardKey


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


_FILE = tr_later("&File")
_EDIT = tr_later("&Edit")
_VIEW = tr_later("&View")
_ROBOT = tr_later("&Robot")
_PATH = tr_later("&Path")
_HELP = tr_later("&Help")
MENUS = (_FILE, _EDIT, _VIEW, _ROBOT, _PATH, _HELP)

ACTIONS: tuple[ActionSpec, ...] = (
    ActionSpec("new", _FILE, tr_later("New"), tr_later("Begin anew with this arm"), "Ctrl+N"),
    ActionSpec(
        "open", _FILE, tr_later("Open…"), tr_later("Open a session: arm, poses, paths, program, notes"), Key.Open
    ),
    ActionSpec("save", _FILE, tr_later("Save"), tr_later("Save the session"), Key.Save),
    ActionSpec("save_as", _FILE, tr_later("Save as…"), tr_later("Save the session under another name"), "Ctrl+Shift+S"),
    ActionSpec(
        "open_robot",
        _FILE,
        tr_later("Open robot file…"),
        tr_later("Read an arm from a .toml file"),
        "Ctrl+Alt+F",
        before=True,
    ),
    ActionSpec(
        "save_robot", _FILE, tr_later("Save robot file as…"), tr_later("Write this arm as a .toml file"), "Ctrl+Alt+W"
    ),
    ActionSpec(
        "save_picture",
        _FILE,
        tr_later("Save picture…"),
        tr_later("Save the scene as a picture"),
        "Ctrl+Shift+P",
        before=True,
    ),
    ActionSpec(
        "save_csv",
        _FILE,
        tr_later("Save path as CSV…"),
        tr_later("Save the tracked path with its joints"),
        "Ctrl+Shift+E",
    ),
    ActionSpec(
        "save_motion",
        _FILE,
        tr_later("Save motion as CSV…"),
        tr_later("Joints, their rates and the tool, as shown"),
        "Ctrl+E",
    ),
    ActionSpec(
        "save_motion_si",
        _FILE,
        tr_later("Save motion as CSV in SI…"),
        tr_later("The same in radians and metres"),
        "Ctrl+Alt+E",
    ),
    ActionSpec(
        "save_script",
        _FILE,
        tr_later("Save as Python script…"),
        tr_later("Works it out anew with NumPy alone"),
        "Ctrl+Alt+P",
    ),
    ActionSpec(
        "save_animation", _FILE, tr_later("Save animation…"), tr_later("The motion as GIF, APNG or WebP"), "Ctrl+Alt+A"
    ),
    ActionSpec(
        "lab_report",
        _FILE,
        tr_later("Lab report…"),
        tr_later("A report of this experiment, as HTML and PDF"),
        "Ctrl+Alt+L",
    ),
    ActionSpec(
        "import_table",
        _FILE,
        tr_later("Import joints or points…"),
        tr_later("From a CSV file"),
        "Ctrl+Alt+I",
        before=True,
    ),
    ActionSpec("open_program", _FILE, tr_later("Open program…"), tr_later("Read a program of moves"), "Ctrl+Alt+O"),
    ActionSpec(
        "save_program", _FILE, tr_later("Save program as…"), tr_later("Write the program of moves"), "Ctrl+Alt+S"
    ),
    ActionSpec("quit", _FILE, tr_later("Quit"), tr_later("Close rvsim"), "Ctrl+Q", before=True),
    ActionSpec(
        "copy_pose_text",
        _EDIT,
        tr_later("Copy pose as text"),
        tr_later("Joints and tool pose"),
        "Ctrl+Shift+C",
        before=True,
    ),
    ActionSpec(
        "copy_pose_numpy",
        _EDIT,
        tr_later("Copy pose as NumPy"),
        tr_later("Joints and tool, full precision"),
        "Ctrl+Shift+N",
    ),
    ActionSpec("copy_pose_latex", _EDIT, tr_later("Copy pose as LaTeX"), tr_later("The tool's matrix"), "Ctrl+Shift+K"),
    ActionSpec(
        "notes",
        _EDIT,
        tr_later("Notes…"),
        tr_later("Your name and notes, saved with the session"),
        "Ctrl+Alt+N",
        before=True,
    ),
    ActionSpec("view_iso", _VIEW, tr_later("Isometric"), tr_later("Look from the front corner"), "Ctrl+1"),
    ActionSpec("view_top", _VIEW, tr_later("Top"), tr_later("Look straight down"), "Ctrl+2"),
    ActionSpec("view_front", _VIEW, tr_later("Front"), tr_later("Look along −x"), "Ctrl+3"),
    ActionSpec("view_side", _VIEW, tr_later("Side"), tr_later("Look along y"), "Ctrl+4"),
    ActionSpec(
        "view_source",
        _VIEW,
        tr_later("As in the source: view(70, 10)"),
        tr_later("The RV-M1 report's direction"),
        "Ctrl+5",
    ),
    ActionSpec("fit", _VIEW, tr_later("Fit"), tr_later("The whole arm in view"), "Ctrl+0"),
    ActionSpec(
        "box_zoom", _VIEW, tr_later("Zoom to a box"), tr_later("Draw a box around what you want to see"), "Ctrl+B"
    ),
    ActionSpec(
        "orthographic", _VIEW, tr_later("Orthographic"), tr_later("Parallel lines stay parallel"), "Ctrl+6", True
    ),
    ActionSpec(
        "look_stick", _VIEW, tr_later("Stick figure"), tr_later("Lines and joints only"), "Ctrl+7", True, "look", True
    ),
    ActionSpec("look_solid", _VIEW, tr_later("Solid"), tr_later("The arm's body"), "Ctrl+8", True, "look"),
    ActionSpec(
        "look_both", _VIEW, tr_later("Solid and stick"), tr_later("The figure inside the body"), "Ctrl+9", True, "look"
    ),
    ActionSpec(
        "show_frames",
        _VIEW,
        tr_later("Frames"),
        tr_later("Frames of base, joints and tool"),
        "Ctrl+F",
        True,
        before=True,
    ),
    ActionSpec("show_labels", _VIEW, tr_later("Labels"), tr_later("Names in the scene"), "Ctrl+Shift+B", True),
    ActionSpec("show_floor", _VIEW, tr_later("Floor"), tr_later("The floor with its dimensions"), "Ctrl+Shift+G", True),
    ActionSpec("show_trail", _VIEW, tr_later("Tool trail"), tr_later("What the tool has drawn"), "Ctrl+Shift+T", True),
    ActionSpec(
        "show_plots",
        _VIEW,
        tr_later("Curves"),
        tr_later("The motion over time, below the scene"),
        "Ctrl+P",
        True,
        before=True,
    ),
    ActionSpec(
        "dark", _VIEW, tr_later("Dark"), tr_later("Light letters on a dark ground"), "Ctrl+Shift+D", True, before=True
    ),
    ActionSpec(
        "presentation", _VIEW, tr_later("Presentation size"), tr_later("Larger, for a projector"), "Ctrl+Shift+F", True
    ),
    ActionSpec(
        "radians",
        _VIEW,
        tr_later("Angles in radians"),
        tr_later("Instead of degrees"),
        "Ctrl+Shift+R",
        True,
        before=True,
    ),
    ActionSpec(
        "metres", _VIEW, tr_later("Lengths in metres"), tr_later("Instead of millimetres"), "Ctrl+Shift+M", True
    ),
    ActionSpec("more_decimals", _VIEW, tr_later("More decimals"), tr_later("One more decimal everywhere"), "Ctrl+."),
    ActionSpec("fewer_decimals", _VIEW, tr_later("Fewer decimals"), tr_later("One decimal less everywhere"), "Ctrl+,"),
    ActionSpec(
        "animated",
        _VIEW,
        tr_later("Smooth moves"),
        tr_later("Camera and arm glide to where they go"),
        "Ctrl+Shift+A",
        True,
    ),
    ActionSpec("home", _ROBOT, tr_later("Home"), tr_later("The arm's home pose"), "Ctrl+H"),
    ActionSpec("zero", _ROBOT, tr_later("Zero"), tr_later("All joint variables 0"), "Ctrl+Shift+H"),
    ActionSpec("random", _ROBOT, tr_later("Random pose"), tr_later("Any pose within the limits"), "Ctrl+R"),
    ActionSpec("plot", _ROBOT, tr_later("Plot"), tr_later("Draw the arm at the typed values"), "Ctrl+Return"),
    ActionSpec("save_pose", _ROBOT, tr_later("Save pose…"), tr_later("Remember this pose under a name"), "Ctrl+D"),
    ActionSpec(
        "drag_tool",
        _ROBOT,
        tr_later("Drag the tool"),
        tr_later("Arrows, squares and rings to drag the tool by"),
        "G",
        True,
        before=True,
    ),
    ActionSpec(
        "tool_axes",
        _ROBOT,
        tr_later("Drag along the tool's axes"),
        tr_later("T in the scene; else the base's"),
        "Shift+G",
        True,
    ),
    ActionSpec("live", _ROBOT, tr_later("Live"), tr_later("The arm follows each value at once"), "Ctrl+Shift+L", True),
    ActionSpec(
        "ignore_limits",
        _ROBOT,
        tr_later("Ignore limits"),
        tr_later("Let joints go beyond their limits"),
        "Ctrl+I",
        True,
    ),
    ActionSpec("track_line", _PATH, tr_later("Track line"), tr_later("Move the tool along the line"), "Ctrl+L"),
    ActionSpec(
        "track_trajectory",
        _PATH,
        tr_later("Track trajectory"),
        tr_later("Move the tool along the trajectory"),
        "Ctrl+T",
    ),
    ActionSpec(
        "run_program",
        _PATH,
        tr_later("Run program"),
        tr_later("Do the moves of the program one after the other"),
        "Ctrl+Alt+R",
    ),
    ActionSpec("clear_path", _PATH, tr_later("Clear path"), tr_later("Take the path out of the scene"), "Ctrl+Shift+X"),
    ActionSpec("play", _PATH, tr_later("Play or pause"), tr_later("Run or hold the motion"), "F5", before=True),
    ActionSpec("stop", _PATH, tr_later("Stop"), tr_later("Stop the motion where it is"), "Esc"),
    ActionSpec("step_forward", _PATH, tr_later("Step forward"), tr_later("A little later"), "F7"),
    ActionSpec("step_back", _PATH, tr_later("Step back"), tr_later("A little earlier"), "F6"),
    ActionSpec(
        "help", _HELP, tr_later("Help on this panel"), tr_later("What the panel you are in shows, and an example"), "F1"
    ),
    ActionSpec("help_contents", _HELP, tr_later("Contents and search"), tr_later("All pages of the help"), "Shift+F1"),
    ActionSpec(
        "quick_start",
        _HELP,
        tr_later("Quick start"),
        tr_later("The first minute with rvsim"),
        "Ctrl+Shift+F1",
        before=True,
    ),
    ActionSpec("tour", _HELP, tr_later("Tour"), tr_later("One minute through the window"), "Ctrl+F2"),
    ActionSpec("shortcuts", _HELP, tr_later("Keyboard shortcuts"), tr_later("All of them"), "Ctrl+/"),
    ActionSpec("about", _HELP, tr_later("About rvsim"), tr_later("Version and diagnostics"), "Ctrl+F1", before=True),
)
