"""While a window lives, rubbish is collected in its thread alone."""

from __future__ import annotations

import gc
import threading
import weakref

from PySide6.QtCore import QCoreApplication, QObject
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget, QWidgetItem
from pytestqt.qtbot import QtBot
from shiboken6 import getAllValidWrappers

from rvsim.gui.collector import RubbishCollector


def rubbish(died_in: list[int]) -> None:
    """A Qt object that only refers to itself."""
    lost = QObject()
    lost.itself = lost  # type: ignore[attr-defined]
    weakref.finalize(lost, lambda: died_in.append(threading.get_ident()))


def make_much() -> None:
    for _ in range(3000):
        ring: list[object] = []
        ring.append(ring)


def test_a_worker_does_not_collect_what_is_the_windows(qtbot: QtBot) -> None:
    collector, died_in = RubbishCollector(), list[int]()
    try:
        rubbish(died_in)
        worker = threading.Thread(target=make_much)
        worker.start()
        worker.join()
        assert died_in == []
        collector.collect()
        assert died_in == [threading.get_ident()]
    finally:
        collector.end()


def test_it_is_given_back_when_the_last_window_closes() -> None:
    first, second = RubbishCollector(), RubbishCollector()
    first.end()
    assert not gc.isenabled()
    second.end()
    assert gc.isenabled()


def test_python_knows_nothing_of_items_that_qt_deletes_without_a_word(qtbot: QtBot) -> None:
    outside, inner = QWidget(), QVBoxLayout()
    qtbot.addWidget(outside)
    inner.addWidget(QLabel())
    QVBoxLayout(outside).addLayout(inner)
    known = [one for one in getAllValidWrappers() if type(one) is QWidgetItem]
    collector = RubbishCollector()
    QCoreApplication.processEvents()
    collector.end()
    assert known
    assert not [one for one in getAllValidWrappers() if type(one) is QWidgetItem]
