"""Only the latest request counts, and nothing comes after the end."""

from __future__ import annotations

import threading

import pytest
import shiboken6

from rvsim.gui.workers import LatestWorker


@pytest.fixture
def worker(qtbot):
    made = LatestWorker()
    made.results = []
    made.done.connect(made.results.append)
    yield made
    made.close()


def test_a_job_is_done_in_another_thread_and_reported_in_this_one(qtbot, worker) -> None:
    told: list[bool] = []
    worker.done.connect(lambda _: told.append(threading.current_thread() is threading.main_thread()))
    with qtbot.waitSignal(worker.done):
        worker.ask(lambda: threading.current_thread() is threading.main_thread())
    assert worker.results == [False]
    assert told == [True]


def test_of_many_requests_the_last_one_counts(qtbot, worker) -> None:
    gate, done = threading.Event(), []
    worker.ask(gate.wait)
    for number in range(100):
        worker.ask(lambda number=number: done.append(number) or number)
    with qtbot.waitSignal(worker.done):
        gate.set()
    assert worker.results == [99]
    assert done == [99]


def test_what_is_cancelled_reports_nothing(qtbot, worker) -> None:
    gate = threading.Event()
    worker.ask(gate.wait)
    worker.cancel()
    gate.set()
    with qtbot.waitSignal(worker.done):
        worker.ask(lambda: "next")
    assert worker.results == ["next"]


def test_it_ends_when_it_is_closed(worker) -> None:
    worker.ask(lambda: None)
    worker.close()
    assert not any(thread.name == "rvsim-worker" for thread in threading.enumerate())
    worker.close()


def test_its_thread_ends_when_it_goes_without_being_closed(qtbot) -> None:
    made, gate = LatestWorker(), threading.Event()
    with qtbot.waitSignal(made.done):
        made.ask(lambda: None)
    made.ask(gate.wait)
    thread = made._thread
    shiboken6.delete(made)
    gate.set()
    thread.join(10.0)
    assert not thread.is_alive()


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_job_that_fails_is_reported_as_an_error_and_the_next_one_is_done(qtbot, worker, monkeypatch) -> None:
    errors = []
    monkeypatch.setattr(threading, "excepthook", lambda arguments: errors.append(arguments.exc_type))
    worker.ask(lambda: 1 / 0)
    qtbot.waitUntil(lambda: not worker.busy)
    with qtbot.waitSignal(worker.done):
        worker.ask(lambda: "next")
    assert errors == [ZeroDivisionError]
    assert worker.results == ["next"]
