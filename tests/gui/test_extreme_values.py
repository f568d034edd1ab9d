"""Every box of a page takes or refuses whatever is typed or pasted into it, at once and without a fault.

A few of the pages and texts that `tests/soak/soak_boxes.py` goes through.
"""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

SOAK = Path(__file__).parents[1] / "soak"
TEXTS = ("nan", "1e308", "", "1,5", "٣٫٥")


@pytest.mark.parametrize(("page", "huge"), [("arm", ()), ("inverse", ("١٢٣",))])
def test_no_text_upsets_a_box(
    qapp: QApplication, monkeypatch: pytest.MonkeyPatch, page: str, huge: tuple[str, ...]
) -> None:
    monkeypatch.syspath_prepend(str(SOAK))
    filling, watching, around = (
        importlib.import_module(name) for name in ("soak_boxes", "monkey_watch", "monkey_world")
    )
    quits = qapp.quitOnLastWindowClosed()
    qapp.setQuitOnLastWindowClosed(False)
    with around.temporary_world(hard=False), watching.Watch(slowness=False) as watch:
        boxes = filling.Boxes("rv-m1", watch)
        boxes.fill_page(page, TEXTS, huge)
        boxes.window.close()
        boxes.window.deleteLater()
    qapp.setQuitOnLastWindowClosed(quits)
    assert not watch.findings, "\n".join(watch.findings)
    assert boxes.filled > 40
