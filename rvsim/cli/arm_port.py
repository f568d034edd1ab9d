"""`rvsim arm --port`: what an arm at a port says of itself, and, asked twice for it, a calm move."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rvsim.cli.endings import ending_signals_interrupt
from rvsim.cli.outcome import DONE, FAILED, InputError
from rvsim.cli.output import print_result
from rvsim.cli.values import typed_joints
from rvsim.errors import DeviceError, UnknownNameError
from rvsim.files import load_robot
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

if TYPE_CHECKING:
    from rvsim.device.driver.actions import Axis
    from rvsim.device.driver.io_thread import ArmDriver
    from rvsim.device.driver.state import DriverState

_USUAL_BAUD = 9600
_CONNECTING, _WAKING, _MOVING, _REPORTING = 15.0, 15.0, 80.0, 1.0  # [s] nobody waits longer
_BEHIND = 0.02  # [rad, m]
_OVER = ("stopped", "lost", "disconnected")


class _Request(NamedTuple):
    """Which axes wake (joints from 0, or "gripper"), and where the joints go then, q (n,) or None, in how long."""

    wake: tuple[Axis, ...]
    q: FloatArray | None
    seconds: float | None


def talk(options: argparse.Namespace) -> int:
    """Connect, do what is asked, say how things stand; the exit status."""
    from rvsim.device.driver.io_thread import ArmDriver

    robot = load_robot(options.robot)
    request = _request(robot, options)
    baud = options.baud or _USUAL_BAUD
    with ending_signals_interrupt(), ArmDriver(robot, options.port, baud=baud, language=options.language) as driver:
        try:
            _connect(driver)
            plan, problem = _perform(driver, request, options.yes)
        except KeyboardInterrupt:
            driver.stop("Interrupted.")
            plan, problem = [], "Interrupted: the arm has been told to stop."
        state = driver.state
        _print_state(options, robot, state, plan, problem)
    return FAILED if problem or state.phase in _OVER else DONE


# --- what is asked -----------------------------------------------------------------------------------------------


def _request(robot: Robot, options: argparse.Namespace) -> _Request:
    q = None if options.deg is None else typed_joints(robot, "--deg", options.deg)
    names = _named(robot, options.wake or [])
    if q is not None and not set(robot.joint_names) <= set(names):
        raise InputError("--deg moves all joints, and only those that are awake move: add --wake all.")
    if options.seconds is not None and q is None:
        raise InputError("--seconds is how long a move takes: say with --deg where to.")
    axes: tuple[Axis, ...] = tuple("gripper" if name == "gripper" else robot.joint_names.index(name) for name in names)
    return _Request(axes, q, options.seconds)


def _named(robot: Robot, wanted: list[str]) -> list[str]:
    known = (*robot.joint_names, *(["gripper"] if robot.gripper_servo else []))
    for name in wanted:
        if name not in (*known, "all"):
            raise UnknownNameError("joint", name, (*known, "all"))
    chosen = {*wanted, *(robot.joint_names if "all" in wanted else ())}
    return [name for name in known if name in chosen]


# --- what is done ------------------------------------------------------------------------------------------------


def _connect(driver: ArmDriver) -> None:
    driver.connect()
    driver.wait(lambda state: state.phase != "connecting", _CONNECTING)
    state = driver.state
    if not state.connected:
        if driver.url in state.reason:  # it is named once
            raise InputError(state.reason)
        raise DeviceError(driver.url, "no arm has been reached", state.reason)


def _perform(driver: ArmDriver, request: _Request, agreed: bool) -> tuple[list[str], str]:
    """What is to happen, in sentences, and why not all of it has; "" where it has."""
    if not request.wake:
        return [], ""
    values = _wake_values(driver, request)
    plan = _sentences(driver, request, values)
    if (problem := _forbidden(driver, request)) or not agreed:
        return plan, problem or "Nothing has moved. Watch the arm, keep clear of it, and add --yes."
    for axis, value in values.items():
        problem = problem or _wait(driver, driver.wake(axis, value), _WAKING)
    if request.q is not None:
        problem = problem or _wait(driver, driver.move_to(request.q, request.seconds), _MOVING)
    driver.wait(_reported, _REPORTING)
    return plan, problem


def _forbidden(driver: ArmDriver, request: _Request) -> str:
    """Why the pose is not gone to, told before anything wakes."""
    from rvsim.device.driver.plan import outside

    refusal = None if request.q is None else outside(driver.robot, driver.limits, request.q[None])
    return "" if refusal is None else refusal.sentence


def _wait(driver: ArmDriver, refusal: object, seconds: float) -> str:
    """Until what was asked for is over; what went wrong."""
    if refusal is not None:
        return str(refusal)
    ended = driver.wait(lambda state: not state.busy, seconds)
    if driver.state.phase in _OVER:
        return driver.state.reason
    return "" if ended else f"The arm has not arrived in {seconds:g} s."


def _reported(state: DriverState) -> bool:
    """Whether what is reported has caught up with what was commanded, or nothing more will come."""
    behind = np.abs(state.commanded_q - state.measured_q)
    return state.phase in _OVER or not bool(np.any(behind > _BEHIND))


def _wake_values(driver: ArmDriver, request: _Request) -> dict[Axis, float]:
    """Where each axis wakes: where it is reported to be, otherwise at home; the gripper open."""
    reported = driver.state.measured_q
    pose = np.clip(np.where(np.isfinite(reported), reported, driver.robot.home), *driver.limits.T)
    return {axis: 1.0 if axis == "gripper" else float(pose[axis]) for axis in request.wake}


# --- what is said ------------------------------------------------------------------------------------------------


def _sentences(driver: ArmDriver, request: _Request, values: dict[Axis, float]) -> list[str]:
    sentences = [_wake_sentence(driver, axis, value) for axis, value in values.items()]
    if request.q is not None:
        pose = ", ".join(_shown(driver.robot, joint, value) for joint, value in enumerate(request.q))
        pace = "calmly" if request.seconds is None else f"in {request.seconds:g} s or more"
        sentences.append(f"Then all joints go to ({pose}), {pace}.")
    return sentences


def _wake_sentence(driver: ArmDriver, axis: Axis, value: float) -> str:
    if axis == "gripper":
        return "The gripper jumps open."
    place, name = _shown(driver.robot, axis, value), driver.robot.joint_names[axis]
    known = np.isfinite(driver.state.measured_q[axis])
    return f"The {name} wakes at {place}." if known else f"The {name} jumps to {place} at full speed: hold it there."


def _shown(robot: Robot, joint: int, value: float, unknown: str = "unknown") -> str:
    from rvsim.device.driver.plan import shown

    return shown(robot, joint, value) if np.isfinite(value) else unknown


def _print_state(options: argparse.Namespace, robot: Robot, state: DriverState, plan: list[str], problem: str) -> None:
    print_result(
        options,
        {**_record(options, robot, state), "plan": plan, "problem": problem},
        "\n".join([*plan, *_state_lines(options, robot, state), *([problem] if problem else [])]),
    )


def _record(options: argparse.Namespace, robot: Robot, state: DriverState) -> dict[str, Any]:
    from rvsim.lab.tables import joint_units, shown_joints

    columns = (robot.joint_names, joint_units(robot), state.awake)
    places = (shown_joints(robot, state.commanded_q).tolist(), shown_joints(robot, state.measured_q).tolist())
    keys = ("joint", "unit", "awake", "commanded", "measured")
    return {
        "port": options.port,
        "board": state.board,
        "phase": state.phase,
        "reason": state.reason,
        "measured_kind": state.measured_kind,
        "joints": [dict(zip(keys, row, strict=True)) for row in zip(*columns, *places, strict=True)],
        "gripper": {"awake": state.gripper_awake, "opening": state.gripper},
    }


def _state_lines(options: argparse.Namespace, robot: Robot, state: DriverState) -> list[str]:
    from rvsim.device.driver.state import MEASURED_WORDS

    width = max(len(name) for name in robot.joint_names)
    rows = (f"  {name:{width}}  {_place(robot, joint, state)}" for joint, name in enumerate(robot.joint_names))
    head = f"{robot.title} at {options.port}: {state.board or 'a board without a name'}, {state.phase}."
    return [" ".join([head, state.reason]).rstrip(), *rows, MEASURED_WORDS[state.measured_kind]]


def _place(robot: Robot, joint: int, state: DriverState) -> str:
    commanded, measured = float(state.commanded_q[joint]), float(state.measured_q[joint])
    reported = _shown(robot, joint, measured)
    if state.awake[joint]:
        return f"awake  commanded {_shown(robot, joint, commanded):>8}  reported {reported:>8}"
    return f"not woken by rvsim; the controller reports {reported}" if np.isfinite(measured) else "asleep"
