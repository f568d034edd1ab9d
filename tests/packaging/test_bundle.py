"""What goes into a bundle. Making one takes minutes and is no test: `packaging/dev.py bundle` makes and tries it."""

from __future__ import annotations

import ast
import importlib.util
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]


def _imported() -> Iterator[str]:
    """Every module that rvsim imports, also late."""
    for path in (ROOT / "rvsim").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from (alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
                yield node.module
                yield from (f"{node.module}.{alias.name}" for alias in node.names)


def test_nothing_that_rvsim_imports_stays_out() -> None:
    from bundle_parts import EXCLUDED

    imported = set(_imported())
    assert not [name for name in imported for out in EXCLUDED if f"{name}.".startswith(f"{out}.")]


def test_what_is_imported_by_name_alone_is_there_to_be_put_in() -> None:
    from bundle_parts import HIDDEN

    assert [name for name in HIDDEN if importlib.util.find_spec(name) is None] == []


@pytest.mark.parametrize(
    ("target", "kept"),
    [
        ("PySide6/Qt/plugins/platforms/libqxcb.so", True),
        ("PySide6/Qt/plugins/platforms/libqoffscreen.so", True),
        ("PySide6/plugins/platforms/qwindows.dll", True),
        ("PySide6\\plugins\\platforms\\qdirect2d.dll", False),
        ("PySide6/Qt/plugins/platforms/libqlinuxfb.so", False),
        ("PySide6/Qt/plugins/platformthemes/libqgtk3.so", False),
        ("PySide6/Qt/plugins/tls/libqopensslbackend.so", False),
        ("PySide6/Qt/translations/qtbase_ar.qm", True),
        ("PySide6/Qt/translations/qtbase_nn.qm", False),
        ("rvsim/_resources/languages/qt_ar.qm", True),
        ("PySide6/Qt/lib/libQt6Gui.so.6", True),
        ("libQt6Network.so.6", False),
        ("numpy/linalg/_umath_linalg.cpython-311-x86_64-linux-gnu.so", True),
        ("numpy.libs/libscipy_openblas-6cdc3b4a.so", True),
        # The graphics driver brings its own.
        ("libstdc++.so.6", False),
        ("libgcc_s.so.1", False),
        ("libX11.so.6", False),
        ("libxcb-cursor.so.0", True),
        # A wheel's own library, of whatever name.
        ("pillow.libs/libXau-154567c4.so.6.0.0", True),
        ("rvsim/_resources/robots/ur5e.toml", True),
        ("numpy-2.4.6.dist-info/METADATA", True),
        ("numpy-2.4.6.dist-info/RECORD", False),
    ],
)
def test_what_is_put_in(target: str, kept: bool) -> None:
    from bundle_parts import is_kept

    assert is_kept(target, "linux") is kept


def test_only_pythons_own_libraries_are_slimmed() -> None:
    from bundle_parts import is_pythons_own

    assert is_pythons_own("libpython3.11.so.1.0")
    assert is_pythons_own("python3.11/lib-dynload/_decimal.cpython-311-x86_64-linux-gnu.so")
    assert not is_pythons_own("numpy.libs/libscipy_openblas64_-32a4b2a6.so")


def test_other_systems_keep_their_libraries() -> None:
    from bundle_parts import is_kept

    assert is_kept("libstdc++.so.6", "darwin")


def test_every_library_that_rvsim_needs_has_its_licence_and_qt_has_the_lgpl() -> None:
    from bundle_licences import SUPPLIED, part_of, python_part, required

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    direct = {Requirement(text).name for text in project["dependencies"]}
    parts = {part.name: part for part in map(part_of, required(direct))}
    assert {"numpy", "PySide6_Essentials", "ruckig", "ziafont"} <= parts.keys()
    assert [name for name, part in parts.items() if not part.texts and SUPPLIED.get(name) != ()] == []
    assert [name for name, part in parts.items() if not part.licence or part.licence == "see its text"] == []
    qt = "".join(parts["PySide6_Essentials"].texts)
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in qt
    assert "may be replaced" in qt
    assert "code.qt.io" in qt
    assert "OPEN FONT LICENSE" in "".join(parts["ziamath"].texts)
    assert python_part().texts


def test_the_icon_is_drawn_in_every_format(qapp: object, tmp_path: Path) -> None:
    from bundle_icons import SIZES, write_icons

    write_icons(ROOT / "resources" / "icons" / "rvsim.svg", tmp_path)
    for size in SIZES:
        with Image.open(tmp_path / f"rvsim-{size}.png") as picture:
            assert picture.size == (size, size)
            assert picture.getpixel((0, 0))[3] == 0  # its corners are round
            assert len(picture.getcolors(1 << 18)) > 8
    with Image.open(tmp_path / "rvsim.ico") as icon:
        assert {(16, 16), (32, 32), (256, 256)} <= icon.info["sizes"]
    with Image.open(tmp_path / "rvsim.icns") as icon:
        assert (256, 256, 2) in icon.info["sizes"]


def test_a_bundle_is_named_after_what_it_runs_on() -> None:
    import dev_bundle

    import rvsim

    assert dev_bundle.name("linux", "x86_64") == f"rvsim-{rvsim.__version__}-linux-x86_64"
    assert dev_bundle.name("win32", "AMD64") == f"rvsim-{rvsim.__version__}-windows-amd64"


def test_parts_are_weighed_with_their_libraries() -> None:
    from dev_bundle import largest

    folder = Path("rvsim")
    sizes = {"rvsim": 1, "_internal/numpy/linalg/a.so": 2, "_internal/numpy.libs/b.so": 3, "_internal/libpython.so": 4}
    found = largest({folder / path: size for path, size in sizes.items()}, folder)
    assert found == [("numpy", 5), ("libpython.so", 4), ("rvsim", 1)]


def test_a_program_without_console_has_no_streams_and_works(tmp_path: Path) -> None:
    picture = tmp_path / "window.png"
    script = f"""
import sys
sys.stdin = sys.stdout = sys.stderr = None
from rvsim.cli import main
from rvsim.cli.window import leave
leave(main(["--screenshot", {str(picture)!r}]) or 10 * main(["fk"]))
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (20, "", "")
    assert picture.stat().st_size > 10_000
