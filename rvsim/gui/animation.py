"""A motion as an animated picture: painted frame by frame, and written as GIF, APNG or WebP."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from PySide6.QtGui import QImage

from rvsim.errors import FileWriteError
from rvsim.files.atomic import write_atomically
from rvsim.gui.motion_control import Opening
from rvsim.gui.renderers.painter import scene_image
from rvsim.playback.player import Playable
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Camera
from rvsim.scene.build import SceneOptions, compose
from rvsim.scene.palette import ScenePalette
from rvsim.scene.paths import trail_items
from rvsim.scene.primitives import Item

FORMATS = {".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}
SIZES = ((480, 270), (640, 360), (854, 480), (1280, 720), (1920, 1080))
RATES = (5, 10, 15, 20, 25, 30)
MOST_BYTES = 1_200_000_000  # of all frames in memory
_HOLD = 0.8  # [s] the last frame stays longer, before it all begins again
# Measured on motions of several arms: bytes for a pixel that changes little from frame to frame.
_BYTES = {".gif": 0.04, ".png": 0.09, ".webp": 0.02}
_MOST_COLORS = 255  # of a GIF: one is left for "as before"
_ENCODING: dict[str, dict[str, Any]] = {".webp": {"quality": 82, "method": 2}, ".gif": {"optimize": False}}


@dataclass(frozen=True)
class AnimationSettings:
    """How large, how often, how fast: pixels, frames a second, seconds of the motion in a second."""

    width: int = 640
    height: int = 360
    rate: int = 15
    speed: float = 1.0
    loop: bool = True

    def frames(self, duration: float) -> int:
        """How many frames a motion of that duration [s] takes, its first and last moment among them."""
        return max(math.ceil(duration / self.speed * self.rate - 1e-9), 1) + 1

    def seconds(self, duration: float) -> float:
        """How long the animation runs [s]."""
        return (self.frames(duration) - 1) / self.rate + _HOLD

    def too_many(self, duration: float) -> bool:
        """Whether all frames together would need too much memory."""
        return 3 * self.frames(duration) * self.width * self.height > MOST_BYTES

    def times(self, duration: float) -> list[float]:
        """The moments of the motion that are shown [s]."""
        return [min(frame / self.rate * self.speed, duration) for frame in range(self.frames(duration))]

    def estimated_bytes(self, duration: float, ending: str) -> int:
        """About how large the file will be."""
        return round(self.frames(duration) * self.width * self.height * _BYTES[ending])


@dataclass(frozen=True, eq=False)
class Picturing:
    """All that a frame needs but the pose: the arm, how it is seen, and what stands beside it."""

    robot: Robot
    camera: Camera
    palette: ScenePalette
    options: SceneOptions
    extras: tuple[Item, ...] = ()
    trail_times: FloatArray = field(default_factory=lambda: np.empty(0))
    trail: FloatArray = field(default_factory=lambda: np.empty((0, 3)))
    opening_at: Opening = lambda _: 1.0

    def frame(self, time: float, q: FloatArray, settings: AnimationSettings) -> QImage:
        """The picture of a pose (n,) at a moment [s]: what the tool has drawn until then is there."""
        done = int(np.searchsorted(self.trail_times, time + 1e-9))
        extras = (*self.extras, *trail_items(self.trail[:done], self.palette))
        scene = compose(self.robot, q, self.palette, self.options, extras, opening=self.opening_at(time))
        return scene_image(scene, self.camera, settings.width, settings.height)


class Animation:
    """Frames are painted one at a time, each when `step` is called, then `encode` makes the file of them.

    Args:
        trajectory: the motion.
        picturing: how it is seen.
    """

    def __init__(self, trajectory: Playable, picturing: Picturing, settings: AnimationSettings) -> None:
        self.settings, self._trajectory, self._picturing = settings, trajectory, picturing
        self.total = settings.frames(trajectory.duration)
        self._left: Iterator[float] = iter(settings.times(trajectory.duration))
        self.frames: list[Image.Image] = []
        self.last: QImage | None = None  # painted
        self._given_up = False

    @property
    def share(self) -> float:
        """How much of it is painted, 0…1."""
        return len(self.frames) / self.total

    def step(self) -> bool:
        """Paint the next frame; False when all are painted."""
        time = next(self._left, None)
        if time is None:
            return False
        self.last = self._picturing.frame(time, self._trajectory.q(time), self.settings)
        self.frames.append(pillow_image(self.last))
        return len(self.frames) < self.total

    def encode(self, ending: str) -> bytes:
        """The file in the format of ".gif", ".png" (APNG) or ".webp", empty if it was given up; in any thread."""
        with suppress(_GivenUpError):
            return encoded(self.frames, self.settings, ending, self._go_on)
        return b""

    def give_up(self) -> None:
        """Let `encode` end soon; from any thread."""
        self._given_up = True

    def _go_on(self) -> None:
        if self._given_up:
            raise _GivenUpError


class _GivenUpError(Exception):
    """Nobody waits for the file any more."""


class _AskingFile(io.BytesIO):
    """A file in memory that calls `go_on` before it is written to."""

    def __init__(self, go_on: Callable[[], None]) -> None:
        super().__init__()
        self._go_on = go_on

    def write(self, data: Any) -> int:
        self._go_on()
        return super().write(data)


def pillow_image(image: QImage) -> Image.Image:
    """The same picture, opaque."""
    plain = image.convertToFormat(QImage.Format.Format_RGB888)
    size = (plain.width(), plain.height())
    return Image.frombuffer("RGB", size, bytes(plain.constBits()), "raw", "RGB", plain.bytesPerLine(), 1)


def encoded(
    frames: list[Image.Image], settings: AnimationSettings, ending: str, go_on: Callable[[], None] = lambda: None
) -> bytes:
    """The frames one after the other, the last one held for a moment; `go_on` is called often, and may raise."""
    between = 1000.0 / settings.rate
    ends = [round(between * (number + 1)) for number in range(len(frames) - 1)]
    durations = [end - start for start, end in zip([0, *ends], ends, strict=False)]
    durations.append(round(1000.0 * _HOLD))
    shown = _with_few_colors(frames, go_on) if ending == ".gif" else frames
    for frame in shown:
        vars(frame)["seek"] = partial(_turn_to, go_on)
    more: dict[str, Any] = dict(_ENCODING.get(ending, {}))
    if settings.loop or ending != ".gif":  # a GIF without the word plays once
        more["loop"] = 0 if settings.loop else 1
    file = _AskingFile(go_on)
    shown[0].save(file, FORMATS[ending], save_all=True, append_images=shown[1:], duration=durations, **more)
    return file.getvalue()


def _turn_to(go_on: Callable[[], None], page: int) -> None:
    """Pillow turns each picture to its pages when it comes to it: there is one."""
    go_on()
    if page:
        raise EOFError


def _with_few_colors(frames: list[Image.Image], go_on: Callable[[], None]) -> list[Image.Image]:
    """In the colours of the frame in the middle: one table for all, so that what rests does not flicker."""
    table = frames[len(frames) // 2].quantize(_MOST_COLORS, method=Image.Quantize.MAXCOVERAGE, kmeans=1)
    few = []
    for frame in frames:
        go_on()
        few.append(frame.quantize(palette=table, dither=Image.Dither.NONE))
    return few


def save_animation(data: bytes, path: Path) -> None:
    """Write it whole or not at all.

    Raises:
        FileWriteError: the file cannot be written.
    """
    try:
        write_atomically(path, data)
    except OSError as problem:
        raise FileWriteError(path, (problem.strerror or str(problem)).lower()) from None


def framed_for(camera: Camera, settings: AnimationSettings, width: int, height: int) -> Camera:
    """The camera of a view of that size, so that another shape of picture shows as much as it does."""
    narrower = (width / max(height, 1)) / (settings.width / settings.height)
    return replace(camera, distance=camera.distance * max(narrower, 1.0))
