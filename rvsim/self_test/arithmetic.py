"""The checks that need no screen: data, arithmetic, files, and an arm on a wire."""

from __future__ import annotations

import platform
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rvsim import __version__
from rvsim.resources import resource, resource_folder
from rvsim.self_test.outcome import Check, WrongError, expect
from rvsim.units import degrees_from_radians, radians_from_degrees

if TYPE_CHECKING:
    from rvsim.robot import Robot

_ARM_PATIENCE = 10.0  # [s] for an arm on a wire to answer, or to arrive
_MOVED = 0.1  # [rad] as little as the base must turn
_LEAST_ARMS = 11
_FOLDERS = ("robots", "help", "icons", "fonts", "licences")

# Worked out with 40 digits, apart from this program: arm, joints [deg], place of its tool [m].
_KNOWN_PLACES = (
    ("rv-m1", (0, 0, 0, 0, 0), (0.482, 0.0, 0.152)),
    ("rv-m1", (30, 40, -50, 20, 60), (0.3637, 0.2100, 0.2974)),
    ("rv-1a", (0, 0, 0, 0, 0, 0), (-0.34, 0.0, 0.639)),
    ("rv-1a", (0, 90, 0, 0, 0, 0), (0.339, 0.0, 0.640)),
    ("ur5e", (0, 0, 0, 0, 0, 0), (-0.8172, -0.2329, 0.0628)),
    ("ur5e", (20, -70, 100, -50, 60, 35), (-0.501349, -0.377327, 0.301583)),
    ("rrrp", (0, 0, 0, 0), (5.0, 4.0, 3.0)),
    ("al5b", (0, 0, 0, 0, 0), (0.33147, 0.0, 0.06858)),
)
_DIGITS = 5.1e-5  # [m] four decimals of them are known


def _parts() -> str:
    import PySide6

    kind = "a bundle" if _in_bundle() else "installed" if _in_wheel() else "a checkout"
    libraries = f"numpy {np.__version__}, Qt for Python {PySide6.__version__}"
    return f"rvsim {__version__}, {kind}; Python {platform.python_version()}, {libraries}"


def _in_bundle() -> bool:
    return bool(getattr(sys, "frozen", False))


def _in_wheel() -> bool:
    return resource_folder().name == "_resources"


def _resources() -> str:
    """Every file that rvsim reads is whole; those that only Qt can read are looked at on the screens."""
    from rvsim.motion.lettering import text_strokes

    counts = {folder: _whole_files(folder) for folder in _FOLDERS}
    expect(text_strokes("rvsim", 0.01), "the pen's letters are missing")
    third_party = resource("licences", "THIRD-PARTY.txt")
    expect(not _in_bundle() or third_party.is_file(), "the bundle does not tell the licences of its parts")
    return ", ".join(f"{count} {folder}" for folder, count in counts.items())


def _whole_files(folder: str) -> int:
    files = sorted(path for path in resource(folder).rglob("*") if path.is_file())
    expect(files, f"the folder {folder} is empty")
    for path in files:
        try:
            _KINDS.get(path.suffix, _is_filled)(path)
        except Exception as problem:  # of whichever reader
            raise WrongError(f"{path.relative_to(resource_folder()).as_posix()} is broken: {problem}") from problem
    return len(files)


def _is_filled(path: Path) -> None:
    expect(path.stat().st_size > 0, "it is empty")


def _is_text(path: Path) -> None:
    expect(path.read_text(encoding="utf-8").strip(), "it is empty")


def _is_picture(path: Path) -> None:
    from PIL import Image

    with Image.open(path) as picture:
        picture.load()


def _is_drawing(path: Path) -> None:
    from xml.etree import ElementTree

    ElementTree.parse(path)


def _is_arm(path: Path) -> None:
    from rvsim.files import load_robot

    load_robot(path)


_KINDS: dict[str, Callable[[Path], None]] = {
    ".toml": _is_arm,
    ".md": _is_text,
    ".txt": _is_text,
    ".png": _is_picture,
    ".svg": _is_drawing,
}


def every_arm() -> Iterator[Robot]:
    """Those that come with rvsim."""
    from rvsim import load_robot, robot_names

    names = robot_names()
    expect(len(names) >= _LEAST_ARMS, f"there are {len(names)} arms instead of {_LEAST_ARMS} or more: {names}")
    return map(load_robot, names)


def _forward() -> str:
    from rvsim import forward_kinematics, load_robot
    from rvsim.kinematics import forward_difference

    for name, q_deg, place in _KNOWN_PLACES:
        found = forward_kinematics(load_robot(name), radians_from_degrees(q_deg))[:3, 3]
        expect(np.allclose(found, place, 0.0, _DIGITS), f"{name} at {q_deg}° is at {found} m instead of {place} m")
    worst = max(float(np.max(forward_difference(robot, some_pose(robot)))) for robot in every_arm())
    expect(worst < 1e-12, f"the DH product and the exponentials differ by {worst:.1e}")
    return f"{len(_KNOWN_PLACES)} known places; two ways to compute each arm's agree to {worst:.0e}"


def some_pose(robot: Robot) -> np.ndarray:
    """Within the limits, and not singular."""
    q = robot.home + 0.1 + 0.03 * np.arange(robot.dof)
    low, high = robot.limits.T
    return np.asarray(np.clip(q, low + 0.05, high - 0.05))


