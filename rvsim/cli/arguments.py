"""What may be typed: the parser of all commands, and the options that several of them have."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple, NoReturn

from rvsim.cli.outcome import InputError
from rvsim.files.session_file import ENDING

# A value may begin with a minus sign; written with "=" it is not taken for an option.
_VECTOR_OPTIONS = ("--deg", "--near-deg", "--xyz-mm", "--rpy-deg", "--from-mm", "--to-mm", "--height-mm")
MM_NOTE = "[mm; units for an arm whose lengths have none]"
JOINTS_NOTE = f'degrees, for a prismatic joint {MM_NOTE}; or with the unit behind: "pi/4 rad, 12 cm"'


class Command(NamedTuple):
    """A job without a window; `job` returns the exit status."""

    name: str
    job: Callable[[argparse.Namespace], int]
    summary: str
    add_options: Callable[[argparse.ArgumentParser], None]


class Parser(argparse.ArgumentParser):
    """Says in one sentence what is wrong, and how to get help."""

    def error(self, message: str) -> NoReturn:
        """What is wrong, as the exception that `main` prints."""
        raise InputError(f"{message[:1].upper()}{message[1:]}. Type {self.prog} --help.")


def add_arm(parser: argparse.ArgumentParser) -> None:
    """The arm, as the first argument."""
    parser.add_argument("arm", metavar="ARM", help="a name that `rvsim robots` lists, or a robot file")


def add_arm_and_joints(parser: argparse.ArgumentParser) -> None:
    """An arm and a pose of it in joints."""
    add_arm(parser)
    parser.add_argument("--deg", required=True, metavar='"30,40,…"', help=f"joints: {JOINTS_NOTE}")


def add_near(parser: argparse.ArgumentParser) -> None:
    """Where the joints are, for what depends on it."""
    parser.add_argument("--near-deg", metavar='"0,0,…"', help=f"where the joints are; home if not given: {JOINTS_NOTE}")


def no_options(_parser: argparse.ArgumentParser) -> None:
    """For a command that takes none."""


def joined_values(arguments: Sequence[str]) -> list[str]:
    """`--deg -30,40` as `--deg=-30,40`."""
    joined: list[str] = []
    for argument in arguments:
        if joined and joined[-1] in _VECTOR_OPTIONS:
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def named_session(arguments: Sequence[str]) -> list[str]:
    """`rvsim FILE.rvsim`, as a double click has it, as `rvsim --open=FILE.rvsim`."""
    named = list(arguments)
    index = _first_word(named)
    if index is not None and named[index].lower().endswith(ENDING):
        named[index] = f"--open={named[index]}"
    return named


def _first_word(arguments: Sequence[str]) -> int | None:
    """Where a file is named, or a command, whose arguments are its own; None where there is nothing but options."""
    for index, argument in enumerate(arguments):
        before = arguments[index - 1] if index else ""
        belongs_to_option = before.startswith("-") and "=" not in before
        if not argument.startswith("-") and not belongs_to_option:
            return index
    return None


def refuse_other_files(arguments: Sequence[str], commands: Sequence[str]) -> None:
    """Say of a file that is no session what can be done with it: the parser would take it for a command.

    Raises:
        InputError: the first word is a file, and not one that is opened without a word.
    """
    index = _first_word(arguments)
    word = arguments[index] if index is not None else ""
    if not word or word in commands or not (Path(word).suffix or Path(word).exists()):
        return
    if word.lower().endswith(".toml"):
        raise InputError(f"{word} is not a session file (*{ENDING}). To open a robot file: rvsim --robot {word}.")
    raise InputError(f"{word} is not a session file (*{ENDING}). Type rvsim --help.")


def output_file(text: str) -> str:
    """A file to be written: its folder must be there, a mistyped one is not made in silence."""
    folder = Path(text).parent
    if not folder.is_dir():
        raise argparse.ArgumentTypeError(f"there is no folder “{folder}” to write “{Path(text).name}” into")
    return text
