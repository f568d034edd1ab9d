"""The value `Robot`: what a serial arm is, in SI units. Algorithms are functions and files are read elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np

from rvsim.errors import RobotDefinitionError, UnknownNameError
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray, frozen_array
from rvsim.robot.servo import GripperServo, Servo
from rvsim.robot.shape import Shape

Convention = Literal["standard", "modified"]
JointType = Literal["revolute", "prismatic"]


class Datum(NamedTuple):
    """A number whose origin matters: the app shows an assumed one as assumed and lets the user change it."""

    value: float
    assumed: bool
    source: str


@dataclass(frozen=True)
class Joint:
    """One joint and its row of the DH table.

    The joint variable q is the DH angle minus `theta` (revolute, rad) or the DH length minus `d` (prismatic, m):
    `theta` and `d` are the row at q = 0. In the modified convention `a` and `alpha` are those of row i − 1 (Craig).
    """

    name: str
    type: JointType
    theta: float
    d: float
    a: float
    alpha: float
    lower: float = -math.inf
    upper: float = math.inf
    home: float = 0.0
    color: str = "#0072B2"
    max_speed: Datum | None = None  # [rad/s] or [m/s]
    max_acceleration: Datum | None = None  # [rad/s²] or [m/s²]
    max_torque: Datum | None = None  # [N m] or [N]
    dh_assumed: bool = False  # no source gives the row
    limits_assumed: bool = False  # no source gives the limits

    @property
    def revolute(self) -> bool:
        """Whether q is an angle."""
        return self.type == "revolute"

    @property
    def continuous(self) -> bool:
        """Whether it turns without end."""
        return self.revolute and math.isinf(self.lower) and math.isinf(self.upper)


@dataclass(frozen=True, eq=False)
class Tool:
    """What is bolted to the flange: T_flange_tool (4, 4), with a name and a title for the screen."""

    name: str
    title: str
    T_flange_tool: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_flange_tool", frozen_array("T_flange_tool", self.T_flange_tool, (4, 4)))


_NOWHERE = frozen_array("nowhere", np.zeros(3), (3,))
_IN_THE_MIDDLE = 1e-9  # [m²]


@dataclass(frozen=True, eq=False)
class Gripper:
    """A gripper of two fingers, drawn open: its outline in the stick figure, and how the fingers close.

    Args:
        points: (k, 3) in the flange frame [m], one open polyline.
        closing: (3,) how far a finger on the positive side of this direction moves against it until it is closed, in
            the flange frame [m]; a finger on the other side moves as far towards it. Zeros: nothing moves.
    """

    points: FloatArray
    color: str = "#2ca02c"
    closing: FloatArray = field(default_factory=lambda: _NOWHERE)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_array("gripper points", self.points, (-1, 3)))
        object.__setattr__(self, "closing", frozen_array("gripper closing", self.closing, (3,)))

    def shift(self, points: FloatArray, opening: float) -> FloatArray:
        """(..., 3) how far points (..., 3) of the fingers are from where they are drawn; `opening` is 0 (closed) … 1.

        What lies in the middle belongs to no finger and stays.
        """
        along = points @ self.closing
        sides = np.where(np.abs(along) > _IN_THE_MIDDLE, np.sign(along), 0.0)
        return np.asarray((opening - 1.0) * sides[..., None] * self.closing)


@dataclass(frozen=True, eq=False)
class LinkMass:
    """One link: mass [kg], com (3,) in its DH frame [m], inertia (3, 3) about the com in that frame's axes [kg m²]."""

    mass: float
    com: FloatArray
    inertia: FloatArray
    assumed: bool = False
    source: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "com", frozen_array("com", self.com, (3,)))
        object.__setattr__(self, "inertia", frozen_array("inertia", self.inertia, (3, 3)))


_IDENTITY = frozen_array("identity", np.eye(4), (4, 4))
NO_TOOL = Tool("flange", tr_later("Flange (no tool)"), _IDENTITY)


