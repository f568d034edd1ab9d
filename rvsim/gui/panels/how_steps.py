"""One step of the worked solution: its number, a sentence, the equations, the ways that lead on."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from rvsim.gui.formula_view import EquationsView, Typesetter
from rvsim.gui.theme import set_role
from rvsim.kinematics import branch_title
from rvsim.lab.worked import Step
from rvsim.language import tr

Path = tuple[str, ...]
_WIDEST_ROW = 34  # letters: longer choices stand below each other


def wrapped_label(role: str = "") -> QLabel:
    """A text as wide as its column and as high as it needs."""
    label = QLabel()
    label.setWordWrap(True)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    if label.isRightToLeft():  # the blank where a line was broken stands before it, and pushes its end out at the left
        label.setContentsMargins(label.fontMetrics().horizontalAdvance(" ") + 1, 0, 0, 0)
    if role:
        set_role(label, role=role)
    return label


class NoteLabel(QLabel):
    """A remark beside the way, with a bar at its side."""

    def __init__(self) -> None:
        super().__init__()
        self.setWordWrap(True)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        before, after = (4, 12) if self.isRightToLeft() else (12, 0)
        self.setContentsMargins(before, 2, after, 2)
        set_role(self, role="muted")

    def paintEvent(self, event: QPaintEvent) -> None:
        """The bar, then the text."""
        side = self.width() - 3 if self.isRightToLeft() else 0
        QPainter(self).fillRect(side, 0, 3, self.height(), self.palette().mid())
        super().paintEvent(event)


class StepView(QWidget):
    """Shows a step; `followed(path)` when another of its ways is chosen."""

    followed = Signal(tuple)

    def __init__(self, typesetter: Typesetter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.number, self.title = QLabel(), wrapped_label("title")
        self.text, self.failure, self.note = wrapped_label("muted"), wrapped_label(), NoteLabel()
        self.equations = EquationsView(typesetter)
        self.ways = WaysRow()
        self.ways.followed.connect(self.followed)
        set_role(self.failure, level="error")
        self.number.setStyleSheet("color: palette(link); font-weight: 600;")
        self._lay_out()

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.setSpacing(8)
        head.addWidget(self.number)
        head.addWidget(self.title, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addLayout(head)
        for widget in (self.text, self.equations, self.failure, self.ways, self.note):
            column.addWidget(widget)

    def show_step(self, number: int, step: Step, path: Path) -> None:
        """Show a step on the way to the end `path`."""
        self.number.setText(str(number))
        for label, text in ((self.title, step.title), (self.text, step.text)):
            _show_text(label, text)
        _show_text(self.failure, step.failure)
        _show_text(self.note, step.source_note)
        self.equations.show_equations(step.equations)
        self.equations.setVisible(bool(step.equations))
        self.ways.show_ways(step.leads_to, path)


class WaysRow(QWidget):
    """The ways a step opens, the one that is followed pressed."""

    followed = Signal(tuple)

    def __init__(self) -> None:
        super().__init__()
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(6)
        self._ways: tuple[Path, ...] = ()
        self.buttons: list[QToolButton] = []

    def show_ways(self, ways: tuple[Path, ...], path: Path) -> None:
        """Show these; that on the way to `path` is pressed."""
        self.setVisible(bool(ways))
        if ways != self._ways:
            self._offer(ways)
        for button, way in zip(self.buttons, ways, strict=True):
            button.setChecked(path[: len(way)] == way)

    def _offer(self, ways: tuple[Path, ...]) -> None:
        self._ways = ways
        for button in self.buttons:
            self._row.removeWidget(button)
            button.deleteLater()
        while self._row.count():
            self._row.takeAt(0)
        long = sum(len(branch_title(way[-1])) for way in ways) > _WIDEST_ROW
        self._row.setDirection(QBoxLayout.Direction.TopToBottom if long else QBoxLayout.Direction.LeftToRight)
        self.buttons = [self._button(way) for way in ways]
        for button in self.buttons:
            self._row.addWidget(button)
        self._row.addStretch(1)

    def _button(self, way: Path) -> QToolButton:
        button = QToolButton()
        button.setText(tr("→ {way}", way=branch_title(way[-1])))
        button.setCheckable(True)
        button.setObjectName(f"how_way_{'_'.join(way)}".replace(" ", "_"))
        title = branch_title(", ".join(way))
        button.setAccessibleName(tr("Follow {way}", way=title))
        button.setToolTip(tr("Read on with “{way}”; the arm stays where it is", way=title))
        button.clicked.connect(lambda _checked=False: self.followed.emit(way))
        return button


def _show_text(label: QLabel, text: str) -> None:
    if label.text() != text:
        label.setText(text)
    label.setVisible(bool(text))
