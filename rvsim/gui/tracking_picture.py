"""A picture of an arm on its path, painted without a screen: what `rvsim track --png` saves."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from rvsim.kinematics import link_transforms
from rvsim.motion import Tracking
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Camera
from rvsim.scene.build import compose
from rvsim.scene.palette import LIGHT
from rvsim.scene.paths import path_items

_WIDTH, _HEIGHT = 1280, 960
_AIR = 0.15  # about what is shown, as a part of its size


def save_tracking_picture(tracking: Tracking, path: str | Path) -> None:
    """Paint the arm at three quarters of what it reached (at home if nothing), and save it.

    Raises:
        FileWriteError: the file cannot be written, or its ending is no picture format.
    """
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtGui import QGuiApplication

    from rvsim.gui.picture import save_picture
    from rvsim.gui.theme import load_fonts

    application = QGuiApplication.instance() or QGuiApplication(["rvsim"])
    load_fonts()
    reached = np.flatnonzero(tracking.reached)
    q = tracking.q[reached[3 * len(reached) // 4]] if len(reached) else tracking.robot.home
    extras = path_items(tracking.path.points, tracking.reached, tracking.actual[reached], LIGHT)
    scene = compose(tracking.robot, q, LIGHT, extras=extras)
    camera = Camera(np.zeros(3), 1.0).fitted(_seen(tracking, q), _WIDTH, _HEIGHT)
    save_picture(scene, camera, path, _WIDTH, _HEIGHT)
    del application  # it had to live until here


def _seen(tracking: Tracking, q: FloatArray) -> FloatArray:
    """(2, 3) the box around base, arm and path, with some air [m]."""
    arm = link_transforms(tracking.robot, q)[:, :3, 3]
    points = np.concatenate([np.zeros((1, 3)), arm, tracking.path.points])
    air = _AIR * float(np.ptp(points, axis=0).max())
    return np.array([points.min(axis=0) - (air, air, 0.0), points.max(axis=0) + air])
