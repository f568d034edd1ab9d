"""A tour of one minute through the window: a card beside the real control, all else a little darker.

Nothing is locked meanwhile: what the card points at can be tried at once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from rvsim.gui.theme import set_role
from rvsim.gui.tour_steps import STEPS
from rvsim.gui.widgets import button
from rvsim.language import tr

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_WIDTH = 320
_GAP, _EDGE, _ROUND = 14, 8, 8.0  # [pixels] from the control, from the window's edge, of the corners
_AROUND = 5  # [pixels] of light around the control
_SHADE = 105  # of 255
_LATER_MS = 400  # after the window is there
_KEYS = {
    Qt.Key.Key_Right: 1, Qt.Key.Key_PageDown: 1, Qt.Key.Key_Left: -1, Qt.Key.Key_PageUp: -1,
}  # fmt: skip
_ENTER = Qt.Key.Key_Return, Qt.Key.Key_Enter


class Tour(QObject):
    """The tour through a window; it goes when it ends, and remembers whether it is wanted at the next start."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self.setObjectName("tour")
        self._window = window
        self._step = 0
        self._front = window.docks.front
        self.shade = _Shade(window)
        self.card = TourCard(window, self)
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._point)
        window.installEventFilter(self)
        self.go(0)
        self.card.next_button.setFocus(Qt.FocusReason.OtherFocusReason)

    @property
    def step(self) -> int:
        """The number of the present step, from 0."""
        return self._step

    def go(self, step: int) -> None:
        """Show a step; beyond the last one the tour is over."""
        if step >= len(STEPS):
            self.end()
            return
        self._step = max(step, 0)
        self.card.show_step(self._step)
        self._point()
        self._soon.start()  # once more when a panel that came to the front has its place

    def end(self) -> None:
        """Over, or skipped."""
        self._window.removeEventFilter(self)
        self._window.preferences.set("tour_seen", self.card.never.isChecked())
        for part in (self.card, self.shade):
            part.hide()
            part.deleteLater()
        self._soon.stop()
        self._front.raise_()
        self._window.scene_view.setFocus(Qt.FocusReason.OtherFocusReason)
        self.setObjectName("")
        self.deleteLater()

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Stay where the control is."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.LayoutRequest):
            self._soon.start()
        return False

    def _point(self) -> None:
        room = self._window.rect()
        target = STEPS[self._step].where(self._window)
        self.shade.setGeometry(room)
        self.shade.light(target)
        self.card.resize(self.card.fitting())
        self.card.move(place_beside(target, self.card.size(), room, _seen_at(self._window.tool_card, self._window)))
        for part in (self.shade, self.card):
            part.show()
            part.raise_()


def _seen_at(widget: QWidget, window: QWidget) -> QRect:
    """Where a widget is in its window, an empty place if it is hidden."""
    return QRect(widget.mapTo(window, QPoint(0, 0)), widget.size()) if widget.isVisible() else QRect()


def place_beside(target: QRect, size: QSize, room: QRect, free: QRect | None = None) -> QPoint:
    """The upper left corner of a card beside a target: at the right, left, below or above it, else in the middle.

    Args:
        free: what the card should leave free, if it can: beside the target it goes below that.
    """
    inner = room.adjusted(_EDGE, _EDGE, -_EDGE, -_EDGE)
    top = min(max(target.top(), inner.top()), inner.bottom() - size.height())
    left = min(max(target.left(), inner.left()), inner.right() - size.width())
    kept = free or QRect()
    right, before, lower = target.right() + _GAP, target.left() - _GAP - size.width(), kept.bottom() + _GAP
    beside = [QPoint(x, y) for x in (right, before) for y in ((top, lower) if free else (top,))]
    places = (*beside, QPoint(left, target.bottom() + _GAP), QPoint(left, target.top() - _GAP - size.height()))
    rooms = [(place, QRect(place, size)) for place in places if inner.contains(QRect(place, size))]
    for place, taken in (*(one for one in rooms if not one[1].intersects(kept)), *rooms):
        if not target.isEmpty() and not taken.intersects(target):
            return place
    return room.center() - QRect(QPoint(0, 0), size).center()


class _Shade(QWidget):
    """Darkens the window but for what is pointed at; the mouse goes through it."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.setObjectName("tour_shade")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._target = QRect()

    def light(self, target: QRect) -> None:
        """Leave this light."""
        around = QRect() if target.isEmpty() else target.adjusted(-_AROUND, -_AROUND, _AROUND, _AROUND)
        self._target = around.intersected(self.rect())
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paint the shade and a line around the light."""
        shade, hole = QPainterPath(), QPainterPath()
        shade.addRect(QRectF(self.rect()))
        hole.addRoundedRect(QRectF(self._target).adjusted(1, 1, -1, -1), _ROUND, _ROUND)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillPath(shade.subtracted(hole), QColor(0, 0, 0, _SHADE))
        painter.setPen(QPen(self.palette().highlight().color(), 2.0))
        painter.drawPath(hole)
        painter.end()


