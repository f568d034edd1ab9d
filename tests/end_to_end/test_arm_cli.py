"""`rvsim arm`: another process drives the virtual arm with plain pyserial, as it would the real one, or asks it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import serial

from rvsim.cli import BAD_INPUT, DONE, FAILED, main

WAIT = 30.0  # [s] for data that must come
Capture = pytest.CaptureFixture[str]
posix = pytest.mark.skipif(os.name != "posix", reason="this system has neither pseudo-terminals nor SIGINT")
BAUDS = pytest.mark.parametrize("baud", [9600, 115200])


QUICK_RVSIM = Path(__file__).parents[1] / "quick_time.py"


class Served:
    """`rvsim arm --serve …` in a process of its own."""

    def __init__(self, *arguments: str, quick: bool = False) -> None:
        program = [str(QUICK_RVSIM)] if quick else ["-m", "rvsim"]
        command = [sys.executable, *program, "arm", "--json", "--serve", *arguments]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.record = json.loads(self._first_record())

    def _first_record(self) -> str:
        assert self.process.stdout is not None
        text = ""
        while not text.endswith("\n}\n"):
            line = self.process.stdout.readline()
            assert line, self.process.communicate()[1]
            text += line
        return text

    @property
    def address(self) -> str:
        return str(self.record["address"])

    def client(self, baud: int) -> Any:
        return serial.serial_for_url(self.address, baudrate=baud, timeout=WAIT)

    def end(self, number: int = signal.SIGINT) -> tuple[int, str]:
        if self.process.poll() is None:
            self.process.send_signal(number)
        _, errors = self.process.communicate(timeout=WAIT)
        return self.process.returncode, errors


@pytest.fixture
def serve() -> Iterator[Callable[..., Served]]:
    started: list[Served] = []

    def start(*arguments: str, quick: bool = False) -> Served:
        started.append(Served(*arguments, quick=quick))
        return started[-1]

    yield start
    for served in started:
        served.end()


def pulse(port: Any, channel: int) -> int:
    port.write(f"QP{channel}\r".encode())
    return 10 * int(port.read(1)[0])


def drive_as_real_clients_do(port: Any) -> None:
    """A time in the first command, decimals, CRLF, lower case, spaces, empty lines, queries as fast as they come."""
    port.write(b"#0 P1600.7 T400\r\n")  # jumps nevertheless: the board does not know where it is
    while pulse(port, 0) not in (1600, 1610):
        pass
    port.write(b"\r\r\n  #1p1500t100#2P1500T100\r\nver\r")
    assert port.read_until(b"\r").startswith(b"SSC32-V")
    port.write(b"Q\r" * 500)
    answers = port.read(500)
    assert len(answers) == 500
    assert set(answers) <= set(b".+")
    port.write(b"#0P1500T300\rQ\r")
    port.read(1)
    while port.write(b"Q\r") and port.read(1) == b"+":
        pass
    assert pulse(port, 0) == 1500


@posix
@BAUDS
def test_another_process_drives_the_pseudo_terminal(serve: Callable[..., Served], tmp_path: Path, baud: int) -> None:
    link = tmp_path / "arm"
    served = serve("pty", "--link", str(link), "--baud", str(baud))
    assert served.address == str(link)
    terminal = os.readlink(link)
    with served.client(baud) as port:
        drive_as_real_clients_do(port)
    with served.client(baud) as port:
        assert pulse(port, 1) == 1500
    assert os.readlink(link) == terminal
    assert served.end() == (DONE, "")
    assert not link.is_symlink()


@posix
@BAUDS
def test_another_process_drives_the_tcp_port(serve: Callable[..., Served], baud: int) -> None:
    served = serve("tcp", "--baud", str(baud))
    for _ in range(2):
        with served.client(9600) as port:
            drive_as_real_clients_do(port)
    assert served.end(signal.SIGTERM) == (DONE, "")


@posix
def test_a_client_at_the_wrong_rate_is_told_where_the_server_runs(serve: Callable[..., Served], tmp_path: Path) -> None:
    served = serve("pty", "--link", str(tmp_path / "arm"), "--baud", "115200")
    with served.client(9600):
        assert served.process.stderr is not None
        told = served.process.stderr.readline()
    assert told == "rvsim: a client talks at 9600 baud, the board at 115200: both hear garbage.\n"


@posix
def test_a_served_arm_is_asked_and_moved_through_its_link(
    serve: Callable[..., Served], tmp_path: Path, capsys: Capture, quick_time: None
) -> None:
    served = serve("pty", "--link", str(tmp_path / "arm"), quick=True)
    move = ("--wake", "all", "--deg", "-10,80,-80,5,5", "--seconds", "0.5")
    ask = ["arm", "--port", served.address, "--baud", "115200"]
    assert main([*ask, *move]) == FAILED
    assert "Nothing has moved. Watch the arm, keep clear of it, and add --yes." in capsys.readouterr().out
    assert main([*ask, *move, "--yes", "--json"]) == DONE
    record = json.loads(capsys.readouterr().out)
    assert (record["phase"], record["problem"], record["plan"][0][:14]) == ("ready", "", "The base jumps")
    assert [joint["commanded"] for joint in record["joints"]] == pytest.approx([-10, 80, -80, 5, 5], abs=0.1)
    assert main([*ask, "--wake", "base", "--yes"]) == DONE  # its pulse is known now: it need not jump
    assert "The base wakes at −10" in capsys.readouterr().out
    assert main(ask) == DONE
    assert "shoulder      not woken by rvsim; the controller reports " in capsys.readouterr().out


def test_an_arm_that_is_only_asked_stays_asleep(capsys: Capture) -> None:
    assert main(["arm", "--port", "al5b://", "--json"]) == DONE
    record = json.loads(capsys.readouterr().out)
    assert (record["board"][:7], record["phase"], record["measured_kind"]) == ("SSC32-V", "asleep", "commanded pulse")
    assert {joint["awake"] for joint in record["joints"]} == {False}
    assert {joint["measured"] for joint in record["joints"]} == {None}


def test_a_pose_outside_the_servos_wakes_nobody(capsys: Capture) -> None:
    move = ["--wake", "all", "--deg", "0,175,-90,0,0", "--yes"]
    assert main(["arm", "--port", "al5b://", *move]) == FAILED
    out = capsys.readouterr().out
    assert "shoulder would be at 175.0°; arm and servo together allow 0.0° to 168.0°." in out
    assert "base          asleep" in out


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ((), "Say either --serve pty|tcp, or --port URL."),
        (("--serve", "tcp", "--port", "al5b://"), "Say either --serve pty|tcp, or --port URL."),
        (("--serve", "tcp", "--wake", "base"), "--wake cannot be used with --serve."),
        (("--port", "al5b://", "--seed", "0"), "--seed cannot be used with --port."),
        (("--port", "al5b://", "--wake", "bse"), "Did you mean 'base'?"),
        (("--port", "al5b://", "--wake", "base", "--deg", "0,90,-90,0,0"), "add --wake all."),
        (("--port", "al5b://", "--wake", "base", "--seconds", "2"), "say with --deg where to."),
        (("--port", "al5b://?sead=1"), "there is no option “sead”. Did you mean 'seed'?"),
        (("--port", "no-such-port"), "The port no-such-port cannot be opened: "),
        (("--port", "al5b://", "--robot", "ur5e"), "servo"),
        (("--serve", "tcp", "--robot", "ur5e"), "servo"),
        (("--serve", "tcp", "--baud", "0"), "“0” is no baud rate"),
        (("--serve", "pty", "--link", "no-such-folder/arm"), "Choose another place for the link."),
    ],
)
def test_what_cannot_be_done_is_one_sentence(capsys: Capture, arguments: tuple[str, ...], what: str) -> None:
    assert main(["arm", *arguments]) == BAD_INPUT
    out, err = capsys.readouterr()
    assert out == ""
    assert what in err
    assert err.count("\n") == 1
    assert err.count("no-such-port") == arguments.count("no-such-port"), "a port is named once"
