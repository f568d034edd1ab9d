"""The window's language: Qt's own words, the direction of writing, the fonts; and which one the system speaks."""

from __future__ import annotations

from PySide6.QtCore import QLibraryInfo, QLocale, Qt, QTranslator
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QApplication, QMainWindow, QMenu

from rvsim.gui.preferences import Preferences
from rvsim.language import LANGUAGES, catalogue_file, language, speak, tr

_NAME = "qt_words"  # of the translator of Qt's own dialogs and buttons


def system_language() -> str:
    """The code of the first language of this system that rvsim speaks; English where it speaks none."""
    wanted = (name.partition("-")[0] for name in QLocale.system().uiLanguages())
    return next((code for code in wanted if code in LANGUAGES), "en")


def wear_language(app: QApplication, code: str) -> None:
    """Speak a language in all windows that are made from now on.

    Numbers are typed and shown as ever, with Western digits and a point: formulas and files have them so too.
    """
    speak(code)
    QLocale.setDefault(QLocale.c())
    _translate_qt(app, code)
    right_to_left = LANGUAGES[code].right_to_left
    app.setLayoutDirection(Qt.LayoutDirection.RightToLeft if right_to_left else Qt.LayoutDirection.LeftToRight)


def _translate_qt(app: QApplication, code: str) -> None:
    """Qt's own words, and before them those that it has not, or says otherwise than the window."""
    for old in app.findChildren(QTranslator, _NAME):
        app.removeTranslator(old)
        old.setParent(None)
    for file in (f"{QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)}/qtbase_{code}", _own_words(code)):
        translator = QTranslator(app)
        translator.setObjectName(_NAME)
        if translator.load(file):
            app.installTranslator(translator)


def _own_words(code: str) -> str:
    return str(catalogue_file(code).with_name(f"qt_{code}.qm"))


def language_menu(window: QMainWindow, preferences: Preferences) -> QMenu:
    """Each language under its own name for itself; in the title English too, for who has gone astray."""
    title = tr("Language")
    menu = QMenu(title if title == "Language" else f"{title} (Language)", window)
    menu.setObjectName("language_menu")
    group = QActionGroup(menu)
    for code, one in LANGUAGES.items():
        action = group.addAction(one.name)
        action.setObjectName(f"action_language_{code}")
        action.setCheckable(True)
        action.setChecked(code == language().code)
        action.triggered.connect(lambda _checked=False, code=code: preferences.set("language", code))
        menu.addAction(action)
    return menu
