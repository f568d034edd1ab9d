"""Which closed form fits an arm: the families' conditions are asked of its numbers, never of its name."""

from __future__ import annotations

from functools import lru_cache

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.inverse.chain import canonical_chain
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.rrrp import RollAndExtend
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.kinematics.inverse.textbook import Articulated, Cartesian, Cylindrical, Planar, Scara, Spherical
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.language import tr
from rvsim.robot import Robot

FAMILIES: tuple[type[ClosedForm], ...] = (
    FiveAxis,
    ParallelAxes,
    SphericalWrist,
    RollAndExtend,
    Planar,
    Articulated,
    Spherical,
    Scara,
    Cylindrical,
    Cartesian,
)


@lru_cache(maxsize=64)
def closed_form(robot: Robot) -> ClosedForm:
    """The closed form of an arm.

    Raises:
        NoClosedFormError: it breaks a condition of each family of its joint types; the message says which.
    """
    chain = canonical_chain(robot)
    failures = []
    for family in FAMILIES:
        if family.joints == chain.joints:
            failure = family.failure(chain)
            if not failure:
                return family(chain)
            failures.append(_not_as(family.title, failure))
    known = ", ".join(sorted({family.joints for family in FAMILIES}))
    raise NoClosedFormError(
        robot.name,
        " ".join(failures) or tr("its joints are {joints}; known are {known}.", joints=chain.joints, known=known),
    )


def _not_as(title: str, failure: str) -> str:
    if title[0] in "aeiou":
        return tr("as an {family}, {failure}", family=tr(title), failure=failure)
    return tr("as a {family}, {failure}", family=tr(title), failure=failure)


def branch_labels(robot: Robot) -> tuple[str, ...]:
    """One name for each column of `inverse_kinematics_batch`, for instance "front, elbow up".

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    return closed_form(robot).labels


def five_axis(form: ClosedForm, purpose: str) -> FiveAxis:
    """The closed form as that of a 5R arm.

    Raises:
        NoClosedFormError: it is none; `purpose` says what only such an arm can do, for instance "a pitch is free".
    """
    if not isinstance(form, FiveAxis):
        raise NoClosedFormError(
            form.chain.robot.name, tr("{purpose} only for a {family}.", purpose=purpose, family=tr(FiveAxis.title))
        )
    return form
