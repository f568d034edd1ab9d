"""The families of singular poses an arm has, in closed form, from the shape of its DH table.

Each family is the common zero of one or two terms of the joints, for instance sin q₃ or the distance r of the wrist
from the base axis. They belong to the shape (waist, parallel axes, wrist …), never to the name: arms of the user have
them too. Sources: Siciliano et al., Robotics (2009), §3.3; Spong, Hutchinson, Vidyasagar (2006), §4.9; the terms of
each shape follow from its axes (three parallel axes give two translations and a turn unless they lie in one plane).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.inverse.chain import Chain, canonical_chain
from rvsim.kinematics.inverse.closed_form import ClosedForm, is_zero
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.projection import has_tip_on_roll_axis
from rvsim.kinematics.inverse.rrrp import RollAndExtend
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.kinematics.inverse.textbook import Articulated, Cartesian, Cylindrical, Planar, Scara, Spherical
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats

FamilyKind = Literal["boundary", "internal"]
FamilyPart = Literal["pose", "position"]

ACTIVE = 1e-6  # of a term (of a length: in arm sizes): the family is active

# What a family is called, by its name: in a sentence, and as a heading.
_NAMES: Mapping[str, tuple[str, str]] = {
    "elbow": (tr_later("elbow"), tr_later("Elbow")),
    "shoulder": (tr_later("shoulder"), tr_later("Shoulder")),
    "wrist": (tr_later("wrist"), tr_later("Wrist")),
    "coaxial": (tr_later("coaxial"), tr_later("Coaxial")),
    "stretched": (tr_later("stretched"), tr_later("Stretched")),
    "tip on axis": (tr_later("tip on axis"), tr_later("Tip on axis")),
    "zero extension": (tr_later("zero extension"), tr_later("Zero extension")),
}
KIND_TITLES: Mapping[FamilyKind, str] = {"boundary": tr_later("boundary"), "internal": tr_later("internal")}


class Term(NamedTuple):
    """What is zero at the singularity: its symbol and formula in LaTeX, whether it is a length [m], and its value."""

    symbol: str
    formula: str
    is_length: bool
    of: Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class SingularFamily:
    """One family: all poses at which each of its `terms` is 0.

    Args:
        name: for instance "elbow".
        kind: "boundary" where the arm is stretched or folded, at an edge of its reach; else "internal".
        part: "pose" where the Jacobian of the arm's own task loses rank, "position" where only the linear part does.
        meaning: what has happened to the arm there, and what it loses, in English; `sentence` says it.
        terms: one or two.
    """

    robot: Robot
    name: str
    kind: FamilyKind
    part: FamilyPart
    meaning: str
    terms: tuple[Term, ...]

    @property
    def title(self) -> str:
        """The name with what it is, for instance "stretched singularity of the position"."""
        if self.part == "position":
            return tr("{name} singularity of the position", name=self.short_title)
        return tr("{name} singularity", name=self.short_title)

    @property
    def short_title(self) -> str:
        """The name in the language that is spoken."""
        return tr(_NAMES[self.name][0])

    @property
    def heading(self) -> str:
        """The same where nothing stands before it."""
        return tr(_NAMES[self.name][1])

    @property
    def kind_title(self) -> str:
        """The kind in the language that is spoken."""
        return tr(KIND_TITLES[self.kind])

    @property
    def sentence(self) -> str:
        """What has happened to the arm there, and what it loses."""
        return tr(self.meaning)

    @property
    def formula(self) -> str:
        """The condition in LaTeX, for instance r = 0 and cos φ = 0."""
        return r",\quad ".join(f"{term.formula} = 0" for term in self.terms)

    def values(self, q: ArrayLike) -> FloatArray:
        """(..., k) the terms at q (..., n): numbers −1…1, or lengths [m].

        Raises:
            ShapeError: the last axis of q is not the number of joints.
        """
        joints = floats("q", q, self.robot.dof)
        return np.stack([np.asarray(term.of(joints), np.float64) for term in self.terms], axis=-1)

    def scaled(self, q: ArrayLike) -> FloatArray:
        """(..., k) the same, lengths in sizes of the arm."""
        return np.asarray(self.values(q) / [self.robot.size if term.is_length else 1.0 for term in self.terms])

    def measure(self, q: ArrayLike) -> FloatArray:
        """(...) how far q (..., n) is from the family: the largest of the scaled terms, 0 on it."""
        return np.asarray(np.abs(self.scaled(q)).max(axis=-1))


@lru_cache(maxsize=64)
def singular_families(robot: Robot) -> tuple[SingularFamily, ...]:
    """All families the arm has: those of its own task first, then those of the position alone.

    () for an arm that has none, and for one whose shape is not known here: `families_known` tells.
    """
    try:
        form = closed_form(robot)
    except NoClosedFormError:
        return ()
    return tuple(_OF_FORM[type(form)](_Terms(canonical_chain(robot)), form))


def families_known(robot: Robot) -> bool:
    """Whether the arm has a shape whose families are known; of any other arm only the numbers are."""
    try:
        closed_form(robot)
    except NoClosedFormError:
        return False
    return True


class _Terms:
    """Terms of one arm, written with the variables θ = sign · q + offset of its normal form."""

    def __init__(self, chain: Chain) -> None:
        self.chain = chain
        self.a = [float(value) for value in chain.a]
        self.d = [float(value) for value in chain.d]
        self.tip = [float(value) for value in chain.T_n_tool[:3, 3]]

    def family(self, name: str, kind: FamilyKind, part: FamilyPart, meaning: str, *terms: Term) -> SingularFamily:
        """One family of this arm."""
        return SingularFamily(self.chain.robot, name, kind, part, meaning, terms)

    def sine(self, joint: int, zero: float = 0.0) -> Term:
        """The sine of a joint (from 0), 0 where θ = zero."""
        sign = float(self.chain.sign[joint])
        at = math.remainder(sign * (zero - float(self.chain.offset[joint])), math.tau)
        symbol = rf"\sin q_{{{joint + 1}}}"
        if min(abs(at), math.pi - abs(at)) < 1e-9:
            at = 0.0
        else:
            symbol = rf"\sin(q_{{{joint + 1}}} {'-' if at > 0 else '+'} {abs(math.degrees(at)):.4g}^\circ)"
        return Term(symbol, symbol, False, lambda q: np.sin(q[..., joint] - at))

    def reach(self, symbol: str, formula: str, links: list[tuple[float, float]], first: int = 1) -> Term:
        """How far out a point stands in the arm's plane: a1 and links (length, lift) at the joints from `first` on."""
        start = self.a[0]

        def out(q: FloatArray) -> FloatArray:
            bends = np.cumsum(self.chain.inner(q)[..., first : first + len(links)], axis=-1)
            lengths, lifts = np.array(links).T
            return np.asarray(start + (lengths * np.cos(bends + lifts)).sum(axis=-1))

        return Term(symbol, rf"{symbol} = {formula}" if formula else symbol, True, out)

    def plain(self, *joints: int) -> bool:
        """Whether these joints' θ (from 0) are their DH angles: then the textbook's formula holds letter by letter."""
        robot, chain = self.chain.robot, self.chain
        return robot.convention == "standard" and all(
            chain.sign[i] == 1.0 and math.isclose(chain.offset[i], robot.dh[i, 0], abs_tol=1e-12) for i in joints
        )


