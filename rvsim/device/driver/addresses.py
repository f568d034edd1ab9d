"""Addresses of virtual arms: the ones on offer, and the options that belong to the arm that is shown."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import parse_qsl, urlencode, urlsplit, urlunsplit

from rvsim.device.driver.ports import PortChoice
from rvsim.language import tr_later

if TYPE_CHECKING:
    from rvsim.device.driver.languages import LanguageName

SCHEME = "al5b"
# Beside the plain one, which is mounted as its robot file says.
OTHER_VIRTUAL = (
    PortChoice(
        "al5b://?seed=3",
        tr_later("Virtual arm, wired otherwise"),
        tr_later(
            "Some servos turn the other way and none is as the robot file says, as on a kit that was just built: "
            "calibrate it."
        ),
    ),
    PortChoice(
        "al5b://?potentiometers=1",
        tr_later("Virtual arm with potentiometers"),
        tr_later("Its joints are measured, as with potentiometers on the controller's analog inputs."),
    ),
)


def is_virtual(url: str) -> bool:
    """Whether the address means an arm of this process."""
    return url.strip().lower().startswith(f"{SCHEME}:")


def has_potentiometers(url: str) -> bool:
    """Whether a virtual arm with measured joints is meant."""
    return is_virtual(url) and _options(url).get("potentiometers", "0") not in ("0", "false", "no", "")


def completed(url: str, robot: str, language: LanguageName) -> str:
    """The address of a virtual arm with the arm's name and language, where it does not say them; others as they are."""
    if not is_virtual(url):
        return url
    options = {"robot": robot, "language": language} | _options(url)
    return urlunsplit((SCHEME, "", "", urlencode(options), "")).replace(f"{SCHEME}:?", f"{SCHEME}://?")


def _options(url: str) -> dict[str, str]:
    return dict(parse_qsl(urlsplit(url).query, keep_blank_values=True))
