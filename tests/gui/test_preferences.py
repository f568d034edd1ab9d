"""Preferences: what is set is found again, and no broken file stops anybody."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rvsim.gui.preferences import SETTINGS, Preferences


def another_value(name: str) -> object:
    default, choices = SETTINGS[name]
    if choices:
        return next(choice for choice in choices if choice != default)
    return not default if isinstance(default, bool) else "ur5e"


@pytest.mark.parametrize("name", SETTINGS)
def test_a_setting_is_found_again(tmp_path: Path, name: str) -> None:
    file = tmp_path / "settings.ini"
    first = Preferences(file)
    first.set(name, another_value(name))
    del first
    assert Preferences(file)[name] == another_value(name)


def test_a_change_is_told_once() -> None:
    told: list[str] = []
    preferences = Preferences()
    preferences.changed.connect(told.append)
    preferences.set("theme", "dark")
    preferences.set("theme", "dark")
    assert told == ["theme"]


def test_a_value_outside_the_choices_is_refused() -> None:
    with pytest.raises(ValueError, match="theme"):
        Preferences().set("theme", "pink")


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(garbage=st.binary(max_size=300))
def test_a_broken_file_gives_the_defaults_or_sound_values(tmp_path: Path, garbage: bytes) -> None:
    file = tmp_path / "settings.ini"
    file.write_bytes(b"[preferences]\ntheme=" + garbage + b"\nspeed=fast\nlive=" + garbage)
    preferences = Preferences(file)
    for name, setting in SETTINGS.items():
        value = preferences[name]
        assert type(value) is type(setting.default)
        assert not setting.choices or value in setting.choices


def test_a_file_that_cannot_be_written_is_no_obstacle(tmp_path: Path) -> None:
    preferences = Preferences(tmp_path)  # a folder, where a file should be
    preferences.set("theme", "dark")
    assert preferences["theme"] == "dark"