def _straight(a2: float, forearm: float) -> float:
    """θ3 of a stretched arm with the lengths a2 and forearm (≥ 0)."""
    return 0.0 if a2 * forearm > 0.0 else math.pi


_ELBOW_TO_WRIST = tr_later(
    "The elbow is stretched or folded: the links are in line, and the wrist cannot move along them. "
    "It is an edge of the reach."
)
_ELBOW_TO_CENTRE = tr_later(
    "The elbow is stretched or folded: the links are in line, and the wrist centre cannot move along them. "
    "It is an edge of the reach."
)
_ELBOW_TO_TIP = tr_later(
    "The elbow is stretched or folded: the links are in line, and the tip cannot move along them. "
    "It is an edge of the reach."
)
_ELBOW_TO_AXIS = tr_later(
    "The elbow is stretched or folded: the links are in line, and the tool axis cannot move along them. "
    "It is an edge of the reach."
)
_TIP_OVER_AXIS = tr_later("The tip is over the base axis: joint 1 cannot move it sideways.")


def _five_axis(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    a, d, tip = terms.a, terms.d, terms.tip
    last = (math.hypot(a[3], d[4] + tip[2]), math.atan2(-(d[4] + tip[2]), a[3]))
    r = terms.reach("r", _five_axis_reach(terms), [(a[1], 0.0), (a[2], 0.0), last])
    elbow = terms.sine(2, _straight(a[1], a[2]))
    tilt = Term(r"\cos\varphi", r"\cos\varphi", False, lambda q: np.sin(terms.chain.inner(q)[..., 1:4].sum(axis=-1)))
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_WRIST, elbow)
    yield terms.family(
        "coaxial",
        "internal",
        "pose",
        tr_later(
            "The tool stands upright on the base axis: the roll axis and the base axis are one, and joints 1 and 5 do "
            "the same."
        ),
        r,
        tilt,
    )
    if not has_tip_on_roll_axis(terms.chain):
        return
    yield terms.family(
        "tip on axis",
        "internal",
        "position",
        tr_later("The tip is on the base axis: joint 1 cannot move it sideways."),
        r,
    )
    stretched = [elbow, terms.sine(3, -last[1])] if last[0] > 1e-9 else [elbow]
    yield terms.family(
        "stretched",
        "boundary",
        "position",
        tr_later("Upper arm, forearm and hand are in line: the tip cannot move along them."),
        *stretched,
    )


