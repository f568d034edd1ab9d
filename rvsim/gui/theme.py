"""Light and dark: palette, style sheet and fonts. One accent colour; meaning is never colour alone."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtGui import QColor, QFont, QFontDatabase, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from rvsim.gui.preferences import Preferences
from rvsim.language import language
from rvsim.resources import resource


class Theme(NamedTuple):
    """The colours of the window, "#rrggbb"; every text has a contrast of at least 4.5:1 on its ground."""

    window: str
    base: str
    raised: str
    text: str
    muted: str
    border: str
    accent: str
    on_accent: str
    good: str
    warning: str
    error: str
    dark: bool


THEMES = {
    "light": Theme(
        window="#f4f6f8",
        base="#ffffff",
        raised="#ffffff",
        text="#1a2129",
        muted="#55616d",
        border="#cfd6dd",
        accent="#0b5fc0",
        on_accent="#ffffff",
        good="#0b7a3e",
        warning="#8a5a00",
        error="#b42318",
        dark=False,
    ),
    "dark": Theme(
        window="#1b1f24",
        base="#14171b",
        raised="#262b32",
        text="#e7ebef",
        muted="#9fabb7",
        border="#3a424c",
        accent="#58a6ff",
        on_accent="#0c1622",
        good="#56d18a",
        warning="#f0b84a",
        error="#ff8a7a",
        dark=True,
    ),
}

_PRESENTATION_SCALE = 1.4
# Before the system's own font, for languages that it may lack; these bring only their own letters and digits.
_FAMILIES = {"ar": ("Noto Sans Arabic UI",)}

_STYLE = """
QMainWindow, QDialog {{ background: {window}; }}
QMainWindow::separator {{ background: {window}; width: 6px; height: 6px; }}
QMainWindow::separator:hover {{ background: {accent}; }}
QToolTip {{ background: {raised}; color: {text}; border: 1px solid {border}; padding: 4px; }}
QMenuBar {{ background: {window}; }}
QToolBar {{ background: {window}; border: none; spacing: 3px; padding: 4px 6px; }}
QToolBar::separator {{ background: {border}; width: 1px; margin: 4px 3px; }}
QToolButton {{ border: 1px solid transparent; border-radius: 5px; padding: 4px 6px; }}
QToolButton#qt_toolbar_ext_button {{ padding: 0; background: {raised}; border-color: {border}; }}
QToolButton:hover {{ background: {raised}; border-color: {border}; }}
QToolButton:checked, QToolButton:pressed {{ background: {raised}; border-color: {accent}; }}
QToolButton:focus {{ border-color: {accent}; }}
QToolButton[role="page"] {{ border: none; border-radius: 5px; padding: 4px 4px; color: {muted}; }}
QToolButton[role="page"]:hover {{ color: {text}; background: {raised}; }}
QToolButton[role="page"]:checked {{ color: {text}; background: {raised}; border: 1px solid {border};
    font-weight: 600; }}
QToolButton[role="page"]:focus {{ border: 1px solid {accent}; }}
QToolButton[role="stop"] {{ background: #b42318; color: #ffffff; border: 1px solid #b42318; border-radius: 5px;
    padding: 4px 10px; font-weight: 700; }}
