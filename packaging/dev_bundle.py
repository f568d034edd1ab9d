"""The verb `bundle`: a folder and a single file that run without Python, weighed, timed, and tested by themselves."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from statistics import median
from typing import NamedTuple

import dev_environment
import dev_screen
import dev_system
from dev_environment import ROOT
from dev_system import Need, SetupError

KIND = dev_environment.Kind(".venv-bundle", ("constraints.txt", "bundle-constraints.txt"), ("pyinstaller", "hatchling"))
# PyInstaller asks objdump what a library needs; strip is in the same package.
TOOLS = (Need("objdump", "binutils"),) if sys.platform == "linux" else ()
MOST_MB, WISHED_MB = 270, 220
SLOWEST_START = 1.5  # [s] from the start of the program to the first picture in its window
_STARTS = 5
_LARGEST = 12
_OFF_SCREEN = {"QT_QPA_PLATFORM": "offscreen", "DISPLAY": "", "WAYLAND_DISPLAY": ""}
_DIST, _BUILD = ROOT / "dist", ROOT / "build"
_DESKTOP = """\
[Desktop Entry]
Type=Application
Name=rvsim
Comment=See, move, compute and understand a robot arm
Exec=rvsim %f
Icon=rvsim
Categories=Education;Science;Robotics;
Terminal=false
"""


class Made(NamedTuple):
    """What has been made: the folder and its program, the single file, the archive of the folder."""

    folder: Path
    program: Path
    one_file: Path
    archive: Path


def bundle(arguments: list[str]) -> int:
    """Make the bundles of this machine's kind in dist/; 0 if they are small enough and pass their self-test."""
    if arguments:
        raise SetupError("`bundle` takes no arguments.")
    dev_system.provide((*dev_environment.needs(KIND), *dev_system.QT, *dev_system.VIRTUAL_SCREEN, *TOOLS))
    python = str(dev_environment.ensure(KIND))
    made = _made(python)
    is_small = _weigh(made)
    passed = [_tested(variables, made) for variables in _screens()]
    _archived(made)
    print(f"{made.archive.relative_to(ROOT)}: {_megabytes(made.archive):.0f} MB")
    return 0 if is_small and all(passed) else 1


def version() -> str:
    """Of rvsim, as its source says."""
    line = next(
        line for line in (ROOT / "rvsim" / "__init__.py").read_text().splitlines() if line.startswith("__version__")
    )
    return line.partition('"')[2].rstrip('"')


def name(system: str = sys.platform, machine: str = "") -> str:
    """What a bundle is called: program, version, and what it runs on."""
    systems = {"win32": "windows", "darwin": "macos"}
    return f"rvsim-{version()}-{systems.get(system, system)}-{(machine or platform.machine()).lower()}"


def _made(python: str) -> Made:
    """Run PyInstaller, and put what it makes under its name."""
    work = _DIST / "work"
    shutil.rmtree(work, ignore_errors=True)
    command = ["PyInstaller", "--noconfirm", "--log-level", "ERROR", "--distpath", str(work), "--workpath", str(_BUILD)]
    print("Making the bundles takes a minute or two.", flush=True)
    command = [python, "-m", *command, str(ROOT / "packaging" / "rvsim.spec")]
    if subprocess.call(command, env=dev_environment.child_environment(), cwd=ROOT) != 0:
        raise SetupError("PyInstaller could not make the bundles; its own words are above.")
    suffix = ".exe" if sys.platform == "win32" else ""
    folder, one_file = _DIST / name(), _DIST / f"{name()}-one-file{suffix}"
    for old in (folder, one_file):
        shutil.rmtree(old) if old.is_dir() else old.unlink(missing_ok=True)
    shutil.move(work / "rvsim", folder)
    shutil.move(work / f"rvsim-one-file{suffix}", one_file)
    if sys.platform == "darwin":
        shutil.rmtree(folder)
        shutil.move(work / "rvsim.app", folder / "rvsim.app")
    shutil.rmtree(work)
    _add_papers(folder)
    program = {"win32": "rvsim-cli.exe", "darwin": "rvsim.app/Contents/MacOS/rvsim"}.get(sys.platform, "rvsim")
    return Made(folder, folder / program, one_file, _DIST / f"{name()}{_ending()}")


def _add_papers(folder: Path) -> None:
    """What a person looks for in the folder: the licences, the icon, and on Linux what puts rvsim into a menu."""
    papers = _BUILD / "rvsim" / "THIRD-PARTY.txt"
    for place in (folder, _DIST):
        shutil.copy(papers, place / "THIRD-PARTY.txt")
    shutil.copy(ROOT / "LICENSE", folder / "LICENSE.txt")
    if sys.platform == "linux":
        shutil.copy(_BUILD / "rvsim" / "icons" / "rvsim-256.png", folder / "rvsim.png")
        shutil.copy(ROOT / "resources" / "icons" / "rvsim.svg", folder / "rvsim.svg")
        (folder / "rvsim.desktop").write_text(_DESKTOP, encoding="utf-8")


