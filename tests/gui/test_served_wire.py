"""The log of a served arm: whole lines, and each answer right after its question."""

from __future__ import annotations

from rvsim.gui.served_wire import ServedWire


def test_pieces_become_lines_and_answers_follow_their_questions() -> None:
    times = iter(range(100))
    wire = ServedWire(lambda: 0.01 * next(times))
    wire.add("→", b"VER\rQP0")
    wire.add("→", b"QP1\r#0P1500\r")
    for piece in (b"SSC3", b"2\r\x96", b"\x00"):
        wire.add("←", piece)
    said = [(entry.direction, entry.data) for entry in wire.log.since(0)[1]]
    assert said == [
        ("→", b"VER\r"), ("←", b"SSC32\r"), ("→", b"QP0QP1\r"), ("←", b"\x96\x00"), ("→", b"#0P1500\r"),
    ]  # fmt: skip


def test_an_answer_that_never_comes_holds_nothing_up_for_long() -> None:
    now = [0.0]
    wire = ServedWire(lambda: now[0])
    wire.add("→", b"Q\r#0P1500\r")
    assert wire.log.count == 1
    now[0] = 2.0
    wire.add("→", b"#1P1500\r")
    assert [entry.data for entry in wire.log.since(0)[1]] == [b"Q\r", b"#0P1500\r", b"#1P1500\r"]
