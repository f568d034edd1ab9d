"""A box for one quantity: SI inside, the user's unit outside, expressions taken, nothing clamped in silence."""

import math

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QWheelEvent
from PySide6.QtWidgets import QLabel

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox

SHIFT, CTRL, NONE = (
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.NoModifier,
)


class Heard:
    """What a box has told."""

    def __init__(self, box: QuantityBox) -> None:
        self.values: list[float] = []
        self.refusals: list[str] = []
        box.quantity_changed.connect(self.values.append)
        box.refused.connect(self.refusals.append)


@pytest.fixture
def preferences(qapp):
    return Preferences()


@pytest.fixture
def box(qtbot, preferences):
    """The elbow of the RV-M1: −110° … 0°, at −50°."""
    made = QuantityBox("angle", preferences, "J3 elbow")
    made.set_range(math.radians(-110), 0.0, hint="Switch “Ignore limits” on to go there.")
    made.set_quantity(math.radians(-50))
    qtbot.addWidget(made)
    made.show()
    return made


@pytest.fixture
def free(qtbot, preferences):
    """A length without limits."""
    made = QuantityBox("length", preferences, "Tool x")
    qtbot.addWidget(made)
    made.show()
    return made


def paste(box, text):
    """Put a text where typing would; Qt's key simulation knows Latin letters only."""
    box.selectAll()
    QGuiApplication.clipboard().setText(text)
    box.lineEdit().paste()


def enter(box, qtbot, text):
    paste(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)


def wheel(box, notches, modifiers=NONE, *, sideways=False):
    box.window().activateWindow()
    box.setFocus()
    delta = QPoint(120 * notches, 0) if sideways else QPoint(0, 120 * notches)
    box.wheelEvent(
        QWheelEvent(
            QPointF(5, 5), QPointF(5, 5), QPoint(), delta, Qt.MouseButton.NoButton, modifiers,
            Qt.ScrollPhase.NoScrollPhase, False,
        )
    )  # fmt: skip


# --- showing -------------------------------------------------------------------------------------------------------


def test_it_shows_the_unit_and_a_true_minus_and_never_a_negative_zero(box, free):
    assert box.text() == "\u221250.0°"
    free.set_quantity(-1e-9)
    assert free.text() == "0.0 mm"


def test_setting_a_quantity_is_silent_and_exact(box):
    heard = Heard(box)
    box.set_quantity(-math.pi / 7)
    assert box.quantity == -math.pi / 7
    assert heard.values == []
    assert box.text() == "\u221225.7°"


@pytest.mark.parametrize(
    ("kind", "setting", "value", "text"),
    [
        ("angle", ("angle_unit", "rad"), math.pi / 4, "0.785 rad"),
        ("length", ("length_unit", "m"), 0.3637, "0.3637 m"),
        ("length", ("extra_decimals", 2), 0.36370001, "363.700 mm"),
        ("unit_length", ("length_unit", "m"), 2.5, "2.500 unit"),
        ("number", ("angle_unit", "rad"), 0.5, "0.5000"),
    ],
)
def test_units_and_decimals_follow_the_preferences_and_keep_the_value(qtbot, preferences, kind, setting, value, text):
    box = QuantityBox(kind, preferences, "value")
    qtbot.addWidget(box)
    box.set_quantity(value)
    heard = Heard(box)
    preferences.set(*setting)
    assert box.text() == text
    assert box.quantity == value
    assert heard.values == []


def test_the_tooltip_has_the_digits_that_the_text_has_not(box):
    box.set_quantity(-math.pi / 7)
    assert "-25.7142857143°" in box.toolTip()


# --- typing --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value_deg"),
    [
        ("-30", -30.0),
        ("\u221230", -30.0),
        ("-30,5", -30.5),
        ("-30.5", -30.5),
        ("-2*30", -60.0),
        ("-sqrt(2)/2", -math.sqrt(2) / 2),
        ("-degrees(pi/4)", -45.0),
        ("-30°", -30.0),
        ("-pi/4 rad", -45.0),
        ("-0.5rad", -math.degrees(0.5)),
        ("-45deg", -45.0),
        ("-pi/4 rad°", -45.0),
        (" \u2212 30 ° ", -30.0),
        ("-٣٠", -30.0),
        ("-۳۰", -30.0),
        ("0", 0.0),
        ("-110", -110.0),
    ],
)
def test_numbers_and_expressions_are_taken(box, qtbot, text, value_deg):
    heard = Heard(box)
    enter(box, qtbot, text)
    assert math.degrees(box.quantity) == pytest.approx(value_deg, abs=1e-12)
    assert heard.values == [box.quantity]
    assert heard.refusals == []