QToolButton[role="stop"]:hover, QToolButton[role="stop"]:pressed {{ background: #8f1a12; }}
QToolButton[role="stop"]:focus {{ border: 2px solid {text}; padding: 3px 9px; }}
QPushButton {{ background: {raised}; border: 1px solid {border}; border-radius: 5px; padding: 5px 8px; }}
QPushButton:hover {{ border-color: {accent}; }}
QPushButton:pressed, QPushButton:checked {{ background: {window}; border-color: {accent}; }}
QPushButton:focus {{ border-color: {accent}; }}
QPushButton:disabled {{ color: {muted}; background: {window}; }}
QPushButton[primary="true"] {{ background: {accent}; color: {on_accent}; border-color: {accent}; font-weight: 600; }}
QPushButton[primary="true"]:focus {{ border: 2px solid {text}; padding: 4px 7px; }}
QPushButton[primary="true"]:disabled {{ background: {border}; border-color: {border}; color: {muted}; }}
QDockWidget {{ font-weight: 600; }}
QDockWidget::title {{ background: {window}; padding: 6px 8px; }}
QDockWidget > QWidget {{ font-weight: 400; }}
QTabBar::tab {{ background: transparent; padding: 6px 5px; border: none; border-bottom: 2px solid transparent;
    color: {muted}; }}
QTabBar::tab:selected {{ color: {text}; border-bottom-color: {accent}; }}
QTabBar::tab:hover {{ color: {text}; }}
QTabWidget::pane {{ border: none; border-top: 1px solid {border}; }}
QGroupBox {{ border: none; margin-top: 16px; font-weight: 600; }}
QGroupBox::title {{ subcontrol-origin: margin; left: 0; padding: 0 8px 0 0; }} /* bold needs more than Qt reckons */
QAbstractSpinBox, QLineEdit, QComboBox {{
    background: {base}; border: 1px solid {border}; border-radius: 5px; padding: 3px 6px; min-height: 20px;
    selection-background-color: {accent}; selection-color: {on_accent};
}}
QAbstractSpinBox:focus, QLineEdit:focus, QComboBox:focus {{ border-color: {accent}; }}
QAbstractSpinBox:read-only {{ background: {window}; }}
QAbstractSpinBox[outside="true"] {{ border: 2px dashed {error}; }}
QAbstractSpinBox[refused="true"] {{ border: 2px solid {error}; }}
QLabel#refusal_bubble {{ background: {raised}; color: {text}; border: 1px solid {error}; border-radius: 5px;
    padding: 6px; }}
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button {{ width: 0; border: none; }}
QComboBox::drop-down {{ border: none; width: 22px; }}
QComboBox::down-arrow {{ image: url({arrow}); width: 10px; height: 10px; }}
QComboBox QAbstractItemView {{ background: {raised}; border: 1px solid {border}; selection-background-color: {accent};
    selection-color: {on_accent}; }}
QTableView, QPlainTextEdit, QTextBrowser {{ background: {base}; border: 1px solid {border}; border-radius: 5px;
    gridline-color: {border}; selection-background-color: {accent}; selection-color: {on_accent}; }}
QHeaderView::section {{ background: {window}; color: {muted}; border: none; border-bottom: 1px solid {border};
    padding: 4px 6px; }}
