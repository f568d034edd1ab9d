"""The pinned Qt must survive a long session."""

from __future__ import annotations

import subprocess
import sys

MANY_CALLS = """
from PySide6.QtWidgets import QApplication, QLabel

application = QApplication([])
label = QLabel()
for number in range(20_000):
    label.setText(str(number))
print(label.text())
"""


def test_twenty_thousand_void_calls_do_not_abort_the_interpreter() -> None:
    """PySide6 6.12.0 loses a reference to None in each call on Python 3.11, and aborts after some 5,000."""
    outcome = subprocess.run([sys.executable, "-c", MANY_CALLS], capture_output=True, text=True, check=False)
    assert (outcome.returncode, outcome.stdout.strip()) == (0, "19999"), outcome.stderr
