"""What a system lacks, and the one line that brings it."""

from __future__ import annotations

import pytest

DEBIAN_12 = 'PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\nVERSION_ID="12"\nID=debian\n'
UBUNTU_22 = 'ID=ubuntu\nID_LIKE=debian\nVERSION_ID="22.04"\n'
UBUNTU_24 = 'ID=ubuntu\nID_LIKE=debian\nVERSION_ID="24.04"\n'
DEBIAN_TESTING = 'ID=debian\nPRETTY_NAME="Debian GNU/Linux forky/sid"\n'
MINT = 'ID=linuxmint\nID_LIKE="ubuntu debian"\nVERSION_ID="22"\n'


@pytest.mark.parametrize(
    ("os_release", "glib"),
    [
        (DEBIAN_12, "libglib2.0-0"),
        (UBUNTU_22, "libglib2.0-0"),
        (UBUNTU_24, "libglib2.0-0t64"),
        (DEBIAN_TESTING, "libglib2.0-0t64"),
        (MINT, "libglib2.0-0"),
        ("", "libglib2.0-0"),
    ],
)
def test_the_glib_package_has_the_name_of_the_release(os_release: str, glib: str) -> None:
    from dev_system import QT, apt_packages, release

    packages = apt_packages(QT, release(os_release))
    assert [name for name in packages if "glib2" in name] == [glib]
    assert len(packages) == len(QT)


def test_the_line_to_type_names_what_is_missing_and_nothing_else() -> None:
    from dev_system import Need, apt_line, apt_packages

    packages = apt_packages([Need("libEGL.so.1", "libegl1"), Need("Xvfb", "xvfb")], {})
    assert apt_line(packages) == ("sudo apt-get update && sudo apt-get install --no-install-recommends libegl1 xvfb")


def test_presence_is_found_out_by_looking() -> None:
    from dev_system import Need, is_present

    assert not is_present(Need("libno-such-library.so.7", "x"))
    assert not is_present(Need("no-such-program", "x"))


def test_somebody_who_is_not_root_is_told_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    import dev_system

    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("os.geteuid", lambda: 1000, raising=False)
    monkeypatch.setattr("shutil.which", lambda name: "/usr/bin/apt-get" if name == "apt-get" else None)
    with pytest.raises(dev_system.SetupError, match="sudo apt-get install --no-install-recommends no-such"):
        dev_system.provide([dev_system.Need("no-such-program", "no-such")])


def test_without_apt_the_libraries_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import dev_system

    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(dev_system.SetupError, match=r"libno-such\.so\.3"):
        dev_system.provide([dev_system.Need("libno-such.so.3", "no-such")])


@pytest.mark.parametrize(
    ("environment", "packages"),
    [
        ({}, None),
        ({"DISPLAY": ":0"}, "libxcb-cursor0"),
        ({"WAYLAND_DISPLAY": "wayland-0"}, "libwayland-client0"),
        ({"DISPLAY": ":0", "WAYLAND_DISPLAY": "wayland-0"}, "libxcb-cursor0"),
    ],
)
def test_a_window_needs_the_libraries_of_its_screen(environment: dict[str, str], packages: str | None) -> None:
    from dev_screen import has_screen
    from dev_system import window_needs

    needs = [need.package for need in window_needs(environment)]
    assert needs[:1] == ([packages] if packages else [])
    assert has_screen(environment, "linux") is bool(needs)
    assert has_screen(environment, "darwin")
