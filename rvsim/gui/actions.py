"""The menus of the window and their commands, made of the table of all commands."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from rvsim.gui.action_table import ACTIONS, MENUS, ActionSpec
from rvsim.language import language, left_to_right, tr

_NATIVE = QKeySequence.SequenceFormat.NativeText


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
    menu = window.menuBar().addMenu(tr(title))
    menu.setObjectName(title.replace("&", "").lower() + "_menu")
    menu.setToolTipsVisible(True)
    return menu


def _action(window: QMainWindow, spec: ActionSpec) -> QAction:
    action = QAction(tr(spec.text), window)
    action.setObjectName(f"action_{spec.name}")
    action.setCheckable(spec.checkable)
    action.setStatusTip(tr(spec.tip))
    action.setShortcut(QKeySequence(spec.shortcut))
    if spec.name in ("help", "about"):  # in dialogs and the help window too
        action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
    keys = action.shortcut().toString(_NATIVE)
    action.setToolTip(f"{tr(spec.tip)} ({left_to_right(keys)})" if keys else tr(spec.tip))
    if language().right_to_left and keys and not keys[-1].isalnum():  # a menu would show .+Ctrl
        action.setText(f"{action.text()}\t{left_to_right(keys)}")
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
            found.append((action.text().partition("\t")[0].replace("&", ""), action.shortcut().toString(_NATIVE)))
    return found
