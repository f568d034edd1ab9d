"""A slice of the soak: a monkey plays with the real window, and nothing raises, warns, or stays behind."""

from __future__ import annotations

import gc
import importlib
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from rvsim.language import LANGUAGES

SOAK = Path(__file__).parents[1] / "soak"


@pytest.mark.parametrize(("seed", "events"), [(11, 300), (12, 300)])
def test_whatever_is_done_to_the_window_it_lives_on(
    qapp: QApplication, monkeypatch: pytest.MonkeyPatch, seed: int, events: int
) -> None:
    monkeypatch.syspath_prepend(str(SOAK))
    monkey, watching, around = (importlib.import_module(f"monkey{part}") for part in ("", "_watch", "_world"))
    choices = importlib.import_module("monkey_choices")  # a change of the language would leave a window in this process
    monkeypatch.setattr(choices, "FORBIDDEN", ("action_quit", *(f"action_language_{code}" for code in LANGUAGES)))
    quits = qapp.quitOnLastWindowClosed()
    qapp.setQuitOnLastWindowClosed(False)
    with around.temporary_world(hard=False) as world, watching.Watch(slowness=False) as watch:
        life = monkey.Life(seed, events, world, watch, monkey.Journal())
        life.live()
    qapp.setQuitOnLastWindowClosed(quits)
    assert not watch.findings, "\n".join([*watch.findings, *life.journal.last])
    assert life.done == events
    assert gc.isenabled()
