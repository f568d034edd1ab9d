"""What the laboratory shows in the scene: a solver's iterates as a fading arm, and the ellipse of source 002."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject

from rvsim.experiment import Experiment
from rvsim.gui.panels.laboratory import LaboratoryPanel
from rvsim.gui.panels.laboratory_contest import Iterates
from rvsim.gui.panels.laboratory_looks import SOLVER_LOOKS, SOURCE_002_LOOKS
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.kinematics import forward_kinematics
from rvsim.lab.source_002 import Comparison
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.scene.build import arm_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Color, Dots, Item, Label, Labels, Polyline, Triads
from rvsim.units import metres_from_millimetres

ITERATES_KEY = "iterates"
SOURCE_002_KEY = "source_002"
_MOST_ARMS = 9
_FAINT, _STRONG = 0.10, 0.60
_TARGET_AXES = 0.12  # in sizes of the arm


class LaboratoryScene(QObject):
    """Keeps the stage's layers `iterates` and `source_002` true to the laboratory."""

    def __init__(self, panel: LaboratoryPanel, session: Session, stage: Stage, preferences: Preferences) -> None:
        super().__init__(stage)
        self._stage, self._session, self._preferences = stage, session, preferences
        self._iterates: Iterates | None = None
        self._comparison: Comparison | None = None
        panel.contest.iterates_changed.connect(self._on_iterates)
        panel.source_002.comparison_changed.connect(self._on_comparison)
        session.changed.connect(self._on_session)
        preferences.changed.connect(self._on_preference)

    def _on_iterates(self, iterates: Iterates | None) -> None:
        self._iterates = iterates
        items = iterates_items(iterates, self._stage.palette) if iterates is not None else ()
        self._stage.set_layer(ITERATES_KEY, items)

    def _on_comparison(self, comparison: Comparison | None) -> None:
        self._comparison = comparison
        shown = comparison is not None and self._session.robot.name == "ur5e"
        items = comparison_items(comparison, self._stage.palette) if comparison is not None and shown else ()
        self._stage.set_layer(SOURCE_002_KEY, items)

    def _on_session(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            self._on_comparison(self._comparison)

    def _on_preference(self, name: str) -> None:
        if name == "theme":
            self._on_iterates(self._iterates)
            self._on_comparison(self._comparison)


def iterates_items(iterates: Iterates, palette: ScenePalette) -> tuple[Item, ...]:
    """The arm from faint at the start to strong at the result, the tool's way with a dot an iterate, and the target."""
    robot, q = iterates.robot, iterates.q
    color = _color(SOLVER_LOOKS[iterates.solver].light, SOLVER_LOOKS[iterates.solver].dark, palette)
    items: list[Item] = []
    chosen = _spread(q)
    for number, alpha in zip(chosen, np.linspace(_FAINT, _STRONG, len(chosen)), strict=True):
        key = f"{ITERATES_KEY}.{number}"
        items += arm_items(robot, q[number], palette, look="stick", labels=False, key=key, alpha=float(alpha))
    points = forward_kinematics(robot, q)[:, :3, 3]
    items.append(
        Triads(
            f"{ITERATES_KEY}.target",
            iterates.T[None],
            _TARGET_AXES * robot.size,
            letters=False,
        )
    )
    items.append(Polyline(f"{ITERATES_KEY}.way", points, color, 2.2))
    items.append(Dots(f"{ITERATES_KEY}.places", points, color, 6.0))
    items.append(Labels(f"{ITERATES_KEY}.names", _names(iterates, points, palette)))
    return tuple(items)


def _names(iterates: Iterates, points: FloatArray, palette: ScenePalette) -> tuple[Label, ...]:
    last = f"{tr(SOLVER_LOOKS[iterates.solver].short)}, {len(points) - 1}"
    target = Label(iterates.T[:3, 3], tr("target"), palette.text, (10.0, 18.0), 13.0)
    ends = (Label(points[0], tr("start"), palette.text), Label(points[-1], last, palette.text))
    return (*(end._replace(shift=(10.0, -10.0), size=13.0) for end in ends), target)


def _spread(q: FloatArray) -> list[int]:
    """At most a handful of iterates, the first and the last among them, evenly spread over the joints' way."""
    steps = np.abs(np.diff(q, axis=0)).max(axis=1, initial=0.0)
    way = np.concatenate([[0.0], np.cumsum(steps)])
    marks = np.linspace(0.0, way[-1], min(len(q), _MOST_ARMS))
    nearest = np.abs(way[None, :] - marks[:, None]).argmin(axis=1)
    return sorted({0, len(q) - 1, *nearest.tolist()})


def comparison_items(comparison: Comparison, palette: ScenePalette) -> tuple[Item, ...]:
    """The ellipse, and where the real arm is with the angles of the printed program."""
    targets, reached = (metres_from_millimetres(points) for points in (comparison[0].targets, comparison[0].reached))
    look = SOURCE_002_LOOKS["printed"]
    wrong = _color(look.light, look.dark, palette)
    names = (
        Label(targets[0], tr("ellipse"), palette.text, (10.0, -8.0), 13.0),
        Label(reached[0], tr("as printed"), palette.text, (10.0, -8.0), 13.0),
    )
    return (
        Polyline(f"{SOURCE_002_KEY}.ellipse", targets, palette.desired, 2.4),
        Dots(f"{SOURCE_002_KEY}.printed", reached, wrong, 5.0),
        Polyline(
            f"{SOURCE_002_KEY}.gap",
            np.stack([targets[0], reached[0]]),
            wrong,
            1.6,
            dashed=True,
        ),
        Labels(f"{SOURCE_002_KEY}.names", names),
    )


def _color(light: str, dark: str, palette: ScenePalette) -> Color:
    return Color.from_hex(dark if palette.background.red < 0.5 else light)