def _five_axis_reach(terms: _Terms) -> str:
    if not terms.plain(1, 2) or terms.a[0] or terms.a[3]:
        return ""
    hand = "(d_5 + d_t)" if terms.tip[2] else "d_5"
    return rf"a_2 c_2 + a_3 c_{{23}} + {hand} \cos\varphi"


def _parallel_axes(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    a, d = terms.a, terms.d
    formula = r"a_2 c_2 + a_3 c_{23} + d_5 s_{234}" if terms.plain(1, 2, 3) and not (a[0] or a[3]) else ""
    links = [(a[1], 0.0), (a[2], 0.0), (math.hypot(a[3], d[4]), math.atan2(-d[4], a[3]))]
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_WRIST, terms.sine(2, _straight(a[1], a[2])))
    yield terms.family(
        "shoulder",
        "internal",
        "pose",
        tr_later(
            "The point where axes 5 and 6 meet is beside or on the base axis, in the plane of axes 1 and 2: it cannot "
            "move along the shoulder's axis."
        ),
        terms.reach("r_w", formula, links),
    )
    yield terms.family(
        "wrist",
        "internal",
        "pose",
        tr_later(
            "Axis 6 is parallel to axes 2, 3 and 4: it turns the tool as they do, and a turn about an axis square to "
            "axes 5 and 6 is lost."
        ),
        terms.sine(4),
    )


def _spherical_wrist(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    a, d = terms.a, terms.d
    forearm, lift = math.hypot(a[2], d[3]), math.atan2(-d[3], a[2])
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_CENTRE, terms.sine(2, _straight(a[1], forearm) - lift))
    yield terms.family(
        "shoulder",
        "internal",
        "pose",
        tr_later("The wrist centre is over the base axis: joint 1 cannot move it sideways."),
        terms.reach("r_w", "", [(a[1], 0.0), (forearm, lift)]),
    )
    yield terms.family(
        "wrist",
        "internal",
        "pose",
        tr_later(
            "Axes 4 and 6 are one line: both turn the tool in the same way, and a turn about an axis square to axes 5 "
            "and 6 is lost."
        ),
        terms.sine(4),
    )


