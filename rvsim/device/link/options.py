"""Which virtual arm is meant: the options of an `al5b://` address, and the arm that they describe."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args
from urllib.parse import parse_qsl, urlsplit

from rvsim.device.virtual.contract import Language
from rvsim.errors import DeviceError, did_you_mean
from rvsim.language import tr, tr_later

if TYPE_CHECKING:
    from rvsim.device.virtual.arm import VirtualArm

SCHEME = "al5b"


@dataclass(frozen=True)
class ArmOptions:
    """A virtual arm and its port.

    Args:
        robot: a built-in arm's name or a robot file.
        seed: of the calibration that it hides, as a real arm does.
        language: "ssc32" or "bridge".
        board: a name under which the arm is kept in this process when its port is closed; "" makes a new one each time.
        potentiometers: whether the joints have them, on the controller's analog inputs.
        board_baud: the rate that the board is set to [bit/s]; None: whichever the port is opened with.
    """

    robot: str = "al5b"
    seed: int = 0
    language: Language = "ssc32"
    board: str = ""
    potentiometers: bool = False
    board_baud: int | None = None


def options_of(url: str) -> ArmOptions:
    """The options in an address such as `al5b://?seed=3&language=bridge`; `al5b://` alone has all the usual ones.

    Raises:
        DeviceError: an option that there is not, or a value that it cannot have.
    """
    parts = urlsplit(url)
    if parts.scheme.lower() != SCHEME or parts.netloc or parts.path.strip("/") or parts.fragment:
        raise DeviceError(
            url,
            tr("this is no address of a virtual arm"),
            tr("Write it like {example}.", example=f"{SCHEME}://?robot=al5b&seed=3"),
        )
    found = dict(parse_qsl(parts.query, keep_blank_values=True))
    return ArmOptions(**{name: _value(url, name, text) for name, text in found.items()})


def new_arm(options: ArmOptions) -> VirtualArm:
    """The virtual arm that the options describe, switched on a moment ago.

    Raises:
        RvsimError: there is no such robot, or it has no servos.
    """
    from rvsim.device.virtual.arm import VirtualArm
    from rvsim.files import load_robot

    robot = load_robot(options.robot)
    return VirtualArm(robot, seed=options.seed, language=options.language, potentiometers=options.potentiometers)


def _value(url: str, name: str, text: str) -> Any:
    if name not in _READERS:
        raise DeviceError(url, tr("there is no option “{name}”", name=name), did_you_mean(name, tuple(_READERS)))
    rule, read = _READERS[name]
    value = read(text)
    if value is None:
        raise DeviceError(url, tr("the option {name} is “{text}”", name=name, text=text), tr(rule))
    return value


def _name(text: str) -> str | None:
    return text or None


def _whole(text: str) -> int | None:
    return int(text) if text.isdecimal() and len(text) <= 9 else None


def _rate(text: str) -> int | None:
    return _whole(text) or None


def _language(text: str) -> str | None:
    return text if text in get_args(Language) else None


def _switch(text: str) -> bool | None:
    return {"1": True, "0": False, "true": True, "false": False, "yes": True, "no": False}.get(text.lower())


_READERS: Mapping[str, tuple[str, Callable[[str], Any]]] = {
    "robot": (tr_later("It must be the name of an arm or a robot file."), _name),
    "seed": (tr_later("It must be a whole number, 0 or more."), _whole),
    "language": (tr_later("It must be ssc32 or bridge."), _language),
    "board": (tr_later("It must be a name."), _name),
    "potentiometers": (tr_later("It must be 0 or 1."), _switch),
    "board_baud": (tr_later("It must be a rate such as 9600."), _rate),
}
