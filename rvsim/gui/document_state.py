"""What the window holds as the value of a session file, and a session file's value into the window."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from rvsim.experiment import SHAPE_KINDS, CameraView, Experiment, SessionState, View
from rvsim.files import example_names, robot_names
from rvsim.files.session.tables import ExperimentKind
from rvsim.gui.panels.device_port import PortSection
from rvsim.gui.panels.user_robot import own_copy
from rvsim.gui.preferences import SETTINGS
from rvsim.gui.session import Session
from rvsim.lab.named_paths import path_names
from rvsim.robot import Robot
from rvsim.scene import Camera

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow


def port_section(window: MainWindow) -> PortSection:
    """Where the device's settings are."""
    section = window.findChild(PortSection)
    assert section is not None
    return section


def state_of(window: MainWindow) -> SessionState:
    """All that is to be saved, as it is now."""
    experiment = window.session.at_rest
    left = tuple(one for one in window.session.left if not _is_untouched(window.session, one))
    return SessionState(experiment, left, port_section(window).settings, view_of(window))


def _is_untouched(session: Session, one: Experiment) -> bool:
    """Whether an arm was only looked at: it is as it would be taken for the first time."""
    kind = ExperimentKind()
    return kind.plain(one) == kind.plain(session.fresh(one.robot))


def view_of(window: MainWindow) -> View:
    """From where the scene is seen, and what is in front."""
    camera, framed = window.scene_view.stance
    seen = CameraView(camera.azimuth, camera.elevation, camera.field_of_view, camera.orthographic)
    if not framed:
        seen = replace(seen, target=camera.target, distance=camera.distance)
    preferences = window.preferences
    loop = window.player_bar.loop.isChecked()
    look, panel, speed = preferences["look"], window.docks.front_page, preferences["speed"]
    tracker = window.tracker
    return View(seen, look, panel, speed, loop, tracker.asked_for, tracker.began)


def show_state(window: MainWindow, state: SessionState) -> None:
    """Show a session instead of the present one. A device is let go of first: nothing that is opened moves it."""
    window.device.disconnect_device()
    window.tracker.clear()
    window.motion.load(None, "")
    left = [_fitting(window, one) for one in state.left]
    for one in left:
        window.library.remember(one.robot)
    window.session.begin(_fitting(window, state.experiment), left)
    port_section(window).show_settings(state.device)
    window.tracker.track_quietly(state.view.tracked, state.view.tracked_from)
    show_view(window, state.view)


def _fitting(window: MainWindow, experiment: Experiment) -> Experiment:
    """With the window's own object for a built-in arm, and a path that this rvsim knows."""
    robot = _own_robot(window, experiment.robot)
    task = experiment.trajectory
    if task.name not in {*path_names(robot), *SHAPE_KINDS}:
        task = window.session.fresh(robot).trajectory
    return replace(experiment, robot=robot, trajectory=task)


def _own_robot(window: MainWindow, robot: Robot) -> Robot:
    """A file's own arm under a built-in one's name becomes a copy: it must not take that one's place in the list."""
    if robot.name not in (*robot_names(), *example_names()):
        return robot
    text = ExperimentKind.arm(robot)
    if "file" in text:
        return own_copy(robot)
    known = window.library[robot.name]
    return known if ExperimentKind.arm(known) == text else robot


def show_view(window: MainWindow, view: View) -> None:
    """Look at the scene from there, with that panel in front."""
    window.preferences.set("look", view.look)
    if view.speed in SETTINGS["speed"].choices:
        window.preferences.set("speed", view.speed)
    window.player_bar.loop.setChecked(view.loop)
    window.docks.show_panel(view.panel)
    if view.camera is not None:
        _show_camera(window, view.camera)


def _show_camera(window: MainWindow, seen: CameraView) -> None:
    window.preferences.set("orthographic", seen.orthographic)
    framed = seen.target is None or seen.distance is None
    now = window.scene_view.stance[0]
    target = now.target if seen.target is None else seen.target
    distance = now.distance if seen.distance is None else min(max(seen.distance, 1e-3), 1e4)
    camera = Camera(target, distance, seen.azimuth, seen.elevation, seen.field_of_view, seen.orthographic)
    window.scene_view.take_stance(camera, framed=framed)
