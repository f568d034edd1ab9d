"""Finds the data folder `resources/`: beside the package in a checkout, inside it in a wheel and in a bundle."""

from __future__ import annotations

from functools import cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
_PLACES = (_PACKAGE.parent / "resources", _PACKAGE / "_resources")


@cache
def resource_folder() -> Path:
    """The folder that holds robots/, examples/, help/, icons/, themes/ and fonts/."""
    for place in _PLACES:
        if (place / "robots").is_dir():
            return place
    looked = " or ".join(str(place) for place in _PLACES)
    raise FileNotFoundError(f"rvsim is not installed whole: its data folder is missing (looked for {looked})")


def resource(*parts: str) -> Path:
    """The path of one resource, for instance resource("robots", "rv-m1.toml")."""
    return resource_folder().joinpath(*parts)
