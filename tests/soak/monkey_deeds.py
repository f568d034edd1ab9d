"""What the monkey can do: each deed by its name, as a person would do it."""

from __future__ import annotations

import time
from collections.abc import Callable

from monkey_sight import Deed, Playing, file_dialog, front, handle_of, name_of
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QDragEnterEvent, QDropEvent, QGuiApplication, QKeyEvent, QWindow
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QDialog, QMenu, QWidget

Button, Key, Modifier = Qt.MouseButton, Qt.Key, Qt.KeyboardModifier


class Deeds:
    """Does deeds to the window; what they were aimed at may have gone since."""

    def __init__(self, play: Playing) -> None:
        self._play = play
        self._doing: dict[str, Callable[..., object]] = {
            name.removeprefix("_do_"): getattr(self, name) for name in dir(self) if name.startswith("_do_")
        }

    def do(self, deed: Deed) -> None:
        """Do it."""
        self._doing[deed.name](*deed.values)

    def _at(self, name: str) -> QWindow | None:
        """The window that is meant, if it is still there and takes clicks."""
        ahead = front()
        if ahead is not None:
            return handle_of(ahead)
        tops = [w for w in QApplication.topLevelWidgets() if w.isVisible() and w.objectName() == name]
        return handle_of(tops[0] if tops else self._play.window)

    def _do_click(self, top: str, x: int, y: int, button: str = "LeftButton", modifier: str = "NoModifier") -> None:
        for deed in (QTest.mousePress, QTest.mouseRelease):
            window = self._at(top)
            if window is not None:
                deed(window, Button[button], Modifier[modifier], QPoint(x, y))

    def _do_double_click(self, top: str, x: int, y: int) -> None:
        window = self._at(top)
        if window is not None:
            QTest.mouseDClick(window, Button.LeftButton, Modifier.NoModifier, QPoint(x, y))

    def _do_drag(self, top: str, x: int, y: int, button: str, modifier: str, path: list[tuple[int, int]]) -> None:
        window = self._at(top)
        if window is None:
            return
        point = QPoint(x, y)
        QTest.mousePress(window, Button[button], Modifier[modifier], point)
        for right, down in path:
            point = QPoint(x + right, y + down)
            window = self._at(top)
            if window is not None:
                QTest.mouseMove(window, point)
        window = self._at(top)
        if window is not None:
            QTest.mouseRelease(window, Button[button], Modifier[modifier], point)

    def _do_wheel(self, top: str, x: int, y: int, angle: int) -> None:
        window = self._at(top)
        if window is not None:
            QTest.wheelEvent(window, QPointF(x, y), QPoint(0, angle))

    def _do_key(self, key: str, modifier: str = "NoModifier") -> None:
        """Through the main window, shortcuts and all; to another window straight: QTest crashes when that one goes."""
        code, held = Key[f"Key_{key}"], Modifier[modifier]
        kinds = {QTest.keyPress: QEvent.Type.KeyPress, QTest.keyRelease: QEvent.Type.KeyRelease}
        for deed, kind in kinds.items():
            focused, main = QApplication.focusWidget(), handle_of(self._play.window)
            elsewhere = focused is not None and focused.window() is not self._play.window
            if focused is not None and (elsewhere or QApplication.activeModalWidget() is not None):
                QApplication.sendEvent(focused, QKeyEvent(kind, code, held))
            elif main is not None:
                deed(main, code, held)

    def _do_type(self, text: str) -> None:
        for letter in text[:40]:
            for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
                focused = QApplication.focusWidget()
                if focused is not None:
                    QApplication.sendEvent(focused, QKeyEvent(kind, 0, Modifier.NoModifier, letter))

    def _do_box(self, top: str, x: int, y: int, text: str, end: str) -> None:
        self._do_click(top, x, y)
        self._do_key("A", "ControlModifier")
        self._do_type(text)
        self._do_key(end)

    def _do_paste(self, text: str, size: int) -> None:
        QGuiApplication.clipboard().setText(text * max(size // len(text), 1))
        self._do_key("V", "ControlModifier")
        QGuiApplication.clipboard().setText("")

    def _do_trigger(self, name: str) -> None:
        action = self._play.window.findChild(QAction, name)
        if action is not None and front() is None:
            action.trigger()

    def _do_page(self, name: str) -> None:
        self._play.window.docks.show_panel(name)

    def _do_robot(self, number: int) -> None:
        combo = self._play.window.joints.robots
        if front() is None and number < combo.count():
            combo.setCurrentIndex(number)
            combo.activated.emit(number)

    def _do_undo(self, forth: bool) -> None:
        stack = self._play.window.session.undo_stack
        if not forth:
            self._do_key("Z", "ControlModifier")
        elif front() is None and stack.canRedo():
            stack.redo()

    def _do_combo(self, name: str, number: int) -> None:
        for combo in (front() or self._play.window).findChildren(QComboBox):
            if name_of(combo) == name and combo.isVisible() and combo.isEnabled() and number < combo.count():
                combo.setCurrentIndex(number)
                combo.activated.emit(number)
                return

    def _do_resize(self, width: int, height: int) -> None:
        self._play.window.resize(width, height)

    def _do_dock(self, number: int, deed: str) -> None:
        window, dock = self._play.window, self._play.window.docks.all[number]
        areas = {"left": Qt.DockWidgetArea.LeftDockWidgetArea, "below": Qt.DockWidgetArea.BottomDockWidgetArea}
        areas["back"] = Qt.DockWidgetArea.RightDockWidgetArea
        if deed in areas:
            window.addDockWidget(areas[deed], dock)
            return
        deeds: dict[str, Callable[[], object]] = {
            "float": lambda: dock.setFloating(not dock.isFloating()),
            "hide": dock.hide,
            "show": dock.show,
            "raise": dock.raise_,
        }
        deeds[deed]()

    def _do_connect_arm(self, number: int) -> None:
        """Bring the wired arm, choose a virtual one, and press the button."""
        window = self._play.window
        if front() is not None:
            return
        if not window.session.robot.servos:
            window.session.use_robot(window.library["al5b"])
        window.docks.show_panel("device")
        port, button = window.findChild(QComboBox, "device_port"), window.findChild(QWidget, "device_connect_button")
        if port is not None and isinstance(button, QAbstractButton):
            port.setCurrentIndex(number % max(port.count(), 1))
            button.click()
        for name in ("device_wake_all", "device_live", "device_run"):
            found = window.findChild(QWidget, name)
            if isinstance(found, QAbstractButton) and found.isEnabled():
                found.click()

    def _do_fault(self, number: int) -> None:
        window = self._play.window
        window.docks.show_panel("virtual")
        found = [b for b in window.findChildren(QAbstractButton) if b.objectName().startswith("fault")]
        if found and front() is None:
            found[number % len(found)].click()

    def _do_wait(self, _seconds: float) -> None:
        """The next deed comes later."""

    def _do_stall(self, seconds: float) -> None:
        time.sleep(seconds)

    def _do_clock(self, seconds: float) -> None:
        self._play.world.jump_clock(seconds)

    def _do_folder(self, kind: str) -> None:
        self._play.world.use_folder(kind)

    def _do_disk(self, full: bool) -> None:
        self._play.world.fill_disk(full)

    def _do_drop(self) -> None:
        window, data = self._play.window, self._play.world.dropped()
        place, left, none = QPoint(400, 300), Button.LeftButton, Modifier.NoModifier
        enter = QDragEnterEvent(place, Qt.DropAction.CopyAction, data, left, none)
        QApplication.sendEvent(window, enter)
        if enter.isAccepted():
            QApplication.sendEvent(window, QDropEvent(QPointF(place), Qt.DropAction.CopyAction, data, left, none))

    def _do_file_dialog(self) -> None:
        dialog = file_dialog()
        if dialog is not None:
            name, _ = self._play.world.path_to_open()
            if name:
                dialog.fileSelected.emit(name)
            dialog.reject()

    def _do_answer(self, share: float) -> None:
        """Press a button of what is in front, or send it away."""
        ahead = front()
        buttons = [b for b in ahead.findChildren(QAbstractButton) if b.isEnabled() and b.isVisible()] if ahead else []
        if buttons and share < 0.6:
            buttons[int(share / 0.6 * len(buttons))].click()
        elif isinstance(ahead, QDialog):
            ahead.reject()
        elif isinstance(ahead, QMenu) and share < 0.9:
            self._do_key("Down")
            self._do_key("Return")
        elif ahead is not None:
            ahead.close()
