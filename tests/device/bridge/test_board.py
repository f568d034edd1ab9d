"""The virtual bridge: wakes without a jump, moves together, latches its stop, and never acts on what is spoilt."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.bridge.axes import places_of, values_of
from rvsim.device.bridge.board import BridgeBoard
from rvsim.device.bridge.frames import Frame, Problem, frame_bytes
from rvsim.device.bridge.host_side import BridgeDecoder, BridgeEncoder, Heard
from rvsim.device.bridge.messages import (
    Axes,
    Clear,
    Encoders,
    Error,
    HostMessage,
    Identify,
    Identity,
    Limp,
    Period,
    Place,
    Poll,
    PollAxes,
    SetPoints,
    Status,
    Stop,
    Wake,
    encode,
)
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.bounds import settling_bound
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.files import load_robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import servo_limits

ROBOT = load_robot("al5b")
HERE = np.radians([5.0, 80.0, -100.0, 10.0, -20.0])
ALL = range(6)


class Desk:
    """A board on its own, with an arm that stands still, and a host."""

    def __init__(self) -> None:
        self.board = BridgeBoard(ROBOT, ROBOT.servos, ROBOT.gripper_servo, lambda: HERE)
        self.encoder, self.decoder = BridgeEncoder(), BridgeDecoder()

    def say(self, message: HostMessage) -> Heard:
        self.board.write(self.encoder.encode(message))
        (answer,) = self.hear()
        return answer

    def hear(self) -> tuple[Heard, ...]:
        return self.decoder.feed(self.board.read())

    def wake_all(self) -> None:
        for axis in ALL:
            assert isinstance(self.say(Wake(axis, 5000 if axis == 5 else None, 0)), Status)

    def told(self) -> FloatArray:
        answer = self.say(PollAxes())
        assert isinstance(answer, Axes)
        return values_of(ROBOT, answer.places)


def only(axis: int, place: int) -> tuple[Place, ...]:
    return tuple(place if other == axis else None for other in ALL)


def test_nothing_has_a_pulse_until_it_is_woken() -> None:
    desk = Desk()
    assert isinstance(desk.say(Identify()), Identity)
    assert desk.say(SetPoints(only(2, -9000), 500)) == Error(Problem.ASLEEP, 2)
    desk.board.process(1.0)
    assert not desk.board.powered.any()
    assert set(desk.board.channels) == {"unknown"}


def test_a_joint_wakes_where_its_encoder_says_it_is_and_then_goes_slowly() -> None:
    desk = Desk()
    desk.say(Wake(1, 9000, 1000))
    assert np.degrees(desk.told()[1]) == pytest.approx(80.0, abs=0.2)
    desk.board.process(0.5)
    assert np.degrees(desk.told()[1]) == pytest.approx(85.0, abs=0.2)
    desk.board.process(0.6)
    assert np.degrees(desk.told()[1]) == pytest.approx(90.0, abs=0.005)


def test_the_gripper_has_no_encoder_and_needs_a_place_to_wake() -> None:
    desk = Desk()
    assert desk.say(Wake(5, None, 0)) == Error(Problem.VALUE, 5)
    assert isinstance(desk.say(Wake(5, 5000, 0)), Status)
    assert desk.told()[5] == 0.5
    answer = desk.say(Poll())
    assert isinstance(answer, Encoders)
    assert answer.places == (*places_of(ROBOT, np.append(HERE, np.nan))[:5], None)


def test_axes_start_and_end_together_and_no_axis_is_too_quick() -> None:
    desk = Desk()
    desk.wake_all()
    desk.say(SetPoints((500, 17000, -10100, 1000, -2000, 5000), 0))  # 90° of the shoulder, at 190 °/s
    desk.board.process(0.5 * 90.0 / 190.0)
    answer = desk.say(PollAxes())
    assert isinstance(answer, Axes)
    assert answer.status.moving
    part = (np.degrees(values_of(ROBOT, answer.places)[1:3]) - np.degrees(HERE)[1:3]) / (90, -1)
    assert part == pytest.approx([0.5, 0.5], abs=0.05)
    desk.board.process(0.3)
    assert not desk.board.moving


def test_a_place_beyond_a_limit_is_the_limit_and_says_so() -> None:
    desk = Desk()
    desk.wake_all()
    desk.say(SetPoints(only(2, -1000), 100))
    desk.board.process(2.0)
    answer = desk.say(PollAxes())
    assert isinstance(answer, Axes)
    assert answer.status.limit
    assert answer.limit == (False, False, True, False, False, False)
    assert desk.told()[2] == pytest.approx(servo_limits(ROBOT.servos)[2, 1], abs=1e-4)
    desk.say(SetPoints(only(2, -9000), 100))
    assert not desk.say(Stop()).limit  # type: ignore[union-attr]


def test_a_stop_latches_until_it_is_cleared() -> None:
    desk = Desk()
    desk.wake_all()
    desk.say(SetPoints(only(0, 8000), 2000))
    desk.board.process(0.5)
    answer = desk.say(Stop())
    stopped = desk.board.pulses
    assert isinstance(answer, Status)
    assert (answer.stopped, answer.moving) == (True, False)
    assert desk.say(SetPoints(only(0, 0), 100)) == Error(Problem.STOPPED)
    assert desk.say(Wake(1, 9000, 100)) == Error(Problem.STOPPED)
    desk.board.process(3.0)
    np.testing.assert_array_equal(desk.board.pulses, stopped)
    desk.say(Clear())
    desk.board.process(3.0)
    np.testing.assert_array_equal(desk.board.pulses, stopped)
    assert isinstance(desk.say(SetPoints(only(0, 0), 100)), Status)


def test_limp_switches_one_axis_off_even_in_a_stop() -> None:
    desk = Desk()
    desk.wake_all()
    desk.say(Stop())
    desk.say(Limp(1))
    assert desk.board.channels[:6] == ("holding", "limp", "holding", "holding", "holding", "holding")
    assert np.isnan(desk.board.pulses[1])


def test_numbers_that_repeat_or_are_old_are_not_acted_upon() -> None:
    desk = Desk()
    desk.wake_all()
    move = encode(SetPoints(only(0, 3000), 100), 40)
    desk.board.write(move + move + encode(SetPoints(only(0, 9000), 100), 39))
    assert desk.hear() == (
        Status(moving=True, restarted=True),
        Error(Problem.SEQUENCE),
        Error(Problem.SEQUENCE),
    )
    desk.board.process(2.0)
    desk.board.write(encode(PollAxes(), 41 + 126))
    (answer,) = desk.hear()
    assert isinstance(answer, Axes)
    assert answer.places[0] == 3000


def test_a_stop_counts_whatever_its_number() -> None:
    desk = Desk()
    desk.wake_all()
    desk.board.write(encode(Stop(), 5) + encode(Stop(), 5) + encode(Poll(), 6))
    first, second, third = desk.hear()
    assert isinstance(first, Status)
    assert first.stopped
    assert first == second
    assert isinstance(third, Encoders)


def test_reports_come_by_themselves_at_their_period() -> None:
    desk = Desk()
    desk.board.process(0.01)
    desk.say(Period(100))
    assert desk.board.busy
    desk.board.process(1.0)
    times = [heard.timestamp_ms for heard in desk.hear() if isinstance(heard, Encoders)]
    assert times == [120 + 100 * index for index in range(9)]
    desk.say(Period(0))
    desk.board.process(1.0)
    assert not desk.hear()
    assert not desk.board.busy
    assert desk.say(Period(5)) == Error(Problem.VALUE)


def test_a_jammed_joint_is_told() -> None:
    desk = Desk()
    desk.wake_all()
    assert not desk.say(Stop()).stalled  # type: ignore[union-attr]
    desk.say(Clear())
    desk.say(SetPoints(only(3, 4000), 200))
    desk.board.process(1.0)
    answer = desk.say(PollAxes())
    assert isinstance(answer, Axes)
    assert answer.stalled == (False, False, False, True, False, False)


@given(st.lists(st.floats(0.0, 0.3), max_size=12))
def test_time_in_pieces_is_the_same_time(pieces: list[float]) -> None:
    desks = Desk(), Desk()
    for desk in desks:
        desk.wake_all()
        desk.say(SetPoints(only(4, 6000), 900))
        desk.say(Period(70))
    for piece in pieces:
        desks[0].board.process(piece)
    desks[1].board.process(sum(pieces))
    assert desks[0].board.read() == desks[1].board.read()
    np.testing.assert_array_equal(desks[0].board.pulses, desks[1].board.pulses)


@given(st.lists(st.binary(max_size=40), max_size=20))
def test_arbitrary_bytes_never_raise_and_never_act(pieces: list[bytes]) -> None:
    desk = Desk()
    desk.wake_all()
    before = desk.board.pulses
    for piece in pieces:
        desk.board.write(piece)
        desk.board.process(0.02)
    assert all(isinstance(heard, Error) for heard in desk.hear())
    np.testing.assert_array_equal(desk.board.pulses, before)


FRAMES = st.builds(Frame, st.integers(0, 255), st.integers(0, 10) | st.integers(0x80, 0x86), st.binary(max_size=16))


@given(
    st.lists(FRAMES | st.builds(Frame, st.integers(0, 255), st.just(7), st.binary(min_size=5, max_size=5)), max_size=25)
)
def test_any_frame_is_answered_once_and_no_servo_leaves_its_range(frames: list[Frame]) -> None:
    desk = Desk()
    for frame in frames:
        desk.board.write(frame_bytes(frame))
        assert len(desk.hear()) == 1
        desk.board.process(0.02)
        desk.hear()
        pulses = desk.board.pulses
        for servo in ROBOT.servos:
            assert np.isnan(pulses[servo.channel]) or servo.min_us <= pulses[servo.channel] <= servo.max_us


@given(st.integers(0, 21), st.integers(0, 7))
def test_a_spoilt_set_point_moves_nothing_and_is_answered_with_an_error(place: int, bit: int) -> None:
    desk = Desk()
    desk.wake_all()
    before = desk.board.pulses
    spoilt = bytearray(encode(SetPoints((8000, 2000, -5000, 8000, 8000, 0), 500), 10))
    spoilt[min(place, len(spoilt) - 1)] ^= 1 << bit
    desk.board.write(bytes(spoilt) + encode(PollAxes(), 11))
    answers = desk.hear()
    assert answers
    assert all(isinstance(heard, Error) for heard in answers[:-1])
    assert isinstance(answers[0], Error)
    assert isinstance(answers[-1], Axes)
    desk.board.process(2.0)
    np.testing.assert_array_equal(desk.board.pulses, before)


def test_power_forgets_everything_but_the_calibration() -> None:
    desk = Desk()
    desk.say(Identify())
    desk.wake_all()
    desk.say(Stop())
    desk.board.power_cycle()
    assert not desk.board.powered.any()
    assert desk.say(Poll()).status == Status(asleep=True, restarted=True)  # type: ignore[union-attr]


# --- in the virtual arm ----------------------------------------------------------------------------------------------


class Room:
    """A virtual arm that speaks the bridge's language, and a host."""

    def __init__(self, seed: int) -> None:
        self.arm = VirtualArm(ROBOT, seed=seed, language="bridge")
        self.encoder, self.decoder = BridgeEncoder(), BridgeDecoder()
        for axis in ALL:
            self.say(Wake(axis, 5000 if axis == 5 else None, 0))

    def say(self, message: HostMessage) -> Heard:
        self.arm.write(self.encoder.encode(message))
        self.arm.process(0.001)
        return self.decoder.feed(self.arm.read())[-1]

    def measured(self) -> FloatArray:
        answer = self.say(Poll())
        assert isinstance(answer, Encoders)
        return values_of(ROBOT, answer.places)[:5]


