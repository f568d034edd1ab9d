"""The wire log: every byte, in order, bounded, whoever looks at it and however often."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.wire_log import WireEntry, WireLog, printable
from rvsim.errors import FileWriteError


def _log(*data: bytes, most: int = 100) -> WireLog:
    log = WireLog(most)
    for index, one in enumerate(data):
        log.add(0.5 * index, "→" if index % 2 == 0 else "←", one)
    return log


@given(st.binary())
def test_what_is_printed_is_plain_and_loses_nothing(data: bytes) -> None:
    shown = printable(data)

    assert shown.isascii()
    assert shown.isprintable()
    assert shown.encode("ascii").decode("unicode_escape").encode("latin-1") == data


def test_control_bytes_are_escaped_by_name_or_number() -> None:
    assert printable(b"#5P1500\r\n\t\x1b\x96\\'") == r"#5P1500\r\n\t\x1b\x96\\'"


def test_a_view_that_polls_sees_each_entry_once() -> None:
    log = _log(b"Q\r", b".")
    count, first = log.since(0)
    log.add(2.0, "→", b"VER\r")

    assert first == (WireEntry(0.0, "→", b"Q\r"), WireEntry(0.5, "←", b"."))
    assert log.since(count) == (3, (WireEntry(2.0, "→", b"VER\r"),))
    assert log.since(3) == (3, ())


def test_the_oldest_entries_make_room() -> None:
    log = _log(*(b"%d" % index for index in range(10)), most=3)

    count, entries = log.since(0)

    assert (count, log.count) == (10, 10)
    assert [entry.data for entry in entries] == [b"7", b"8", b"9"]
    assert log.since(8)[1] == entries[1:]


def test_nothing_is_no_entry() -> None:
    assert _log(b"", b"").since(0) == (0, ())


def test_a_search_knows_no_capitals_and_finds_control_bytes() -> None:
    log = _log(b"#5P1500\r", b".", b"QP5\r", b"\x96")

    assert [entry.data for entry in log.search("p5")] == [b"QP5\r"]
    assert [entry.data for entry in log.search(r"\r")] == [b"#5P1500\r", b"QP5\r"]
    assert [entry.data for entry in log.search(r"\X96")] == [b"\x96"]


def test_what_is_saved_is_what_is_shown(tmp_path: Path) -> None:
    log = _log(b"Q\r", b"\x96")
    file = tmp_path / "wire.txt"

    log.save(file)

    assert file.read_text(encoding="utf-8") == log.text()
    assert log.text() == "     0.000 → Q\\r\n     0.500 ← \\x96\n"
    assert log.text(log.search("q")) == "     0.000 → Q\\r\n"


def test_a_file_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileWriteError, match="nowhere"):
        _log(b"Q\r").save(tmp_path / "nowhere" / "wire.txt")


def test_threads_lose_no_entry() -> None:
    log = WireLog()

    def add(index: int) -> int:
        log.add(float(index), "→", b"%d" % index)
        return log.since(0)[0]

    with ThreadPoolExecutor(4) as pool:
        seen = list(pool.map(add, range(500)))

    count, entries = log.since(0)
    assert count == max(seen) == 500
    assert {entry.data for entry in entries} == {b"%d" % index for index in range(500)}
