"""Assembles the window: panels in docks, scene in the middle, time below it. It decides nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QByteArray, QElapsedTimer, QEvent, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QGuiApplication, QMouseEvent, QPixmap, QShowEvent, QStatusTipEvent
from PySide6.QtWidgets import QApplication, QLabel, QMainWindow, QMenu, QPushButton, QSplitter, QToolBar, QWidget

from rvsim.experiment import Experiment
from rvsim.files import find_user_folder
from rvsim.gui.actions import make_actions
from rvsim.gui.collector import RubbishCollector
from rvsim.gui.commands import Commands
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.device_scene import DeviceScene
from rvsim.gui.device_words import phase_level, phase_words
from rvsim.gui.document import Document
from rvsim.gui.emergency_stop import EmergencyStop
from rvsim.gui.gizmo_drag import GizmoDrag
from rvsim.gui.help.attention import Attention
from rvsim.gui.languages import language_menu
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.page_stack import Page, PageStack
from rvsim.gui.panel_docks import PanelDocks, lies_behind
from rvsim.gui.panels.device_pages import device_pages
from rvsim.gui.panels.dh_table import DHTablePanel
from rvsim.gui.panels.how import HowPanel
from rvsim.gui.panels.inspect import inspector
from rvsim.gui.panels.inverse import InversePanel
from rvsim.gui.panels.joints import JointsPanel
from rvsim.gui.panels.laboratory import LaboratoryPanel
from rvsim.gui.panels.laboratory_scene import LaboratoryScene
from rvsim.gui.panels.matrices import MatricesPanel
from rvsim.gui.panels.path import PathPanel
from rvsim.gui.panels.path_pages import path_pages
from rvsim.gui.panels.points import PointsPanel
from rvsim.gui.panels.tool import ToolPanel
from rvsim.gui.player_bar import PlayerBar
from rvsim.gui.plots.panel import PlotsPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.renderers.choose import Choice, renderer_factory
from rvsim.gui.robot_library import RobotLibrary
from rvsim.gui.scene_view import SceneView
from rvsim.gui.served_arm import ServedArm
from rvsim.gui.session import Session
from rvsim.gui.sources_menu import make_sources_menu
from rvsim.gui.stage import Stage
from rvsim.gui.target import TargetControl
from rvsim.gui.target_scene import TargetScene
from rvsim.gui.theme import set_role, text_scale, wear_theme
from rvsim.gui.tool_card import ToolCard
from rvsim.gui.tracker import PathTracker
from rvsim.gui.undo_words import UndoWords
from rvsim.gui.widgets import ElidedLabel, clear_scenes, column_of
from rvsim.language import again, language, tr, tr_later

if TYPE_CHECKING:
    from rvsim.device.driver.state import DriverState

_TOOLBAR = ("home", "|", "undo", "redo", "|", "view_iso", "view_top", "view_front", "view_side", "fit",
            "|", "look_stick", "look_solid", "look_both", "show_frames", "|",
            "show_plots", "dark")  # fmt: skip
_TOOLBAR_TEXTS = {
    "home": tr_later("⌂ Home"), "undo": tr_later("↶ Undo"), "redo": tr_later("↷ Redo"), "view_iso": tr_later("Iso"),
    "look_stick": tr_later("Stick"), "look_both": tr_later("Both"), "dark": "◐",
}  # fmt: skip
_TELL_MS = 250
_STATE_VERSION = 3
_MOST_WIDGETS = 1000  # that Tab may pass over
_LEFT_WIDTH, _RIGHT_WIDTH = 284, 372
_NARROWEST_RIGHT = 350  # [pixels] with all tabs readable at the usual size
_SEPARATOR = 6  # [pixels] as in the style sheet
_SCENE_SHARE = 0.4  # of the width, at least, unless the panels cannot do with the rest


class MainWindow(QMainWindow):
    """The window of rvsim, objectName `main_window`."""

    def __init__(self, session: Session, preferences: Preferences, library: RobotLibrary, choice: Choice) -> None:
        super().__init__()
        self.setObjectName("main_window")
        self.session, self.preferences, self.library, self.choice = session, preferences, library, choice
        self.collector = RubbishCollector(self)  # before any worker
        self.motion = MotionControl(session, preferences, self)
        self.tracker = PathTracker(session, self.motion, self)
        self.device = DeviceControl(session, self.motion, preferences, self)
        self.served = ServedArm(session, self)
        self.emergency_stop = EmergencyStop(self.device, self.motion, self)
        self.scene_view = SceneView(renderer_factory(choice, session.warn))
        self.target = TargetControl(session, preferences, self)  # before the stage: its ghosts are in the same picture
        self.stage = Stage(session, self.motion, preferences, self.scene_view, self)
        self.device_scene = DeviceScene(session, self.stage, self.device, self.served, self)
        self.target_scene = TargetScene(self.target, self.stage, preferences)
        self.gizmo = GizmoDrag(self.target, self.scene_view, self.stage, preferences)
        self.tool_card = ToolCard(session, preferences, self.scene_view)
        self.player_bar = PlayerBar(self.motion, preferences)
        self.joints = JointsPanel(session, preferences)
        self.actions_by_name = make_actions(self)
        self._add_undo_actions()
        self.commands = Commands(self)
        self._make_center()
        self._make_docks()
        self.attention = Attention(self)
        self._make_toolbar()
        self._make_status_bar(choice)
        self._connect()
        self.document = Document(self)
        self._add_recent_menu()
        self._show_robot()
        self.resize(1366, 768)
        self._dragged = self._sized = False
        self._restore_layout()

    # --- assembly --------------------------------------------------------------------------------------------------

    def _make_center(self) -> None:
        self.plots = PlotsPanel(self.session, self.motion, self.preferences)
        self.plots.setVisible(self.preferences["show_plots"])
        parts = QSplitter(Qt.Orientation.Vertical)
        parts.setObjectName("center_splitter")
        parts.setChildrenCollapsible(False)
        parts.addWidget(self.scene_view)
        parts.addWidget(self.plots)
        parts.setStretchFactor(0, 3)
        parts.setStretchFactor(1, 2)
        center = QWidget()
        column_of(center, parts, self.player_bar)
        self.setCentralWidget(center)

    def _make_docks(self) -> None:
        self.docks = PanelDocks(self, ("arm", tr("Arm"), self.joints), self._right_panels())
        menu = self.findChild(QMenu, "view_menu")
        assert menu is not None
        menu.addSeparator()
        menu.addMenu(self.docks.make_menu())
        menu.addMenu(language_menu(self, self.preferences))
        help_menu = self.findChild(QMenu, "help_menu")
        assert help_menu is not None
        self.menuBar().insertMenu(help_menu.menuAction(), make_sources_menu(self))

    def _right_panels(self) -> list[tuple[str, str, QWidget]]:
        arguments = (self.session, self.preferences)
        beside = path_pages(*arguments, self.stage, self.tracker, self.motion)
        tip = tr("Lines and trajectories, and what came of tracking them")
        path = (Page("path", tr("Track"), tip, PathPanel(*arguments, self.tracker, self.stage)), *beside)
        inverse = (
            Page("inverse", tr("Solve"), tr("Every branch for a wanted pose, and why not"), self._make_inverse()),
            Page(
                "how", tr("How"), tr("The closed form, step by step with this target's numbers"), HowPanel(*arguments)
            ),
            Page("lab", tr("Lab"), tr("Numeric solvers side by side"), self._make_laboratory()),
        )
        model = (
            Page("tool", tr("Tool"), tr("Where the tool is, in every notation"), ToolPanel(*arguments)),
            Page("matrices", tr("Matrices"), tr("Every A and the product up to it"), MatricesPanel(*arguments)),
            Page("points", tr("Points"), tr("The characteristic points of the stick figure"), PointsPanel(*arguments)),
            Page(
                "dh", tr("DH table"), tr("The Denavit–Hartenberg table, to be changed live"), DHTablePanel(*arguments)
            ),
        )
        return [
            ("path", tr("Path"), PageStack("path_pages", path)),
            ("inverse", tr("Inverse"), PageStack("inverse_pages", inverse)),
            ("inspect", tr("Inspect"), inspector(*arguments, self.stage)),
            ("model", tr("Model"), PageStack("model_pages", model)),
            (
                "device",
                tr("Device"),
                PageStack("device_pages", device_pages(*arguments, self.stage, self.device, self.served)),
            ),
        ]

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Tab passes over the panels that lie behind others: Qt calls them visible, but nobody sees them."""
        for _ in range(_MOST_WIDGETS):
            if not super().focusNextPrevChild(forward):
                return False
            focused = QApplication.focusWidget()
            if focused is None or not lies_behind(focused):
                return True
        return True

    def _make_inverse(self) -> InversePanel:
        """The panel that brings the gizmo along."""
        panel = InversePanel(self.target, self.preferences)
        panel.shown.connect(self.gizmo.switch)
        return panel

    def _make_laboratory(self) -> LaboratoryPanel:
        """The panel that shows its iterates in the scene, while it can be seen."""
        self.laboratory = LaboratoryPanel(self.session, self.preferences)
        self.laboratory_scene = LaboratoryScene(self.laboratory, self.session, self.stage, self.preferences)
        return self.laboratory

    def _make_toolbar(self) -> None:
        bar = QToolBar(tr("Toolbar"), self)
        bar.setObjectName("toolbar")
        bar.setMovable(False)
        bar.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        for name in _TOOLBAR:
            if name == "|":
                bar.addSeparator()
                continue
            action = self.actions_by_name[name]
            action.setIconText(tr(_TOOLBAR_TEXTS[name]) if name in _TOOLBAR_TEXTS else action.text())
            bar.addAction(action)
        self.addToolBar(bar)
        self.addToolBar(self.emergency_stop.toolbar())

    def _add_undo_actions(self) -> None:
        stack = self.session.undo_stack
        edit = self.findChild(QMenu, "edit_menu")
        assert edit is not None
        first = edit.actions()[0]
        for name, action, keys in (
            ("undo", stack.createUndoAction(self, tr("Undo")), "Ctrl+Z"),
            ("redo", stack.createRedoAction(self, tr("Redo")), "Ctrl+Shift+Z"),
        ):
            action.setObjectName(f"action_{name}")
            action.setShortcut(keys)
            edit.insertAction(first, action)
            self.actions_by_name[name] = action
        UndoWords(self.actions_by_name["undo"], self.actions_by_name["redo"], stack, self)
        self.actions_by_name["undo"].triggered.connect(
            lambda: self.session.say(tr("Undone: {step}.", step=stack.redoText()))
        )
        self.actions_by_name["redo"].triggered.connect(
            lambda: self.session.say(tr("Done again: {step}.", step=stack.undoText()))
        )

    def _add_recent_menu(self) -> None:
        files = self.findChild(QMenu, "file_menu")
        assert files is not None
        menu = self.document.recent.menu(self, self.document.ask_and_open)
        files.insertMenu(self.actions_by_name["save"], menu)

    def _make_status_bar(self, choice: Choice) -> None:
        self.message = ElidedLabel()
        self.message.setObjectName("status_message")
        self.message.setAccessibleName(tr("Message"))
        self._said = "", ""
        self._told_time = QElapsedTimer()
        self.renderer_label = QLabel(choice.name)
        self.renderer_label.setObjectName("renderer_label")
        self.renderer_label.setToolTip(again(choice.reason))
        set_role(self.renderer_label, role="muted")
        self.statusBar().addWidget(self.message, 1)
        self.device_label = QLabel()
        self.device_label.setObjectName("device_state_label")
        self.device_label.hide()
        self.statusBar().addPermanentWidget(self.device_label)
        self.statusBar().addPermanentWidget(self.renderer_label)
        self.statusBar().setSizeGripEnabled(False)

    def _connect(self) -> None:
        self.session.said.connect(self._say)
        self.session.changed.connect(self._on_changed)
        self.joints.robot_wanted.connect(lambda name: self.session.use_robot(self.library[name]))
        self.preferences.changed.connect(self._on_preference)
        self.scene_view.painted.connect(self._show_frame_time)
        self.device.state_changed.connect(self._show_device)
        self.device.limits_changed.connect(self.tracker.track_again)
        self.device.left.connect(self.library.remember)
        self.commands.connect_all()

    # --- what is shown ---------------------------------------------------------------------------------------------

    def _say(self, text: str, level: str) -> None:
        self._said = text, level
        self.message.setText(text)
        set_role(self.message, level=level)

    def event(self, event: QEvent) -> bool:
        """Show what a command does in the place of the message, and the message again afterwards.

        The status bar's own way would write it over the message. A press between docks begins to drag them.
        """
        if event.type() == QEvent.Type.MouseButtonPress and isinstance(event, QMouseEvent):
            self._dragged |= self.isSeparator(event.position().toPoint())
        if event.type() == QEvent.Type.DeferredDelete:
            self.session.end()
            clear_scenes(self)
        if not isinstance(event, QStatusTipEvent):
            return super().event(event)
        text, level = (event.tip(), "") if event.tip() else self._said
        self.message.setText(text)
        set_role(self.message, level=level)
        return True

    def _show_frame_time(self, milliseconds: float) -> None:
        # Nobody reads a number that changes with every frame, and each change lays the status line out anew.
        if self._told_time.isValid() and self._told_time.elapsed() < _TELL_MS:
            return
        self._told_time.start()
        renderer, spent = tr(self.scene_view.renderer.description), f"{milliseconds:.1f}"
        self.renderer_label.setText(tr("{renderer}, {milliseconds} ms", renderer=renderer, milliseconds=spent))

    def _show_device(self, state: DriverState | None) -> None:
        words = f"● {phase_words(state, self.device.title)}"
        self.device_label.setVisible(state is not None)
        if words != self.device_label.text():
            self.device_label.setText(words)
            set_role(self.device_label, level=phase_level(state.phase if state else ""))

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            self._show_robot()

    def _show_robot(self) -> None:
        robot, titles = self.session.robot, self.library.titles
        self.library.remember(robot)
        if self.library.titles != titles or self.joints.robots.count() == 0:
            self.joints.show_robots(self.library.titles, robot.name)
        self.preferences.set("robot", robot.name)

    def _on_preference(self, name: str) -> None:
        if name in ("theme", "presentation"):
            wear_theme(self.preferences)
            self.dress_narrowest()
        if name == "show_plots":
            self.plots.setVisible(self.preferences["show_plots"])
            self.plots.give_room()
        if name == "presentation":
            QTimer.singleShot(0, self, self._size_docks)

    def _size_docks(self) -> None:
        """Room for the panels' texts, as large as they are."""
        scale = text_scale(self.preferences["presentation"])
        left, right = round(scale * _LEFT_WIDTH), round(scale * _RIGHT_WIDTH)
        room = round((1.0 - _SCENE_SHARE) * self.width()) - 2 * _SEPARATOR
        left = min(left, max(room - right, self.joints.minimumSizeHint().width()))  # the joints need the least
        right = min(right, max(room - left, _NARROWEST_RIGHT))
        self._dragged = False
        self._widen_docks((left, right))

    def _widen_docks(self, widths: tuple[int, int]) -> None:
        self.resizeDocks([self.docks.left, self.docks.right[0]], list(widths), Qt.Orientation.Horizontal)

    def say_welcome(self) -> None:
        """The first minute: what to do now."""
        self.session.say(tr("Drag a slider, or press Track line."))
        for problem in (find_user_folder().problem, *self.library.problems):
            self.session.warn(problem)

    # --- layout ----------------------------------------------------------------------------------------------------

    def _restore_layout(self) -> None:
        kept, key = self.preferences.window_state, _layout_key()
        self.lay_out(kept("geometry"), kept(key), _widths_in(kept(f"{key}_widths")))

    def lay_out(self, geometry: QByteArray, layout: QByteArray, widths: tuple[int, ...]) -> None:
        """Take the geometry, the dock layout and `dragged_widths` of another window; what is empty is left as it is."""
        if not geometry.isEmpty():
            self.restoreGeometry(geometry)
        if not layout.isEmpty():
            self.restoreState(layout, _STATE_VERSION)
        self._first_widths = widths

    @property
    def dragged_widths(self) -> tuple[int, ...]:
        """Of the docks at the left and at the right, if somebody has dragged them; else a window needs its own."""
        return (self.docks.left.width(), self.docks.front.width()) if self._dragged else ()

    def dress_narrowest(self) -> None:
        """Dress the buttons at the left before they are shown: undressed ones are wider, and would widen the window."""
        for button in self.joints.findChildren(QPushButton):
            button.ensurePolished()
            button.updateGeometry()
        self.joints.arrange()
        layout = self.joints.layout()
        assert layout is not None
        layout.activate()
        self.joints.updateGeometry()

    def showEvent(self, event: QShowEvent) -> None:
        """Give the docks their first widths: Qt heeds them only once the window has its size."""
        super().showEvent(event)
        if not self._sized:
            self._sized = True
            QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)  # or the next one takes the widths back
            self._size_docks()
            if self._first_widths:
                left, right = self._first_widths
                self._widen_docks((left, right))
                self._dragged = True
            QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)

    def window_layout(self) -> tuple[QByteArray, QByteArray]:
        """Geometry and dock layout, as they are now."""
        return self.saveGeometry(), self.saveState(_STATE_VERSION)

    def picture(self) -> QPixmap:
        """The window as it looks now, with the scene in it whichever renderer draws it."""
        # OpenGL items that paint texts are missing in a widget's own grab; what is on the screen is whole.
        on_screen = QGuiApplication.platformName() == "xcb"
        return self.screen().grabWindow(self.winId()) if on_screen else self.grab()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember the layout; stop what moves. Where work would be lost, ask first."""
        self.motion.pause()
        if self.device.moves:  # before any question is asked
            self.device.stop(tr("The window was to be closed."))
        if not self.document.may_close():
            event.ignore()
            return
        geometry, layout = self.window_layout()
        self.preferences.keep_window_state("geometry", geometry)
        self.preferences.keep_window_state(_layout_key(), layout)
        widths = " ".join(map(str, self.dragged_widths))
        self.preferences.keep_window_state(f"{_layout_key()}_widths", QByteArray(widths.encode()))
        self.end()
        super().closeEvent(event)

    def end(self) -> None:
        """Let go of the arm, and end all threads."""
        self.device.close()
        self.served.end()
        self.tracker.close()
        self.target.close()
        self.docks.close_workers()
        self.collector.end()

    def rest(self) -> None:
        """End for good: hide with all floating docks and dialogs, while they are whole.

        A window that is still shown hides itself in the middle of being destroyed, and its parts answer to that when
        the Python side of what they ask is gone.
        """
        self.end()
        for widget in (*self.findChildren(QWidget), self):
            if widget.isWindow():
                widget.hide()


def _layout_key() -> str:
    """Under which the docks are remembered: from right to left they lie the other way round."""
    return "mirrored_layout" if language().right_to_left else "layout"


def _widths_in(kept: QByteArray) -> tuple[int, ...]:
    """Two widths, or none where nothing was kept or something else."""
    words = bytes(kept.data()).split()
    return tuple(map(int, words)) if len(words) == 2 and all(map(bytes.isdigit, words)) else ()