@pytest.mark.parametrize("seed", [0, 3, 7])
def test_measured_angles_are_the_true_ones_and_lag_behind_the_command(seed: int) -> None:
    room = Room(seed)
    goal = np.radians([60.0, 60.0, -90.0, -60.0, 60.0])
    room.arm.process(1.0)
    room.say(SetPoints((*places_of(ROBOT, np.append(goal, np.nan))[:5], 0), 1000))
    room.arm.process(0.5)
    told = room.say(PollAxes())
    assert isinstance(told, Axes)
    lag = np.abs(values_of(ROBOT, told.places)[:5] - room.measured())
    assert np.all(np.abs(room.measured() - room.arm.true_q) < np.radians(0.5))
    assert np.all(lag[[0, 3, 4]] > np.radians(2.0))
    room.arm.process(2.0)
    rest = np.abs(goal - room.measured())
    assert rest[1] > np.radians(0.5)  # the shoulder sags under the arm
    assert np.all(rest < settling_bound(ROBOT) + np.radians(0.01))
    assert room.arm.true_opening == pytest.approx(0.0, abs=0.02)


def test_waking_does_not_make_the_arm_jump() -> None:
    arm = VirtualArm(ROBOT, seed=2, language="bridge")
    arm.put(HERE)
    before = arm.true_q
    arm.write(b"".join(encode(Wake(axis, None, 0), axis) for axis in range(5)))
    arm.process(0.5)
    assert np.all(np.abs(arm.true_q - before) < np.radians(5.0))  # they sag under the arm's weight
    assert np.all(np.abs(arm.true_q - before)[[0, 3, 4]] < np.radians(1.0))