@pytest.mark.parametrize(
    ("shown", "text", "metres"),
    [
        ("mm", "12 cm", 0.12),
        ("mm", "0.3 m", 0.3),
        ("mm", "0.3 m mm", 0.3),
        ("mm", "300", 0.3),
        ("m", "300 mm", 0.3),
        ("m", "300 mm m", 0.3),
        ("m", "0,3", 0.3),
    ],
)
def test_a_length_may_say_its_own_unit(free, preferences, qtbot, shown, text, metres):
    preferences.set("length_unit", shown)
    enter(free, qtbot, text)
    assert free.quantity == pytest.approx(metres, abs=1e-12)


@pytest.mark.parametrize("text", ["", "hello", "five rad", "1/0", "__import__('os')", "nan", "1e400", "(3", "3 mm"])
def test_what_is_no_number_is_refused_once_with_a_sentence_and_changes_nothing(box, qtbot, text):
    before = box.quantity
    heard = Heard(box)
    enter(box, qtbot, text)
    assert box.quantity == before
    assert box.text() == "\u221250.0°"
    assert heard.values == []
    assert len(heard.refusals) == 1
    assert heard.refusals[0].startswith("J3 elbow: ")
    assert "is no number" in heard.refusals[0]


@pytest.mark.parametrize("text", ["90", "0.1", "-110.1", "1e12"])
def test_outside_the_limits_is_refused_and_never_clamped(box, qtbot, text):
    before = box.quantity
    heard = Heard(box)
    enter(box, qtbot, text)
    assert (box.quantity, heard.values) == (before, [])
    assert len(heard.refusals) == 1


def test_the_refusal_names_the_value_the_limits_and_the_way_out(box, qtbot):
    heard = Heard(box)
    enter(box, qtbot, "90")
    assert heard.refusals == [
        "J3 elbow: 90.0° lies outside \u2212110.0° … 0.0°. Switch “Ignore limits” on to go there."
    ]


@pytest.mark.parametrize(
    ("lower", "upper", "typed", "words"),
    [(0.0, math.inf, "-5", "\u22125.0 mm is below 0.0 mm"), (-math.inf, 0.4, "500", "500.0 mm is above 400.0 mm")],
)
def test_a_single_limit_is_named_alone(free, qtbot, lower, upper, typed, words):
    free.set_range(lower, upper)
    heard = Heard(free)
    enter(free, qtbot, typed)
    assert words in heard.refusals[0]


def test_leaving_the_box_refuses_as_enter_does(box, free, qtbot):
    heard = Heard(box)
    paste(box, "90")
    box.clearFocus()
    box.interpretText()
    assert box.text() == "\u221250.0°"
    assert len(heard.refusals) == 1


def test_enter_and_leaving_without_typing_keep_every_digit(box, qtbot):
    box.set_quantity(-math.pi / 7)
    heard = Heard(box)
    qtbot.keyClick(box, Qt.Key.Key_Return)
    box.interpretText()
    assert box.quantity == -math.pi / 7
    assert heard.values == []


def test_typing_the_rounded_text_means_the_rounded_number(box, qtbot):
    box.set_quantity(-math.pi / 7)
    enter(box, qtbot, "-25.7")
    assert math.degrees(box.quantity) == pytest.approx(-25.7, abs=1e-12)


def test_a_refused_text_keeps_every_digit_of_the_last_value(box, qtbot):
    box.set_quantity(-math.pi / 7)
    heard = Heard(box)
    enter(box, qtbot, "90")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert box.quantity == -math.pi / 7
    assert heard.values == []
    assert len(heard.refusals) == 1


def test_escape_gives_the_last_value_back_and_without_typing_is_left_to_the_window(box, qtbot):
    heard = Heard(box)
    paste(box, "-20")
    qtbot.keyClick(box, Qt.Key.Key_Escape)
    assert box.text() == "\u221250.0°"
    assert heard.values == []


def test_nothing_is_told_while_a_number_is_being_typed(box, qtbot):
    heard = Heard(box)
    box.selectAll()
    qtbot.keyClicks(box, "-20")
    assert heard.values == []


def test_the_same_text_in_another_unit_means_another_quantity(free, qtbot, preferences):
    enter(free, qtbot, "250")
    assert free.quantity == pytest.approx(0.25)
    preferences.set("length_unit", "m")
    enter(free, qtbot, "0.3")
    assert free.quantity == pytest.approx(0.3)
    enter(free, qtbot, "0.35 m")
    assert free.quantity == pytest.approx(0.35)
    enter(free, qtbot, "400 mm")
    assert free.quantity == pytest.approx(0.4), "millimetres stay millimetres"


def test_set_value_is_typing_for_programs(box):
    heard = Heard(box)
    box.setValue(-20.0)
    assert math.degrees(box.quantity) == pytest.approx(-20.0)
    box.setValue(20.0)
    box.setValue(math.nan)
    assert math.degrees(box.quantity) == pytest.approx(-20.0)
    assert len(heard.values) == 1
    assert len(heard.refusals) == 2


