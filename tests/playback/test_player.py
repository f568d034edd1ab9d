"""The player: time passes only when it is told, exactly, in steps of any length."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from rvsim.playback import Player

DURATION = 4.0


class Ramp:
    """q = t."""

    duration = DURATION

    def q(self, t: ArrayLike) -> np.ndarray:
        return np.asarray([np.clip(t, 0.0, DURATION)])


@pytest.fixture
def player() -> Player:
    player = Player()
    player.load(Ramp())
    return player


def test_an_empty_player_does_nothing() -> None:
    player = Player()
    for action in (player.play, player.pause, player.stop):
        action()
        assert player.state == "empty"
    player.seek(3.0)
    assert not player.advance(1.0)
    assert player.time == player.duration == 0.0
    assert player.q is None


def test_from_start_to_end_and_again(player: Player) -> None:
    assert player.state == "stopped"
    assert not player.advance(1.0)
    player.play()
    assert player.advance(1.0)
    assert (player.time, player.state) == (1.0, "playing")
    assert player.q == [1.0]
    assert player.advance(100.0)
    assert (player.time, player.state) == (DURATION, "finished")
    assert not player.advance(1.0)
    player.play()
    assert (player.time, player.state) == (0.0, "playing")


def test_pause_holds_the_moment_and_stop_goes_back(player: Player) -> None:
    player.play()
    player.advance(1.5)
    player.pause()
    assert not player.advance(1.0)
    assert (player.time, player.state) == (1.5, "paused")
    player.play()
    player.advance(0.5)
    assert player.time == 2.0
    player.stop()
    assert (player.time, player.state) == (0.0, "stopped")


@given(st.lists(st.floats(0.0, 3.0), max_size=12), st.booleans(), st.floats(0.1, 10.0))
def test_many_short_times_are_one_long_time(steps: list[float], loop: bool, speed: float) -> None:
    short, long = Player(), Player()
    for player in (short, long):
        player.load(Ramp())
        player.loop, player.speed = loop, speed
        player.play()
    for dt in steps:
        short.advance(dt)
    long.advance(sum(steps))
    difference = abs(short.time - long.time)
    assert min(difference, abs(DURATION - difference) if loop else np.inf) < 1e-9


def test_it_repeats_for_ever_when_it_loops(player: Player) -> None:
    player.loop = True
    player.play()
    player.advance(10 * DURATION + 1.0)
    assert player.time == pytest.approx(1.0)
    assert player.playing


@pytest.mark.parametrize(("wish", "speed"), [(0.0, 0.1), (2.0, 2.0), (99.0, 10.0)])
def test_the_speed_has_bounds_and_scales_time(player: Player, wish: float, speed: float) -> None:
    player.speed = wish
    assert player.speed == speed
    player.play()
    player.advance(0.2)
    assert player.time == pytest.approx(0.2 * speed)


def test_seeking_is_clamped_and_rests_where_it_rested(player: Player) -> None:
    player.seek(99.0)
    assert (player.time, player.state) == (DURATION, "paused")
    player.seek(-1.0)
    assert player.time == 0.0
    player.play()
    player.seek(2.0)
    assert player.playing
    player.advance(1.0)
    assert player.time == 3.0


def test_a_step_pauses_and_goes_either_way(player: Player) -> None:
    player.play()
    player.step(1.0)
    assert (player.time, player.state) == (1.0, "paused")
    player.step(-0.25)
    assert player.time == 0.75


def test_loading_starts_afresh_and_none_empties(player: Player) -> None:
    player.play()
    player.advance(1.0)
    player.load(Ramp())
    assert (player.time, player.state) == (0.0, "stopped")
    player.load(None)
    assert player.state == "empty"