def test_a_jammed_servo_and_a_brown_out_are_told() -> None:
    room = Room(1)
    room.say(Identify())
    room.arm.faults = Faults(frozenset({Fault.STALLED_SERVO}), stalled=(0,))
    room.say(SetPoints(only(0, 4000), 300))
    room.arm.process(1.5)
    answer = room.say(PollAxes())
    assert isinstance(answer, Axes)
    assert answer.stalled == (True, False, False, False, False, False)
    room.arm.faults = Faults(frozenset({Fault.BROWN_OUT}))
    room.arm.process(1.0)
    answer = room.say(PollAxes())
    assert isinstance(answer, Axes)
    assert answer.status.restarted
    assert answer.places == (None,) * 6


def test_an_arm_in_pieces_of_time_is_the_same_arm() -> None:
    whole, cut = Room(5), Room(5)
    for room, pieces in ((whole, [1.2]), (cut, [0.013, 0.3, 0.0001, 0.42, 0.4669])):
        room.say(Period(50))
        room.say(SetPoints(only(0, 4000), 700))
        room.heard = b""
        for piece in pieces:
            room.arm.process(piece)
            room.heard += room.arm.read()
    assert whole.heard == cut.heard
    np.testing.assert_array_equal(whole.arm.true_q, cut.arm.true_q)