@dataclass(frozen=True, eq=False)
class Robot:
    """A serial arm: T_base_tool = T_base_0 · A1 … An · T_flange_tool.

    Args:
        name: the stable id, for instance "rv-m1".
        title: the name people use, for instance "Mitsubishi RV-M1".
        convention: "standard", A = Rz(θ) Tz(d) Tx(a) Rx(α), or "modified" (Craig), A = Rx(α) Tx(a) Tz(d) Rz(θ).
        joints: from the base to the tool.
        T_base_0: (4, 4) where the first DH frame stands in the base frame.
        tools: what can be bolted to the flange; `tool_name` is the one in use.
        gripper: its outline, or None.
        shapes: the solid look.
        masses: one entry a link, or () where nothing is known.
        length_unit: "millimetre", or "unit" for an arm whose source gives lengths without a unit (inside: metres).
        source, notes: where the numbers come from; what a student should know.
        family: the arm's kind in the field's words, for instance "5R, wrist without yaw".
        servos: one a joint for an arm of hobby servos, or (); gripper_servo: the gripper's, or None.

    Raises:
        RobotDefinitionError: the values make no arm.
    """

    name: str
    title: str
    convention: Convention
    joints: tuple[Joint, ...]
    T_base_0: FloatArray = field(default_factory=lambda: _IDENTITY)
    tools: tuple[Tool, ...] = (NO_TOOL,)
    tool_name: str = ""
    gripper: Gripper | None = None
    shapes: tuple[Shape, ...] = ()
    masses: tuple[LinkMass, ...] = ()
    length_unit: Literal["millimetre", "unit"] = "millimetre"
    source: str = ""
    notes: str = ""
    family: str = ""
    servos: tuple[Servo, ...] = ()
    gripper_servo: GripperServo | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_base_0", frozen_array("T_base_0", self.T_base_0, (4, 4)))
        if not self.joints:
            raise RobotDefinitionError(self.name, tr("an arm needs at least one joint."))
        for joint in self.joints:
            _check_joint(self.name, joint)
        if any(shape.finger and shape.frame != self.dof for shape in self.shapes):
            raise RobotDefinitionError(
                self.name, tr("a finger of the gripper moves with frame {dof}, the flange.", dof=self.dof)
            )
        if self.masses and len(self.masses) != self.dof:
            raise RobotDefinitionError(
                self.name, tr("{masses} link masses for {links} links.", masses=len(self.masses), links=self.dof)
            )
        if self.servos and len(self.servos) != self.dof:
            raise RobotDefinitionError(
                self.name, tr("{servos} servos for {joints} joints.", servos=len(self.servos), joints=self.dof)
            )
        _check_channels(self.name, self.servos, self.gripper_servo)
        if not self.tool_name:
            object.__setattr__(self, "tool_name", self.tools[0].name)
        _ = self.tool  # raises at once if there is no such tool

    @property
    def dof(self) -> int:
        """The number of joints, n."""
        return len(self.joints)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """One name a joint."""
        return tuple(joint.name for joint in self.joints)

    @property
    def joint_types(self) -> tuple[JointType, ...]:
        """ "revolute" or "prismatic", one a joint."""
        return tuple(joint.type for joint in self.joints)

    @cached_property
    def limits(self) -> FloatArray:
        """(n, 2) lower and upper bound of q [rad, m]; ±inf where there is none."""
        return frozen_array("limits", [(joint.lower, joint.upper) for joint in self.joints], (self.dof, 2))

    @cached_property
    def home(self) -> FloatArray:
        """(n,) the home pose [rad, m], inside the limits."""
        return frozen_array("home", [joint.home for joint in self.joints], (self.dof,))

    @cached_property
    def dh(self) -> FloatArray:
        """(n, 4) rows theta, d, a, alpha at q = 0 [rad, m]."""
        return frozen_array("dh", [(j.theta, j.d, j.a, j.alpha) for j in self.joints], (self.dof, 4))

    @cached_property
    def is_revolute(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """(n,) True where q is an angle."""
        mask = np.array([joint.revolute for joint in self.joints])
        mask.setflags(write=False)
        return mask

    @property
    def tool(self) -> Tool:
        """The tool in use."""
        for tool in self.tools:
            if tool.name == self.tool_name:
                return tool
        raise UnknownNameError(tr_later("tool"), self.tool_name, [tool.name for tool in self.tools])

    @property
    def T_flange_tool(self) -> FloatArray:
        """(4, 4) of the tool in use."""
        return self.tool.T_flange_tool

    @cached_property
    def size(self) -> float:
        """A length that bounds the arm's reach from its base [m]: the sum of its |d| and |a|, strokes and tool."""
        total = float(np.abs(self.dh[:, 1:3]).sum()) + float(np.linalg.norm(self.T_flange_tool[:3, 3]))
        strokes = (max(abs(j.lower), abs(j.upper)) for j in self.joints if not j.revolute)
        total += sum(stroke for stroke in strokes if math.isfinite(stroke))
        return max(total, 1e-3)

    def with_joint(self, index: int, **changes: Any) -> Robot:
        """A copy whose joint `index` (from 0) has other values."""
        joints = list(self.joints)
        joints[index] = replace(joints[index], **changes)
        return replace(self, joints=tuple(joints))

    def with_tool(self, name: str) -> Robot:
        """A copy that holds another of its tools."""
        return replace(self, tool_name=name)

    def renamed(self, name: str, title: str) -> Robot:
        """A copy under another name."""
        return replace(self, name=name, title=title)


def _check_joint(robot: str, joint: Joint) -> None:
    where = tr("joint {name!r}", name=joint.name)
    if joint.type not in ("revolute", "prismatic"):
        raise RobotDefinitionError(
            robot, tr("{joint} is {type!r}; a joint is 'revolute' or 'prismatic'.", joint=where, type=joint.type)
        )
    if not all(math.isfinite(value) for value in (joint.theta, joint.d, joint.a, joint.alpha, joint.home)):
        raise RobotDefinitionError(robot, tr("{joint} has a DH value that is not finite.", joint=where))
    if not joint.lower < joint.upper:
        raise RobotDefinitionError(robot, tr("{joint}: its lower limit must lie below its upper limit.", joint=where))
    if not joint.lower <= joint.home <= joint.upper:
        raise RobotDefinitionError(robot, tr("{joint}: its home must lie within its limits.", joint=where))


def _check_channels(robot: str, servos: tuple[Servo, ...], gripper: GripperServo | None) -> None:
    channels = [servo.channel for servo in servos] + ([gripper.channel] if gripper else [])
    twice = {channel for channel in channels if channels.count(channel) > 1}
    if twice:
        raise RobotDefinitionError(
            robot, tr("two servos on channel {channel}; each needs a channel of its own.", channel=min(twice))
        )
