"""Source 002's algorithm as printed, misprints and all, beside the corrected one.

Both are the same Newton–Raphson iteration, Δq = J⁺ (p_target − p), position only, each point of the ellipse started
from the solution of the one before. They differ in what they take for p(q) and J(q), and in what happens to the angles
on the way: the source turns degrees into radians by three different numbers. The printed one believes itself within
its 1 mm everywhere; a real arm that is sent its angles is somewhere else.

How far exactly is an accident of the start: with the wrong Jacobian the first point takes a long way, and a ten
thousandth of a degree elsewhere ends on other angles, some hundred millimetres off as well.

Lengths and errors in this module are millimetres and angles radians, as in the source; the docstrings say where not.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.lab.drawings import ellipse
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import millimetres_from_metres

# Code 2 and 3 of the source: a2 and a3 are positive there, the table of the same source has them negative.
_D1, _A2, _A3, _D4, _D5, _D6 = 162.5, 425.0, 392.2, 133.3, 99.7, 99.6
_GUESS_DEG = (15.0, 20.0, 25.0, 10.0, 15.0, 12.0)
_INTO_GUESS, _INTO_NEXT, _INTO_PLOT = 0.0175, 0.01744, 0.01745
_ITERATIONS, _THRESHOLD = 300, 1.0
# As far as float64 can tell two places apart at this distance.
_FINEST = 1e-9


class Formulas(NamedTuple):
    """What an iteration takes for the tool's place (3,) and its derivatives (3, 6), in mm, of q (6,)."""

    position: Callable[[FloatArray], FloatArray]
    jacobian: Callable[[FloatArray], FloatArray]


class Recipe(NamedTuple):
    """One form of the algorithm.

    Args:
        title: what to call it.
        formulas: what it takes for the arm.
        threshold: on each axis [mm].
        next_factor: what the angles are multiplied with before they start the next point.
        sent_factor: what they are multiplied with before they are shown or sent.
    """

    title: str
    formulas: Formulas
    threshold: float
    next_factor: float
    sent_factor: float


class Run(NamedTuple):
    """A recipe followed along the ellipse.

    Args:
        title: of the recipe.
        targets: (m, 3) the ellipse [mm].
        q: (m, 6) the angles sent [rad].
        believed: (m, 3) where its own formulas say the tool is [mm].
        reached: (m, 3) where the real arm is with these angles [mm].
        iterations: (m,) of each point.
    """

    title: str
    targets: FloatArray
    q: FloatArray
    believed: FloatArray
    reached: FloatArray
    iterations: tuple[int, ...]

    @property
    def deviations(self) -> FloatArray:
        """(m,) distances of the real arm from the ellipse [mm]."""
        return np.asarray(np.linalg.norm(self.reached - self.targets, axis=1))

    @property
    def believed_deviations(self) -> FloatArray:
        """(m,) the distances that the recipe believes in [mm]."""
        return np.asarray(np.linalg.norm(self.believed - self.targets, axis=1))

    @property
    def rms(self) -> float:
        """Of the real arm's distances [mm]."""
        return float(np.sqrt(np.mean(self.deviations**2)))


class Comparison(NamedTuple):
    """The algorithm as printed, and corrected."""

    printed: Run
    corrected: Run


def compare_source_002(robot: Robot) -> Comparison:
    """Both recipes along the 184 points, judged by the arm's own forward kinematics (the UR5e's).

    As printed the real arm is 431 mm RMS away from the ellipse; corrected, by rounding only.
    """
    recipes = (printed_recipe(), corrected_recipe(robot))
    return Comparison(*(follow_ellipse(robot, recipe) for recipe in recipes))


def printed_recipe() -> Recipe:
    """Everything as the source's code has it."""
    next_factor, sent_factor = _INTO_NEXT / _INTO_GUESS, _INTO_PLOT / _INTO_GUESS
    formulas = Formulas(printed_position, printed_jacobian)
    return Recipe(tr_later("As printed"), formulas, _THRESHOLD, next_factor, sent_factor)


def corrected_recipe(robot: Robot) -> Recipe:
    """The same algorithm with the arm's kinematics and one measure of angles, followed until rounding stops it."""
    formulas = Formulas(
        lambda q: millimetres_from_metres(forward_kinematics(robot, q)[:3, 3]),
        lambda q: millimetres_from_metres(jacobian(robot, q)[:3]),
    )
    return Recipe(tr_later("Corrected"), formulas, _FINEST, 1.0, 1.0)


