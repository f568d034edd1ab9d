"""What the target shows in the scene: the ghosts of all branches, the nearest pose, and the frame that is missed."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject

from rvsim.gui.branch_words import circled
from rvsim.gui.preferences import Preferences
from rvsim.gui.stage import Stage
from rvsim.gui.target import TargetControl
from rvsim.gui.target_solution import Answer
from rvsim.kinematics import forward_kinematics
from rvsim.language import tr
from rvsim.scene.ghosts import GHOST_KEY, Ghost, ghost_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Item, Label, Labels, Polyline, Triads

PANEL = "panel"  # the watcher for whom the ghosts are shown
_HERE = 1e-6  # [rad, m] a branch so close is where the arm is
_AWAY = 1e-6  # [m] a target so close is where the tool is
_FRAME = 0.10  # the length of the target's axes, in sizes of the arm


class TargetScene(QObject):
    """Keeps the stage's layer "target" true to the target."""

    def __init__(self, control: TargetControl, stage: Stage, preferences: Preferences) -> None:
        super().__init__(stage)
        self._control, self._stage, self._preferences = control, stage, preferences
        for signal in (control.changed, control.lit_changed, control.watched_changed):
            signal.connect(self._show)
        preferences.changed.connect(self._on_preference)

    def _on_preference(self, name: str) -> None:
        if name in ("theme", "look", "all_ghosts"):
            self._show()

    def _show(self) -> None:
        answer = self._control.answer
        items: tuple[Item, ...] = ()
        if answer is not None and self._control.is_watched:
            palette = self._stage.palette
            items = (*self._ghosts(answer, palette), *self._missed(answer, palette))
        self._stage.set_layer("target", items)

    def _ghosts(self, answer: Answer, palette: ScenePalette) -> tuple[Item, ...]:
        """The branches, all or the lit one alone; and where none will do, the nearest pose."""
        control, everything = self._control, self._preferences["all_ghosts"]
        ghosts = []
        if control.is_watched_by(PANEL) and answer.numeric is None:
            named = [(control.name_of(branch), branch) for branch in answer.branches]
            ghosts = [
                Ghost(name, circled(name), branch.q, branch.within_limits, name == control.lit, branch.distance < _HERE)
                for name, branch in named
                if everything or name == control.lit
            ]
        if control.nearest is not None:
            ghosts.append(
                Ghost("nearest", tr("nearest"), control.nearest.q, True, lit=not any(ghost.lit for ghost in ghosts))
            )
        return ghost_items(answer.question.robot, ghosts, palette, self._preferences["look"])

    def _missed(self, answer: Answer, palette: ScenePalette) -> tuple[Item, ...]:
        """The target's frame where the tool is not, and how far it is away."""
        control, robot = self._control, answer.question.robot
        reached = control.nearest.T if control.nearest is not None else None
        tool = reached if reached is not None else forward_kinematics(robot, control.session.q)
        frame = Triads(
            f"{GHOST_KEY}.target",
            control.T[None],
            _FRAME * robot.size,
            letters=False,
            alpha=0.9,
        )
        gap = np.stack([tool[:3, 3], control.T[:3, 3]])
        away = float(np.linalg.norm(gap[1] - gap[0])) > _AWAY
        if not (answer.missed or away):
            return ()
        items: list[Item] = [
            frame,
            Labels(f"{GHOST_KEY}.target.name", (_target_label(control.T, palette),)),
        ]
        if away:
            items.append(Polyline(f"{GHOST_KEY}.gap", gap, palette.unreached, 2.0, dashed=True))
        return tuple(items)


def _target_label(T: np.ndarray, palette: ScenePalette) -> Label:
    return Label(T[:3, 3], tr("target"), palette.unreached, (12.0, 36.0), 13.0)
