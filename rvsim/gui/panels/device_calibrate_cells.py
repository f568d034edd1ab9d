"""What stands in the table of servos, what is typed into it, and what that makes of the arm."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

from rvsim.device.words import in_a_row, with_capital
from rvsim.errors import RobotDefinitionError
from rvsim.expressions import evaluate
from rvsim.gui.quantities import format_number
from rvsim.language import tr, tr_later
from rvsim.robot import GripperServo, Robot, Servo

_PLUS_MINUS = {1: "+", -1: "\u2212"}
# Robot files keep these as they are; `origin` says them in the language.
CALIBRATED, _TYPED = tr_later("calibrated on {date}"), tr_later("typed in on {date}")
_SIGNS = {"+": 1, "+1": 1, "1": 1, "-": -1, "-1": -1}


class Column(NamedTuple):
    """A number of a servo: its key, header, tooltip, and how it is shown."""

    key: str
    head: str
    tip: str
    decimals: int = 0


SERVO_COLUMNS = (
    Column("channel", tr_later("ch"), tr_later("Channel of the controller, 0 to 31")),
    Column("sign", "±", tr_later("+ where a longer pulse means a larger angle, − where it means a smaller one")),
    Column("zero_us", tr_later("zero"), tr_later("Pulse at the joint's zero [µs]; the servo need not reach it"), 1),
    Column("scale", "µs/°", tr_later("How many µs turn the joint by 1° (µs/mm where it slides)"), 2),
    Column("min_us", tr_later("min"), tr_later("The shortest pulse that the servo may get [µs]")),
    Column("max_us", tr_later("max"), tr_later("The longest pulse that the servo may get [µs]")),
)
GRIPPER_COLUMNS = (
    Column("channel", tr_later("ch"), tr_later("Channel of the controller, 0 to 31")),
    Column("open_us", tr_later("open"), tr_later("Pulse at which the gripper is open [µs]")),
    Column("closed_us", tr_later("closed"), tr_later("Pulse at which the gripper is closed [µs]")),
)
Wiring = tuple[tuple[Servo, ...], GripperServo | None]


def wiring_of(robot: Robot) -> Wiring:
    """The servos of an arm, and its gripper's."""
    return robot.servos, robot.gripper_servo


def servo_number(robot: Robot, joint: int, key: str) -> float:
    """A number of a joint's servo, as it is shown."""
    servo = robot.servos[joint]
    return servo.us_per_rad * _per_shown_unit(robot, joint) if key == "scale" else float(getattr(servo, key))


def cell_text(column: Column, number: float, decimals: int | None = None) -> str:
    """As a cell shows it."""
    if column.key == "sign":
        return _PLUS_MINUS[int(number)]
    return format_number(number, column.decimals if decimals is None else decimals)


def whole_text(column: Column, number: float) -> str:
    """As it is offered for editing: with all its digits."""
    return cell_text(column, number) if column.key == "sign" else f"{number:.12g}"


def with_servo_number(robot: Robot, joint: int, key: str, text: str, today: str) -> Wiring:
    """Another number typed for a joint's servo.

    Raises:
        RvsimError: the text is no number, or the numbers make no servo, or two servos would share a channel.
    """
    servo = robot.servos[joint]
    number = _typed(key, text)
    changes: dict[str, Any] = {key: number}
    if key == "scale":
        changes = {"us_per_rad": number / _per_shown_unit(robot, joint)}
    changed = replace(servo, **changes, assumed=False, source=_by_hand(today))
    servos = (*robot.servos[:joint], changed, *robot.servos[joint + 1 :])
    return _checked(robot, (servos, robot.gripper_servo))


def with_gripper_number(robot: Robot, key: str, text: str, today: str) -> Wiring:
    """Another number typed for the gripper's servo.

    Raises:
        RvsimError: as `with_servo_number`.
    """
    assert robot.gripper_servo is not None
    changes: dict[str, Any] = {key: _typed(key, text)}
    gripper = replace(robot.gripper_servo, **changes, assumed=False, source=_by_hand(today))
    return _checked(robot, (robot.servos, gripper))


def turned_gripper(robot: Robot, today: str) -> Wiring:
    """Open and closed exchanged."""
    assert robot.gripper_servo is not None
    old = robot.gripper_servo
    source = _by_hand(today)
    gripper = replace(old, open_us=old.closed_us, closed_us=old.open_us, assumed=False, source=source)
    return robot.servos, gripper


def swapped_channels(robot: Robot, first: int, second: int) -> Wiring:
    """What hangs on one channel hangs on the other; the rest of each servo stays its own."""
    other = {first: second, second: first}
    servos = tuple(replace(servo, channel=other.get(servo.channel, servo.channel)) for servo in robot.servos)
    gripper = robot.gripper_servo
    if gripper is not None:
        gripper = replace(gripper, channel=other.get(gripper.channel, gripper.channel))
    return servos, gripper


def on_channel(robot: Robot, channel: int) -> str:
    """What hangs on a channel, as it is called in the robot's file, or ""."""
    names = {servo.channel: name for servo, name in zip(robot.servos, robot.joint_names, strict=False)}
    if robot.gripper_servo is not None:
        names[robot.gripper_servo.channel] = "gripper"
    return names.get(channel, "")


def origins(robot: Robot) -> tuple[str, ...]:
    """A sentence for each place that numbers come from: which servos, and whether that is assumed."""
    groups: dict[tuple[bool, str], list[str]] = {}
    for name, servo in zip(robot.joint_names, robot.servos, strict=False):  # an arm may have no servos
        groups.setdefault((servo.assumed, servo.source), []).append(tr(name))
    gripper = robot.gripper_servo
    if gripper is not None:
        groups.setdefault((gripper.assumed, gripper.source), []).append(tr("gripper"))
    return tuple(
        tr("{joints}: {origin}.", joints=with_capital(in_a_row(names)), origin=origin(*key))
        for key, names in groups.items()
    )


def origin(assumed: bool, source: str) -> str:
    """Where a servo's numbers come from, in words."""
    words = _said(source) if source else tr("its robot file")
    return tr("assumed ({origin})", origin=words) if assumed else words


def _said(source: str) -> str:
    """What a robot file says in English, where it comes from here."""
    for known in (CALIBRATED, _TYPED):
        before = known.removesuffix("{date}")
        if source.startswith(before):
            return tr(known, date=source.removeprefix(before))
    return tr(source)


def _by_hand(today: str) -> str:
    return _TYPED.format(date=today)


def _per_shown_unit(robot: Robot, joint: int) -> float:
    """From µs/rad to µs/°, from µs/m to µs/mm."""
    return math.radians(1.0) if robot.joints[joint].revolute else 1e-3


def _typed(key: str, text: str) -> float:
    plain = text.strip().replace("\u2212", "-")
    return _READERS.get(key, _number)(plain)


def _sign(text: str) -> int:
    if text not in _SIGNS:
        raise RobotDefinitionError("sign", tr("{typed!r} is none: type + or -.", typed=text))
    return _SIGNS[text]


def _channel(text: str) -> int:
    number = _number(text)
    if number != round(number):
        raise RobotDefinitionError("channel", tr("{typed} is none: they are whole numbers, 0 to 31.", typed=text))
    return round(number)


def _number(text: str) -> float:
    return evaluate(text.removesuffix("µs").strip())


def _checked(robot: Robot, wiring: Wiring) -> Wiring:
    """Whether the arm can be made so: no channel twice."""
    replace(robot, servos=wiring[0], gripper_servo=wiring[1])
    return wiring


_READERS: dict[str, Callable[[str], float]] = {"sign": _sign, "channel": _channel}
