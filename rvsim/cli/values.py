"""Typed numbers and expressions as the values of an arm: degrees and millimetres in, radians and metres out."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence

import numpy as np

from rvsim.cli.outcome import InputError
from rvsim.expressions import evaluate_in
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SEPARATOR = re.compile(r"[,;](?![^()]*\))")


def typed_numbers(option: str, text: str, names: Sequence[str], units: Sequence[str]) -> FloatArray:
    """As many numbers or expressions, separated by commas (or semicolons), as there are names; each in its unit."""
    parts = _SEPARATOR.split(text) if ";" not in text else text.split(";")
    if len(parts) != len(names):
        raise InputError(
            f"{option} needs {len(names)} values ({', '.join(names)}), separated by commas; found {len(parts)}."
        )
    return np.array([evaluate_in(unit, part) for unit, part in zip(units, parts, strict=True)])


def typed_joints(robot: Robot, option: str, text: str) -> FloatArray:
    """q (n,) of typed degrees and millimetres (units)."""
    from rvsim.lab.tables import joint_units, shown_factors

    return typed_numbers(option, text, robot.joint_names, joint_units(robot)) / shown_factors(robot)


def typed_lengths(robot: Robot, option: str, text: str | None, names: Sequence[str]) -> FloatArray | None:
    """Typed millimetres (units) in metres, one a name; None where nothing was typed."""
    from rvsim.lab.tables import length_unit, shown_length

    if text is None:
        return None
    return typed_numbers(option, text, names, [length_unit(robot)] * len(names)) / shown_length(robot, 1.0)


def near_joints(robot: Robot, options: argparse.Namespace) -> FloatArray:
    """q (n,) where the joints are said to be: home, when nothing was said."""
    return robot.home if options.near_deg is None else typed_joints(robot, "--near-deg", options.near_deg)
