"""The house stays a house: the import rule, the six entries at the top, small functions, nothing half-done."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from importlinter.cli import lint_imports

ROOT = Path(__file__).resolve().parent.parent
SOURCES = sorted([*(ROOT / "rvsim").rglob("*.py"), *(ROOT / "packaging").glob("*.py")])
TEXTS = sorted(
    [
        *SOURCES,
        *(ROOT / "tests").rglob("*.py"),
        *(path for path in (ROOT / "resources").rglob("*") if path.suffix in {".toml", ".md", ".csv", ".txt"}),
        *(ROOT / name for name in ("pyproject.toml", "README.md")),
    ]
)

TOP_LEVEL = {"pyproject.toml", "rvsim", "resources", "tests", "packaging", "README.md", "LICENSE"}
MADE_BY_TOOLS = {"build", "dist", "out"}
LONGEST_FUNCTION, LONGEST_MODULE = 50, 450
MOST_FUNCTIONS = 24  # nine in ten are not longer than this

UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX|HACK|NotImplementedError|stub|placeholder)\b")
# A path that exists on one person's machine only. (Written in pieces, or this file would find itself.)
SOMEBODYS_FOLDER = re.compile(r"(?<![\w.~])(?:/(?:home|root|Users|work|tmp|mnt)/" + r"\w|[A-Z]:\\+Users\\)")


def _name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def _functions() -> Iterator[tuple[str, int]]:
    """Every function's place and its number of lines."""
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                yield f"{_name(path)}:{node.lineno} {node.name}", (node.end_lineno or node.lineno) - node.lineno + 1


def _lines_with(pattern: re.Pattern[str], paths: list[Path]) -> list[str]:
    """The lines in which the pattern occurs, each with its place."""
    return [
        f"{_name(path)}:{number}: {line.strip()}"
        for path in paths
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if pattern.search(line)
    ]


def test_each_floor_imports_only_floors_below_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("logging.config.dictConfig", lambda _: None)  # the linter's silences every logger there is
    code = lint_imports(config_filename=str(ROOT / "pyproject.toml"), no_cache=True, no_logo=True)
    assert code == 0, capsys.readouterr().out


def test_the_checkout_has_the_six_entries_and_the_licence_and_nothing_else() -> None:
    found = {path.name for path in ROOT.iterdir() if not path.name.startswith((".", "__pycache__"))}
    assert {name for name in found - MADE_BY_TOOLS if not name.endswith(".egg-info")} == TOP_LEVEL


def test_packaging_is_no_package_because_it_would_shadow_the_library_of_that_name() -> None:
    assert not (ROOT / "packaging" / "__init__.py").exists()


def test_no_function_is_long_and_nine_in_ten_are_short() -> None:
    functions = sorted(_functions(), key=lambda entry: entry[1])
    assert [entry for entry in functions if entry[1] > LONGEST_FUNCTION] == []
    place, lines = functions[len(functions) * 9 // 10]
    assert lines <= MOST_FUNCTIONS, place


def test_no_module_is_long() -> None:
    lengths = {_name(path): len(path.read_text(encoding="utf-8").splitlines()) for path in SOURCES}
    assert {name: lines for name, lines in lengths.items() if lines > LONGEST_MODULE} == {}


def test_nothing_is_left_unfinished() -> None:
    assert _lines_with(UNFINISHED, SOURCES) == []


def test_no_file_knows_the_folders_of_one_machine() -> None:
    assert _lines_with(SOMEBODYS_FOLDER, TEXTS) == []
