"""The weight of each link, as an arrow at its centre of mass. Arithmetic only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics import link_transforms
from rvsim.robot import Robot
from rvsim.scene.arrows import ON_TOP, arrow_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Color, Dots, Item

FloatArray = NDArray[np.float64]

_KEY = f"{ON_TOP}weight"
_LONGEST = 0.22  # of the arm's size: the arrow of the heaviest link
_DOT = 9.0


def weight_items(robot: Robot, q: FloatArray, palette: ScenePalette) -> tuple[Item, ...]:
    """A dot in the joint's colour at each centre of mass, and an arrow downwards as long as the link is heavy."""
    heaviest = max((link.mass for link in robot.masses), default=0.0)
    if heaviest <= 0.0:
        return ()
    items: list[Item] = []
    for index, (at, link) in enumerate(zip(centers_of_mass(robot, q), robot.masses, strict=True)):
        down = np.array([0.0, 0.0, -_LONGEST * robot.size * link.mass / heaviest])
        items += arrow_items(f"{_KEY}.{index}", at, down, palette.text, palette, width=2.4)
        color = Color.from_hex(robot.joints[index].color)
        items += [
            Dots(f"{_KEY}.{index}.rim", at[None], palette.text, _DOT + 4.0),
            Dots(f"{_KEY}.{index}.dot", at[None], color, _DOT),
        ]
    return tuple(items)


def centers_of_mass(robot: Robot, q: FloatArray) -> FloatArray:
    """(n, 3) where the links' centres of mass are, base axes [m]."""
    T = link_transforms(robot, q)[1:]
    com = np.array([link.com for link in robot.masses])
    return np.asarray((T[:, :3, :3] @ com[..., None])[..., 0] + T[:, :3, 3])
