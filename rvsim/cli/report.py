"""`rvsim report`: the lab report of an arm in a pose, and on a path if one is named, without a window."""

from __future__ import annotations

import argparse
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from rvsim.cli.arguments import JOINTS_NOTE, Command, add_arm, output_file
from rvsim.cli.outcome import DONE
from rvsim.cli.output import print_result
from rvsim.cli.values import typed_joints
from rvsim.files import load_robot

if TYPE_CHECKING:
    from rvsim.experiment import Experiment
    from rvsim.lab.report import Study


def _add_options(parser: argparse.ArgumentParser) -> None:
    add_arm(parser)
    parser.add_argument("--out", metavar="FOLDER", help="to be made; report-ARM if not given")
    parser.add_argument("--deg", metavar='"30,40,…"', help=f"the pose; home if not given: {JOINTS_NOTE}")
    parser.add_argument("--path", metavar="line|NAME", help="to be tracked: line, letter-board, ellipse, …")
    parser.add_argument("--title", help="of the report")
    parser.add_argument("--name", default="", help="of the student")
    parser.add_argument("--date", default="", help="as it is to stand there; today's if not given")
    parser.add_argument("--notes", default="", help="what was done and found")
    parser.add_argument("--animation", action="store_true", help="the motion as a GIF too")
    parser.add_argument("--png", type=output_file, metavar="FILE", help="three of its pages as a picture too")
    parser.add_argument("--zip", action="store_true", help="a .zip of the folder too")


def _report(options: argparse.Namespace) -> int:
    from rvsim.experiment import Notes, SessionState
    from rvsim.files.session_file import session_bytes
    from rvsim.gui.report.bundle import Order
    from rvsim.gui.report.headless import write_report
    from rvsim.lab.report import Cover, title_of

    study = _study(options)
    today = date.today()
    day = options.date or f"{today.day} {today:%B %Y}"
    cover = Cover(options.title or title_of(study), options.name, day, options.notes)
    folder = Path(options.out or f"report-{study.robot.name}").absolute()
    kept = replace(study.experiment, notes=Notes(options.name, options.notes))
    session = session_bytes(SessionState(kept))
    write_report(study, Order(folder, cover, None, options.animation, options.zip, session), options.png)
    files = sorted(file.name for file in folder.iterdir())
    lines = (f"Written: {folder} ({', '.join(files)})", *([f"Written: {options.png}"] if options.png else []))
    print_result(options, {"folder": str(folder), "files": files}, "\n".join(lines))
    return DONE


def _study(options: argparse.Namespace) -> Study:
    from rvsim.lab import default_experiment
    from rvsim.lab.repairs import motion_of, path_of
    from rvsim.lab.report import Study
    from rvsim.motion import track

    robot = load_robot(options.arm)
    experiment = default_experiment(robot)
    if options.deg is not None:
        experiment = experiment.at(typed_joints(robot, "--deg", options.deg))
    if options.path is None:
        return Study(experiment)
    experiment = _with_path(experiment, options.path)
    path = path_of("line" if options.path == "line" else "trajectory", experiment)
    tracking = track(robot, path, near=experiment.q)
    return Study(experiment, tracking, motion_of(tracking, experiment))


def _with_path(experiment: Experiment, name: str) -> Experiment:
    from rvsim.errors import UnknownNameError
    from rvsim.experiment import TrajectoryTask
    from rvsim.lab import path_names

    known = path_names(experiment.robot)
    if name != "line" and name not in known:
        raise UnknownNameError("path", name, ("line", *known))
    return experiment if name == "line" else replace(experiment, trajectory=TrajectoryTask(name))


COMMANDS = (Command("report", _report, "write the lab report of an arm: HTML, PDF, tables, script", _add_options),)
