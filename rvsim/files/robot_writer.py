"""A robot as the text of a robot file: commented, in the file's units, the shortest decimals that mean the same."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rvsim.files.kinds import Items, Key, Table
from rvsim.files.place import Units
from rvsim.files.robot_format import ROBOT
from rvsim.robot import Robot

_PREAMBLE = """\
# A robot file of rvsim. Angles are degrees, lengths {length_unit}s; q is the joint variable, 0 in the DH table's pose.
# standard:  A = Rz(theta) Tz(d) Tx(a) Rx(alpha)      modified (Craig):  A = Rx(alpha) Tx(a) Tz(d) Rz(theta)
"""


def robot_text(robot: Robot) -> str:
    """The robot file of an arm; `load_robot` reads it back equal within 1e-12."""
    present = ROBOT.present(robot, Units())
    flat = [line for key, value, units in present if not _has_tables(key) for line in _line(key, value, units, True)]
    tables = [line for key, value, units in present if _has_tables(key) for line in _tables(key, value, units)]
    return _PREAMBLE.format(length_unit=robot.length_unit) + "\n" + "\n".join([*flat, *tables]) + "\n"


def _has_tables(key: Key) -> bool:
    return isinstance(key.kind, Table) or (isinstance(key.kind, Items) and isinstance(key.kind.kind, Table))


def _tables(key: Key, value: Any, units: Units) -> Iterator[str]:
    if isinstance(key.kind, Items):
        for index, item in enumerate(value):
            yield from _table(f"[[{key.name}]]", key.kind.kind, item, units, key.comment if index == 0 else "")
    else:
        yield from _table(f"[{key.name}]", key.kind, value, units, key.comment)


def _table(header: str, kind: Any, value: Any, units: Units, comment: str) -> Iterator[str]:
    yield ""
    yield f"{header}  # {comment}" if comment else header
    for key, part, inner in kind.present(value, units):
        yield from _line(key, part, inner, bool(comment))


def _line(key: Key, value: Any, units: Units, commented: bool) -> Iterator[str]:
    line = f"{key.name} = {key.kind.write(value, units)}"
    yield f"{line}  # {key.comment}" if commented and key.comment else line