def _inverse() -> str:
    from rvsim import forward_kinematics, inverse_kinematics

    branches = 0
    for robot in every_arm():
        q = some_pose(robot)
        result = inverse_kinematics(robot, forward_kinematics(robot, q), near=q)
        nearest = min((float(np.abs(branch.q - q).max()) for branch in result.branches), default=np.inf)
        expect(nearest < 1e-6, f"{robot.name}: the joints that made the pose are not among its solutions")
        branches += len(result.branches)
    return f"every arm's joints are found again, among {branches} branches"


def _tracking() -> str:
    from rvsim import load_robot
    from rvsim.lab import named_path
    from rvsim.motion import track

    robot = load_robot("rv-m1")
    path = named_path("line", robot, start=(0.11, 0.0, 0.13), end=(0.23, 0.0, 0.333), samples=11)
    within, without = track(robot, path), track(robot, path, ignore_limits=True)
    counts = (within.reached_count, without.reached_count)
    expect(counts == (4, 11), f"source 000's line: {counts} of 11 points instead of (4, 11)")
    rms = without.rms
    expect(rms is not None and rms < 1e-9, f"source 000's line is missed by {rms} m")
    return "source 000's line: 4 of 11 points within the limits, 11 without"


def _smooth_motion() -> str:
    from rvsim.motion.laws.jerk_limited import Limits, jerk_limited
    from rvsim.motion.spline import spline_points

    one = np.ones(1)
    law = jerk_limited(0.0, [0.0], [1.0], Limits(one, one, one))
    expect(abs(law.end - 3.1748) < 1e-4, f"the quickest move takes {law.end} s instead of 3.1748 s")
    x = np.linspace(0.0, 3.0, 2001)  # so many that the system is reduced first
    error = float(np.abs(spline_points(x, np.sin(x)[:, None], [1.5])[0, 0] - np.sin(1.5)))
    expect(error < 1e-12, f"a spline through {len(x)} points of a sine is {error:.1e} away from it")
    return f"1 rad within 1 rad/s, 1 rad/s², 1 rad/s³ in {law.end:.4f} s; a spline through {len(x)} points"


def _files() -> str:
    """In a folder whose name is not plain, as students have them."""
    from rvsim.experiment import SessionState
    from rvsim.files import load_robot, robot_text, save_robot
    from rvsim.files.session_file import load_session, save_session, session_bytes
    from rvsim.lab import default_experiment

    with tempfile.TemporaryDirectory(prefix="rvsim-self-test-") as folder:
        place = Path(folder) / "ملف Größe 1"
        place.mkdir()
        for robot in every_arm():
            save_robot(robot, place / f"{robot.name}.toml")
            again = load_robot(place / f"{robot.name}.toml")
            expect(robot_text(again) == robot_text(robot), f"{robot.name} is another arm when it is read back")
            state = SessionState(default_experiment(robot))
            save_session(state, place / "student.rvsim")
            kept = session_bytes(load_session(place / "student.rvsim").state)
            expect(kept == session_bytes(state), f"a session with {robot.name} is another one when it is read back")
    return "every arm, and a session with each, saved in a new folder and read back"


def _device() -> str:
    """The virtual arm, asked in its own language by pyserial and moved by the driver; and the other kinds of port."""
    import serial

    import rvsim.device  # so that pyserial knows al5b://  # noqa: F401
    from rvsim import load_robot
    from rvsim.device.driver.io_thread import ArmDriver
    from rvsim.device.driver.ports import available_ports

    with serial.serial_for_url("al5b://", timeout=_ARM_PATIENCE) as port:
        port.write(b"VER\r")
        board = port.read_until(b"\r").decode().strip()
    for url in ("socket://127.0.0.1:1", "rfc2217://127.0.0.1:1", "loop://"):
        serial.serial_for_url(url, do_not_open=True)
    with ArmDriver(load_robot("al5b"), baud=115200) as driver:
        moved = _drive(driver)
    ports = len(available_ports()) - 1
    return f"{board} moved {moved:.0f}° and stopped; {ports} serial {'port' if ports == 1 else 'ports'} here"


def _drive(driver: Any) -> float:
    """Connect, wake the base, turn it, stop; how far it went [deg]. One joint, because each takes a second to wake."""
    base = driver.robot.servos[0]
    driver.connect()
    _wait(driver, lambda state: state.phase == "asleep", "no arm answers")
    driver.wake(0, float(driver.robot.home[0]))
    _wait(driver, lambda state: state.awake[0] and not state.busy, "it does not wake")
    began = driver.state.commanded_q[0]
    driver.jog_pulse(base.channel, 1600.0, 0.3)
    _wait(driver, lambda state: not state.busy and abs(state.measured_q[0] - began) > _MOVED, "it does not move")
    driver.stop("The self-test is over.")
    _wait(driver, lambda state: state.phase == "stopped", "the stop does not stop it")
    return abs(float(degrees_from_radians(driver.state.measured_q[0] - began)))


def _wait(driver: Any, until: Callable[[Any], bool], otherwise: str) -> None:
    expect(driver.wait(until, _ARM_PATIENCE), f"{otherwise}; it is {driver.state.phase}. {driver.state.reason}")


CHECKS: Mapping[str, Check] = {
    "parts": _parts,
    "resources": _resources,
    "forward kinematics": _forward,
    "inverse kinematics": _inverse,
    "tracking": _tracking,
    "smooth motion": _smooth_motion,
    "files": _files,
    "virtual arm": _device,
}
