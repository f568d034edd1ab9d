"""The exceptions of rvsim. Each takes data and writes its own message: the culprit, the rule, what would have worked.

    RvsimError
    ├── ShapeError             an array has the wrong shape for this arm
    ├── RobotDefinitionError   values that make no arm (no joint, a lower limit above the upper one)
    ├── UnknownRobotError      a name that is no built-in arm and no file
    ├── RobotFileError         a robot file that cannot be read, with its path, table and key
    ├── UnknownNameError       a name outside a closed list (a path, a tool, an orientation)
    ├── LetterError            a text that the pen cannot write
    ├── NotFiniteError         a number that is none (NaN) or infinite, with its place in the array
    ├── TooManyPointsError     a path of so many points that nobody would wait for it
    ├── PathFileError          a file of points that cannot be read, with its row and column
    ├── ProgramFileError       a program that cannot be read, with its line and key
    ├── SessionFileError       a session file that cannot be read, with the place in it
    ├── FileWriteError         a file that cannot be written, with its path and the reason
    ├── ExpressionError        a typed value that is no number
    ├── FormulaError           a typed formula of a path that cannot be worked out, with its stage and coordinate
    ├── PoseError              a 4 × 4 matrix that is no pose of a tool
    ├── SettingError           a setting of a solver outside what it may be
    ├── NoClosedFormError      an arm whose inverse kinematics has no closed form here
    ├── NoMassDataError        dynamics asked of an arm without masses
    └── DeviceError            a port, a link or an arm on a wire that cannot be used, with what would help

Ordinary outcomes ("out of reach") are values, never exceptions.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from rvsim.language import left_to_right, tr


def did_you_mean(found: str, known: Sequence[str]) -> str:
    """The sentence that offers what would have worked: the nearest of the known names, and all of them."""
    near = get_close_matches(found.lower(), [name.lower() for name in known], n=1)
    originals = {name.lower(): name for name in known}
    if near:
        return tr("Did you mean {guess!r}? Known: {known}.", guess=originals[near[0]], known=", ".join(known))
    return tr("Known: {known}.", known=", ".join(known))


def _unreadable(path: object, where: str, found: str, expected: str, suggestion: str = "") -> str:
    """What is wrong at a place of a file, and what would work; `found` alone where nothing is said to be expected."""
    message = tr(
        "{path}: {where}: found {found}, expected {expected}.", path=path, where=where, found=found, expected=expected
    )
    return f"{message if expected else found} {suggestion}".rstrip()


_TAG = re.compile(r"<(?=\s*[A-Za-z/!?])")


def without_markup(text: str) -> str:
    """A text that no widget takes for HTML: a name in a file could make it read any other file, for instance /dev/zero.

    Where a tag could begin stands "‹" instead.
    """
    return _TAG.sub("‹", text)


class RvsimError(Exception):
    """The root of every exception that rvsim raises on purpose."""

    def __str__(self) -> str:
        """The message; what of it is from a file is no markup."""
        return without_markup(super().__str__())


class ShapeError(RvsimError, ValueError):
    """An array has the wrong shape for this arm."""

    def __init__(self, name: str, expected: str, found: tuple[int, ...]) -> None:
        self.name, self.expected, self.found = name, expected, found
        super().__init__(
            tr("{name} must have the shape {expected}, but has {found}.", name=name, expected=expected, found=found)
        )


class RobotDefinitionError(RvsimError, ValueError):
    """Values that make no arm."""

    def __init__(self, robot: str, what: str) -> None:
        self.robot, self.what = robot, what
        super().__init__(tr("Robot {robot!r}: {what}", robot=robot, what=what))


class UnknownRobotError(RvsimError, LookupError):
    """A name that is neither a built-in arm nor a file."""

    def __init__(self, name: str, known: Sequence[str]) -> None:
        self.name, self.known = name, tuple(known)
        super().__init__(f"{tr('No robot {name!r}, and no such file.', name=name)} {did_you_mean(name, known)}")


class RobotFileError(RvsimError, ValueError):
    """A robot file that cannot be read or makes no arm.

    Args:
        path: the file.
        where: table and key, for instance "joint 3, key 'alpha'".
        found: what stands there; or a sentence about the whole file.
        expected: what should stand there; "" with a sentence.
        suggestion: what would work, a sentence (may be empty).
    """

    def __init__(self, path: object, where: str, found: str, expected: str, suggestion: str = "") -> None:
        self.path, self.where, self.suggestion = str(path), where, suggestion
        self.found, self.expected = found, expected
        super().__init__(_unreadable(path, where, found, expected, suggestion))


class UnknownNameError(RvsimError, LookupError):
    """A name outside a closed list."""

    def __init__(self, kind: str, name: str, known: Sequence[str]) -> None:
        self.kind, self.name, self.known = kind, name, tuple(known)
        unknown = tr("No {kind} {name!r}.", kind=tr(kind), name=name)
        super().__init__(f"{unknown} {did_you_mean(name, known)}")


class LetterError(RvsimError, LookupError):
    """A text that the pen cannot write: a letter that its font has not, or no letter at all."""

    def __init__(self, letter: str) -> None:
        self.letter = letter
        super().__init__(
            tr(
                "The pen cannot write “{letter}”. It knows the Latin letters with and without accents, digits and the "
                "usual signs.",
                letter=letter,
            )
            if letter
            else tr("Type a letter or more to be written.")
        )


class NotFiniteError(RvsimError, ValueError):
    """A number in an array that is none (NaN) or infinite; `index` is its place, counted from 0."""

    def __init__(self, name: str, index: tuple[int, ...], found: float) -> None:
        self.name, self.index, self.found = name, index, found
        place = ", ".join(map(str, index))
        super().__init__(
            tr(
                "{name}[{place}] is {found}, but must be a finite number (indices count from 0).",
                name=name,
                place=place,
                found=found,
            )
        )


class TooLargeError(RvsimError, ValueError):
    """A length or factor with which nothing can be worked out: its square is no number."""

    def __init__(self, name: str, found: float, most: float) -> None:
        self.name, self.found, self.most = name, found, most
        super().__init__(
            tr(
                "{name} is {found:g}, and that is too large for an arm: at most {most:g}.",
                name=name,
                found=found,
                most=most,
            )
        )


class TooManyPointsError(RvsimError, ValueError):
    """A path of so many points that nobody would wait for it."""

    def __init__(self, what: str, points: float, most: int, advice: str) -> None:
        self.what, self.points, self.most = what, points, most
        super().__init__(
            tr(
                "{what} would have about {points:.3g} points, and a path has at most {most}: {advice}.",
                what=what,
                points=points,
                most=most,
                advice=advice,
            )
        )


class PathFileError(RvsimError, ValueError):
    """A file of points that cannot be read."""

    def __init__(self, path: object, where: str, found: str, expected: str) -> None:
        self.path, self.where, self.found, self.expected = str(path), where, found, expected
        super().__init__(_unreadable(path, where, found, expected))


class ProgramFileError(RvsimError, ValueError):
    """A file of a program that cannot be read; the arguments are those of `RobotFileError`."""

    def __init__(self, path: object, where: str, found: str, expected: str, suggestion: str = "") -> None:
        self.path, self.where, self.found, self.expected = str(path), where, found, expected
        super().__init__(_unreadable(path, where, found, expected, suggestion))


class SessionFileError(RvsimError, ValueError):
    """A session file that cannot be read, or a session that no file may hold; arguments as of `RobotFileError`."""

    def __init__(self, path: object, where: str, found: str, expected: str, suggestion: str = "") -> None:
        self.path, self.where, self.suggestion = str(path), where, suggestion
        self.found, self.expected = found, expected
        super().__init__(_unreadable(path, where, found, expected, suggestion))


class FileWriteError(RvsimError, OSError):
    """A file that cannot be written."""

    def __init__(self, path: object, reason: str) -> None:
        self.path, self.reason = str(path), reason
        super().__init__(tr("{path} cannot be written: {reason}.", path=path, reason=reason))


class ExpressionError(RvsimError, ValueError):
    """A typed value that is no number."""

    def __init__(self, text: str, reason: str) -> None:
        self.text, self.reason = text, reason
        super().__init__(
            tr(
                "“{text}” is no number: {reason}. Type a number or an expression like 90/4, 2*30, pi/4 rad.",
                text=text,
                reason=reason,
            )
        )


class FormulaError(RvsimError, ValueError):
    """A typed formula of a path that cannot be worked out."""

    def __init__(self, stage: int, coordinate: str, text: str, reason: str) -> None:
        self.stage, self.coordinate, self.text, self.reason = stage, coordinate, text, reason
        super().__init__(
            tr(
                "Stage {stage}, {coordinate}: “{text}” does not work: {reason}.",
                stage=stage,
                coordinate=coordinate,
                text=text,
                reason=reason,
            )
        )


class PoseError(RvsimError, ValueError):
    """A 4 × 4 matrix that is no pose of a tool."""

    def __init__(self, what: str) -> None:
        self.what = what
        super().__init__(tr("This matrix is no pose: {what}", what=what))


class SettingError(RvsimError, ValueError):
    """A setting of a solver outside what it may be; `rule` completes "must be …"."""

    def __init__(self, name: str, found: object, rule: str) -> None:
        self.name, self.found, self.rule = name, found, rule
        super().__init__(tr("{name} must be {rule}, but is {found!r}.", name=name, rule=rule, found=found))


class NoClosedFormError(RvsimError):
    """An arm whose inverse kinematics has no closed form here."""

    def __init__(self, robot: str, why: str) -> None:
        self.robot, self.why = robot, why
        super().__init__(tr("{robot} has no closed form for its inverse kinematics: {why}", robot=robot, why=why))


class NoMassDataError(RvsimError):
    """Dynamics asked of an arm without masses."""

    def __init__(self, robot: str) -> None:
        self.robot = robot
        super().__init__(
            tr(
                "{robot} has no mass data: add a mass and a centre of mass for each link to its robot file.",
                robot=robot,
            )
        )


class DeviceError(RvsimError, OSError):
    """A port, a link or an arm on a wire that cannot be used.

    Args:
        port: its name or URL.
        what: what is wrong, a part of a sentence without a full stop.
        remedy: what would help, a whole sentence (may be empty).
    """

    def __init__(self, port: str, what: str, remedy: str = "") -> None:
        self.port, self.what, self.remedy = port, what, remedy
        super().__init__(f"{left_to_right(port)}: {what}. {remedy}".rstrip())
