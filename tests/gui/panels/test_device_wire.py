"""The Wire page: what it shows of a log, live, however long it is; and of a real connection to the virtual arm."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QCheckBox, QLabel, QLineEdit, QPushButton, QTableView, QWidget

from rvsim.device.bridge.messages import Poll, SetPoints, Status, Stop, encode
from rvsim.device.wire_log import WireLog
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.device_wire import WirePage

ASKED, ANSWERED = b"QP0QP1\r", bytes([150, 160])


class Wire:
    """A page, and the driver's end of its log."""

    def __init__(self, page: WirePage, device: DeviceControl, language: str = "ssc32") -> None:
        self.page, self.device, self.log = page, device, WireLog()
        self.time = 0.0
        device._driver = SimpleNamespace(log=self.log, language=language, robot=page._session.robot)

    def say(self, *data: bytes) -> None:
        """Sent, answered, sent, …; and the window's timer ticks."""
        for number, piece in enumerate(data):
            self.time += 0.01
            self.log.add(self.time, "←" if number % 2 else "→", piece)
        self.device.polled.emit()

    def send(self, *data: bytes) -> None:
        for piece in data:
            self.log.add(self.time, "→", piece)
        self.device.polled.emit()

    def find(self, kind: type[QWidget], name: str) -> QWidget:
        found = self.page.findChild(kind, name)
        assert found is not None
        return found

    def text(self, name: str) -> str:
        return self.find(QLabel, name).text()

    def click(self, name: str) -> None:
        self.find(QPushButton, name).click()

    @property
    def rows(self) -> list[str]:
        model = self.find(QTableView, "wire_log").model()
        return [model.index(row, 2).data() for row in range(model.rowCount())]


@pytest.fixture
def device(session_with, preferences) -> Iterator[DeviceControl]:
    session = session_with("al5b")
    control = DeviceControl(session, MotionControl(session, preferences), preferences)
    yield control
    if isinstance(control._driver, SimpleNamespace):
        control._driver = None
    control.close()


@pytest.fixture
def page(device, preferences, shown) -> Iterator[WirePage]:
    page = shown(WirePage(device._session, preferences, SimpleNamespace(set_layer=lambda *_: None), device))
    page.set_seen(True)
    yield page
    page.worker.close()


@pytest.fixture
def wire(page, device) -> Wire:
    return Wire(page, device)


@pytest.fixture
def found(qtbot, wire) -> Callable[[str], str]:
    """Search for a text; how many matches there are."""

    def search(text: str) -> str:
        wire.find(QLineEdit, "wire_search").setText(text)
        qtbot.waitUntil(lambda: not wire.page.search.searching)
        return wire.text("wire_matches")

    return search


def test_before_anything_was_said_the_page_says_what_will_be_seen_here(page, wire):
    assert "connect an arm" in wire.text("wire_empty")
    assert not wire.find(QTableView, "wire_log").isVisible()
    wire.say(b"VER\r")
    assert not wire.find(QLabel, "wire_empty").isVisible()
    assert wire.rows == [r"VER\r"]


def test_lines_come_at_the_end_without_a_reset(qtbot, wire):
    wire.say(b"VER\r", b"SSC32-V2.04GP\r")
    with qtbot.assertNotEmitted(wire.page.model.modelReset):
        wire.say(ASKED, ANSWERED, b"#0P1500\r")
    assert wire.rows == [r"VER\r", r"SSC32-V2.04GP\r", r"QP0QP1\r", r"\x96\xa0", r"#0P1500\r"]


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (0, "Wakes the base and the shoulder: they jump to 1500 and 1600 µs, T is ignored."),
        (2, "Which pulse does the board send to base and shoulder?"),
        (
            3,
            "The board sends to base 1500 µs and shoulder 1600 µs (commanded, not measured). "
            "Answered after 10\u00a0ms.",
        ),
        (4, "Cut off before its end: the controller does nothing with it."),
        (6, "Gripper stops where it is."),
        (7, "Nothing had been asked."),
    ],
)
def test_a_line_is_said_in_words_with_the_joints_names(wire, row, words):
    wire.say(b"#0P1500#1P1600T700\r", b".", ASKED, ANSWERED)
    wire.send(b"#0P15", b"\x1bSTOP0\r", b"STOP4\r")
    wire.log.add(1.0, "←", b"?")
    wire.device.polled.emit()
    table = wire.find(QTableView, "wire_log")
    table.selectRow(row)
    assert wire.text("wire_words") == words
    assert words in table.model().index(row, 2).data(Qt.ItemDataRole.ToolTipRole)


