"""An arm on a wire: `arm --serve` lends the virtual one to other programs, `arm --port` talks to one."""

from __future__ import annotations

import argparse

from rvsim.cli.arguments import JOINTS_NOTE, Command
from rvsim.cli.outcome import InputError

_LANGUAGES = ("ssc32", "bridge")
_ONLY_SERVE = {"link": "--link", "tcp_port": "--tcp-port", "seed": "--seed", "potentiometers": "--potentiometers"}
_ONLY_PORT = {"wake": "--wake", "deg": "--deg", "seconds": "--seconds", "yes": "--yes"}


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--robot", default="al5b", metavar="ARM", help="an arm with servos; al5b if not given")
    parser.add_argument("--language", choices=_LANGUAGES, default="ssc32", help="of its controller")
    parser.add_argument("--baud", type=_rate, metavar="N", help="the board's rate; 9600, or the client's, if not given")
    _add_serve_options(parser.add_argument_group("lend the virtual arm to other programs"))
    _add_port_options(parser.add_argument_group("talk to an arm"))


def _add_serve_options(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--serve", choices=("pty", "tcp"), help="on a pseudo-terminal or on 127.0.0.1, until Ctrl-C")
    group.add_argument("--link", metavar="FILE", help="the name of the pseudo-terminal")
    group.add_argument("--tcp-port", type=_tcp_port, metavar="N", help="a free one if not given")
    group.add_argument("--seed", type=_seed, metavar="N", help="of the calibration that the virtual arm hides")
    group.add_argument("--potentiometers", action="store_true", help="its joints are measured, on VA, VB, …")


def _add_port_options(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--port", metavar="URL", help="COM3, /dev/ttyUSB0, al5b://, socket://127.0.0.1:5331, …")
    group.add_argument(
        "--wake",
        nargs="+",
        metavar="JOINT",
        help="joints that may move: names, gripper, or all (joints); they jump first",
    )
    group.add_argument("--deg", metavar='"0,90,…"', help=f"where to go: {JOINTS_NOTE}")
    group.add_argument("--seconds", type=_seconds, metavar="S", help="how long that takes at least")
    group.add_argument("--yes", action="store_true", help="it may move: somebody watches it, nobody is in its way")


def _arm(options: argparse.Namespace) -> int:
    if (options.serve is None) == (options.port is None):
        raise InputError("Say either --serve pty|tcp, or --port URL. Type rvsim arm --help.")
    _refuse_others(options, _ONLY_PORT if options.serve else _ONLY_SERVE, "--serve" if options.serve else "--port")
    if options.serve:
        from rvsim.cli.arm_serve import serve

        return serve(options)
    from rvsim.cli.arm_port import talk

    return talk(options)


def _refuse_others(options: argparse.Namespace, others: dict[str, str], mode: str) -> None:
    given = vars(options)
    found = [option for name, option in others.items() if given[name] is not None and given[name] is not False]
    if found:
        raise InputError(f"{' and '.join(found)} cannot be used with {mode}.")


def _whole(text: str, least: int, most: int, what: str) -> int:
    if not text.isdecimal() or not least <= int(text) <= most:
        raise argparse.ArgumentTypeError(f"“{text}” is no {what}; it must be {least} to {most}")
    return int(text)


def _rate(text: str) -> int:
    return _whole(text, 50, 4_000_000, "baud rate")


def _tcp_port(text: str) -> int:
    return _whole(text, 0, 65535, "TCP port")


def _seed(text: str) -> int:
    return _whole(text, 0, 10**9, "seed")


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.1 <= seconds <= 60.0:
        raise argparse.ArgumentTypeError(f"“{text}” is no time for a move; it must be 0.1 to 60 seconds")
    return seconds


COMMANDS = (Command("arm", _arm, "an arm on a wire: lend the virtual one, or talk to one", _add_options),)
