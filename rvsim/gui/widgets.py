"""Small makers of widgets, so that every panel's boxes and buttons look and behave alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QSignalBlocker, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QGraphicsView,
    QLabel,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QStyle,
    QVBoxLayout,
    QWidget,
)

from rvsim.gui.calm_boxes import ComboBox
from rvsim.language import tr


def combo(object_name: str, title: str, choices: Mapping[str, str] | None = None) -> QComboBox:
    """A combo box with a name for tests, one for screen readers, and choices data → text, said in the language."""
    box = ComboBox()
    box.setObjectName(object_name)
    box.setAccessibleName(tr(title))
    box.setToolTip(tr(title))
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    box.setMinimumContentsLength(8)
    box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
    for data, text in (choices or {}).items():
        box.addItem(tr(text), data)
    return box


def show_whole(*boxes: QComboBox) -> None:
    """Let boxes be no narrower than their longest choices."""
    for box in boxes:
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        box.setMinimumContentsLength(0)


def select(box: QComboBox, data: object) -> None:
    """Show the entry with that data, silently."""
    with QSignalBlocker(box):
        box.setCurrentIndex(box.findData(data))


def button(object_name: str, text: str, tip: str, slot: Callable[[], object], *, primary: bool = False) -> QPushButton:
    """A push button, its texts said in the language; the primary one of a panel is filled with the accent colour."""
    made = QPushButton(tr(text))
    made.setObjectName(object_name)
    made.setToolTip(tr(tip))
    made.setAutoDefault(False)
    made.setProperty("primary", primary)
    made.clicked.connect(lambda _checked=False: slot())
    return made


def silence(widget: QWidget) -> None:
    """Let a widget that is taken out for good, and all in it, say nothing more, and be found by name no more.

    A box that is hidden loses the focus, and would take what is half typed in it: for an arm that is there no more.
    """
    for part in (widget, *widget.findChildren(QWidget)):
        part.blockSignals(True)
        part.setObjectName("")


def clear_scenes(widget: QWidget) -> None:
    """Empty the plots in a widget that is about to be destroyed, while all is whole.

    A plot's layout and what lies in it are freed by Python and by Qt, each in its own order: Qt for Python 6.11 then
    asks what is gone, and the program ends.
    """
    for view in widget.findChildren(QGraphicsView):
        view.scene().clear()
        menu = getattr(getattr(view, "plotItem", None), "ctrlMenu", None)
        if menu is not None:  # nobody's child, and never shown
            menu.deleteLater()


def form() -> QFormLayout:
    """A form as all panels have it."""
    made = QFormLayout()
    made.setContentsMargins(0, 6, 0, 0)
    made.setHorizontalSpacing(10)
    made.setVerticalSpacing(6)
    made.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.ExpandingFieldsGrow)
    return made


def scrolled(inside: QWidget) -> QScrollArea:
    """A column that scrolls when the screen is low, without a frame or a ground of its own."""
    area = QScrollArea()
    area.setWidget(inside)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    inside.setMinimumWidth(1)  # never wider than the area, or what is beyond its edge could not be reached
    inside.setAutoFillBackground(False)
    area.viewport().setAutoFillBackground(False)
    return area


def column_of(widget: QWidget, first: QWidget, *others: QWidget) -> None:
    """Put widgets below each other into a widget, the first one filling it."""
    column = QVBoxLayout(widget)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    column.addWidget(first, 1)
    for other in others:
        column.addWidget(other)


class PaintedLines(QWidget):
    """A read-out that paints its own text: always as high as its hint, which follows the font, and narrower if need be.

    The height is for those who derive from it: in `sizeHint`.
    """

    narrowest = 120  # [pixels]

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def minimumSizeHint(self) -> QSize:
        """As high as the hint, narrower."""
        return QSize(self.narrowest, self.sizeHint().height())

    def changeEvent(self, event: QEvent) -> None:
        """Another font: another height."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.updateGeometry()


class ElidedLabel(QLabel):
    """A text that ends in … when the room is short; the whole stands in the tooltip.

    It is one line, or a few where it is high enough for them: long words break at their hyphens.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)

    def setText(self, text: str) -> None:
        """Show a text."""
        super().setText(text)
        self.setToolTip(text)

    def minimumSizeHint(self) -> QSize:
        """It can be as narrow as you like."""
        return QSize(40, super().minimumSizeHint().height())

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw what fits."""
        painter = QPainter(self)
        inner = self.contentsRect()
        side = QStyle.visualAlignment(self.layoutDirection(), Qt.AlignmentFlag.AlignLeft)
        place = side | Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignAbsolute
        broken, metrics = place | Qt.TextFlag.TextWordWrap, self.fontMetrics()
        painter.setPen(self.palette().windowText().color())
        if metrics.horizontalAdvance(self.text()) > inner.width() and inner.contains(
            metrics.boundingRect(inner, broken, self.text())
        ):
            painter.drawText(inner, broken, self.text())
            return
        text = metrics.elidedText(self.text(), Qt.TextElideMode.ElideRight, inner.width())
        painter.drawText(inner, place, text)
