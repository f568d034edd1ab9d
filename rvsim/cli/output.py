"""What is printed and written: sentences or JSON, readable on any terminal."""

from __future__ import annotations

import argparse
import codecs
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from rvsim.robot.arrays import FloatArray

# For a terminal that lacks the sign; a minus that became a question mark would change the number.
_PLAIN = {"−": "-", "–": "-", "…": "...", "°": " deg", "“": '"', "”": '"', "×": "x", "·": "*"}


def _plain_signs(problem: UnicodeError) -> tuple[str, int]:
    """A codec's error handler: the nearest sign that every terminal has."""
    if not isinstance(problem, UnicodeEncodeError):
        raise problem
    lacking = problem.object[problem.start : problem.end]
    return "".join(_PLAIN.get(sign, "?") for sign in lacking), problem.end


def speak_any_encoding() -> None:
    """Keep a terminal that lacks a sign from raising: it gets the nearest one that it has."""
    codecs.register_error("rvsim-plain-signs", _plain_signs)
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):
            stream.reconfigure(errors="rvsim-plain-signs")  # type: ignore[union-attr]


def print_result(options: argparse.Namespace, record: Any, text: str) -> None:
    """The record as JSON where `--json` asks for it, otherwise the sentences."""
    from rvsim.lab.tables import json_text

    print(json_text(record) if options.json else text)


def number_row(values: FloatArray, decimals: int = 1) -> str:
    """Numbers separated by commas, none of them −0."""
    return ", ".join(f"{value:.{decimals}f}" for value in np.round(values, decimals) + 0.0)


def write_text(file: str, text: str) -> None:
    """A whole file or none."""
    from rvsim.files.atomic import write_atomically

    write_atomically(Path(file), text.encode())