def follow_ellipse(robot: Robot, recipe: Recipe) -> Run:
    """Solve point after point, and ask the real arm where it is."""
    targets = millimetres_from_metres(ellipse())
    guess = _INTO_GUESS * np.array(_GUESS_DEG)
    solved: list[FloatArray] = []
    iterations: list[int] = []
    for target in targets:
        path = iterate(recipe, target, guess)
        solved.append(path[-1])
        iterations.append(len(path))
        guess = path[-1] * recipe.next_factor
    q = np.array(solved) * recipe.sent_factor
    believed = np.array([recipe.formulas.position(angles) for angles in solved])
    reached = millimetres_from_metres(forward_kinematics(robot, q)[:, :3, 3])
    return Run(recipe.title, targets, q, believed, reached, tuple(iterations))


def iterate(recipe: Recipe, target: FloatArray, guess: FloatArray) -> FloatArray:
    """(k, 6) the iterates of one point, target (3,) in mm: the last is where the error was found to be small enough.

    At most 300, as in the source.
    """
    path = [guess]
    for _ in range(_ITERATIONS - 1):
        error = target - recipe.formulas.position(path[-1])
        if np.max(np.abs(error)) <= recipe.threshold:
            break
        path.append(path[-1] + np.linalg.pinv(recipe.formulas.jacobian(path[-1])) @ error)
    return np.array(path)


class _Angles(NamedTuple):
    """Sines and cosines of q, and of the sums q2 + q3 and q2 + q3 + q4."""

    s: tuple[float, ...]
    c: tuple[float, ...]
    s23: float
    c23: float
    s234: float
    c234: float


def _angles(q: FloatArray) -> _Angles:
    h = [float(angle) for angle in q]
    two, three = h[1] + h[2], h[1] + h[2] + h[3]
    sines, cosines = tuple(map(math.sin, h)), tuple(map(math.cos, h))
    return _Angles(sines, cosines, math.sin(two), math.cos(two), math.sin(three), math.cos(three))


def printed_position(q: FloatArray) -> FloatArray:
    """posx, posy, posz (3,) [mm] of code 2: d6 without sin q5 in x and missing in y, a2 and a3 positive."""
    (s1, s2, _, _, s5, _), (c1, c2, _, _, c5, _), s23, c23, s234, c234 = _angles(q)
    x = _D5 * c1 * s234 + _D4 * s1 - _D6 * c1 * c234 + _A2 * c1 * c2 + _D6 * c5 * s1 + _A3 * c1 * c23
    y = _D5 * s1 * s234 - _D4 * c1 - _D6 * c1 * c5 + _A2 * c2 * s1 + _A3 * s1 * c23
    z = _D1 - _D6 * s234 * s5 + _A3 * s23 + _A2 * s2 - _D5 * c234
    return np.array([x, y, z])


def printed_jacobian(q: FloatArray) -> FloatArray:
    """dposx_1 … dposz_6 (3, 6) of code 2.

    Most d6 terms lack sin q5, ∂y/∂q3 has one term with the wrong sign, ∂x/∂q5 and ∂y/∂q5 lack a term each. The lines
    of the fourth column cannot be read in the published copy; they are what the column of q3 is without a3.
    """
    s, c, s23, c23, s234, c234 = _angles(q)
    lever_x, lever_y = (_D5 * factor * c234 + _D6 * factor * s234 for factor in (c[0], s[0]))
    fall = _D5 * s234 - _D6 * c234 * s[4]
    across = _D4 * c[0] + _D6 * c[4] * c[0] - s[0] * (_D5 * s234 - _D6 * c234 + _A2 * c[1] + _A3 * c23)
    along = _D4 * s[0] + _D6 * c[4] * s[0] + c[0] * (_D5 * s234 - _D6 * c234 + _A2 * c[1] + _A3 * c23)
    upper_arm, forearm = _A2 * s[1] + _A3 * s23, _A3 * s23
    wrong_sign = _A3 * (c[1] * s[2] - s[1] * c[2])
    columns = [
        (across, along, 0.0),
        (lever_x - c[0] * upper_arm, lever_y - s[0] * upper_arm, fall + _A3 * c23 + _A2 * c[1]),
        (lever_x - c[0] * forearm, lever_y + s[0] * wrong_sign, fall + _A3 * c23),
        (lever_x, lever_y, fall),
        (-_D6 * s[4] * s[0], _D6 * c[0] * s[4], -_D6 * s234 * c[4]),
        (0.0, 0.0, 0.0),
    ]
    return np.array(columns).T
