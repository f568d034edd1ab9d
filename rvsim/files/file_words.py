"""Sentences about a file as a whole: it is not there, it may not be read, it is empty, too large or cut off."""

from __future__ import annotations

from rvsim.language import tr


def unread(path: object, problem: Exception) -> str:
    """Why a file could not be read at all."""
    if isinstance(problem, FileNotFoundError):
        return tr("There is no file {path}.", path=path)
    if isinstance(problem, PermissionError):
        return tr("{path} may not be read: its owner, or this computer, does not permit it.", path=path)
    reason = str(getattr(problem, "strerror", None) or problem)
    return tr("{path} cannot be read: {reason}.", path=path, reason=reason.lower())


def too_large(path: object, most: int) -> str:
    """It has more than so many bytes."""
    megabytes, kilobytes = most // 1024**2, most // 1024
    if megabytes:
        return tr("{path} is too large: at most {most} MB are read.", path=path, most=megabytes)
    return tr("{path} is too large: at most {most} kB are read.", path=path, most=kilobytes)


def empty(path: object) -> str:
    """There is nothing in it."""
    return tr("{path} is empty.", path=path)


def cut_off(path: object, line: int) -> str:
    """It ends where it must go on."""
    return tr("{path} ends in line {line} in the middle of something: it may be cut off.", path=path, line=line)