class TourCard(QWidget):
    """What a step says, and where to go from there."""

    def __init__(self, window: QWidget, tour: Tour) -> None:
        super().__init__(window)
        self.setObjectName("tour_card")
        self._tour = tour
        self.title, self.text, self.number = QLabel(), QLabel(), QLabel()
        self.text.setObjectName("tour_text")
        self.text.setWordWrap(True)
        set_role(self.title, role="title")
        set_role(self.number, role="muted")
        self.never = QCheckBox(tr("Do not show this again"))
        self.never.setObjectName("tour_never")
        self.never.setChecked(True)
        self.skip_button = button("tour_skip", tr("Skip"), tr("End the tour (Esc)"), tour.end)
        self.back_button = button("tour_back", tr("Back"), tr("The step before (←)"), lambda: tour.go(tour.step - 1))
        self.next_button = button(
            "tour_next", tr("Next"), tr("The next step (→)"), lambda: tour.go(tour.step + 1), primary=True
        )
        for part in (self.never, self.skip_button, self.back_button, self.next_button):
            part.installEventFilter(self)  # a button would take the arrow keys for itself
        self._lay_out()

    def _lay_out(self) -> None:
        head, foot = QHBoxLayout(), QHBoxLayout()
        head.addWidget(self.title, 1)
        head.addWidget(self.number)
        foot.addWidget(self.skip_button)
        foot.addStretch(1)
        foot.addWidget(self.back_button)
        foot.addWidget(self.next_button)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(16, 12, 16, 12)
        column.setSpacing(8)
        column.addLayout(head)
        column.addWidget(self.text)
        column.addWidget(self.never)
        column.addLayout(foot)

    def _next(self) -> None:
        self._tour.go(self._tour.step + 1)

    def show_step(self, number: int) -> None:
        """Say what a step has to say."""
        step, last = STEPS[number], number == len(STEPS) - 1
        self.title.setText(tr(step.title))
        self.text.setText(tr(step.text))
        self.number.setText(tr("{number} of {count}", number=number + 1, count=len(STEPS)))
        self.back_button.setEnabled(number > 0)
        self.skip_button.setVisible(not last)
        self.next_button.setText(tr("Done") if last else tr("Next"))
        self.setAccessibleName(
            tr("Tour, step {number} of {count}: {title}", number=number + 1, count=len(STEPS), title=tr(step.title))
        )

    def fitting(self) -> QSize:
        """As wide as agreed, in letters as large as they are, and as high as its text needs."""
        width = max(round(_WIDTH * self.fontMetrics().height() / 16.0), self.minimumSizeHint().width())
        return QSize(width, max(self._column.totalHeightForWidth(width), self.minimumSizeHint().height()))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Arrows go through the steps, Esc ends, Enter is Next unless another button has the focus."""
        if event.type() != QEvent.Type.KeyPress or not isinstance(event, QKeyEvent):
            return False
        pressed = watched if watched in (self.skip_button, self.back_button) else self.next_button
        if event.key() in _ENTER and isinstance(pressed, QPushButton):
            pressed.click()
            return True
        return self._took(event)

    def _took(self, event: QKeyEvent) -> bool:
        key = Qt.Key(event.key())
        if key in _KEYS:
            turned = self.isRightToLeft() and key in (Qt.Key.Key_Left, Qt.Key.Key_Right)
            self._tour.go(self._tour.step + (-_KEYS[key] if turned else _KEYS[key]))
        elif key == Qt.Key.Key_Escape:
            self._tour.end()
        else:
            return False
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """The same, when the card itself has the focus."""
        if not self._took(event):
            super().keyPressEvent(event)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paint the card."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.palette().mid().color(), 1.0))
        painter.setBrush(self.palette().button())
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), _ROUND, _ROUND)
        painter.end()


def begin_tour(window: MainWindow) -> Tour:
    """Begin the tour, or begin again."""
    running = window.findChild(Tour, "tour")
    if isinstance(running, Tour):
        running.go(0)
        return running
    return Tour(window)


def offer_tour(window: MainWindow) -> None:
    """At the first start: the tour, once the window is there."""
    QTimer.singleShot(_LATER_MS, window, lambda: begin_tour(window))
