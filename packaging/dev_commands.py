"""What the commands do, once an environment stands."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from itertools import takewhile
from pathlib import Path

import dev_environment
import dev_screen
import dev_system
from dev_environment import ROOT
from dev_system import SetupError

BENCH = dev_environment.Kind(
    ".venv-bench",
    ("constraints.txt", "bench-constraints.txt"),
    # There is no pin for Windows; what needs it says so there.
    ("roboticstoolbox-python", "sympy", "eaik", "ur-analytic-ik", "pin; sys_platform != 'win32'", "threadpoolctl"),
)
# One core and one thread each, and the processor's own kernels: variables that choose slower ones are dropped.
_ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
_SLOWER_KERNELS = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")
# These measure what a person sees: on a screen, and with the whole machine.
_WINDOW_BENCHMARKS = ("bench_window",)
# Source 000, Program 12.
_SOURCE_LINE = ("--from-mm", "110,0,130", "--to-mm", "230,0,333", "--samples", "11")
_OFF_SCREEN = {"QT_QPA_PLATFORM": "offscreen"}


def run(arguments: list[str]) -> int:
    """Start rvsim; without a screen and without a wish, do its main job as a picture and a table."""
    dev_system.provide((*dev_environment.needs(), *dev_system.QT, *dev_system.window_needs(os.environ)))
    python = str(dev_environment.ensure())
    if dev_screen.has_screen(os.environ):
        return _become([python, "-m", "rvsim", *arguments])
    if arguments:
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
        return _become([python, "-m", "rvsim", *arguments])
    return _track_the_line(python)


def _become(command: list[str]) -> int:
    """Turn this process into the command, so that nothing of dev.py remains; Windows can only wait for it."""
    environment = dev_environment.child_environment()
    sys.stdout.flush()
    if os.name != "nt":
        os.execve(command[0], command, environment)
    return subprocess.call(command, env=environment)


def _track_the_line(python: str) -> int:
    """The main job without a window: the RV-M1 tracks the source's line. rvsim names the files that it writes."""
    print("There is no display here, so no window can open. Off-screen the RV-M1 tracks source 000's line.", flush=True)
    out = ROOT / "out"
    out.mkdir(exist_ok=True)
    files = ["--csv", str(out / "rv-m1-line.csv"), "--png", str(out / "rv-m1-line.png")]
    command = [python, "-m", "rvsim", "track", "rv-m1", "--path", "line", *_SOURCE_LINE, *files]
    return subprocess.call(command, env=dev_environment.child_environment(**_OFF_SCREEN))


def bench(arguments: list[str]) -> int:
    """Measure each benchmark in an environment of their own: arithmetic on one core, windows on a virtual screen."""
    names, options = _split(arguments)
    scripts = _scripts("benchmarks", "bench", names)
    windows = [script for script in scripts if script.stem in _WINDOW_BENCHMARKS]
    screen = dev_system.VIRTUAL_SCREEN if windows else ()
    dev_system.provide((*dev_environment.needs(BENCH), *dev_system.QT, *screen))
    python = str(dev_environment.ensure(BENCH))
    harness = ROOT / "tests" / "benchmarks" / "harness.py"
    with _one_core():
        arithmetic = [script for script in scripts if script not in windows]
        code = _run_each(python, [harness, *arithmetic], options, _bench_environment())
    if windows:
        with dev_screen.virtual_screen() if sys.platform == "linux" else nullcontext({}) as variables:
            code = max(code, _run_each(python, windows, options, {**_bench_environment(), **variables}))
    return code


def _bench_environment() -> dict[str, str]:
    environment = dev_environment.child_environment(**_ONE_THREAD)
    return {name: value for name, value in environment.items() if name not in _SLOWER_KERNELS}


@contextmanager
def _one_core() -> Iterator[None]:
    """Keep this process and those it starts on one core, where the system can."""
    if sys.platform != "linux":
        yield
        return
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(cores)})
    yield
    os.sched_setaffinity(0, cores)


def soak(arguments: list[str]) -> int:
    """Run the long random tests one after the other."""
    names, options = _split(arguments)
    scripts = _scripts("soak", "soak", names)
    dev_system.provide((*dev_environment.needs(), *dev_system.QT))
    python = str(dev_environment.ensure(extras=("test",)))
    return _run_each(python, scripts, options, dev_environment.child_environment(**_OFF_SCREEN))


def _split(arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """The names at the beginning, and the options for the scripts from the first one on."""
    names = list(takewhile(lambda argument: not argument.startswith("-"), arguments))
    return names, list(arguments[len(names) :])


def _scripts(folder: str, prefix: str, names: Sequence[str]) -> list[Path]:
    """The scripts tests/FOLDER/PREFIX_NAME.py: all of them, or those that were named."""
    found = sorted((ROOT / "tests" / folder).glob(f"{prefix}_*.py"))
    there = {path.stem.removeprefix(f"{prefix}_"): path for path in found}
    unknown = [name for name in names if name not in there]
    if unknown or not there:
        raise SetupError(f"There is no {prefix} {' or '.join(unknown)}. There are: {', '.join(there) or 'none'}.")
    return [there[name] for name in names] if names else found


def _run_each(python: str, scripts: list[Path], options: list[str], environment: dict[str, str]) -> int:
    codes = [subprocess.call([python, str(script), *options], env=environment, cwd=ROOT) for script in scripts]
    return max((abs(code) for code in codes), default=0)


def test(arguments: list[str]) -> int:
    """Every check there is; with arguments, only the tests that pytest chooses by them."""
    import dev_test

    return dev_test.test(arguments)


def bundle(arguments: list[str]) -> int:
    """A folder and a single file that run without Python."""
    import dev_bundle

    return dev_bundle.bundle(arguments)


def wheel(arguments: list[str]) -> int:
    """A wheel and an sdist."""
    import dev_wheel

    return dev_wheel.wheel(arguments)


def texts(arguments: list[str]) -> int:
    """Bring the catalogues of the languages up to date with the code."""
    python = str(dev_environment.ensure())
    return subprocess.call([python, str(ROOT / "packaging" / "dev_texts.py"), *arguments])


COMMANDS: dict[str, Callable[[list[str]], int]] = {
    "run": run,
    "test": test,
    "bench": bench,
    "soak": soak,
    "bundle": bundle,
    "texts": texts,
    "wheel": wheel,
}


def start(command: str, arguments: list[str]) -> int:
    """Do the command; what goes wrong in a way that is known is told in a sentence, without a traceback."""
    try:
        return COMMANDS[command](arguments)
    except SetupError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
