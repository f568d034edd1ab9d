"""Hobby servos: they lag, stick, sag under weight, sink without power, and stop at their ends."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.device.virtual.bounds import largest_loads, settling_bound, settling_time
from rvsim.device.virtual.calibration import hidden_servos
from rvsim.device.virtual.clock import FRAME
from rvsim.device.virtual.faults import NO_FAULTS, Fault
from rvsim.device.virtual.servo import LOOP_TIME, ServoBank, drive_of, lowest, places_after, servo_bank
from rvsim.dynamics import gravity_torques
from rvsim.robot.arrays import FloatArray

ROBOT = load_robot("al5b")
BANK = servo_bank(ROBOT, *hidden_servos(ROBOT, 0))
HOME = np.append(ROBOT.home, 0.5)
NO_PULSES = np.full(len(HOME), np.nan)


def pulses_for(places: FloatArray) -> FloatArray:
    return BANK.zero_us + BANK.gain_us * places


def settled(places: FloatArray, pulses: FloatArray, bank: ServoBank = BANK) -> FloatArray:
    limp = bool(np.isnan(pulses).any())
    for _ in range(round(settling_time(ROBOT, limp=limp) / FRAME)):
        after = places_after(bank, places, drive_of(bank, places, pulses, NO_FAULTS), FRAME)
        if np.array_equal(after, places):
            return after
        places = after
    raise AssertionError("it never comes to rest")


@given(st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6), st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_it_comes_to_rest_near_its_pulses_and_within_the_bound(start: list[float], end: list[float]) -> None:
    span = BANK.upper - BANK.lower
    wanted = BANK.lower + span * end
    rest = settled(BANK.lower + span * start, pulses_for(wanted))
    assert np.all(np.abs(rest - wanted)[:5] <= settling_bound(ROBOT))
    assert abs(rest[5] - wanted[5]) <= BANK.dead[5]


def test_no_pose_loads_a_joint_more_than_the_bound_says() -> None:
    poses = np.random.default_rng(0).uniform(ROBOT.limits[:, 0], ROBOT.limits[:, 1], (2000, ROBOT.dof))
    loads = np.abs(gravity_torques(ROBOT, poses)).max(axis=0)
    assert np.all(loads <= largest_loads(ROBOT))
    assert loads[1] > 0.9 * largest_loads(ROBOT)[1]  # and it says not much more


def test_a_stretched_arm_hangs_below_its_command() -> None:
    wanted = np.array([0.0, 0.3, -0.8, 0.0, 0.0, 0.5])
    rest = settled(wanted, pulses_for(wanted))
    assert math.degrees(wanted[1] - rest[1]) > 1.0


def test_it_is_never_faster_than_the_joint_and_lags_behind() -> None:
    far = np.add(HOME, (1.0, 0.5, 0.5, 0.9, 0.9, 0.5))
    after = places_after(BANK, HOME, drive_of(BANK, HOME, pulses_for(far), NO_FAULTS), FRAME)
    # What is far runs at full speed from the start.
    np.testing.assert_allclose(after - HOME, BANK.speed * FRAME, atol=1e-12)


def test_within_the_last_degrees_what_is_left_shrinks_with_the_loop_time() -> None:
    near = HOME.copy()
    near[0] += 0.05
    drive = drive_of(BANK, HOME, pulses_for(near), NO_FAULTS)
    left = [near[0] - places_after(BANK, HOME, drive, t)[0] for t in (0.0, LOOP_TIME)]
    assert left[1] / left[0] == pytest.approx(math.exp(-1.0))


def test_an_error_within_the_dead_band_moves_nothing() -> None:
    base = HOME.copy()
    base[0] += 0.9 * BANK.dead[0]
    rest = settled(HOME, pulses_for(HOME))
    assert settled(rest, pulses_for(HOME) + (base - HOME) * BANK.gain_us)[0] == rest[0]


def test_without_pulses_only_what_is_too_heavy_for_friction_sinks_and_the_table_carries_it() -> None:
    stretched = np.array([0.4, 0.8, -0.4, 0.3, 0.2, 0.5])
    rest = settled(stretched, NO_PULSES)
    assert lowest(ROBOT, rest[:5]) < lowest(ROBOT, stretched[:5])
    assert lowest(ROBOT, rest[:5]) > -0.005
    assert rest[[0, 4, 5]].tolist() == stretched[[0, 4, 5]].tolist()
    balanced = np.array([0.0, 2.1, -0.9, 0.0, 0.0, 0.5])
    assert settled(balanced, NO_PULSES).tolist() == balanced.tolist()


def test_sinking_is_slow() -> None:
    stretched = np.array([0.0, 0.8, -0.4, 0.0, 0.0, 0.5])
    after = places_after(BANK, stretched, drive_of(BANK, stretched, NO_PULSES, NO_FAULTS), 0.02)
    assert 0.0 < (stretched - after)[1] / 0.02 < math.radians(30.0)


def test_end_stops_hold_whatever_the_pulse() -> None:
    for pulse in (500.0, 2500.0):
        rest = settled(HOME, np.full(6, pulse))
        assert np.all((rest >= BANK.lower) & (rest <= BANK.upper))


@given(st.lists(st.floats(500.0, 2500.0), min_size=6, max_size=6), st.floats(0.0, FRAME), st.floats(0.0, 1.0))
def test_half_a_frame_and_its_other_half_are_a_frame(pulses: list[float], elapsed: float, share: float) -> None:
    drive = drive_of(BANK, HOME, np.array(pulses), NO_FAULTS)
    half = places_after(BANK, HOME, drive, share * elapsed)
    moving = np.abs(drive.target - half) > BANK.dead  # what is within its dead band stands still from then on
    halves = places_after(BANK, half, drive, elapsed - share * elapsed)
    np.testing.assert_allclose(halves[moving], places_after(BANK, HOME, drive, elapsed)[moving], atol=1e-12)


def test_a_weak_servo_sags_more_and_a_jammed_one_stays() -> None:
    wanted = np.array([0.0, 0.6, -0.8, 0.0, 0.0, 0.5])
    sound = drive_of(BANK, wanted, pulses_for(wanted), NO_FAULTS)
    weak = drive_of(BANK, wanted, pulses_for(wanted), NO_FAULTS.switched(Fault.SAGGING_SERVO))
    np.testing.assert_allclose((wanted - weak.target)[1], 6.0 * (wanted - sound.target)[1])
    jammed = drive_of(BANK, HOME, pulses_for(wanted), NO_FAULTS.switched(Fault.STALLED_SERVO))
    after = places_after(BANK, HOME, jammed, 1.0)
    assert after[1] == HOME[1]
    assert after[2] != HOME[2]
