"""Boxes and sliders that the mouse wheel changes only while they have the focus: else the panel around them scrolls."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QHelpEvent, QPaintEvent, QWheelEvent
from PySide6.QtWidgets import (
    QComboBox,
    QSlider,
    QSpinBox,
    QStyle,
    QStyleOptionComboBox,
    QStylePainter,
    QToolTip,
    QWidget,
)

_EDGES = 4  # [pixels] that a style leaves free beside the text of a list


def needs_focus(widget: QWidget) -> None:
    """Let a widget take the focus by a click or Tab, but not by the wheel."""
    widget.setFocusPolicy(Qt.FocusPolicy.StrongFocus)


class ComboBox(QComboBox):
    """A list that nobody changes by scrolling past it.

    What is chosen ends in … where the room is short; then the whole stands in the tooltip.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        needs_focus(self)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Only with the focus."""
        super().wheelEvent(event) if self.hasFocus() else event.ignore()

    def paintEvent(self, event: QPaintEvent) -> None:
        """As any list, its text as far as it fits."""
        if self.isEditable():
            super().paintEvent(event)
            return
        option = self._option()
        option.currentText = self._elided(option)
        painter = QStylePainter(self)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        painter.drawControl(QStyle.ControlElement.CE_ComboBoxLabel, option)

    def event(self, event: QEvent) -> bool:
        """The tooltip, with what is cut off before it."""
        option = self._option() if event.type() == QEvent.Type.ToolTip and not self.isEditable() else None
        if option is None or self._elided(option) == option.currentText:
            return super().event(event)
        assert isinstance(event, QHelpEvent)
        QToolTip.showText(event.globalPos(), "\n".join(filter(None, (option.currentText, self.toolTip()))), self)
        return True

    def _option(self) -> QStyleOptionComboBox:
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        return option

    def _elided(self, option: QStyleOptionComboBox) -> str:
        field = QStyle.SubControl.SC_ComboBoxEditField
        room = self.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, field, self).width() - _EDGES
        room -= 0 if option.currentIcon.isNull() else option.iconSize.width() + _EDGES
        return self.fontMetrics().elidedText(option.currentText, Qt.TextElideMode.ElideRight, room)


class CountBox(QSpinBox):
    """A whole number that nobody changes by scrolling past it, aligned as other numbers are."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        needs_focus(self)
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Only with the focus."""
        super().wheelEvent(event) if self.hasFocus() else event.ignore()


class Slider(QSlider):
    """A horizontal slider that nobody moves by scrolling past it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        needs_focus(self)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Only with the focus."""
        super().wheelEvent(event) if self.hasFocus() else event.ignore()
