"""What Undo and Redo say that they will do: "Undo: move joint 3"."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QUndoStack

from rvsim.experiment import TrajectoryTask
from rvsim.language import language, tr, tr_later

_TURNED = tr_later("Turn the tool along the trajectory")
_TRAJECTORY_EDITS = {
    "shape": tr_later("Edit the shape of the trajectory"),
    "placement": tr_later("Place the trajectory"),
    "height": tr_later("Set the height of the drawing plane"),
    **dict.fromkeys(("orientation", "turn_from", "turn_to", "pitch"), _TURNED),
}


class UndoWords(QObject):
    """Keeps the texts of the two actions true to the stack."""

    def __init__(self, undo: QAction, redo: QAction, stack: QUndoStack, parent: QObject) -> None:
        super().__init__(parent)
        self._undo, self._redo = undo, redo
        stack.undoTextChanged.connect(self._show_undo)
        stack.redoTextChanged.connect(self._show_redo)
        self._show_undo(stack.undoText())  # the stack may have steps: of a window in another language
        self._show_redo(stack.redoText())

    def _show_undo(self, text: str) -> None:
        self._undo.setText(undo_words(tr("Undo"), text))

    def _show_redo(self, text: str) -> None:
        self._redo.setText(undo_words(tr("Redo"), text))


def trajectory_words(before: TrajectoryTask, after: TrajectoryTask) -> str:
    """What was changed in a trajectory, as the text of an undo step."""
    changed = (words for name, words in _TRAJECTORY_EDITS.items() if getattr(before, name) is not getattr(after, name))
    return tr(next(changed, tr_later("Edit the trajectory")))


def undo_words(verb: str, text: str) -> str:
    """ "Undo: move joint 3" for "Move joint 3"; what is written in capitals stays so, and so do other languages."""
    if not text:
        return verb
    kept = text[1:2].isupper() or language().code != "en"
    small = text if kept else text[0].lower() + text[1:]
    return f"{verb}: {small}".replace("&", "&&")
