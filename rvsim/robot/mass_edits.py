"""Edits of the mass data: a copy of the arm with another mass, centre of mass or moment of inertia of a link."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from rvsim.errors import RobotDefinitionError, UnknownNameError
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import LinkMass, Robot

MassKey = Literal["mass", "x", "y", "z", "xx", "yy", "zz"]
MASS_KEYS: tuple[MassKey, ...] = get_args(MassKey)
BY_HAND = tr_later("entered by hand")  # the source of a number of the user's own
_GUESSED = tr_later("a guess to start from: 1 kg half-way along the link")
_GUESSED_MASS = 1.0  # [kg]
_LEAST_INERTIA = 1e-3  # [kg m²]


def mass_value(link: LinkMass, key: MassKey) -> float:
    """One number of a link: mass [kg], centre of mass x, y, z [m], moments of inertia about it [kg m²]."""
    if key == "mass":
        return link.mass
    axis = "xyz".index(key[0])
    return float(link.com[axis]) if len(key) == 1 else float(link.inertia[axis, axis])


def with_mass_value(robot: Robot, link: int, key: MassKey, value: float) -> Robot:
    """A copy whose link `link` (from 0) has another mass, centre of mass or moment of inertia; then it is assumed.

    An arm without masses gets massless links first.

    Raises:
        UnknownNameError: no such key.
        RobotDefinitionError: not finite, or a negative mass or moment of inertia.
    """
    if key not in MASS_KEYS:
        raise UnknownNameError(tr_later("mass value"), key, MASS_KEYS)
    if not math.isfinite(value) or (value < 0.0 and key not in ("x", "y", "z")):
        raise RobotDefinitionError(
            robot.name, tr("link {link}: {key} must be finite, and no mass is negative.", link=link + 1, key=key)
        )
    masses = list(robot.masses or _massless(robot))
    masses[link] = _changed(masses[link], key, value)
    return replace(robot, masses=tuple(masses))


def with_guessed_masses(robot: Robot) -> Robot:
    """A copy whose links weigh 1 kg each, half-way between the joints at their ends: something to start from."""
    inertia = _LEAST_INERTIA * np.eye(3)
    middles = (np.round(0.5 * way, 12) for way in _links(robot))  # a quarter turn leaves 1e-17 behind
    return replace(robot, masses=tuple(LinkMass(_GUESSED_MASS, com, inertia, True, _GUESSED) for com in middles))


def _massless(robot: Robot) -> tuple[LinkMass, ...]:
    return (LinkMass(0.0, np.zeros(3), np.zeros((3, 3)), True, BY_HAND),) * robot.dof


def _changed(link: LinkMass, key: MassKey, value: float) -> LinkMass:
    marked = replace(link, assumed=True, source=BY_HAND)
    if key == "mass":
        return replace(marked, mass=value)
    axis = "xyz".index(key[0])
    com, inertia = np.array(link.com), np.array(link.inertia)
    if len(key) == 1:
        com[axis] = value
    else:
        inertia[axis, axis] = value
    return replace(marked, com=com, inertia=inertia)


def _links(robot: Robot) -> list[FloatArray]:
    """For each link the way (3,) from its DH frame to the joint at its other end."""
    if robot.convention == "standard":  # back to the joint that moves it
        return [-np.array([j.a, j.d * math.sin(j.alpha), j.d * math.cos(j.alpha)]) for j in robot.joints]
    # on to the next joint, or to the tool
    ways = [np.array([j.a, -j.d * math.sin(j.alpha), j.d * math.cos(j.alpha)]) for j in robot.joints[1:]]
    return [*ways, np.array(robot.T_flange_tool[:3, 3])]
