"""A spin box for one quantity: SI inside, the user's unit outside, expressions taken, nothing clamped in silence."""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QResizeEvent, QValidator, QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QWidget

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate_in
from rvsim.gui.calm_boxes import needs_focus
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number, without_unit
from rvsim.gui.refusal import end_refusal, show_refusal
from rvsim.language import left_to_right, tr

_LONGEST = 400  # characters: more than any number or pose; ten million that are pasted must not be laid out
_MARGINS = 4  # [pixels] that the line edit keeps left and right of its text
_KEPT_DECIMALS = 12  # the spin box rounds to these; the text shows far fewer
_STEPS = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1, Qt.Key.Key_PageUp: 10, Qt.Key.Key_PageDown: -10}


class QuantityBox(QDoubleSpinBox):
    """Shows and edits one SI value.

    `quantity_changed(float)` tells a new SI value that the user (or `setValue`) gave; `set_quantity` is silent.
    `refused(str)` tells in a sentence why a typed value was not taken.
    """

    quantity_changed = Signal(float)
    refused = Signal(str)

    def __init__(self, kind: Kind, preferences: Preferences, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._kind, self._preferences, self._title = kind, preferences, tr(title)
        self._quantity, self._lower, self._upper = 0.0, -math.inf, math.inf
        self._limits_hint = ""
        self._span = (0.0, 0.0)
        needs_focus(self)
        self.setKeyboardTracking(False)
        self.setAccessibleName(self._title)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # a number and its unit, in any language
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setCorrectionMode(QAbstractSpinBox.CorrectionMode.CorrectToPreviousValue)
        self.setDecimals(_KEPT_DECIMALS)
        self.lineEdit().setMaxLength(_LONGEST)
        self._show()
        self.valueChanged.connect(self._take)
        self.refused.connect(self._show_refusal)
        self.lineEdit().textEdited.connect(self._end_refusal)
        preferences.changed.connect(self._on_preference)

    # --- SI side ---------------------------------------------------------------------------------------------------

    @property
    def quantity(self) -> float:
        """The SI value, exactly as it was set."""
        return self._quantity

    @property
    def limits(self) -> tuple[float, float]:
        """The SI values between which a value is taken; ±inf where there is no limit."""
        return self._lower, self._upper

    def set_quantity(self, quantity: float) -> None:
        """Show an SI value, without telling anybody."""
        if quantity == self._quantity:
            return
        self._quantity = quantity
        self._end_refusal()
        self._show()

    def set_range(self, lower: float, upper: float, hint: str = "") -> None:
        """Take only SI values from lower to upper; `hint` says what to do about a refused one."""
        self._lower, self._upper, self._limits_hint = lower, upper, hint
        self._show()

    def set_kind(self, kind: Kind) -> None:
        """Show another kind of quantity."""
        self._kind = kind
        self._show()

    def _show(self) -> None:
        shown = display(self._kind, self._preferences)
        blocked = self.blockSignals(True)
        # A pose reached while limits were ignored may lie outside them: it is shown as it is.
        lower, upper = min(self._lower, self._quantity), max(self._upper, self._quantity)
        span = max(lower * shown.factor, -1e9), min(upper * shown.factor, 1e9)
        # Range and suffix make every layout around the box work anew: only when they are other ones than those given
        # last (the box rounds them, so that its own are other ones nearly always).
        if span != self._span:
            self._span = span
            self.setRange(*span)
        super().setValue(self._quantity * shown.factor)
        suffix = shown.suffix if self._has_room_for(shown.suffix) else ""
        if suffix != self.suffix():
            self.setSuffix(suffix)
        text = self.textFromValue(self.value()) + self.suffix()
        if text != self.lineEdit().text() or self.lineEdit().isModified():
            self.lineEdit().setText(text)
        self.setToolTip(f"{self._title}: {left_to_right(f'{self._quantity * shown.factor:.12g}{shown.suffix}')}")
        self.blockSignals(blocked)

    def _has_room_for(self, unit: str) -> bool:
        """Whether number and unit fit. A number that lost its sign would be another one; the tooltip has the unit."""
        text = self.textFromValue(self.value()) + unit
        return not self.isVisible() or self.fontMetrics().horizontalAdvance(text) <= self.lineEdit().width() - _MARGINS

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the unit where there is room for it."""
        super().resizeEvent(event)
        if not self.lineEdit().isModified():
            self._show()

    def _show_refusal(self, sentence: str) -> None:
        show_refusal(self, sentence)

    def _end_refusal(self, _text: str = "") -> None:
        end_refusal(self)

    def _take(self, value: float) -> None:
        self._end_refusal()
        self._quantity = value / display(self._kind, self._preferences).factor
        self._show()
        self.quantity_changed.emit(self._quantity)

    def _on_preference(self, name: str) -> None:
        if name == "language" and self.lineEdit().isModified():
            self.interpretText()  # another window is about to take the place of this one
        if name in ("angle_unit", "length_unit", "extra_decimals"):
            self._show()

    # --- what is typed ---------------------------------------------------------------------------------------------

    def setValue(self, value: float) -> None:
        """Take a value in the shown unit, as if it had been typed: outside the limits it is refused, not clamped."""
        problem = self._problem(value)
        if problem:
            self.refused.emit(problem)
            return
        super().setValue(value)

    def textFromValue(self, value: float) -> str:
        """The shown text, without the unit."""
        return format_number(value, display(self._kind, self._preferences).decimals)

    def valueFromText(self, text: str) -> float:
        """The value of a typed text; the text that is merely shown keeps the exact value behind it."""
        bare = self._bare(text)
        if self._is_untouched(bare):
            return self.value()
        try:
            return self._evaluated(bare)
        except ExpressionError:
            return self.value()

    def validate(self, text: str, position: int) -> tuple[QValidator.State, str, int]:
        """Anything may be typed; only a number within the limits is taken."""
        bare = self._bare(text)
        try:
            acceptable = self._is_untouched(bare) or not self._problem(self._evaluated(bare))
        except ExpressionError:
            acceptable = False
        state = QValidator.State.Acceptable if acceptable else QValidator.State.Intermediate
        return state, text, position

    def fixup(self, text: str) -> str:
        """Asked for when what stands there cannot be taken: say why, and go back to the last value."""
        try:
            sentence = self._problem(self._evaluated(self._bare(text)))
        except ExpressionError as problem:
            sentence = f"{self._title}: {problem}"
        self._show()
        if sentence:
            self.refused.emit(sentence)
        return self.textFromValue(self.value())

    def _evaluated(self, bare: str) -> float:
        """The value in the shown unit; another unit of the same kind may stand behind."""
        return evaluate_in(display(self._kind, self._preferences).suffix.strip(), bare)

    def _is_untouched(self, bare: str) -> bool:
        """Whether nobody has typed since the text was shown: then the exact value behind the rounded text counts."""
        return bare == self.textFromValue(self.value()) and not self.lineEdit().isModified()

    def _bare(self, text: str) -> str:
        """Without the unit; it stands there twice where the user typed it before the one that Qt keeps."""
        unit = display(self._kind, self._preferences).suffix
        return without_unit(without_unit(text, unit), unit)

    def _problem(self, value: float) -> str:
        """Why a value in the shown unit cannot be taken, or nothing."""
        shown = display(self._kind, self._preferences)
        lower, upper = self._lower * shown.factor, self._upper * shown.factor
        if not math.isfinite(value) or abs(value) > 1e9:
            return tr("{title}: {value:g} is too large for an arm.", title=self._title, value=value)
        if lower - 1e-9 <= value <= upper + 1e-9:
            return ""
        texts = [format_number(number, shown.decimals) + shown.suffix for number in (value, lower, upper)]
        if math.isinf(self._upper):
            return tr(
                "{title}: {number} is below {lowest}. {hint}",
                title=self._title,
                number=texts[0],
                lowest=texts[1],
                hint=self._limits_hint,
            ).rstrip()
        if math.isinf(self._lower):
            return tr(
                "{title}: {number} is above {highest}. {hint}",
                title=self._title,
                number=texts[0],
                highest=texts[2],
                hint=self._limits_hint,
            ).rstrip()
        return tr(
            "{title}: {number} lies outside {lowest} … {highest}. {hint}",
            title=self._title,
            number=texts[0],
            lowest=texts[1],
            highest=texts[2],
            hint=self._limits_hint,
        ).rstrip()

    # --- keys and wheel --------------------------------------------------------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Undo and redo are the window's: the box's own are for a text that is being typed."""
        if event.type() == QEvent.Type.ShortcutOverride and not self.lineEdit().isModified():
            assert isinstance(event, QKeyEvent)
            if event.matches(QKeySequence.StandardKey.Undo) or event.matches(QKeySequence.StandardKey.Redo):
                event.ignore()
                return False
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows step 1, with Shift 10, with Ctrl 0.1; Escape gives back the last value."""
        if event.key() == Qt.Key.Key_Escape and self.lineEdit().isModified():
            self._show()
            self.selectAll()
            return
        steps = _STEPS.get(Qt.Key(event.key())) if event.key() in _STEPS else None
        if steps is None:
            super().keyPressEvent(event)
        else:
            self._step(steps, event.modifiers())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """One notch is one step, with the focus; some systems turn the wheel sideways while a modifier is held."""
        notches = (event.angleDelta().y() or event.angleDelta().x()) / 120.0
        if notches and self.hasFocus() and not self.isReadOnly():
            self._step(notches, event.modifiers())
            event.accept()
        else:
            event.ignore()  # what is around the box may scroll

    def _step(self, steps: float, modifiers: Qt.KeyboardModifier) -> None:
        if self.isReadOnly():
            return
        self.interpretText()
        scale = 10.0 if modifiers & Qt.KeyboardModifier.ShiftModifier else 1.0
        scale = 0.1 if modifiers & Qt.KeyboardModifier.ControlModifier else scale
        shown = display(self._kind, self._preferences)
        wanted = self.value() + steps * scale * shown.step
        # Stepping against a stop ends at the stop: it is written beside the slider. A value that is outside already
        # (limits were ignored) steps back in, and no further out: it does not jump.
        lower, upper = min(self._lower, self._quantity), max(self._upper, self._quantity)
        super().setValue(min(max(wanted, lower * shown.factor), upper * shown.factor))
        self.selectAll()

    def stepBy(self, steps: int) -> None:
        """The little arrows of the box."""
        self._step(steps, Qt.KeyboardModifier.NoModifier)

    def changeEvent(self, event: QEvent) -> None:
        """Keep the digits when the style changes."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._show()
