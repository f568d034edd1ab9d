"""How fast the window is: value change to painted frame, first window, memory over many frames.

Each figure comes from a process of its own, on the screen that there is (`dev.py bench` lends a virtual one).
Wall-clock times: what a person waits for. Figures of one machine; read them beside its name. Names of measurements
as arguments ("scrub", "drag" …) leave the others out.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time

FRAMES, MEMORY_FRAMES = 400, 10_000
# Where a drag begins: all that it asks for can be reached. [degrees]
_READY = {
    "rv-m1": (30.0, 40.0, -50.0, 20.0, 60.0),
    "rv-1a": (20.0, 80.0, 30.0, 40.0, 50.0, 30.0),
    "ur5e": (20.0, -70.0, 100.0, -50.0, 60.0, 35.0),
    "al5b": (20.0, 100.0, -80.0, -20.0, 15.0),
}
_MODES = ("frame", "drag", "beyond", "inspector", "scrub", "startup", "memory")
_SIX_PLOTS = ("q", "qd", "qdd", "tool", "sigma", "deviation")
_OTHERS = {"rv-m1": "RV-M1", "rv-1a": "RV-1A", "al5b": "AL5B"}


def main(chosen: list[str]) -> int:
    """Run every measurement, or those chosen, and print a row each."""
    rows = [
        ("value change to painted frame, own renderer, 1280×720, p95", "≤ 16 ms", ("frame", "auto", "1280", "720")),
        ("the same with OpenGL forced (software here), 800×600 view, p95", "≤ 40 ms", ("frame", "gl", "800", "600")),
        ("drag step: inverse, table, ghosts and frame, UR5e, 1280×720, p95", "≤ 16 ms", ("drag", "ur5e")),
        *((f"drag step: the same of the {title}, p95", "≤ 16 ms", ("drag", name)) for name, title in _OTHERS.items()),
        ("drag step beyond the reach, the arm creeping, UR5e, p95", "≤ 16 ms", ("beyond", "ur5e")),
        ("inspector: numbers, both ellipsoids and frame, UR5e, p95", "≤ 16 ms", ("inspector", "ur5e")),
        ("scrubbing the time slider, six plots open, UR5e, 1280×800, p95", "≤ 16 ms", ("scrub", "ur5e")),
        ("first window painted, warm, median of 5", "≤ 1.0 s", ("startup",)),
        ("resident memory after 10,000 frames", "≤ 280 MB, flat", ("memory",)),
    ]  # fmt: skip
    for title, target, mode in rows:
        if chosen and mode[0] not in chosen:
            continue
        print(f"{title:62s} {target:16s} {_measured(mode)}", flush=True)
    return 0


def _measured(mode: tuple[str, ...]) -> str:
    if mode[0] == "startup":
        times = sorted(json.loads(_child(mode))["seconds"] for _ in range(6))[:5]
        return f"{times[2]:.2f} s  ({times[0]:.2f} … {times[-1]:.2f})"
    found = json.loads(_child(mode))
    if mode[0] == "memory":
        return f"{found['before']:.0f} MB after 500 frames, {found['after']:.0f} MB after {MEMORY_FRAMES}"
    return f"{found['p95']:.1f} ms  (median {found['median']:.1f}, {found['renderer']})"


def _child(mode: tuple[str, ...]) -> str:
    command = [sys.executable, __file__, *mode, str(time.time())]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{mode} failed:\n{done.stderr}")
    return done.stdout.strip().splitlines()[-1]


# --- in the child ----------------------------------------------------------------------------------------------------


def child(arguments: list[str]) -> None:
    """One measurement, printed as one JSON line."""
    mode, started = arguments[0], float(arguments[-1])
    from rvsim.gui.app import build_window, make_application
    from rvsim.gui.preferences import Preferences

    app = make_application(["rvsim"])
    renderer = arguments[1] if mode == "frame" else "auto"
    robot = arguments[1] if mode in ("drag", "beyond", "inspector", "scrub") else "rv-m1"
    window = build_window(Preferences(), robot=robot, renderer=renderer)
    painted: list[float] = []
    window.scene_view.painted.connect(lambda _: painted.append(time.perf_counter()))
    window.resize(1280, 800 if mode == "scrub" else 720)
    if mode == "frame" and renderer == "gl":
        window.scene_view.setFixedSize(int(arguments[2]), int(arguments[3]))
    window.show()
    _until(app, lambda: bool(painted))
    if mode == "startup":
        print(json.dumps({"seconds": time.time() - started}))
    elif mode in ("drag", "beyond"):
        print(json.dumps(_drag_times(app, window, painted, beyond=mode == "beyond")))
    elif mode == "inspector":
        print(json.dumps(_inspector_times(app, window, painted)))
    elif mode == "scrub":
        print(json.dumps(_scrub_times(app, window, painted)))
    elif mode == "frame":
        print(json.dumps(_frame_times(app, window, painted)))
    else:
        print(json.dumps(_memory(app, window, painted)))
    sys.stdout.flush()
    os._exit(0)


def _until(app: object, done: object, seconds: float = 20.0) -> None:
    end = time.perf_counter() + seconds
    while not done():  # type: ignore[operator]
        app.processEvents()  # type: ignore[attr-defined]
        if time.perf_counter() > end:
            raise SystemExit("nothing was painted within 20 s")


def _change(window: object, number: int) -> None:
    box = window.joints._rows[number % 2].box  # type: ignore[attr-defined]
    box.setValue(-60.0 + (number * 7) % 100 if number % 2 == 0 else (number * 3) % 90)


def _frame_times(app: object, window: object, painted: list[float]) -> dict[str, object]:
    window.preferences.set("show_frames", True)  # type: ignore[attr-defined]
    times = []
    for number in range(FRAMES):
        app.processEvents()  # type: ignore[attr-defined]
        painted.clear()
        start = time.perf_counter()
        _change(window, number)
        _until(app, lambda: bool(painted))
        times.append((painted[-1] - start) * 1e3)
    name = window.scene_view.renderer.description  # type: ignore[attr-defined]
    return {**_spread(times), "renderer": name}


def _inspector_times(app: object, window: object, painted: list[float]) -> dict[str, object]:
    """The Singular page is seen with both ellipsoids; from a change of a joint to the painted frame."""
    from PySide6.QtWidgets import QDockWidget

    from rvsim.gui.page_stack import PageStack
    from rvsim.gui.panels.inspect_singular import SingularPage

    window.findChild(QDockWidget, "inspect_dock").raise_()  # type: ignore[attr-defined]
    window.findChild(PageStack, "inspect_pages").show_page("singular")  # type: ignore[attr-defined]
    page = window.findChild(SingularPage)  # type: ignore[attr-defined]
    page.velocity.setChecked(True)
    page.force.setChecked(True)
    _until(app, lambda: page.seen)
    times = _frame_times(app, window, painted)
    assert page.kinds == ("velocity", "force"), "both ellipsoids must be there"
    return times


def _drag_times(app: object, window: object, painted: list[float], beyond: bool) -> dict[str, object]:
    """The branch wall is open; a hand holds an arrow of the gizmo and goes up and down, or far out of reach and back.

    From the pointer's move to the painted frame; the drag's own pause between frames is left out.
    """
    import numpy as np
    from PySide6.QtCore import QPointF, Qt
    from PySide6.QtWidgets import QDockWidget

    session, gizmo, view = window.session, window.gizmo, window.scene_view  # type: ignore[attr-defined]
    window.findChild(QDockWidget, "inverse_dock").raise_()  # type: ignore[attr-defined]
    session.move_to(np.radians(_READY[session.robot.name]), "Begin")
    end = time.perf_counter() + 1.0
    while time.perf_counter() < end:
        app.processEvents()  # type: ignore[attr-defined]
    shown = gizmo._gizmo()
    arrow = next(handle for handle in shown.handles if handle.key == "axis z")
    places = shown.origin + shown.size * np.array([[0.6], [0.9]]) * arrow.direction
    (x0, y0, _), (x1, y1, _) = view.camera.project(places, view.width(), view.height()).tolist()
    assert gizmo.press(QPointF(x1, y1)), "nothing to take hold of"
    along = QPointF(x1 - x0, y1 - y0) / np.hypot(x1 - x0, y1 - y0)
    times, missed = [], 0
    for number in range(FRAMES):
        way = 3.0 * abs((number + 100) % 200 - 100) if beyond else 12.0 * np.sin(0.05 * number)
        app.processEvents()  # type: ignore[attr-defined]
        painted.clear()
        start = time.perf_counter()
        gizmo.drag(QPointF(x1, y1) + along * way, Qt.KeyboardModifier.NoModifier)
        window.target.flush()  # type: ignore[attr-defined]
        _until(app, lambda: bool(painted))
        times.append((painted[-1] - start) * 1e3)
        missed += window.target.answer.missed  # type: ignore[attr-defined]
    return {**_spread(times), "renderer": view.renderer.description, "missed": missed}


def _scrub_times(app: object, window: object, painted: list[float]) -> dict[str, object]:
    """Six plots of a tracked ellipse; a hand drags the time slider. Until scene, panels and plots are painted."""
    from dataclasses import replace

    from rvsim.experiment import TrajectoryTask

    plots, session = window.plots, window.session  # type: ignore[attr-defined]
    window.preferences.set("show_plots", True)  # type: ignore[attr-defined]
    for name, made in plots._buttons.items():
        made.setChecked(name in _SIX_PLOTS)
    session.edit("path", replace(session.experiment, trajectory=TrajectoryTask("ellipse-moved")))
    window.tracker.track_trajectory()  # type: ignore[attr-defined]
    _until(app, lambda: session.tracking is not None)
    window.motion.pause()  # type: ignore[attr-defined]
    _until(app, lambda: len(plots.plots) == len(_SIX_PLOTS) and not plots._later.isActive())
    times = []
    for number in range(FRAMES):
        app.processEvents()  # type: ignore[attr-defined]
        painted.clear()
        start = time.perf_counter()
        window.player_bar.slider.setValue(100 + (37 * number) % 9800)  # type: ignore[attr-defined]
        _until(app, lambda: bool(painted))
        app.processEvents()  # type: ignore[attr-defined]
        times.append((time.perf_counter() - start) * 1e3)
    return {**_spread(times), "renderer": window.scene_view.renderer.description}  # type: ignore[attr-defined]


def _spread(times: list[float]) -> dict[str, float]:
    settled = sorted(times[20:])
    return {"median": settled[len(settled) // 2], "p95": settled[int(0.95 * len(settled))]}


def _memory(app: object, window: object, painted: list[float]) -> dict[str, float]:
    before = 0.0
    for number in range(MEMORY_FRAMES):
        painted.clear()
        _change(window, 2 * number)  # one joint: its moves are one undo step, so that frames alone are counted
        _until(app, lambda: bool(painted))
        if number == 500:
            before = _resident_mb()
    return {"before": before, "after": _resident_mb()}


def _resident_mb() -> float:
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


if __name__ == "__main__":
    if len(sys.argv) > 2 and sys.argv[1] in _MODES:
        child(sys.argv[1:])
    else:
        sys.exit(main(sys.argv[1:]))
