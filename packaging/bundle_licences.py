"""THIRD-PARTY.txt: every part of a bundle that others have made, its licence, and the texts of all these licences.

The parts are the libraries that rvsim requires, Python, the start-up program of PyInstaller, and what was taken from
the system. The texts come from the installed wheels; resources/licences has those that wheels lack.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterable
from importlib.metadata import Distribution, distribution
from pathlib import Path
from typing import NamedTuple

TEXTS = Path(__file__).resolve().parent.parent / "resources" / "licences"
_IS_TEXT = re.compile(r"(^|[/_-])(licen[cs]e|copying|notice)", re.IGNORECASE)
_QT = ("qt.txt", "LGPL-3.0.txt", "GPL-3.0.txt", "qt-parts.txt")
# What wheels lack: their licence's text, or that of a font; the files in resources/licences.
SUPPLIED = {
    "PySide6_Essentials": _QT,
    "shiboken6": (),  # the same as PySide6
    "pyserial": ("pyserial.txt",),
    "PyOpenGL": ("PyOpenGL.txt",),
    "latex2mathml": ("latex2mathml.txt",),
    "ziafont": ("DejaVu-Sans.txt",),
    "ziamath": ("STIX-Two-Math.txt",),
}
# Where wheels say less than there is to say.
_LICENCES = {"PySide6_Essentials": "LGPL-3.0-only", "shiboken6": "LGPL-3.0-only"}
_HEAD = """\
What rvsim is made of, besides its own code (MIT licence); the texts of all licences follow the list.

The pen's letters: the Hershey Fonts were originally created by Dr. A. V. Hershey while working at the U.S. National
Bureau of Standards. The format of the font data from which ours was converted was originally created by James Hurt,
Cognition, Inc., 900 Technology Park Drive, Billerica, MA 01821.

"""
_LINE = "=" * 100


class Part(NamedTuple):
    """Something made by others."""

    name: str
    version: str
    licence: str
    home: str
    texts: tuple[str, ...]


def required(roots: Iterable[str] = ("rvsim",)) -> list[Distribution]:
    """What these distributions need to run here, what that needs, and so on, by name; without rvsim itself."""
    from packaging.requirements import Requirement

    found: dict[str, Distribution] = {}
    waiting = list(roots)
    while waiting:
        part = distribution(waiting.pop())
        if part.metadata["Name"] in found:
            continue
        found[part.metadata["Name"]] = part
        needs = [Requirement(text) for text in part.requires or ()]
        waiting += [need.name for need in needs if need.marker is None or need.marker.evaluate({"extra": ""})]
    return sorted((part for name, part in found.items() if name != "rvsim"), key=lambda part: _name(part).lower())


def _name(part: Distribution) -> str:
    return str(part.metadata["Name"])


def part_of(wheel: Distribution) -> Part:
    """A library, with the texts of its licence.

    Raises:
        LookupError: neither the wheel nor resources/licences has any.
    """
    name = _name(wheel)
    inside = [file for file in wheel.files or () if ".dist-info" in str(file) and _IS_TEXT.search(str(file))]
    texts = [Path(str(file.locate())).read_text(encoding="utf-8", errors="replace") for file in sorted(inside, key=str)]
    texts += [(TEXTS / file).read_text(encoding="utf-8") for file in SUPPLIED.get(name, ())]
    if not texts and name not in SUPPLIED:
        raise LookupError(f"the wheel of {name} has no licence, and packaging/bundle_licences.py names none")
    return Part(name, wheel.version, _licence(wheel), _home(wheel), tuple(texts))


def _licence(wheel: Distribution) -> str:
    about = wheel.metadata
    named = _LICENCES.get(_name(wheel)) or about["License-Expression"] or about["License"] or ""
    if named and "\n" not in named and len(named) < 80 and "Copyright" not in named:
        return str(named)
    kinds = [line for line in about.get_all("Classifier") or () if line.startswith("License ::")]
    return kinds[0].rpartition("::")[2].strip() if kinds else "see its text"


def _home(wheel: Distribution) -> str:
    links = dict(line.partition(", ")[::2] for line in wheel.metadata.get_all("Project-URL") or ())
    order = ("Source", "Source Code", "Source code", "source", "repository", "Repository", "Homepage", "homepage")
    return next((links[name] for name in order if name in links), wheel.metadata["Home-page"] or "")


def python_part() -> Part:
    """Python itself."""
    stdlib = Path(sysconfig.get_path("stdlib"))
    version = ".".join(map(str, sys.version_info[:3]))
    debian = Path("/usr/share/doc") / f"python{version.rpartition('.')[0]}" / "copyright"
    places = (stdlib / "LICENSE.txt", Path(sys.base_prefix) / "LICENSE.txt", debian)
    texts = [place.read_text(encoding="utf-8") for place in places if place.is_file()][:1]
    return Part("Python", version, "PSF-2.0", "https://www.python.org", tuple(texts))


def system_parts(libraries: Iterable[Path]) -> list[Part]:
    """The packages of this Debian or Ubuntu that these libraries belong to; elsewhere the libraries by name."""
    owners: dict[str, list[str]] = {}
    for library in libraries:
        owners.setdefault(_owner(library), []).append(library.name)
    return [_system_part(owner, names) for owner, names in sorted(owners.items())]


def _owner(library: Path) -> str:
    if shutil.which("dpkg") is None:
        return library.name
    for path in (library, library.resolve(), Path("/usr") / library.relative_to("/")):
        found = subprocess.run(["dpkg", "-S", str(path)], capture_output=True, text=True, check=False)
        if found.returncode == 0:
            return found.stdout.partition(":")[0]
    return library.name


def _system_part(owner: str, names: list[str]) -> Part:
    text = Path("/usr/share/doc") / owner / "copyright"
    texts = (text.read_text(encoding="utf-8", errors="replace"),) if text.is_file() else ()
    return Part(f"{owner} ({', '.join(sorted(names))})", "of the system", "see its text", "", texts)


def own_fonts() -> list[Part]:
    """The fonts in resources/fonts that others have made."""
    text = (TEXTS / "Noto-Sans-Arabic.txt").read_text(encoding="utf-8")
    return [Part("Noto Sans Arabic UI", "2.005", "OFL-1.1", "https://notofonts.github.io", (text,))]


def third_party(libraries: Iterable[Path] = ()) -> str:
    """The whole text: a table of the parts, then each part's texts.

    Args:
        libraries: those that the bundle takes from the system.
    """
    wheels = [part_of(wheel) for wheel in required()]
    loader = part_of(distribution("pyinstaller"))._replace(licence="GPL-2.0 with an exception for what it starts")
    parts = [*wheels, python_part(), loader, *own_fonts(), *system_parts(libraries)]
    table = "".join(f"  {part.name} {part.version}: {part.licence}  {part.home}\n" for part in parts)
    texts = [f"\n\n{_LINE}\n{part.name}\n{_LINE}\n\n{text.strip()}\n" for part in parts for text in part.texts]
    return _HEAD + table + "".join(texts)