def test_frames_of_the_bridge_are_put_together_and_answers_found_by_their_number(page, device):
    wire = Wire(page, device, "bridge")
    answers = encode(Status(moving=True), 7) + encode(Status(), 8)
    wire.say(
        encode(SetPoints((1000, None, None, None, None, None), 500), 7), answers[:3], encode(Stop(), 8), answers[3:]
    )
    lines = page.model.shown
    assert [line.entry.data for line in lines[-2:]] == [encode(Status(moving=True), 7), encode(Status(), 8)]
    assert [line.latency for line in lines[-2:]] == pytest.approx([0.03, 0.01])
    assert [line.stops for line in lines] == [False, True, False, False]
    assert "base to 10.00°" in page.model.words.of(lines[0])
    wire.say(encode(Poll(), 9))
    assert wire.rows[-1] == encode(Poll(), 9).hex(" ").upper()
    wire.find(QCheckBox, "wire_hide_polling").setChecked(True)
    assert len(wire.rows) == 4


def test_polling_can_be_left_out_and_comes_back(wire):
    wire.say(b"VER\r", b"SSC32\r", ASKED, ANSWERED, b"Q\r", b".", b"#0P1500\r")
    wire.find(QCheckBox, "wire_hide_polling").setChecked(True)
    wire.say(b"VA\r", b"\x80", b"STOP0\r")
    assert wire.rows == [r"VER\r", r"SSC32\r", r"#0P1500\r", r"STOP0\r"]
    assert "6 lines of polling hidden, 4 shown" in wire.text("wire_note")
    wire.find(QCheckBox, "wire_hide_polling").setChecked(False)
    assert len(wire.rows) == 10


def test_paused_the_view_holds_and_counts_what_comes(wire):
    wire.say(ASKED, ANSWERED)
    wire.click("wire_pause")
    wire.say(b"#0P1500\r", b"x", b"STOP0\r")
    assert len(wire.rows) == 2
    assert "3 lines came meanwhile" in wire.text("wire_note")
    wire.click("wire_pause")
    assert len(wire.rows) == 5
    assert wire.text("wire_note") == ""


def test_clearing_empties_the_view_alone(wire):
    wire.say(ASKED, ANSWERED)
    wire.click("wire_clear")
    assert wire.rows == []
    wire.say(b"STOP0\r")
    assert wire.rows == [r"STOP0\r"]
    assert wire.log.count == 3


def test_the_search_finds_bytes_and_words_and_goes_round(wire, found):
    wire.say(b"#1P1500\r", b".", b"#0P1501\r", b".", b"#1P1502\r")
    assert found("SHOULDER") == "2"
    wire.click("wire_next")
    assert wire.text("wire_bytes") == r"#1P1500\r"
    wire.click("wire_next")
    assert (wire.text("wire_bytes"), wire.text("wire_matches")) == (r"#1P1502\r", "2 of 2")
    wire.click("wire_next")
    assert wire.text("wire_matches") == "1 of 2"
    wire.click("wire_previous")
    assert wire.text("wire_matches") == "2 of 2"
    assert found("p150") == "3 of 3"
    assert found("nowhere") == "none"


def test_first_moves_wake_and_are_found_by_that_word(wire, found):
    wire.say(b"#0P1500T700\r")
    wire.send(b"#0P1600T700\r", b"#0P0\r", b"#0P1500\r", b"#0P1510T50\r")
    wire.time = 5.0
    wire.say(b"QP0\r", b"\0")
    wire.send(b"#0P1520T50\r")
    assert found("wakes the base") == "3"
    jumps = [bool(line.wakes) for line in wire.page.model.shown]
    assert jumps == [True, False, False, True, False, False, False, True]


def test_what_the_board_already_moves_is_not_woken(wire):
    wire.say(b"QP0QP1\r", bytes([150, 0]), b"#0P1500#1P1600T700\r")
    assert wire.page.model.words.of(wire.page.model.shown[2]) == (
        "Wakes the shoulder: it jumps to 1600 µs, T is ignored; base to 1500 µs in 700 ms."
    )


def test_return_right_after_typing_goes_to_the_first_match(wire, qtbot):
    wire.send(*[b"#0P%d\r" % (1000 + number) for number in range(200)])
    box = wire.find(QLineEdit, "wire_search")
    box.setText("p11")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: wire.text("wire_matches") == "1 of 100")
    assert wire.text("wire_bytes") == r"#0P1100\r"


