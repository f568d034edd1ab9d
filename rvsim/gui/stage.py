"""Turns the present moment into a scene: arm, floor, path, trail. The scene view is told; it asks nobody."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEasingCurve, QObject, QTimer, QVariantAnimation

from rvsim.experiment import Experiment
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.path_legend import Entry, PathLegend, path_entries
from rvsim.gui.preferences import Preferences
from rvsim.gui.scene_view import SceneView
from rvsim.gui.session import Session
from rvsim.kinematics import forward_kinematics
from rvsim.motion import Tracking, Trajectory
from rvsim.robot.arrays import FloatArray
from rvsim.scene.build import SceneOptions, compose
from rvsim.scene.palette import DARK, LIGHT, ScenePalette
from rvsim.scene.paths import path_items, trail_items
from rvsim.scene.primitives import Dots, Item, Polyline, Segments

_TRAIL_SAMPLES = 1500
_GLIDE_MS = 280
_TARGET_ROOM = 0.1  # [sizes] on each side: the target's axes
_PAGES = "inspect_"  # how the names of the inspector's layers begin
_MARKED_POINTS = 25  # more dots than these hide the line
_SCENE_SETTINGS = {"theme", "look", "show_frames", "show_labels", "show_floor", "show_trail", "length_unit"}


class Stage(QObject):
    """Keeps the scene view true to session, motion and preferences."""

    def __init__(
        self,
        session: Session,
        motion: MotionControl,
        preferences: Preferences,
        view: SceneView,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._motion, self._preferences, self._view = session, motion, preferences, view
        self._path: tuple[Item, ...] = ()
        self._legend = PathLegend(view)
        self._legend_more: tuple[Entry, ...] = ()
        self._trail = np.empty((0, 3))
        self._trail_times = np.empty(0)
        self._trail_up: NDArray[np.bool_] | None = None
        self._layers: dict[str, tuple[Item, ...]] = {}
        self._gripper: float | None = None  # that of a connected arm
        self._shown_opening = 1.0
        self._stale = QTimer(self, singleShot=True, interval=0)
        self._stale.timeout.connect(lambda: self._show_at(self._shown_q))
        self._from_q: FloatArray = session.q
        self._shown_q: FloatArray = session.q
        self._glide = QVariantAnimation(self)
        self._glide.setStartValue(0.0)
        self._glide.setEndValue(1.0)
        self._glide.setDuration(_GLIDE_MS)
        self._glide.setEasingCurve(QEasingCurve.Type.InOutCubic)
        self._glide.valueChanged.connect(self._on_glide)
        session.settled.connect(self._on_changed)
        session.tracking_changed.connect(self._on_tracking)
        motion.loaded.connect(self._on_loaded)
        motion.moved.connect(lambda _: self._show_opening())
        view.set_outliers(lambda: np.concatenate([self._target_corners(), self._drawn_corners()]))
        preferences.changed.connect(self._on_preference)
        self._show_legend()
        self.show()

    @property
    def palette(self) -> ScenePalette:
        """The scene's colours under the present theme."""
        return DARK if self._preferences["theme"] == "dark" else LIGHT

    @property
    def view(self) -> SceneView:
        """Where the scene is shown."""
        return self._view

    @property
    def motion(self) -> MotionControl:
        """What moves the arm that is shown."""
        return self._motion

    def show(self) -> None:
        """Compose the present moment and hand it to the view."""
        self._glide.stop()
        self._show_at(self._session.q)

    def set_layer(self, name: str, items: tuple[Item, ...]) -> None:
        """Show these items beside the arm, instead of those of the same name before, from the next picture on."""
        if items or self._layers.get(name):
            self._layers[name] = items
            self._stale.start()

    def show_gripper(self, opening: float | None) -> None:
        """Draw the gripper so far open, 0 (closed) … 1, whatever is played: as a connected arm has it.

        None: as the motion that is played has it.
        """
        self._gripper = None if opening is None else min(max(opening, 0.0), 1.0)
        self._show_opening()

    @property
    def opening(self) -> float:
        """How far the gripper that is drawn is open, 0 (closed) … 1."""
        return self._motion.opening if self._gripper is None else self._gripper

    def _show_opening(self) -> None:
        """From the next picture on: while the gripper moves, the arm need not."""
        if self.opening != self._shown_opening:
            self._stale.start()

    def explain(self, entries: tuple[Entry, ...]) -> None:
        """Tell these in the legend too, instead of those before: what a page draws beside the tracked path."""
        if entries != self._legend_more:
            self._legend_more = entries
            self._show_legend()

    def _show_legend(self) -> None:
        trail = bool(self._preferences["show_trail"])
        told = path_entries(self._session.tracking, self.palette, trail=trail)
        self._legend.show_entries((*told, *self._legend_more), self.palette)

    def _show_at(self, q: FloatArray) -> None:
        self._shown_q, self._shown_opening = q, self.opening
        self._stale.stop()
        options = SceneOptions(
            look=self._preferences["look"],
            frames=self._preferences["show_frames"],
            labels=self._preferences["show_labels"],
            floor=self._preferences["show_floor"],
            length_unit=self._preferences["length_unit"],
        )
        layers = (item for items in self._layers.values() for item in items)
        extras = (*self._path, *self._trail_now(), *layers)
        scene = compose(self._session.robot, q, self.palette, options, extras, opening=self._shown_opening)
        self._view.set_scene(replace(scene, bounds=self._with_path(scene.bounds)))

    def _with_path(self, bounds: FloatArray) -> FloatArray:
        """The box of the arm, widened to hold the tracked path: one that is out of reach must be seen to be so."""
        tracking = self._session.tracking
        if tracking is None:
            return bounds
        points = tracking.path.points
        return np.array([np.minimum(bounds[0], points.min(axis=0)), np.maximum(bounds[1], points.max(axis=0))])

    def _target_corners(self) -> FloatArray:
        """(k, 3) the box about a target that the arm has missed: it may lie outside of all that the arm reaches."""
        target, room = self._session.experiment.target, _TARGET_ROOM * self._session.robot.size
        if target is None:
            return np.empty((0, 3))
        return np.stack([target[:3, 3] - room, target[:3, 3] + room])

    def _drawn_corners(self) -> FloatArray:
        """(k, 3) what pages of the inspector draw beside the arm: arrows and ellipsoids may go far beyond its reach."""
        layers = (items for name, items in self._layers.items() if name.startswith(_PAGES))
        lines = [item.points for items in layers for item in items if isinstance(item, Polyline | Segments | Dots)]
        return np.concatenate([np.empty((0, 3)), *(points[np.isfinite(points).all(axis=1)] for points in lines)])

    def _trail_now(self) -> tuple[Item, ...]:
        """What the tool has drawn up to the present moment."""
        if not self._preferences["show_trail"] or not len(self._trail):
            return ()
        done = int(np.searchsorted(self._trail_times, self._motion.player.time + 1e-9))
        up = None if self._trail_up is None else self._trail_up[:done]
        return trail_items(self._trail[:done], self.palette, pen_up=up)

    # --- what changed ----------------------------------------------------------------------------------------------

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            self.show()
            if after.robot.name != before.robot.name:
                self._view.fit()
        elif after.q is not before.q and self._session.gliding and self._can_glide():
            self._from_q = self._shown_q
            self._glide.stop()
            self._glide.start()
        elif after.q is not before.q:
            self.show()

    def _can_glide(self) -> bool:
        return bool(self._preferences["animated"]) and self._view.isVisible()

    def _on_glide(self, share: float) -> None:
        """The arm is there at once in every number; the eye is led there."""
        goal = self._session.q
        if self._glide.state() == QVariantAnimation.State.Running and len(goal) == len(self._from_q):
            self._show_at(goal if share >= 1.0 else self._from_q + share * (goal - self._from_q))

    def _on_tracking(self, tracking: Tracking | None) -> None:
        self._path = self._path_items(tracking)
        self._trail_up = self._lifted()
        self._show_legend()
        self.show()

    def _on_loaded(self) -> None:
        self._trail_times, self._trail = self._sampled_trail()
        self._trail_up = self._lifted()
        self.show()

    def _on_preference(self, name: str) -> None:
        if name in _SCENE_SETTINGS:
            self._path = self._path_items(self._session.tracking)
            self._show_legend()
            self.show()

    # --- pieces ----------------------------------------------------------------------------------------------------

    def _path_items(self, tracking: Tracking | None) -> tuple[Item, ...]:
        if tracking is None:
            return ()
        few = tracking.samples <= _MARKED_POINTS
        path = tracking.path
        return path_items(path.points, tracking.reached, np.empty((0, 3)), self.palette, marks=few, pen_up=path.pen_up)

    def _sampled_trail(self) -> tuple[FloatArray, FloatArray]:
        """Times and tool points of the whole motion along the path; the way to it draws nothing."""
        trajectory = self._motion.player.trajectory
        if not isinstance(trajectory, Trajectory):
            return np.empty(0), np.empty((0, 3))
        times = np.linspace(trajectory.path_start, trajectory.duration, _TRAIL_SAMPLES)
        points = forward_kinematics(self._session.robot, trajectory.q(times))[..., :3, 3]
        return times, points

    def _lifted(self) -> NDArray[np.bool_] | None:
        """Whether the pen is up at each moment of the trail; None for a path that is drawn all the way."""
        tracking, trajectory = self._session.tracking, self._motion.player.trajectory
        if tracking is None or tracking.path.pen_up is None or not isinstance(trajectory, Trajectory):
            return None
        towards = np.ceil([trajectory.path_index(t) - 1e-9 for t in self._trail_times]).astype(int)
        another = towards.max(initial=0) >= tracking.samples  # path's motion: that of this one comes at once
        return None if another else np.asarray(tracking.path.pen_up[towards])
