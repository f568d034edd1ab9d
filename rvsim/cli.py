"""The command line: `rvsim` opens the window, a subcommand does one job without it.

Exit status: 0 done, 1 the outcome is a failure (no point reached, no solution), 2 the input cannot be used. What went
wrong is one sentence on the error stream, never a traceback. Results: sentences and tables, or JSON with --json.
"""

from __future__ import annotations

import argparse
import codecs
import os
import re
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, get_args

import numpy as np

from rvsim import __version__
from rvsim.errors import RvsimError
from rvsim.experiment import PathOrientation
from rvsim.expressions import evaluate_in
from rvsim.files import load_robot, robot_names, user_robots
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_rpy, transform
from rvsim.units import radians_from_degrees

if TYPE_CHECKING:
    from rvsim.kinematics import InverseResult
    from rvsim.motion import Tracking

DONE, FAILED, BAD_INPUT = 0, 1, 2

# A value may begin with a minus sign; written with "=" it is not taken for an option.
_VECTOR_OPTIONS = ("--deg", "--near-deg", "--xyz-mm", "--rpy-deg", "--from-mm", "--to-mm", "--height-mm")
_MM = "[mm; units for an arm whose lengths have none]"
_JOINTS = f'degrees, for a prismatic joint {_MM}; or with the unit behind: "pi/4 rad, 12 cm"'
_INDEX = "An index in JSON and CSV counts from 0; sentences count points from 1."
_PANELS = (
    "path", "check", "program", "compare", "inverse", "how", "lab",
    "jacobian", "velocity", "singular", "forces", "dynamics", "workspace", "source",
    "tool", "matrices", "points", "dh",
)  # fmt: skip
_SEPARATOR = re.compile(r"[,;](?![^()]*\))")


class InputError(RvsimError):
    """What was typed cannot be used."""


class _Parser(argparse.ArgumentParser):
    """Says in one sentence what is wrong, and how to get help."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message[:1].upper()}{message[1:]}. Type {self.prog} --help.")


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the arguments say; the exit status."""
    _speak_any_encoding()
    try:
        options = _parser().parse_args(_joined(sys.argv[1:] if arguments is None else arguments))
        job: Callable[[argparse.Namespace], int] = options.job
        return job(options)
    except BrokenPipeError:  # the reader has seen enough, as in `rvsim robots | head -1`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except RvsimError as problem:
        print(f"rvsim: {problem}", file=sys.stderr)
    except OSError as problem:
        file = problem.filename2 or problem.filename
        print(f"rvsim: {file}: {problem.strerror}." if file else f"rvsim: {problem}", file=sys.stderr)
    return BAD_INPUT


# --- arguments ---------------------------------------------------------------------------------------------------


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="rvsim", description="See, move, compute and understand a robot arm.", allow_abbrev=False)
    parser.add_argument("--version", action="version", version=f"rvsim {__version__}")
    _add_window_options(parser)
    parser.set_defaults(job=_window)
    commands = parser.add_subparsers(title="without a window", metavar="COMMAND")
    for name, job, summary, add_options in _COMMANDS:
        command = commands.add_parser(name, help=summary, description=summary, allow_abbrev=False)
        add_options(command)
        command.add_argument("--json", action="store_true", help="print JSON instead of sentences")
        command.set_defaults(job=job)
    return parser


def _add_window_options(parser: argparse.ArgumentParser) -> None:
    window = parser.add_argument_group("the window")
    window.add_argument(
        "--robot", metavar="ARM", help="the arm to begin with: a name that `rvsim robots` lists, or a robot file"
    )
    window.add_argument("--renderer", choices=("auto", "gl", "painter"), help="who draws the scene")
    window.add_argument("--theme", choices=("light", "dark"))
    window.add_argument("--screenshot", type=_output, metavar="FILE.png", help="open, draw, save, leave")
    window.add_argument("--size", type=_size, metavar="1366x768", help="of the window")
    window.add_argument("--state", default="home", metavar="home|line|PATH", help="what the screenshot shows")
    window.add_argument("--panel", choices=_PANELS, default="path", help="the panel that the screenshot shows")
    window.add_argument("--look", choices=("solid", "stick", "both"), help="how the arm is drawn")


