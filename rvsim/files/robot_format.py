"""The format of robot files as tables of keys: the same tables read a file, refuse a bad one and write a good one."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rvsim.errors import RvsimError, did_you_mean
from rvsim.files.kinds import Choice, Flag, HexColor, Items, Key, Number, Numbers, Table, Text
from rvsim.files.place import LENGTH_UNITS, Place, shown, step_words
from rvsim.language import tr, tr_later, trn
from rvsim.robot import BoxShape, CapsuleShape, Datum, Gripper, GripperServo, Joint, LinkMass, Robot, Servo, Shape, Tool
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import NO_TOOL
from rvsim.robot.servo import CHANNELS, LONGEST_US, SHORTEST_US
from rvsim.spatial import rotation_from_rpy, rpy_from_rotation, transform

# A hundred turns; a kilometre.
_ANGLE = Number("angle", -36_000.0, 36_000.0)
_LENGTH = Number("length", -1e6, 1e6)
_JOINT_VALUE = Number("joint", -1e6, 1e6)
_POINT = Numbers(("x", "y", "z"), _LENGTH)
_EDGES = Numbers(("x", "y", "z"), Number("length", 1e-6, 1e6))
_ANGLES = Numbers(("roll", "pitch", "yaw"), _ANGLE)
_INERTIA = Numbers(("xx", "yy", "zz", "xy", "xz", "yz"), Number("plain", -1e6, 1e6))
_FINGER = Key("finger", Flag(), False, tr_later("true: it moves with the gripper"))
_LOOK_COLOR = Key("color", HexColor(optional=True), "", tr_later("when absent: the colour of the joint that moves it"))
_MOST_JOINTS = 32
# An arm whose lengths add up to less than this [m] was most likely written in metres instead of millimetres.
_SMALLEST_ARM = 2e-3


# --- a number whose origin matters ---------------------------------------------------------------------------------


def _datum(number: Number) -> Table:
    return Table(
        keys=(
            Key("value", number),
            Key("assumed", Flag(), False, tr_later("true where no source gives the number")),
            Key("source", Text(longest=500), ""),
        ),
        build=_build_datum,
        parts=lambda datum: datum._asdict(),
    )


def _build_datum(values: dict[str, Any], place: Place) -> Datum:
    if not values["assumed"] and not values["source"]:
        place.refuse(
            tr("a number without origin"),
            'source = "…"' + tr(" or ") + "assumed = true",
            tr("Say where the number comes from."),
        )
    return Datum(**values)


# --- joints --------------------------------------------------------------------------------------------------------

JOINT = Table(
    keys=(
        Key("name", Text(1, 40), comment=tr_later("shown beside its slider")),
        Key("type", Choice(("revolute", "prismatic")), comment=tr_later("revolute turns, prismatic slides")),
        Key("theta", _ANGLE, comment=tr_later("DH angle at q = 0 [degrees]: theta is in degrees")),
        Key("d", _LENGTH, comment=tr_later("DH offset along z at q = 0")),
        Key("a", _LENGTH, comment=tr_later("DH length along x")),
        Key("alpha", _ANGLE, comment=tr_later("DH twist about x: alpha is in degrees")),
        Key("dh_assumed", Flag(), False, tr_later("true where no source gives this row")),
        Key("lower", _JOINT_VALUE, -math.inf, tr_later("lower limit of q; without limit: leave the key out")),
        Key("upper", _JOINT_VALUE, math.inf, tr_later("upper limit of q; without limit: leave the key out")),
        Key("limits_assumed", Flag(), False, tr_later("true where no source gives these limits")),
        Key("home", _JOINT_VALUE, 0.0, tr_later("q of the Home button, within the limits")),
        Key("color", HexColor(), "#0072B2"),
        Key(
            "max_speed",
            _datum(Number("joint", 1e-6, 1e6, " per second")),
            None,
            tr_later("[degrees/s, or length/s]"),
        ),
        Key(
            "max_acceleration",
            _datum(Number("joint", 1e-6, 1e7, " per second²")),
            None,
            tr_later("[degrees/s², or length/s²]"),
        ),
        Key("max_torque", _datum(Number("plain", 1e-6, 1e6)), None, "[N m, or N]"),
    ),
    build=lambda values, place: _build_joint(values, place),
    parts=vars,
    units=lambda table, units: units.for_joint(table.get("type")),
)


def _build_joint(values: dict[str, Any], place: Place) -> Joint:
    joint = Joint(**values)
    unit = place.units.joint
    if not joint.lower < joint.upper:
        below = tr("less than the upper limit {upper:g}", upper=unit.from_si(joint.upper))
        place.at("key 'lower'").refuse(f"{unit.from_si(joint.lower):g}", below, tr("Exchange lower and upper?"))
    if not joint.lower <= joint.home <= joint.upper:
        span = tr(
            "a value within the limits {lower:g} to {upper:g}",
            lower=unit.from_si(joint.lower),
            upper=unit.from_si(joint.upper),
        )
        place.at("key 'home'").refuse(
            f"{unit.from_si(joint.home):g}", span, tr("Set home to a value the joint can take.")
        )
    return joint


# --- places: the base and the tools --------------------------------------------------------------------------------

_XYZ = Key("xyz", _POINT, (0.0, 0.0, 0.0), tr_later("where its origin is"))
_RPY = Key("rpy", _ANGLES, (0.0, 0.0, 0.0), tr_later("roll, pitch, yaw [degrees]: R = Rz(yaw) Ry(pitch) Rx(roll)"))

BASE = Table(
    keys=(_XYZ, _RPY),
    build=lambda values, _: _transform(values),
    parts=lambda T: _place_parts(T),
)
_AT_ORIGIN = NO_TOOL.T_flange_tool
TOOL = Table(
    keys=(
        Key("name", Text(1, 40)),
        Key("title", Text(1, 80), comment=tr_later("shown in the list of tools")),
        _XYZ,
        _RPY,
    ),
    build=lambda values, _: Tool(values["name"], values["title"], _transform(values)),
    parts=lambda tool: {"name": tool.name, "title": tool.title, **_place_parts(tool.T_flange_tool)},
)


def _transform(values: dict[str, Any]) -> FloatArray:
    return transform(rotation_from_rpy(values["rpy"]), values["xyz"])


def _place_parts(T: FloatArray) -> dict[str, Any]:
    return {"xyz": _tuple(T[:3, 3]), "rpy": _tuple(rpy_from_rotation(T[:3, :3]))}


# --- looks ---------------------------------------------------------------------------------------------------------

GRIPPER = Table(
    keys=(
        Key("color", HexColor(), "#2ca02c"),
        Key("points", Items("point", _POINT, 2, 200), comment=tr_later("an open line in the flange frame")),
        Key("closing", _POINT, (0.0, 0.0, 0.0), tr_later("how far a finger moves inwards from open to closed")),
    ),
    build=lambda values, _: Gripper(values["points"], values["color"], values["closing"]),
    parts=lambda gripper: (
        vars(gripper) | {"points": [_tuple(point) for point in gripper.points], "closing": _tuple(gripper.closing)}
    ),
)
_FRAME = Key(
    "frame",
    Number("plain", 0, _MOST_JOINTS + 1),
    comment=tr_later("0 the base, i the link behind joint i, n + 1 the tool"),
)
CAPSULE = Table(
    keys=(
        _FRAME,
        Key("start", _POINT),
        Key("end", _POINT),
        Key("radius", Number("length", 1e-6, 1e6)),
        _LOOK_COLOR,
        _FINGER,
    ),
    build=lambda values, place: CapsuleShape(**_whole_frame(values, place)),
    parts=lambda shape: vars(shape) | {"start": _tuple(shape.start), "end": _tuple(shape.end)},
)
BOX = Table(
    keys=(_FRAME, Key("center", _POINT), Key("size", _EDGES), _LOOK_COLOR, _FINGER),
    build=lambda values, place: BoxShape(**_whole_frame(values, place)),
    parts=lambda shape: vars(shape) | {"center": _tuple(shape.center), "size": _tuple(shape.size)},
)
LOOK = Table(
    keys=(Key("capsules", Items("capsule", CAPSULE), ()), Key("boxes", Items("box", BOX), ())),
    build=lambda values, _: (*values["capsules"], *values["boxes"]),
    parts=lambda shapes: {
        "capsules": tuple(shape for shape in shapes if isinstance(shape, CapsuleShape)),
        "boxes": tuple(shape for shape in shapes if isinstance(shape, BoxShape)),
    },
)


def _whole_frame(values: dict[str, Any], place: Place) -> dict[str, Any]:
    return values | {"frame": _whole(values["frame"], "frame", place)}


# --- masses --------------------------------------------------------------------------------------------------------

MASS = Table(
    keys=(
        Key("mass", Number("plain", 0.0, 1e6), comment="[kg]"),
        Key("com", _POINT, comment=tr_later("centre of mass in the link's DH frame")),
        Key("inertia", _INERTIA, (0.0,) * 6, tr_later("xx, yy, zz, xy, xz, yz about the centre of mass [kg m²]")),
        Key("assumed", Flag(), False),
        Key("source", Text(longest=500), ""),
    ),
    build=lambda values, _: LinkMass(**values | {"inertia": _symmetric(*values["inertia"])}),
    parts=lambda link: vars(link) | {"com": _tuple(link.com), "inertia": _six(link.inertia)},
)


def _symmetric(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> FloatArray:
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _six(inertia: FloatArray) -> tuple[float, ...]:
    return _tuple(inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]])


def _tuple(values: FloatArray) -> tuple[float, ...]:
    return tuple(values.tolist())


# --- servos --------------------------------------------------------------------------------------------------------

_DEGREE = math.radians(1.0)
_CHANNEL = Key("channel", Number("plain", 0, CHANNELS - 1), comment=tr_later("of the controller, 0 to 31"))
_PULSE = Number("plain", SHORTEST_US, LONGEST_US)
_ORIGIN = (Key("assumed", Flag(), False), Key("source", Text(longest=500), ""))
SERVO = Table(
    keys=(
        _CHANNEL,
        Key(
            "sign",
            Number("plain", -1, 1),
            comment=tr_later("1 where a longer pulse means a larger q, -1 where a smaller one"),
        ),
        Key("zero_us", Number("plain", -20_000.0, 20_000.0), comment=tr_later("the pulse at q = 0 [µs]")),
        Key("us_per_degree", Number("plain", 0.1, 1000.0), comment="[µs/degree]"),
        Key("min_us", _PULSE, SHORTEST_US, tr_later("the shortest pulse the servo may get [µs]")),
        Key("max_us", _PULSE, LONGEST_US, tr_later("the longest [µs]")),
        *_ORIGIN,
    ),
    build=lambda values, place: _build_servo(values, place),
    parts=lambda servo: vars(servo) | {"us_per_degree": servo.us_per_rad * _DEGREE},
)
GRIPPER_SERVO = Table(
    keys=(_CHANNEL, Key("open_us", _PULSE, comment="[µs]"), Key("closed_us", _PULSE, comment="[µs]"), *_ORIGIN),
    build=lambda values, place: _checked(
        GripperServo, values | {"channel": _whole(values["channel"], "channel", place)}, place
    ),
    parts=vars,
)


def _build_servo(values: dict[str, Any], place: Place) -> Any:
    values = values | {name: _whole(values[name], name, place) for name in ("channel", "sign")}
    return _checked(Servo, values | {"us_per_rad": values.pop("us_per_degree") / _DEGREE}, place)


def _whole(value: float, key: str, place: Place) -> int:
    if value != int(value):
        place.at(f"key {key!r}").refuse(shown(value), tr("a whole number"))
    return int(value)


def _checked(kind: type[Any], values: dict[str, Any], place: Place) -> Any:
    try:
        return kind(**values)
    except RvsimError as problem:
        place.refuse(str(problem), tr("values that make a servo"))


# --- the whole arm -------------------------------------------------------------------------------------------------

ROBOT = Table(
    keys=(
        Key("name", Text(0, 60), "", tr_later("the short name; when absent: the name of the file")),
        Key("title", Text(1, 80), comment=tr_later("the name people use")),
        Key("family", Text(), "", tr_later("the kind of arm")),
        Key("convention", Choice(("standard", "modified")), comment=tr_later("DH: standard, or modified (Craig)")),
        Key(
            "length_unit",
            Choice(tuple(LENGTH_UNITS)),
            "millimetre",
            tr_later("unit: for an arm whose lengths have no unit"),
        ),
        Key("source", Text(longest=2000), "", tr_later("where the numbers come from")),
        Key("notes", Text(longest=20_000), "", tr_later("what a student should know")),
        Key("tool_name", Text(0, 40), "", tr_later("the tool in use; when absent: the first")),
        Key("base", BASE, _AT_ORIGIN, tr_later("where the first DH frame stands in the base frame")),
        Key(
            "joint", Items("joint", JOINT, 1, _MOST_JOINTS), comment=tr_later("one [[joint]] table a joint, base first")
        ),
        Key("tool", Items("tool", TOOL, 1, 32), (NO_TOOL,), tr_later("what can be bolted to the flange")),
        Key("gripper", GRIPPER, None, tr_later("its outline in the stick figure")),
        Key("look", LOOK, (), tr_later("the solid look: capsules and boxes fixed to the links")),
        Key("mass", Items("mass", MASS, 0, _MOST_JOINTS), (), tr_later("one [[mass]] table a link, or none at all")),
        Key(
            "servo",
            Items("servo", SERVO, 0, _MOST_JOINTS),
            (),
            tr_later("one [[servo]] table a joint, for an arm of servos"),
        ),
        Key("gripper_servo", GRIPPER_SERVO, None, tr_later("the gripper's servo")),
    ),
    build=lambda values, place: _build_robot(values, place),
    parts=lambda robot: {
        **{name: getattr(robot, name) for name in ("name", "title", "family", "convention", "length_unit")},
        **{name: getattr(robot, name) for name in ("source", "notes", "tool_name", "gripper")},
        "base": _AT_ORIGIN if np.array_equal(robot.T_base_0, _AT_ORIGIN) else robot.T_base_0,
        "joint": robot.joints,
        "tool": robot.tools,
        "look": robot.shapes,
        "mass": robot.masses,
        "servo": robot.servos,
        "gripper_servo": robot.gripper_servo,
    },
    units=lambda table, units: units.for_robot(table.get("length_unit", "millimetre")),
)


_FIELDS = {
    "joint": "joints",
    "tool": "tools",
    "look": "shapes",
    "mass": "masses",
    "base": "T_base_0",
    "servo": "servos",
}


def _build_robot(values: dict[str, Any], place: Place) -> Robot:
    _check_names("joint", [joint.name for joint in values["joint"]], place)
    _check_names("tool", [tool.name for tool in values["tool"]], place)
    _check_tool_name(values["tool_name"], [tool.name for tool in values["tool"]], place)
    _check_frames(values["look"], len(values["joint"]), place)
    _check_masses(len(values["mass"]), len(values["joint"]), place)
    _check_size(values["joint"], place)
    _check_servos(len(values["servo"]), len(values["joint"]), place)
    arguments = {
        _FIELDS.get(name, name): value for name, value in values.items() if name != "base" or value is not None
    }
    try:
        return Robot(**arguments)
    except RvsimError as problem:
        place.refuse(str(problem), tr("values that make an arm"))


def _check_names(kind: str, names: list[str], place: Place) -> None:
    for number, name in enumerate(names, 1):
        first = names.index(name) + 1
        if first < number:
            there = place.at(f"{kind} {number}").at("key 'name'")
            there.refuse(
                tr("{name!r} again", name=name),
                tr("a name of its own: {other} is called so already", other=step_words(f"{kind} {first}")),
            )


def _check_tool_name(name: str, names: list[str], place: Place) -> None:
    if name and name not in names:
        place.at("key 'tool_name'").refuse(repr(name), tr("the name of a [[tool]]"), did_you_mean(name, names))


def _check_frames(shapes: tuple[Shape, ...], dof: int, place: Place) -> None:
    counts = {CapsuleShape: 0, BoxShape: 0}
    for shape in shapes:
        counts[type(shape)] += 1
        there = place.at("look").at(f"{'box' if isinstance(shape, BoxShape) else 'capsule'} {counts[type(shape)]}")
        if shape.frame > dof + 1:
            key = there.at("key 'frame'", f"frame: {_FRAME.comment}.")
            key.refuse(
                str(shape.frame),
                trn("0 to {most} for an arm of {n} joint", "0 to {most} for an arm of {n} joints", dof, most=dof + 1),
            )
        if shape.finger and shape.frame != dof:
            key = there.at("key 'finger'", f"finger: {_FINGER.comment}.")
            key.refuse(
                tr("a finger of frame {frame}", frame=shape.frame),
                tr("frame {frame}, the flange, which carries the gripper", frame=dof),
            )


def _check_masses(masses: int, dof: int, place: Place) -> None:
    if masses not in (0, dof):
        place.at("mass").refuse(
            trn("{n} of them", "{n} of them", masses),
            trn("none, or one for the link", "none, or one for each of the {n} links", dof),
        )


def _check_servos(servos: int, joints: int, place: Place) -> None:
    if servos not in (0, joints):
        place.at("servo").refuse(
            trn("{n} of them", "{n} of them", servos),
            trn("none, or one for the joint", "none, or one for each of the {n} joints", joints),
        )


def _check_size(joints: tuple[Joint, ...], place: Place) -> None:
    total = sum(abs(joint.d) + abs(joint.a) for joint in joints)
    if 0.0 < total < _SMALLEST_ARM:
        found = tr("lengths d and a that add up to {sum:g}", sum=place.units.length.from_si(total))
        place.refuse(
            found, tr("lengths in millimetres"), tr('Metres? 0.15 m is 150. No unit at all? length_unit = "unit".')
        )