def _roll_and_extend(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    if is_zero(abs(terms.a[0]) - abs(terms.a[1])):
        yield from _coaxial_extension(terms)
    if has_tip_on_roll_axis(terms.chain):
        yield from _extension(terms, "position", terms.a[1], 3, terms.d[2] + terms.tip[2])


def _coaxial_extension(terms: _Terms) -> Iterator[SingularFamily]:
    """Only where axis 3 can come upon axis 1: upright, and beside the shoulder by a2 = ±a1."""
    side = math.copysign(1.0, -terms.a[0] * terms.a[1])
    half = Term(r"\sin\tfrac{1}{2}\theta_2", r"\sin\tfrac{1}{2}\theta_2", False, lambda q: _half(terms, q, side))
    sentence = tr_later("The roll axis and the base axis are one: joints 1 and 3 do the same.")
    yield terms.family("coaxial", "internal", "pose", sentence, half)


def _half(terms: _Terms, q: FloatArray, side: float) -> FloatArray:
    turned = 0.5 * terms.chain.inner(q)[..., 1]
    return np.asarray(np.sin(turned) if side > 0.0 else np.cos(turned))


def _extension(terms: _Terms, part: FamilyPart, across: float, joint: int, fixed: float) -> Iterator[SingularFamily]:
    """A point at across · x2 + L · z2 from the shoulder, L = the prismatic joint and what is fixed."""
    length = Term("L", "L", True, lambda q: terms.chain.inner(q)[..., joint] + fixed)

    def out(q: FloatArray) -> FloatArray:
        theta2 = terms.chain.inner(q)[..., 1]
        return np.asarray(terms.a[0] + across * np.cos(theta2) + length.of(q) * np.sin(theta2))

    sentence = tr_later(
        "The tip is on the base axis, or in the plane of axes 1 and 2: joint 1 cannot move it sideways."
    )
    yield terms.family("tip on axis", "internal", part, sentence, Term("r", "r", True, out))
    kind: FamilyKind = "internal" if is_zero(across) else "boundary"
    sentence = tr_later(
        "The arm is drawn in to its shoulder: joint 2 moves the tip only along the extension, or not at all."
    )
    yield terms.family("zero extension", kind, part, sentence, length)


def _spherical(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    theta, tip = float(terms.chain.theta[2]), terms.tip
    across = terms.a[1] + math.cos(theta) * tip[0] - math.sin(theta) * tip[1]
    return _extension(terms, "pose", across, 2, tip[2])


def _planar(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    zero = _straight(terms.a[0], 1.0) - math.atan2(terms.tip[1], terms.tip[0])
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_TIP, terms.sine(1, zero))


def _scara(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    theta = float(terms.chain.theta[2])
    link = complex(terms.a[1]) + terms.a[2] * complex(math.cos(theta), math.sin(theta))
    zero = _straight(terms.a[0], 1.0) - math.atan2(link.imag, link.real)
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_AXIS, terms.sine(1, zero))


def _articulated(terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    forearm, lift = math.hypot(*terms.tip[:2]), math.atan2(terms.tip[1], terms.tip[0])
    zero = _straight(terms.a[1], 1.0) - lift
    yield terms.family("elbow", "boundary", "pose", _ELBOW_TO_TIP, terms.sine(2, zero))
    yield terms.family(
        "shoulder",
        "internal",
        "pose",
        _TIP_OVER_AXIS,
        terms.reach("r", "", [(terms.a[1], 0.0), (forearm, lift)]),
    )


def _cylindrical(terms: _Terms, form: ClosedForm) -> Iterator[SingularFamily]:
    assert isinstance(form, Cylindrical)
    fixed = float(form.origin[:2] @ form.outward[:2])
    out = Term("r", "r", True, lambda q: terms.chain.inner(q)[..., 2] + fixed)
    sentence = _TIP_OVER_AXIS
    yield terms.family("tip on axis", "internal", "pose", sentence, out)


def _none(_terms: _Terms, _form: ClosedForm) -> Iterator[SingularFamily]:
    return iter(())


_OF_FORM: Mapping[type[ClosedForm], Callable[[_Terms, ClosedForm], Iterator[SingularFamily]]] = {
    FiveAxis: _five_axis,
    ParallelAxes: _parallel_axes,
    SphericalWrist: _spherical_wrist,
    RollAndExtend: _roll_and_extend,
    Planar: _planar,
    Articulated: _articulated,
    Spherical: _spherical,
    Scara: _scara,
    Cylindrical: _cylindrical,
    Cartesian: _none,
}