def _add_arm(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("arm", metavar="ARM", help="a name that `rvsim robots` lists, or a robot file")


def _add_arm_and_joints(parser: argparse.ArgumentParser) -> None:
    _add_arm(parser)
    parser.add_argument("--deg", required=True, metavar='"30,40,…"', help=f"joints: {_JOINTS}")


def _add_pose_options(parser: argparse.ArgumentParser) -> None:
    _add_arm(parser)
    parser.add_argument("--xyz-mm", required=True, metavar='"x,y,z"', help=f"where the tool should be {_MM}")
    parser.add_argument(
        "--rpy-deg", metavar='"roll,pitch,yaw"', help="how it should be turned: Rz(yaw) Ry(pitch) Rx(roll)"
    )
    parser.add_argument("--task", help='what of the pose counts, for instance "position"; the arm\'s own if not given')
    _add_near(parser)


def _add_near(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--near-deg", metavar='"0,0,…"', help=f"where the joints are; home if not given: {_JOINTS}")


def _add_track_options(parser: argparse.ArgumentParser) -> None:
    _add_arm(parser)
    parser.add_argument("--path", default="line", metavar="NAME|FILE.csv", help="line, letter-board, ellipse, …")
    parser.add_argument("--from-mm", metavar='"x,y,z"', help=f"where the line starts {_MM}")
    parser.add_argument("--to-mm", metavar='"x,y,z"', help=f"where the line ends {_MM}")
    parser.add_argument("--samples", type=_samples, help="the number of points")
    parser.add_argument("--height-mm", metavar="z", help="of the letter divided by 40")
    parser.add_argument("--orientation", choices=get_args(PathOrientation), help="of the tool")
    _add_near(parser)
    parser.add_argument("--ignore-limits", action="store_true", help="leave the joint limits out of account")
    parser.add_argument("--csv", type=_output, metavar="FILE", help="write the joints, a row a point")
    parser.add_argument("--png", type=_output, metavar="FILE", help="draw the arm on its path")
    parser.epilog = _INDEX


def _no_options(_parser: argparse.ArgumentParser) -> None:
    """For a command that takes none."""


def _joined(arguments: Sequence[str]) -> list[str]:
    """`--deg -30,40` as `--deg=-30,40`."""
    joined: list[str] = []
    for argument in arguments:
        if joined and joined[-1] in _VECTOR_OPTIONS:
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _size(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{2,5})[x×](\d{2,5})", text.strip())
    if match is None:
        raise argparse.ArgumentTypeError(f"“{text}” is no size; write it like 1366x768")
    return int(match[1]), int(match[2])


def _samples(text: str) -> int:
    if not text.isdecimal() or not 2 <= int(text) <= 1_000_000:
        raise argparse.ArgumentTypeError(f"“{text}” is no number of points; it must be 2 or more, at most 1000000")
    return int(text)


def _output(text: str) -> str:
    """A file to be written: its folder must be there, a mistyped one is not made in silence."""
    folder = Path(text).parent
    if not folder.is_dir():
        raise argparse.ArgumentTypeError(f"there is no folder “{folder}” to write “{Path(text).name}” into")
    return text


# --- values ------------------------------------------------------------------------------------------------------


def _numbers(option: str, text: str, names: Sequence[str], units: Sequence[str]) -> FloatArray:
    """As many numbers or expressions, separated by commas (or semicolons), as there are names; each in its unit."""
    parts = _SEPARATOR.split(text) if ";" not in text else text.split(";")
    if len(parts) != len(names):
        raise InputError(
            f"{option} needs {len(names)} values ({', '.join(names)}), separated by commas; found {len(parts)}."
        )
    return np.array([evaluate_in(unit, part) for unit, part in zip(units, parts, strict=True)])


def _joints(robot: Robot, option: str, text: str) -> FloatArray:
    """q (n,) of typed degrees and millimetres (units)."""
    from rvsim.lab.tables import joint_units, shown_factors

    return _numbers(option, text, robot.joint_names, joint_units(robot)) / shown_factors(robot)


def _lengths(robot: Robot, option: str, text: str | None, names: Sequence[str]) -> FloatArray | None:
    """Typed millimetres (units) in metres, one a name; None where nothing was typed."""
    from rvsim.lab.tables import length_unit, shown_length

    if text is None:
        return None
    return _numbers(option, text, names, [length_unit(robot)] * len(names)) / shown_length(robot, 1.0)


# --- printing ----------------------------------------------------------------------------------------------------


# For a terminal that lacks the sign; a minus that became a question mark would change the number.
_PLAIN = {"−": "-", "–": "-", "…": "...", "°": " deg", "“": '"', "”": '"', "×": "x", "·": "*"}


def _plain_signs(problem: UnicodeError) -> tuple[str, int]:
    """A codec's error handler: the nearest sign that every terminal has."""
    if not isinstance(problem, UnicodeEncodeError):
        raise problem
    lacking = problem.object[problem.start : problem.end]
    return "".join(_PLAIN.get(sign, "?") for sign in lacking), problem.end


def _speak_any_encoding() -> None:
    codecs.register_error("rvsim-plain-signs", _plain_signs)
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):
            stream.reconfigure(errors="rvsim-plain-signs")  # type: ignore[union-attr]


def _print(options: argparse.Namespace, record: Any, text: str) -> None:
    from rvsim.lab.tables import json_text

    print(json_text(record) if options.json else text)


def _row(values: FloatArray, decimals: int = 1) -> str:
    return ", ".join(f"{value:.{decimals}f}" for value in np.round(values, decimals) + 0.0)


# --- jobs --------------------------------------------------------------------------------------------------------


def _window(options: argparse.Namespace) -> int:
    if options.robot is not None:
        load_robot(options.robot)  # an unknown arm is told before anything opens
    _require_display(options)
    from rvsim.gui.app import main as open_window

    return open_window(options)


def _require_display(options: argparse.Namespace) -> None:
    """Qt aborts without a display; a picture needs none."""
    seen = any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"))
    if seen or not sys.platform.startswith("linux"):
        return
    if options.screenshot is None:
        raise InputError(
            "There is no display for a window. Without one: rvsim --screenshot FILE.png, rvsim track ARM …"
        )
    os.environ["QT_QPA_PLATFORM"] = "offscreen"


def _robots(options: argparse.Namespace) -> int:
    own = user_robots()
    robots = [*(load_robot(name) for name in robot_names()), *own.by_file.values()]
    width = max(12, *(len(robot.name) for robot in robots))
    lines = [f"{robot.name:{width}} {robot.dof} joints  {robot.title}{_in_brackets(robot.family)}" for robot in robots]
    for problem in own.problems:
        print(f"rvsim: left out: {problem}", file=sys.stderr)
    _print(options, [_robot_record(robot) for robot in robots], "\n".join(lines))
    return DONE


def _in_brackets(text: str) -> str:
    return f" ({text})" if text else ""


def _robot_record(robot: Robot) -> dict[str, Any]:
    from rvsim.lab.tables import length_unit, shown_joints

    return {
        "name": robot.name,
        "title": robot.title,
        "dof": robot.dof,
        "convention": robot.convention,
        "joint_names": robot.joint_names,
        "joint_types": robot.joint_types,
        "limits": shown_joints(robot, robot.limits.T).T,
        "home": shown_joints(robot, robot.home),
        "length_unit": length_unit(robot),
        "source": robot.source,
    }


def _fk(options: argparse.Namespace) -> int:
    from rvsim.lab.tables import pose_record

    robot = load_robot(options.arm)
    q = _joints(robot, "--deg", options.deg)
    T = forward_kinematics(robot, q)
    pose, outside = pose_record(robot, T), _outside(robot, q)
    record = {"robot": robot.name, **pose, "T_base_tool": T, "outside_limits": outside}
    text = f"{_place_text(robot, T)}\nroll, pitch, yaw: ({_row(pose['rpy_deg'])})°"
    if outside:
        text += f"\nOutside its limits: {', '.join(outside)}."
    _print(options, record, text)
    return DONE


def _place_text(robot: Robot, T: FloatArray) -> str:
    from rvsim.lab.tables import length_unit, shown_length

    place = shown_length(robot, T[:3, 3])
    return f"({_row(place)}) mm" if length_unit(robot) == "mm" else f"({_row(place, 3)}) units"


def _outside(robot: Robot, q: FloatArray) -> list[str]:
    from rvsim.experiment import limit_violations

    return [robot.joint_names[violation.joint] for violation in limit_violations(robot, q)]


def _jacobian(options: argparse.Namespace) -> int:
    robot = load_robot(options.arm)
    J = jacobian(robot, _joints(robot, "--deg", options.deg))
    sigma = np.linalg.svd(J, compute_uv=False)
    rounded = np.round(J, 5) + 0.0  # no −0.00000
    rows = (
        f"{name:3} {'  '.join(f'{value:9.5f}' for value in row)}" for name, row in zip(_TWIST, rounded, strict=True)
    )
    length = "m" if robot.length_unit == "millimetre" else "unit"
    text = "\n".join([_JACOBIAN_HEADER.format(length), *rows, f"smallest singular value {sigma[-1]:.3e}"])
    _print(options, {"robot": robot.name, "J": J + 0.0, "sigma_min": sigma[-1]}, text)
    return DONE


_JACOBIAN_HEADER = "linear rows in {0}/rad ({0}/{0}), angular rows in rad/rad (rad/{0}); base axes, at the tool origin"
_TWIST = ("vx", "vy", "vz", "wx", "wy", "wz")


def _ik(options: argparse.Namespace) -> int:
    from rvsim.kinematics import forward_kinematics, inverse_kinematics, inverse_tasks
    from rvsim.lab.tables import inverse_record

    robot = load_robot(options.arm)
    task = options.task
    if options.rpy_deg is None and task is None:
        task = next((name for name in inverse_tasks(robot) if name in _PLACE_TASKS), None)
        if task is None:
            raise InputError(f"{robot.title} needs an orientation as well: --rpy-deg roll,pitch,yaw.")
    near = _near(robot, options)
    rotation = forward_kinematics(robot, near)[:3, :3]  # what is not asked for stays as it is, where it can
    if options.rpy_deg is not None:
        rpy_deg = _numbers("--rpy-deg", options.rpy_deg, ("roll", "pitch", "yaw"), 3 * ["deg"])
        rotation = rotation_from_rpy(radians_from_degrees(rpy_deg))
    place = _lengths(robot, "--xyz-mm", options.xyz_mm, "xyz")
    assert place is not None  # the option is required
    result = inverse_kinematics(robot, transform(rotation, place), task=task, near=near)
    _print(options, inverse_record(robot, result), _inverse_text(robot, result))
    return DONE if result.failure is None else FAILED


_PLACE_TASKS = ("position", "x,y")


def _inverse_text(robot: Robot, result: InverseResult) -> str:
    from rvsim.lab.tables import shown_joints

    width = max((len(branch.label) for branch in result.branches), default=0)
    lines = [
        f"{branch.label:{width}}  ({_row(shown_joints(robot, branch.q))})  "
        f"{'within the limits' if branch.within_limits else 'outside the limits'}  residual {branch.residual:.1e}"
        for branch in result.branches
    ]
    return "\n".join([*lines, *([] if result.failure is None else [result.failure.reason])])


def _near(robot: Robot, options: argparse.Namespace) -> FloatArray:
    return robot.home if options.near_deg is None else _joints(robot, "--near-deg", options.near_deg)


def _track(options: argparse.Namespace) -> int:
    from rvsim.lab import named_path
    from rvsim.lab.tables import tracking_csv, tracking_record
    from rvsim.motion import track

    robot = load_robot(options.arm)
    near = _near(robot, options)
    height = _lengths(robot, "--height-mm", options.height_mm, "z")
    path = named_path(
        options.path,
        robot,
        samples=options.samples,
        orientation=options.orientation,
        start=_lengths(robot, "--from-mm", options.from_mm, "xyz"),
        end=_lengths(robot, "--to-mm", options.to_mm, "xyz"),
        q=near,
        **({} if height is None else {"height": float(height[0])}),
    )
    tracking = track(robot, path, near=near, ignore_limits=options.ignore_limits)
    if options.csv:
        _write(options.csv, tracking_csv(tracking))
    if options.png:
        from rvsim.gui.tracking_picture import save_tracking_picture

        save_tracking_picture(tracking, options.png)
    _print(options, tracking_record(tracking), _tracking_text(tracking, options))
    return DONE if tracking.reached_count else FAILED


def _tracking_text(tracking: Tracking, options: argparse.Namespace) -> str:
    from rvsim.lab.sentences import advice_sentence, deviation_sentence, tracking_sentence

    sentences = (tracking_sentence(tracking), deviation_sentence(tracking), advice_sentence(tracking))
    written = [f"Written: {file}" for file in (options.csv, options.png) if file]
    return "\n".join(sentence for sentence in (*sentences, *written) if sentence)


def _write(file: str, text: str) -> None:
    from rvsim.files.atomic import write_atomically

    write_atomically(Path(file), text.encode())


def _reproduce(options: argparse.Namespace) -> int:
    from rvsim.lab.sources.reproduce import reproduce, reproduction_text

    rows = reproduce()
    _print(options, [row._asdict() for row in rows], reproduction_text(rows))
    return DONE


_COMMANDS: tuple[
    tuple[str, Callable[[argparse.Namespace], int], str, Callable[[argparse.ArgumentParser], None]], ...
] = (
    ("robots", _robots, "list the arms", _no_options),
    ("fk", _fk, "where the tool is", _add_arm_and_joints),
    ("jacobian", _jacobian, "how the tool moves with the joints", _add_arm_and_joints),
    ("ik", _ik, "which joints bring the tool to a pose", _add_pose_options),
    ("track", _track, "follow a path", _add_track_options),
    ("reproduce", _reproduce, "work the numbers of the sources out once more", _no_options),
)
