"""The verb `wheel`: a wheel and an sdist, each installed into an environment of its own and tried there."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import dev_bundle
import dev_environment
import dev_system
from dev_environment import ROOT
from dev_system import SetupError

_DIST = ROOT / "dist"
_OFF_SCREEN = {"QT_QPA_PLATFORM": "offscreen"}
# Source 000, and everything else.
_TRIES = (("fk", "rv-m1", "--deg", "30,40,-50,20,60"), ("self-test",))


def wheel(arguments: list[str]) -> int:
    """Make a wheel and an sdist in dist/, install each as a user would, and try it; 0 if both work."""
    if arguments:
        raise SetupError("`wheel` takes no arguments.")
    dev_system.provide((*dev_system.VENV, *dev_system.QT))
    python = str(dev_environment.ensure(dev_bundle.KIND))
    environment = dev_environment.child_environment()
    if subprocess.call([python, "-m", "hatchling", "build", "-d", str(_DIST)], env=environment, cwd=ROOT) != 0:
        raise SetupError("hatchling could not build rvsim; its own words are above.")
    version = dev_bundle.version()
    made = (_DIST / f"rvsim-{version}-py3-none-any.whl", _DIST / f"rvsim-{version}.tar.gz")
    return max([_tried(package) for package in made])


def _tried(package: Path) -> int:
    """Install it into a new environment and use it from a folder that knows nothing of this one."""
    print(f"--- {package.relative_to(ROOT)}: {package.stat().st_size / 1e6:.1f} MB", flush=True)
    with tempfile.TemporaryDirectory(prefix="rvsim-wheel-") as folder:
        python = _installed(package, Path(folder) / "environment")
        program = shutil.which("rvsim", path=str(python.parent))
        if program is None:
            raise SetupError(f"{package.name} brings no program named rvsim.")
        environment = {**dev_bundle.bare_environment(), **_OFF_SCREEN}
        return max([subprocess.call([program, *words], env=environment, cwd=folder) for words in _TRIES])


def _installed(package: Path, folder: Path) -> Path:
    """The interpreter of a new environment that has it, in the versions that were tested together."""
    base = getattr(sys, "_base_executable", None) or sys.executable
    python = dev_environment.python_of(folder)
    pins = (ROOT / "packaging" / "constraints.txt").as_uri()
    install = ["pip", "install", "--quiet", "--disable-pip-version-check", str(package)]
    environment = dev_environment.child_environment(PIP_CONSTRAINT=pins, PIP_BUILD_CONSTRAINT=pins, PIP_USER="0")
    for command in ([base, "-m", "venv", str(folder)], [str(python), "-m", *install]):
        if subprocess.call(command, env=environment) != 0:
            raise SetupError(f"{package.name} cannot be installed; the words above say why.")
    return python