# --- steps ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "modifiers", "step_deg"),
    [
        (Qt.Key.Key_Up, NONE, 1.0),
        (Qt.Key.Key_Down, NONE, -1.0),
        (Qt.Key.Key_Up, SHIFT, 10.0),
        (Qt.Key.Key_Down, CTRL, -0.1),
        (Qt.Key.Key_PageUp, NONE, 10.0),
        (Qt.Key.Key_PageDown, NONE, -10.0),
    ],
)
def test_the_keys_step(box, qtbot, key, modifiers, step_deg):
    heard = Heard(box)
    qtbot.keyClick(box, key, modifiers)
    assert math.degrees(box.quantity) == pytest.approx(-50.0 + step_deg, abs=1e-10)
    assert heard.values == [box.quantity]


@pytest.mark.parametrize(("modifiers", "step_deg"), [(NONE, 2.0), (SHIFT, 20.0), (CTRL, 0.2)])
@pytest.mark.parametrize("sideways", [False, True])
def test_the_wheel_steps_whichever_way_the_system_turns_it(box, modifiers, step_deg, sideways):
    wheel(box, 2, modifiers, sideways=sideways)
    assert math.degrees(box.quantity) == pytest.approx(-50.0 + step_deg, abs=1e-10)


def test_a_hundred_small_steps_are_ten_large_ones(box, qtbot):
    for _ in range(100):
        qtbot.keyClick(box, Qt.Key.Key_Up, CTRL)
    assert box.text() == "\u221240.0°"
    assert math.degrees(box.quantity) == pytest.approx(-40.0, abs=1e-9)


def test_a_step_goes_on_from_what_has_been_typed(box, qtbot):
    paste(box, "-30")
    qtbot.keyClick(box, Qt.Key.Key_Up)
    assert math.degrees(box.quantity) == pytest.approx(-29.0, abs=1e-10)


def test_stepping_against_a_stop_ends_at_the_stop(box, qtbot):
    box.set_quantity(math.radians(-5))
    heard = Heard(box)
    qtbot.keyClick(box, Qt.Key.Key_Up, SHIFT)
    qtbot.keyClick(box, Qt.Key.Key_Up, SHIFT)
    assert box.quantity == 0.0
    assert heard.values == [0.0]


def test_a_value_outside_its_limits_is_shown_as_it_is_and_steps_back_without_a_jump(box, qtbot):
    box.set_quantity(math.radians(30))
    assert box.text() == "30.0°"
    qtbot.keyClick(box, Qt.Key.Key_Up)
    assert math.degrees(box.quantity) == pytest.approx(30.0)
    qtbot.keyClick(box, Qt.Key.Key_Down)
    assert math.degrees(box.quantity) == pytest.approx(29.0)


def test_a_read_only_box_neither_steps_nor_takes_text(box, qtbot):
    box.setReadOnly(True)
    heard = Heard(box)
    qtbot.keyClick(box, Qt.Key.Key_Up)
    qtbot.keyClick(box, Qt.Key.Key_PageDown)
    wheel(box, 3)
    box.stepBy(2)
    qtbot.keyClicks(box, "7")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert heard.values == []


def test_a_read_only_box_leaves_the_wheel_to_what_scrolls_around_it(box):
    box.setReadOnly(True)
    event = QWheelEvent(
        QPointF(5, 5), QPointF(5, 5), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton, NONE,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    box.wheelEvent(event)
    assert not event.isAccepted()


def test_it_has_a_name_for_screen_readers(box):
    assert box.accessibleName() == "J3 elbow"


def test_a_narrow_box_gives_up_the_unit_before_the_sign(qtbot):
    box = QuantityBox("length", Preferences(), "Line start y")
    qtbot.addWidget(box)
    box.set_quantity(-0.18)
    box.resize(160, 30)
    box.show()
    assert box.text() == "\u2212180.0 mm"
    needed = box.fontMetrics().horizontalAdvance("\u2212180.0")
    box.resize(box.width() - box.lineEdit().width() + needed + 8, 30)
    assert box.text() == "\u2212180.0"
    assert "mm" in box.toolTip()
    box.lineEdit().selectAll()
    qtbot.keyClicks(box, "12 cm")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert box.quantity == pytest.approx(0.12)
    box.resize(160, 30)
    assert box.text() == "120.0 mm"


@pytest.mark.parametrize("typed", ["999", "abc"])
def test_what_is_refused_is_said_at_the_box_until_something_else_is_typed(box, qtbot, typed):
    heard = Heard(box)
    enter(box, qtbot, typed)
    assert box.property("refused") is True
    bubble = box.findChild(QLabel, "refusal_bubble")
    assert bubble.isVisible()
    assert bubble.text() == heard.refusals[-1]
    qtbot.keyClicks(box, "-3")
    assert box.property("refused") is False
    assert not bubble.isVisible()
    enter(box, qtbot, "abc")
    box.set_quantity(-1.0)
    assert box.property("refused") is False, "another value, from elsewhere"