def test_lines_that_come_later_are_found_too(wire, found, qtbot):
    wire.say(b"#1P1500\r")
    assert found("1500") == "1"
    wire.say(b"#2P1500\r")
    qtbot.waitUntil(lambda: wire.text("wire_matches") == "2")


def test_the_end_is_followed_until_somebody_scrolls_up(wire, qtbot):
    bar = wire.find(QTableView, "wire_log").verticalScrollBar()
    wire.send(*[b"#0P%d\r" % (1000 + number) for number in range(200)])
    assert bar.value() == bar.maximum() > 0
    bar.setValue(50)
    wire.send(*[b"STOP0\r"] * 20)
    assert bar.value() == 50
    wire.click("wire_end")
    wire.send(b"STOP1\r")
    assert bar.value() == bar.maximum()


def test_a_line_that_is_clicked_does_not_wander_off(wire, qtbot):
    table = wire.find(QTableView, "wire_log")
    wire.send(*[b"#0P%d\r" % (1000 + number) for number in range(200)])
    QGuiApplication.processEvents()
    middle = table.viewport().rect().center()
    qtbot.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=middle)
    clicked = table.indexAt(middle).row()
    wire.send(*[b"STOP0\r"] * 20)
    assert table.currentIndex().row() == clicked
    assert table.visualRect(table.currentIndex()).intersects(table.viewport().rect())


def test_the_oldest_lines_give_way_and_what_is_read_stays_in_sight(wire, found, qtbot):
    wire.page.model._most = 100
    wire.send(*[b"#0P%d\r" % (1000 + number) for number in range(100)])
    assert found("#0P10") == "100"
    table = wire.find(QTableView, "wire_log")
    table.verticalScrollBar().setValue(40)
    before = wire.rows[40]
    wire.send(*[b"STOP0\r"] * 30)
    assert len(wire.rows) == 100
    assert wire.rows[table.verticalScrollBar().value()] == before == r"#0P1040\r"
    qtbot.waitUntil(lambda: wire.text("wire_matches") == "70")


def test_a_long_log_comes_in_slices(wire, qtbot):
    for number in range(5000):
        wire.log.add(1e-3 * number, "→", b"#0P%d\r" % (500 + number % 2000))
    wire.device.polled.emit()
    assert 0 < len(wire.rows) < 5000
    qtbot.waitUntil(lambda: wire.page.model.rowCount() == 5000)


def test_selected_lines_are_copied_as_text_and_the_whole_log_is_saved(wire, qtbot, tmp_path):
    wire.say(b"VER\r", b"SSC32\r", b"STOP0\r")
    wire.find(QTableView, "wire_log").selectRow(2)
    wire.click("wire_copy")
    assert QGuiApplication.clipboard().text() == "     0.030 → STOP0\\r\n"
    wire.click("wire_clear")
    with qtbot.waitSignal(wire.page.worker.done):
        wire.page.save_to(tmp_path / "wire.txt")
    assert (tmp_path / "wire.txt").read_text(encoding="utf-8") == wire.log.text()
    with qtbot.waitSignal(wire.page.worker.done):
        wire.page.save_to(tmp_path / "nowhere" / "wire.txt")
    assert wire.page._session.sentences[-1][1] == "error"


def test_a_line_can_be_tried_without_sending_it(wire):
    box = wire.find(QLineEdit, "wire_try")
    box.setText(r"#2P1500S500T700\r")
    assert wire.text("wire_try_words") == "Elbow to 1500 µs at no more than 500 µs/s in at least 700 ms."
    box.setText("#33P1500")
    assert "drops this line" in wire.text("wire_try_words")
    assert wire.log.count == 0


def test_what_the_virtual_arm_said_can_be_read_after_the_connection_too(page, device, qtbot):
    device.connect_to("al5b://")
    qtbot.waitUntil(lambda: device.state.phase == "asleep" and device.state.received_bytes > 20)
    device.disconnect_device()
    words = [page.model.words.of(line) for line in page.model.shown]
    assert "The board calls itself SSC32-V2.04GP." in words
    assert any("no pulse" in sentence for sentence in words)
    assert not any(line.entry.data.startswith(b"#") for line in page.model.shown)
    assert "bytes sent" in page.findChild(QLabel, "wire_counters").text()
    page.findChild(QPushButton, "wire_pause").click()
    device.connect_to("al5b://")
    assert len(page.model.shown) < len(words)
    assert page.findChild(QPushButton, "wire_pause").text() == "Pause"
