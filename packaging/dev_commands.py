"""What `run`, `test`, `bench` and `soak` do, once an environment stands."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import dev_environment
import dev_system
from dev_environment import ROOT
from dev_system import SetupError

BENCH = dev_environment.Kind(".venv-bench", "bench-constraints.txt", ("roboticstoolbox-python", "pin"))
# One core and one thread each, and the processor's own kernels: variables that choose slower ones are dropped.
_ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
_SLOWER_KERNELS = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")
_OFF_SCREEN = {"QT_QPA_PLATFORM": "offscreen"}


def run(arguments: list[str]) -> int:
    """Start rvsim; without a screen and without a wish, do its main job as a picture and a table."""
    dev_system.provide((*dev_system.QT, *dev_system.window_needs(os.environ)))
    python = str(dev_environment.ensure())
    if dev_system.has_screen(os.environ):
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
    """The main job without a window: the RV-M1 tracks the source's line; says where the results are."""
    print("There is no display here, so no window can open: tracking the RV-M1's line off-screen instead.", flush=True)
    out = ROOT / "out"
    out.mkdir(exist_ok=True)
    table, picture = out / "rv-m1-line.csv", out / "rv-m1-line.png"
    job = ["track", "rv-m1", "--path", "line", "--csv", str(table), "--png", str(picture)]
    code = subprocess.call([python, "-m", "rvsim", *job], env=dev_environment.child_environment(**_OFF_SCREEN))
    for name, path in (("picture", picture), ("table", table)):
        print(f"{name}: {path}" if path.exists() else f"The {name} was not written.")
    return code


def bench(names: list[str]) -> int:
    """Measure each benchmark in an environment of their own, on one core."""
    dev_system.provide(dev_system.QT)
    scripts = _scripts("benchmarks", "bench", names)
    python = str(dev_environment.ensure(BENCH))
    environment = dev_environment.child_environment(**_ONE_THREAD)
    for name in _SLOWER_KERNELS:
        environment.pop(name, None)
    if sys.platform == "linux":
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    harness = ROOT / "tests" / "benchmarks" / "harness.py"
    return _run_each(python, [harness, *scripts], environment)


def soak(names: list[str]) -> int:
    """Run the long random tests one after the other."""
    dev_system.provide(dev_system.QT)
    scripts = _scripts("soak", "soak", names)
    python = str(dev_environment.ensure(extras=("test",)))
    return _run_each(python, scripts, dev_environment.child_environment(**_OFF_SCREEN))


def _scripts(folder: str, prefix: str, names: Sequence[str]) -> list[Path]:
    """The scripts tests/FOLDER/PREFIX_NAME.py: all of them, or those that were named."""
    there = {
        path.stem.removeprefix(f"{prefix}_"): path for path in sorted((ROOT / "tests" / folder).glob(f"{prefix}_*.py"))
    }
    unknown = [name for name in names if name not in there]
    if unknown or not there:
        raise SetupError(f"There is no {prefix} named {', '.join(unknown)}. There are: {', '.join(there) or 'none'}.")
    return [there[name] for name in names] if names else list(there.values())


def _run_each(python: str, scripts: list[Path], environment: dict[str, str]) -> int:
    codes = [subprocess.call([python, str(script)], env=environment, cwd=ROOT) for script in scripts]
    return max((abs(code) for code in codes), default=0)


def test(arguments: list[str]) -> int:
    """Every check there is; with arguments, only the tests that pytest chooses by them."""
    import dev_test

    return dev_test.test(arguments)


COMMANDS: dict[str, Callable[[list[str]], int]] = {"run": run, "test": test, "bench": bench, "soak": soak}


def start(command: str, arguments: list[str]) -> int:
    """Do the command; what goes wrong in a way that is known is told in a sentence, without a traceback."""
    try:
        return COMMANDS[command](arguments)
    except SetupError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
