"""The command line: `rvsim` opens the window, a subcommand does one job without it.

Exit status: 0 done, 1 the outcome is a failure (no point reached, no solution), 2 the input cannot be used. What went
wrong is one sentence on the error stream, never a traceback. Results: sentences and tables, or JSON with --json.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from rvsim import __version__
from rvsim.cli import arm, arms, paths, report, self_test
from rvsim.cli.arguments import Parser, joined_values, named_session, refuse_other_files
from rvsim.cli.outcome import BAD_INPUT, DONE, FAILED, InputError
from rvsim.cli.output import speak_any_encoding
from rvsim.cli.window import add_window_options, leave, open_window
from rvsim.errors import RvsimError

__all__ = ["BAD_INPUT", "DONE", "FAILED", "InputError", "main", "run"]

_COMMANDS = (*arms.COMMANDS, *paths.COMMANDS, *report.COMMANDS, *arm.COMMANDS, *self_test.COMMANDS)


def run() -> NoReturn:
    """Do what the command line says, and end the process with the exit status: what `rvsim` starts."""
    leave(main())


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what the arguments say; the exit status."""
    speak_any_encoding()
    try:
        given = sys.argv[1:] if arguments is None else arguments
        named = named_session(given)
        refuse_other_files(named, [command.name for command in _COMMANDS])
        options = _parser().parse_args(joined_values(named))
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


def _parser() -> argparse.ArgumentParser:
    parser = Parser(prog="rvsim", description="See, move, compute and understand a robot arm.", allow_abbrev=False)
    parser.add_argument("--version", action="version", version=f"rvsim {__version__}")
    add_window_options(parser)
    parser.set_defaults(job=open_window)
    commands = parser.add_subparsers(title="without a window", metavar="COMMAND")
    for command in _COMMANDS:
        child = commands.add_parser(command.name, help=command.summary, description=command.summary, allow_abbrev=False)
        command.add_options(child)
        child.add_argument("--json", action="store_true", help="print JSON instead of sentences")
        child.set_defaults(job=command.job)
    return parser
