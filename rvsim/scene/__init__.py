"""What is to be seen, as plain values: primitives, camera, and the builders that turn an arm into a scene. No Qt."""

from rvsim.scene.camera import PRESETS, Camera, Ray
from rvsim.scene.primitives import (
    Box,
    Capsule,
    Color,
    Dots,
    Item,
    Label,
    Labels,
    Polyline,
    Scene,
    Segments,
    Triads,
)

__all__ = [
    "PRESETS",
    "Box",
    "Camera",
    "Capsule",
    "Color",
    "Dots",
    "Item",
    "Label",
    "Labels",
    "Polyline",
    "Ray",
    "Scene",
    "Segments",
    "Triads",
]
