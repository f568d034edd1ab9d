"""From the window to the report: what is reported on, and the dialog that asks how."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from PySide6.QtCore import Qt

from rvsim.gui.document_state import state_of
from rvsim.gui.quantities import shown_units
from rvsim.gui.report.dialog import ReportDialog
from rvsim.lab.report import Study
from rvsim.language import tr
from rvsim.playback.recording import Recording

if TYPE_CHECKING:
    from rvsim.device.driver.state import MeasuredKind
    from rvsim.gui.main_window import MainWindow


def ask_report(window: MainWindow) -> ReportDialog:
    """Open the dialog about the experiment as it is now."""
    dialog = ReportDialog(window, window.session, window.preferences, study_of(window), state_of(window))
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.show()
    return dialog


def study_of(window: MainWindow) -> Study:
    """The present experiment, its path and motion, and what an arm made of it."""
    session = window.session
    recording = _recording(window)
    return Study(
        session.experiment,
        session.tracking,
        window.motion.player.trajectory,
        recording,
        _measured(recording),
        window.device.table,
        shown_units(window.preferences),
        "" if recording is None else window.device.run_words,
    )


def _recording(window: MainWindow) -> Recording | None:
    recording = window.device.recording
    if recording is None:
        return None
    fits = not recording.empty and recording.desired.shape[1] == window.session.robot.dof
    return recording if fits else None


def _measured(recording: Recording | None) -> str:
    if recording is None:
        return ""
    from rvsim.device.driver.state import MEASURED_WORDS

    return tr(MEASURED_WORDS[cast("MeasuredKind", recording.kind)])
