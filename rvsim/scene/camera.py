"""Where the eye is: orbit, pan, zoom, presets, projection and rays. A frozen value; every move gives a new one."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


class Ray(NamedTuple):
    """A line of sight: origin (3,) [m] and unit direction (3,), base axes."""

    origin: FloatArray
    direction: FloatArray


class Preset(NamedTuple):
    """A named direction of view [rad]."""

    azimuth: float
    elevation: float


_RIGHT_ANGLE = math.pi / 2
# Azimuth is measured as the eye's direction from the target, from the x axis towards y.
PRESETS = {
    "iso": Preset(math.radians(-50.0), math.radians(24.0)),
    "top": Preset(-_RIGHT_ANGLE, _RIGHT_ANGLE),
    "front": Preset(0.0, 0.0),
    "side": Preset(-_RIGHT_ANGLE, 0.0),
    # Source 000 draws with view(70, 10); its azimuth counts from the −y axis.
    "source": Preset(math.radians(70.0 - 90.0), math.radians(10.0)),
}
_CLOSEST, _FARTHEST = 1e-3, 1e4


@dataclass(frozen=True, eq=False)
class Camera:
    """An eye that looks at `target` (3,) from `distance` [m]; z is up.

    Args:
        azimuth, elevation: the direction from the target to the eye [rad].
        field_of_view: the vertical opening angle [rad]; also sets the scale of the orthographic view at the target.
        orthographic: parallel projection instead of perspective.
    """

    target: FloatArray
    distance: float
    azimuth: float = PRESETS["iso"].azimuth
    elevation: float = PRESETS["iso"].elevation
    field_of_view: float = math.radians(35.0)
    orthographic: bool = False

    # --- directions ------------------------------------------------------------------------------------------------

    @property
    def axes(self) -> FloatArray:
        """(3, 3) rows: right, up, and backward (from the target to the eye), base axes."""
        ca, sa = math.cos(self.azimuth), math.sin(self.azimuth)
        ce, se = math.cos(self.elevation), math.sin(self.elevation)
        return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])

    @property
    def eye(self) -> FloatArray:
        """(3,) where the eye is [m]."""
        return np.asarray(self.target + self.distance * self.axes[2])

    # --- matrices --------------------------------------------------------------------------------------------------

    def view_matrix(self) -> FloatArray:
        """(4, 4) base coordinates to eye coordinates (x right, y up, z towards the viewer)."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.axes
        matrix[:3, 3] = -self.axes @ self.eye
        return matrix

    def projection_matrix(self, width: float, height: float) -> FloatArray:
        """(4, 4) eye coordinates to OpenGL clip coordinates for a picture of that many pixels."""
        near, far = self._depth_range()
        aspect = max(width, 1.0) / max(height, 1.0)
        tangent = math.tan(self.field_of_view / 2)
        matrix = np.zeros((4, 4))
        if self.orthographic:
            half = tangent * self.distance
            matrix[0, 0], matrix[1, 1] = 1 / (half * aspect), 1 / half
            matrix[2, 2], matrix[2, 3], matrix[3, 3] = -2 / (far - near), -(far + near) / (far - near), 1.0
        else:
            matrix[0, 0], matrix[1, 1] = 1 / (tangent * aspect), 1 / tangent
            matrix[2, 2], matrix[2, 3] = -(far + near) / (far - near), -2 * far * near / (far - near)
            matrix[3, 2] = -1.0
        return matrix

    def _depth_range(self) -> tuple[float, float]:
        # The arm is never more than a few distances away; a fixed ratio keeps the depth buffer exact enough.
        if self.orthographic:
            return -50.0 * self.distance, 50.0 * self.distance
        return 0.01 * self.distance, 50.0 * self.distance

    def project(self, points: ArrayLike, width: float, height: float) -> FloatArray:
        """Pixels of points (..., 3): (..., 3) with x right, y down [pixels] and the depth before the eye [m].

        A point behind a perspective eye has a depth ≤ 0; its pixel means nothing.
        """
        eye_points = (np.asarray(points, dtype=np.float64) - self.eye) @ self.axes.T
        depth = -eye_points[..., 2]
        half = math.tan(self.field_of_view / 2)
        if self.orthographic:
            scale = np.full_like(depth, height / 2 / (half * self.distance))
        else:
            scale = height / 2 / half / np.maximum(depth, 1e-9)
        return np.stack(
            [width / 2 + eye_points[..., 0] * scale, height / 2 - eye_points[..., 1] * scale, depth], axis=-1
        )

    def ray(self, x: float, y: float, width: float, height: float) -> Ray:
        """The line of sight through a pixel."""
        half = math.tan(self.field_of_view / 2)
        right, up, back = self.axes
        u, v = (x - width / 2) / (height / 2) * half, (height / 2 - y) / (height / 2) * half
        if self.orthographic:
            return Ray(self.eye + self.distance * (u * right + v * up), -back)
        direction = u * right + v * up - back
        return Ray(self.eye, direction / np.linalg.norm(direction))

    def metres_per_pixel(self, height: float) -> float:
        """The size of a pixel at the target [m]."""
        return 2 * math.tan(self.field_of_view / 2) * self.distance / max(height, 1.0)

    # --- moves -----------------------------------------------------------------------------------------------------

    def orbited(self, azimuth: float, elevation: float) -> Camera:
        """Turned about the target by two angles [rad]; the elevation stops at the poles."""
        turned = math.remainder(self.azimuth + azimuth, math.tau)
        lifted = min(max(self.elevation + elevation, -_RIGHT_ANGLE), _RIGHT_ANGLE)
        return replace(self, azimuth=turned, elevation=lifted)

    def panned(self, right: float, down: float, height: float) -> Camera:
        """Moved so that what is under the pointer follows it by (right, down) pixels in a picture of that height."""
        shift = self.metres_per_pixel(height) * (-right * self.axes[0] + down * self.axes[1])
        return replace(self, target=self.target + shift)

    def zoomed(self, factor: float, x: float, y: float, width: float, height: float) -> Camera:
        """Nearer by `factor` (> 1), keeping the point of the target plane under pixel (x, y) where it is."""
        distance = min(max(self.distance / factor, _CLOSEST), _FARTHEST)
        scale = self.metres_per_pixel(height)
        offset = scale * ((x - width / 2) * self.axes[0] - (y - height / 2) * self.axes[1])
        return replace(self, distance=distance, target=self.target + offset * (1 - distance / self.distance))

    def zoomed_to_box(self, x0: float, y0: float, x1: float, y1: float, width: float, height: float) -> Camera:
        """So near that the pixel rectangle fills the picture."""
        box_width, box_height = max(abs(x1 - x0), 4.0), max(abs(y1 - y0), 4.0)
        factor = min(width / box_width, height / box_height)
        centred = self.panned(width / 2 - (x0 + x1) / 2, height / 2 - (y0 + y1) / 2, height)
        return centred.zoomed(factor, width / 2, height / 2, width, height)

    def fitted(self, bounds: ArrayLike, width: float, height: float) -> Camera:
        """From the same direction, with the box `bounds` (2, 3) [m] in view."""
        lower, upper = np.asarray(bounds, dtype=np.float64)
        corners = np.array(list(product(*zip(lower, upper, strict=True))))
        target = (lower + upper) / 2
        offsets = (corners - target) @ self.axes.T
        half = math.tan(self.field_of_view / 2)
        aspect = max(width, 1.0) / max(height, 1.0)
        wanted = np.maximum(np.abs(offsets[:, 0]) / aspect, np.abs(offsets[:, 1])) / half
        distance = float(np.max(wanted if self.orthographic else wanted + offsets[:, 2]))
        return replace(self, target=target, distance=min(max(1.05 * distance, _CLOSEST), _FARTHEST))

    def from_preset(self, name: str) -> Camera:
        """The same target and distance, seen from a named direction of `PRESETS`."""
        preset = PRESETS[name]
        return replace(self, azimuth=preset.azimuth, elevation=preset.elevation)
