"""What the calibration has found: new numbers above old ones, what is odd about them, and what to do with them."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Signal
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QVBoxLayout, QWidget

from rvsim.device.calibrate import Result
from rvsim.gui.panels.device_calibrate_flow import part_title, result_rows
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

_HEADS = ("±", "µs/°", tr_later("zero µs"), tr_later("range µs"))
_TAKEN = tr_later(
    "Taken: the window and the arm use it from now on, and undo takes it back. Save the arm as a robot file to keep "
    "it for the next time."
)
_FOUND = tr_later("Found so far")


class ResultsSection(QWidget):
    """Signals: take_wanted(), save_wanted()."""

    take_wanted = Signal()
    save_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.head, self.table = wrapped_label("title"), wrapped_label()
        self.head.setText(tr(_FOUND))
        self.table.setObjectName("calibrate_results")
        self.remarks, self.taken = wrapped_label(), wrapped_label()
        self.remarks.setObjectName("calibrate_remarks")
        self.taken.setObjectName("calibrate_taken")
        self.taken.setText(tr(_TAKEN))
        set_role(self.remarks, level="warning")
        set_role(self.taken, level="good")
        self.take = button(
            "calibrate_take", tr("Take the calibration"),
            tr("The arm of this window gets these servos; its copy is yours, and undo takes it back"),
            self.take_wanted.emit, primary=True,
        )  # fmt: skip
        self.save = button(
            "calibrate_save",
            tr("Save as robot file …"),
            tr("What keeps a calibration is the robot file"),
            self.save_wanted.emit,
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        for widget in (self.head, self.table, self.remarks, self.taken, self.take, self.save):
            column.addWidget(widget)

    def show_results(self, robot: Robot, results: Sequence[Result], taken: bool) -> None:
        """Show results of an arm, the newest first; `taken`: they are in use already."""
        newest = tuple(reversed(results))
        self.head.setVisible(bool(newest))
        self.table.setVisible(bool(newest))
        self.table.setText(_html(robot, newest, self.palette().color(QPalette.ColorRole.PlaceholderText).name()))
        remarks = "\n".join(remark for result in newest for remark in result.remarks)
        self.remarks.setText(remarks)
        self.remarks.setVisible(bool(remarks) and not taken)
        self.taken.setVisible(taken)
        self.take.setVisible(bool(newest) and not taken)
        self.save.setVisible(bool(newest) or taken)


def _html(robot: Robot, results: Sequence[Result], muted: str) -> str:
    heads = "".join(f"<td align='right'>{escape(tr(head))}</td>" for head in _HEADS)
    rows = "".join(_rows(part_title(robot, result.joint), result, muted) for result in results)
    return f"<table width='100%' cellpadding='2'><tr style='color:{muted}'><td></td>{heads}</tr>{rows}</table>"


def _rows(title: str, result: Result, muted: str) -> str:
    now, was = (_cells(row) for row in result_rows(result))
    before = escape(tr("was"))
    return f"<tr><td><b>{escape(title)}</b></td>{now}</tr><tr style='color:{muted}'><td>{before}</td>{was}</tr>"


def _cells(row: Sequence[str]) -> str:
    span = len(_HEADS) // len(row)
    cells = (escape(cell).replace(" ", "&nbsp;") for cell in row)
    return "".join(f"<td align='right' colspan='{span}'>{cell}</td>" for cell in cells)
