"""`rvsim arm --serve`: the virtual arm for other programs, until Ctrl-C."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rvsim.cli.endings import ending_signals_interrupt
from rvsim.cli.outcome import DONE
from rvsim.cli.output import print_result
from rvsim.errors import DeviceError

if TYPE_CHECKING:
    from rvsim.device.link.serve import Server

_LOOK_AGAIN = 0.2  # [s]


def serve(options: argparse.Namespace) -> int:
    """Serve until an ending signal; the exit status."""
    with ending_signals_interrupt():
        server = _server(options)
        try:
            _print_how_to_connect(options, server)
            _watch(server)
        except KeyboardInterrupt:
            pass
        finally:
            server.close()
    if server.problem:
        raise DeviceError(server.address, f"serving has ended: {server.problem}")
    return DONE


def _server(options: argparse.Namespace) -> Server:
    from rvsim.device.link.options import ArmOptions, new_arm
    from rvsim.device.link.pty_wire import usual_link
    from rvsim.device.link.serve import serve_pty, serve_tcp

    described = ArmOptions(
        robot=options.robot,
        seed=options.seed or 0,
        language=options.language,
        potentiometers=options.potentiometers,
    )
    arm = new_arm(described)
    if options.serve == "tcp":
        return serve_tcp(arm, port=options.tcp_port or 0, baud=options.baud)
    return serve_pty(arm, link=Path(options.link) if options.link else usual_link(), baud=options.baud)


def _print_how_to_connect(options: argparse.Namespace, server: Server) -> None:
    follows = options.baud is None and options.serve == "pty"
    record: dict[str, Any] = {
        "address": server.address,
        "baud": None if follows else server.baud,
        "robot": options.robot,
        "language": options.language,
        "seed": options.seed or 0,
        "pyserial": f'serial.serial_for_url("{server.address}", {server.baud}, timeout=1)',
        "rvsim": _asking(options, server),
    }
    rate = "whichever baud rate a client chooses" if follows else f"{server.baud} baud"
    lines = (
        f"The virtual arm {options.robot} ({options.language}) answers at {server.address}, at {rate}.",
        f"  pyserial:  {record['pyserial']}",
        f"  rvsim:     {record['rvsim']}",
        "Ctrl-C ends it.",
    )
    print_result(options, record, "\n".join(lines))
    sys.stdout.flush()


def _asking(options: argparse.Namespace, server: Server) -> str:
    """The command that talks to the arm, with what is not as usual."""
    unusual = {"robot": "al5b", "language": "ssc32", "baud": None}
    given = [f"--{name} {getattr(options, name)}" for name, usual in unusual.items() if getattr(options, name) != usual]
    return " ".join(["rvsim arm --port", server.address, *given])


def _watch(server: Server) -> None:
    """Until it has ended by itself; a client at another rate than the board's is told here, where someone looks."""
    matched = True
    while not server.wait(_LOOK_AGAIN):
        if matched and not server.matches:
            print(
                f"rvsim: a client talks at {server.baud} baud, the board at {server.board_baud}: both hear garbage.",
                file=sys.stderr,
                flush=True,
            )
        matched = server.matches