QCheckBox::indicator {{ width: 14px; height: 14px; border: 1px solid {muted}; border-radius: 3px; background: {base}; }}
QCheckBox::indicator:hover, QCheckBox::indicator:focus {{ border-color: {accent}; }}
QCheckBox::indicator:checked {{ background: {accent}; border-color: {accent}; image: url({check}); }}
QCheckBox:focus {{ color: {accent}; }}
QScrollArea {{ border: none; background: transparent; }}
QStatusBar {{ background: {window}; border-top: 1px solid {border}; }}
QStatusBar::item {{ border: none; }}
QLabel#tool_card {{ background: {raised}; border: 1px solid {border}; border-radius: 6px; }}
QLabel[role="muted"] {{ color: {muted}; }}
QLabel[role="title"] {{ font-weight: 600; }}
QLabel[level="warning"] {{ color: {warning}; }}
QLabel[level="error"] {{ color: {error}; }}
QLabel[level="good"] {{ color: {good}; }}
"""


def apply_theme(app: QApplication, name: str, *, presentation: bool = False) -> Theme:
    """Dress the whole application; an application that is dressed so already is left alone, for that is slow."""
    theme = _prepare(app, name, presentation)
    if app.property("theme") == app.property("prepared_theme"):
        return theme
    app.setProperty("theme", app.property("prepared_theme"))
    shade = "dark" if theme.dark else "light"
    icons = {icon: resource("icons", f"{icon}-{shade}.svg").as_posix() for icon in ("arrow", "check")}
    app.setStyleSheet(_STYLE.format(**theme._asdict(), **icons))
    return theme


def _prepare(app: QApplication, name: str, presentation: bool) -> Theme:
    """Style, colours and font, which widgets may measure while they are made; all but the style sheet."""
    theme, asked = THEMES[name], f"{name} {presentation} {language().code}"
    if app.property("prepared_theme") != asked:
        app.setProperty("prepared_theme", asked)
        # Undressed and dressed anew it is ready in a quarter of the time that another dress over this one takes.
        app.setStyleSheet("")
        if app.style().name() != "fusion":
            app.setStyle("Fusion")
        app.setPalette(_palette(theme))
        app.setFont(_font(app, presentation))
        app.setProperty("text_scale", text_scale(presentation))
    return theme


def text_scale(presentation: bool) -> float:
    """How much larger than usual everything is."""
    return _PRESENTATION_SCALE if presentation else 1.0


def wear_theme(preferences: Preferences) -> None:
    """Dress the running application as the preferences say."""
    apply_theme(_application(), preferences["theme"], presentation=preferences["presentation"])


def prepare_theme(preferences: Preferences) -> None:
    """All of `wear_theme` but the style sheet: under it a widget is dressed again each time it is put into another.

    Widgets that are made now, and dressed together when all is in its place, take half the time.
    """
    _prepare(_application(), preferences["theme"], preferences["presentation"])


def _application() -> QApplication:
    app = QApplication.instance()
    assert isinstance(app, QApplication)
    return app


def set_role(widget: object, **properties: object) -> None:
    """Set the properties that the style sheet looks at, and let it look again."""
    assert isinstance(widget, QWidget)
    if all(widget.property(name) == value for name, value in properties.items()):
        return
    for name, value in properties.items():
        widget.setProperty(name, value)
    widget.style().unpolish(widget)
    widget.style().polish(widget)


def load_fonts() -> None:
    """Make the fonts in resources/fonts known."""
    for file in sorted(resource("fonts").glob("*.[ot]tf")):
        QFontDatabase.addApplicationFont(str(file))


def number_font(base: QFont) -> QFont:
    """The same font with digits of equal width, where the font has them."""
    font = QFont(base)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


def _font(app: QApplication, presentation: bool) -> QFont:
    natural = app.property("natural_point_size")
    if natural is None:
        natural = max(app.font().pointSizeF(), 9.0)
        app.setProperty("natural_point_size", natural)
        app.setProperty("natural_family", app.font().family())
    font = number_font(app.font())
    own = _FAMILIES.get(language().code, ())
    font.setFamilies([*own, app.property("natural_family")])
    font.setKerning(not own)  # the Arabic font kerns letters within a word as far apart as words
    font.setPointSizeF(float(natural) * text_scale(presentation))
    return font


def _palette(theme: Theme) -> QPalette:
    role = QPalette.ColorRole
    colors = {
        role.Window: theme.window,
        role.WindowText: theme.text,
        role.Base: theme.base,
        role.AlternateBase: theme.window,
        role.Text: theme.text,
        role.Button: theme.raised,
        role.ButtonText: theme.text,
        role.BrightText: theme.error,
        role.ToolTipBase: theme.raised,
        role.ToolTipText: theme.text,
        role.PlaceholderText: theme.muted,
        role.Highlight: theme.accent,
        role.HighlightedText: theme.on_accent,
        role.Link: theme.accent,
        role.Mid: theme.border,
        role.Dark: theme.border,
        role.Light: theme.raised,
        role.Midlight: theme.border,
    }
    palette = QPalette()
    for color_role, color in colors.items():
        palette.setColor(color_role, QColor(color))
    for color_role in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, color_role, QColor(theme.muted))
    return palette
