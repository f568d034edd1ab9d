"""A finding of the check as a row: a symbol, a word, a sentence; clicking it goes there."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QEnterEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QVBoxLayout, QWidget

from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.theme import Theme, set_role
from rvsim.lab.findings import SYMBOLS, WORDS, finding_sentence
from rvsim.lab.sentences import Units
from rvsim.language import tr, tr_later
from rvsim.motion.honesty import Finding, Report, Severity

_SAID: dict[Severity, str] = {
    "good": tr_later("good"),
    "warning": tr_later("mind this"),
    "bad": tr_later("wrong"),
}


def severity_color(severity: Severity, theme: Theme) -> str:
    """The colour of the symbol; the symbol and a word say the same."""
    return {"good": theme.good, "warning": theme.warning, "bad": theme.error}[severity]


class FindingRow(QFrame):
    """One row; `chosen` tells that it was clicked, or Enter pressed on it."""

    chosen = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.symbol, self.word, self.sentence = QLabel(), QLabel(), wrapped_label()
        self.symbol.setFixedWidth(16)
        set_role(self.word, role="title")
        grid = QGridLayout(self)
        grid.setContentsMargins(4, 3, 4, 3)
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(1)
        grid.addWidget(self.symbol, 0, 0, Qt.AlignmentFlag.AlignTop)
        grid.addWidget(self.word, 0, 1)
        grid.addWidget(self.sentence, 1, 1)
        grid.setColumnStretch(1, 1)
        self._goes = False

    def show_finding(self, report: Report, finding: Finding, units: Units, theme: Theme) -> None:
        """Show one."""
        self._goes = finding.time is not None and finding.kind != "reach"
        self.symbol.setText(SYMBOLS[finding.severity])
        self.symbol.setStyleSheet(f"color: {severity_color(finding.severity, theme)}; font-weight: 600;")
        self.word.setText(f"{tr(WORDS[finding.kind])}: {tr(_SAID[finding.severity])}")
        text = finding_sentence(report, finding, units)
        self.sentence.setText(text)
        self.setAccessibleName(f"{self.word.text()}. {text}")
        self.setToolTip(tr("Click to see the arm there") if self._goes else "")
        self.setCursor(Qt.CursorShape.PointingHandCursor if self._goes else Qt.CursorShape.ArrowCursor)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus if self._goes else Qt.FocusPolicy.NoFocus)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A click goes there."""
        inside = self.rect().contains(event.position().toPoint())
        if self._goes and inside and event.button() == Qt.MouseButton.LeftButton:
            self.chosen.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """So do Enter and space."""
        if self._goes and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space):
            self.chosen.emit()
        else:
            super().keyPressEvent(event)

    def enterEvent(self, event: QEnterEvent) -> None:
        """Under the pointer the word is underlined where there is somewhere to go."""
        self._underline(self._goes)
        super().enterEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        """As before."""
        self._underline(False)
        super().leaveEvent(event)

    def _underline(self, on: bool) -> None:
        font = self.word.font()
        font.setUnderline(on)
        self.word.setFont(font)


class FindingList(QWidget):
    """All rows of a report; `chosen(number)` tells which was clicked."""

    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("check_findings")
        self.rows: list[FindingRow] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(2)

    def show_report(self, report: Report | None, units: Units, theme: Theme) -> None:
        """One row for each finding."""
        findings = report.findings if report else ()
        while len(self.rows) < len(findings):
            self._add()
        for row in self.rows[len(findings) :]:
            row.hide()
        for row, finding in zip(self.rows, findings, strict=False):
            assert report is not None
            row.show_finding(report, finding, units, theme)
            row.show()

    def _add(self) -> None:
        row, number = FindingRow(), len(self.rows)
        row.setObjectName(f"finding_{number + 1}")
        row.chosen.connect(lambda: self.chosen.emit(number))
        self._column.addWidget(row)
        self.rows.append(row)
