"""The checkout's own Python environments: made when missing, made anew when something they stand on has changed."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import dev_system
from dev_system import SetupError

ROOT = Path(__file__).resolve().parent.parent
# The parts of pyproject.toml that decide what is installed; a new ruff rule makes no new environment.
_INSTALLED_BY = ("build-system", "project")
# Variables that would let foreign packages in, for instance those of a sourced ROS workspace.
_FOREIGN = ("PYTHONPATH", "PYTHONHOME", "PIP_TARGET", "PIP_PREFIX", "PIP_REQUIRE_HASHES", "__PYVENV_LAUNCHER__")


class Kind(NamedTuple):
    """One kind of environment: its folder, the files that pin its versions, and what is in it besides rvsim."""

    folder: str
    constraints: tuple[str, ...]
    peers: tuple[str, ...] = ()


APP = Kind(".venv", ("constraints.txt",))


class Stamp(NamedTuple):
    """What an environment was made of; written into it last, so that a half-made one has none."""

    place: str
    python: str
    pins: str
    extras: tuple[str, ...]


_CHANGED = {
    "place": "it was copied from another place",
    "python": "it belongs to another Python",
    "pins": "what is to be installed has changed",
}


def reason_to_make(found: Stamp | None, wanted: Stamp, exists: bool, starts: bool) -> str | None:
    """Why the environment must be made (anew), as the end of a sentence; None when it serves as it is."""
    if not exists:
        return "it is not there yet"
    if found is None:
        return "it was not finished"
    changed = [_CHANGED[field] for field in _CHANGED if getattr(found, field) != getattr(wanted, field)]
    if changed:
        return changed[0]
    return None if starts else "its Python is gone"


def extras_to_install(found: Stamp | None, wanted: Stamp) -> tuple[str, ...]:
    """The optional parts that the environment lacks."""
    have = found.extras if found else ()
    return tuple(extra for extra in wanted.extras if extra not in have)


def fingerprint(pyproject: Mapping[str, object], constraints: str, peers: tuple[str, ...] = ()) -> str:
    """A number that changes whenever something else would be installed."""
    parts = [pyproject.get(table) for table in _INSTALLED_BY]
    text = json.dumps([parts, constraints.splitlines(), peers], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def read_stamp(path: Path) -> Stamp | None:
    """The stamp in this file; None when there is none that can be read."""
    try:
        fields = json.loads(path.read_text(encoding="utf-8"))
        return Stamp(**{**fields, "extras": tuple(fields["extras"])})
    except (OSError, ValueError, TypeError, KeyError):
        return None


def python_of(folder: Path) -> Path:
    """The interpreter inside an environment."""
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def child_environment(**changes: str) -> dict[str, str]:
    """The variables for a process in an environment of ours: those of the person, less what would let others in."""
    kept = {name: value for name, value in os.environ.items() if name not in _FOREIGN}
    return {**kept, **changes}


def needs(kind: Kind = APP) -> tuple[dev_system.Need, ...]:
    """What the system must bring to make an environment of this kind; nothing once it is there."""
    return () if python_of(ROOT / kind.folder).exists() else dev_system.VENV


def ensure(kind: Kind = APP, extras: tuple[str, ...] = ()) -> Path:
    """The interpreter of an environment of this kind that has these extras, made now if need be."""
    folder = ROOT / kind.folder
    stamp_file = folder / "rvsim-stamp.json"
    python = python_of(folder)
    found, wanted = read_stamp(stamp_file), _wanted(kind, extras)
    reason = reason_to_make(found, wanted, folder.exists(), python.exists())
    if reason:
        print(f"Making {kind.folder}, because {reason}. This takes a minute or two.", flush=True)
        _make(folder)
        found = None
    lacking = extras_to_install(found, wanted)
    if reason or lacking:
        stamp_file.unlink(missing_ok=True)
        _install(python, kind, lacking)
        together = (found.extras if found else ()) + lacking
        stamp_file.write_text(json.dumps(wanted._replace(extras=together)._asdict()), encoding="utf-8")
        _try_qt(python)
    return python


def _wanted(kind: Kind, extras: tuple[str, ...]) -> Stamp:
    pyproject = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    constraints = "".join(path.read_text(encoding="utf-8") for path in _constraints(kind))
    # Not sys.version: its build date changes with every repair that a Linux distribution makes.
    base = f"{platform.python_implementation()} {platform.python_version()} {platform.machine()} {sys.base_prefix}"
    return Stamp(str(ROOT / kind.folder), base, fingerprint(pyproject, constraints, kind.peers), extras)


def _constraints(kind: Kind) -> list[Path]:
    return [ROOT / "packaging" / name for name in kind.constraints]


def _make(folder: Path) -> None:
    dev_system.provide(dev_system.VENV)
    try:
        if folder.exists():
            shutil.rmtree(folder)
    except OSError as error:
        raise SetupError(
            f"{folder.name} could not be removed ({error}). Close what runs from it, then try again."
        ) from None
    base = getattr(sys, "_base_executable", None) or sys.executable
    if subprocess.call([base, "-m", "venv", str(folder)], env=child_environment()) != 0:
        raise SetupError(f"{base} could not make an environment in {folder}; its own words are above.")


def _install(python: Path, kind: Kind, extras: tuple[str, ...]) -> None:
    rvsim = str(ROOT) + (f"[{','.join(extras)}]" if extras else "")
    # As addresses, because pip splits the variable at spaces, which a folder's name may have.
    constraints = " ".join(path.as_uri() for path in _constraints(kind))
    # Old and new pip hand the pins to the build's own environment by different variables.
    pins = {"PIP_CONSTRAINT": constraints, "PIP_BUILD_CONSTRAINT": constraints, "PIP_USER": "0"}
    command = [str(python), "-m", "pip", "install", "--disable-pip-version-check", "--editable", rvsim, *kind.peers]
    if subprocess.call(command, env=child_environment(**pins)) != 0:
        raise SetupError("pip could not install rvsim; its own words are above. It needs the network and 1 GB of disk.")


def _try_qt(python: Path) -> None:
    command = [str(python), "-c", "from PySide6 import QtWidgets, QtOpenGLWidgets"]
    outcome = subprocess.run(command, env=child_environment(), capture_output=True, text=True, check=False)
    if outcome.returncode != 0:
        last = (outcome.stderr.strip().splitlines() or ["no message"])[-1]
        print(f"The window will not open on this system, because Qt cannot be loaded: {last}", flush=True)
