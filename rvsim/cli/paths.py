"""Following a path, and working the numbers of the sources out once more: `track`, `reproduce`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, get_args

from rvsim.cli.arguments import MM_NOTE, Command, add_arm, add_near, no_options, output_file
from rvsim.cli.outcome import DONE, FAILED
from rvsim.cli.output import print_result, write_text
from rvsim.cli.values import near_joints, typed_lengths
from rvsim.experiment import PathOrientation
from rvsim.files import load_robot

if TYPE_CHECKING:
    from rvsim.motion import Tracking

INDEX_NOTE = "An index in JSON and CSV counts from 0; sentences count points from 1."


def _add_track_options(parser: argparse.ArgumentParser) -> None:
    add_arm(parser)
    parser.add_argument("--path", default="line", metavar="NAME|FILE.csv", help="line, letter-board, ellipse, …")
    parser.add_argument("--from-mm", metavar='"x,y,z"', help=f"where the line starts {MM_NOTE}")
    parser.add_argument("--to-mm", metavar='"x,y,z"', help=f"where the line ends {MM_NOTE}")
    parser.add_argument("--samples", type=_samples, help="the number of points")
    parser.add_argument("--height-mm", metavar="z", help="of the letter divided by 40")
    parser.add_argument("--orientation", choices=get_args(PathOrientation), help="of the tool")
    parser.add_argument("--plane", metavar="level|facing|sideways", help="that a flat shape (circle, star, …) lies in")
    add_near(parser)
    parser.add_argument("--ignore-limits", action="store_true", help="leave the joint limits out of account")
    parser.add_argument("--csv", type=output_file, metavar="FILE", help="write the joints, a row a point")
    parser.add_argument("--png", type=output_file, metavar="FILE", help="draw the arm on its path")
    parser.epilog = INDEX_NOTE


def _samples(text: str) -> int:
    if not text.isdecimal() or not 2 <= int(text) <= 1_000_000:
        raise argparse.ArgumentTypeError(f"“{text}” is no number of points; it must be 2 or more, at most 1000000")
    return int(text)


def _track(options: argparse.Namespace) -> int:
    from rvsim.lab import named_path
    from rvsim.lab.tables import tracking_csv, tracking_record
    from rvsim.motion import track

    robot = load_robot(options.arm)
    near = near_joints(robot, options)
    height = typed_lengths(robot, "--height-mm", options.height_mm, "z")
    path = named_path(
        options.path,
        robot,
        samples=options.samples,
        orientation=options.orientation,
        start=typed_lengths(robot, "--from-mm", options.from_mm, "xyz"),
        end=typed_lengths(robot, "--to-mm", options.to_mm, "xyz"),
        q=near,
        plane=options.plane,
        **({} if height is None else {"height": float(height[0])}),
    )
    tracking = track(robot, path, near=near, ignore_limits=options.ignore_limits)
    if options.csv:
        write_text(options.csv, tracking_csv(tracking))
    if options.png:
        from rvsim.gui.tracking_picture import save_tracking_picture

        save_tracking_picture(tracking, options.png)
    print_result(options, tracking_record(tracking), _tracking_text(tracking, options))
    return DONE if tracking.reached_count else FAILED


def _tracking_text(tracking: Tracking, options: argparse.Namespace) -> str:
    from rvsim.lab.sentences import advice_sentence, deviation_sentence, tracking_sentence

    sentences = (tracking_sentence(tracking), deviation_sentence(tracking), advice_sentence(tracking))
    written = [f"Written: {file}" for file in (options.csv, options.png) if file]
    return "\n".join(sentence for sentence in (*sentences, *written) if sentence)


def _reproduce(options: argparse.Namespace) -> int:
    from rvsim.lab.sources.reproduce import reproduce, reproduction_text

    rows = reproduce()
    print_result(options, [row._asdict() for row in rows], reproduction_text(rows))
    return DONE


COMMANDS = (
    Command("track", _track, "follow a path", _add_track_options),
    Command("reproduce", _reproduce, "work the numbers of the sources out once more", no_options),
)