def _ending() -> str:
    return ".zip" if sys.platform == "win32" else ".tar.xz"


def _archived(made: Made) -> None:
    """The folder as one file to hand out."""
    print("Packing the folder takes another minute.", flush=True)
    kind = "zip" if sys.platform == "win32" else "xztar"
    shutil.make_archive(str(_DIST / name()), kind, root_dir=_DIST, base_dir=made.folder.name)


# --- how large -------------------------------------------------------------------------------------------------------


def _weigh(made: Made) -> bool:
    """Print the sizes; whether the folder is as small as it must be."""
    sizes = {path: path.stat().st_size for path in made.folder.rglob("*") if path.is_file() and not path.is_symlink()}
    total = sum(sizes.values()) / 1e6
    print(f"{made.folder.relative_to(ROOT)}: {total:.0f} MB in {len(sizes)} files (at most {MOST_MB})")
    print(f"{made.one_file.relative_to(ROOT)}: {_megabytes(made.one_file):.0f} MB")
    print("The largest parts of the folder:")
    for part, size in largest(sizes, made.folder)[:_LARGEST]:
        print(f"  {size / 1e6:6.1f} MB  {part}")
    if total > MOST_MB:
        print(f"The folder is {total - MOST_MB:.0f} MB too large.")
    return total <= MOST_MB


def largest(sizes: Mapping[Path, int], folder: Path) -> list[tuple[str, int]]:
    """The packages and loose libraries in a bundle's folder, with their bytes, the largest first."""
    parts: dict[str, int] = {}
    for path, size in sizes.items():
        steps = path.relative_to(folder).parts
        part = steps[1] if steps[0] == "_internal" and len(steps) > 1 else steps[0]
        owner = "numpy" if part == "numpy.libs" else part
        parts[owner] = parts.get(owner, 0) + size
    return sorted(parts.items(), key=lambda entry: -entry[1])


def _megabytes(file: Path) -> float:
    return file.stat().st_size / 1e6


# --- how quick, and whether it works ---------------------------------------------------------------------------------


def _screens() -> Iterator[dict[str, str]]:
    """The variables of each screen that a bundle is tried on, while that screen is there."""
    yield _OFF_SCREEN
    if sys.platform == "linux":
        with dev_screen.virtual_screen() as variables:
            yield variables
    else:
        yield {}


def _tested(variables: Mapping[str, str], made: Made) -> bool:
    """Time both programs on a screen, and let the folder's, on the last screen both, test themselves."""
    environment = {**bare_environment(), **variables}
    screen = variables.get("QT_QPA_PLATFORM", "the screen")
    for program in (made.program, made.one_file):
        seconds = [_seconds_to_window(program, environment) for _ in range(_STARTS)]
        slow = f" (slower than {SLOWEST_START} s)" if median(seconds) > SLOWEST_START else ""
        print(f"first window on {screen}, {program.name}: {median(seconds):.2f} s, at first {seconds[0]:.2f} s{slow}")
    programs = [made.program] if screen == "offscreen" else [made.program, made.one_file]
    passed = [_passes(program, environment) for program in programs]
    return all(passed)


def bare_environment() -> dict[str, str]:
    """A bundle must need nothing of the environment that it was made in."""
    kept = ("HOME", "LANG", "PATH", "TMPDIR", "TEMP", "TMP", "SYSTEMROOT", "APPDATA", "LOCALAPPDATA", "USERPROFILE")
    return {name: value for name, value in os.environ.items() if name.upper() in kept}


def _seconds_to_window(program: Path, environment: Mapping[str, str]) -> float:
    """From the start of the program until its window has been painted [s]; it tells by its own clock."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "seconds"
        own = {**environment, "RVSIM_USER_FOLDER": folder}
        command = [str(program), "self-test", "--report", str(report), "--launched", repr(time.time())]
        ended = subprocess.run(command, env=own, cwd=folder, capture_output=True, text=True, check=False)
        if ended.returncode != 0:
            raise SetupError(f"{program.name} does not open its window: {ended.stderr.strip()[-300:]}")
        return float(report.read_text(encoding="utf-8"))


def _passes(program: Path, environment: Mapping[str, str]) -> bool:
    """Whether its self-test passes, started in another folder."""
    print(f"--- {program.name} self-test", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.call([str(program), "self-test"], env=dict(environment), cwd=folder) == 0
