"""How fast the window is: value change to painted frame, first window, memory over many frames.

Each figure comes from a process of its own, on the screen that there is (`dev.py bench` lends a virtual one).
Wall-clock times: what a person waits for. Figures of one machine; read them beside its name.
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


def main() -> int:
    """Run every measurement and print a row each."""
    rows = [
        ("value change to painted frame, own renderer, 1280×720, p95", "≤ 16 ms", ("frame", "auto", "1280", "720")),
        ("the same with OpenGL forced (software here), 800×600 view, p95", "≤ 40 ms", ("frame", "gl", "800", "600")),
        ("drag step: inverse, table, ghosts and frame, UR5e, 1280×720, p95", "≤ 16 ms", ("drag", "ur5e")),
        ("drag step: the same of the RV-M1, p95", "≤ 16 ms", ("drag", "rv-m1")),
        ("first window painted, warm, median of 5", "≤ 1.0 s", ("startup",)),
        ("resident memory after 10,000 frames", "≤ 280 MB, flat", ("memory",)),
    ]  # fmt: skip
    for title, target, mode in rows:
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
    robot = arguments[1] if mode == "drag" else "rv-m1"
    window = build_window(Preferences(), robot=robot, renderer=renderer)
    painted: list[float] = []
    window.scene_view.painted.connect(lambda _: painted.append(time.perf_counter()))
    window.resize(1280, 720)
    if mode == "frame" and renderer == "gl":
        window.scene_view.setFixedSize(int(arguments[2]), int(arguments[3]))
    window.show()
    _until(app, lambda: bool(painted))
    if mode == "startup":
        print(json.dumps({"seconds": time.time() - started}))
    elif mode == "drag":
        print(json.dumps(_drag_times(app, window, painted)))
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


def _drag_times(app: object, window: object, painted: list[float]) -> dict[str, object]:
    """The branch wall is open; the tool is wanted a little elsewhere, again and again, as a drag would want it."""
    import numpy as np
    from PySide6.QtWidgets import QDockWidget

    from rvsim.gui.target import Wish
    from rvsim.kinematics import forward_kinematics

    robot = window.session.robot  # type: ignore[attr-defined]
    window.findChild(QDockWidget, "inverse_dock").raise_()  # type: ignore[attr-defined]
    begin = np.radians(_READY[robot.name])
    window.session.move_to(begin, "Begin")  # type: ignore[attr-defined]
    end = time.perf_counter() + 1.0
    while time.perf_counter() < end:
        app.processEvents()  # type: ignore[attr-defined]
    start_T = forward_kinematics(robot, window.session.q)  # type: ignore[attr-defined]
    times = []
    for number in range(FRAMES):
        T = start_T.copy()
        T[2, 3] += 0.02 * np.sin(0.05 * number)
        app.processEvents()  # type: ignore[attr-defined]
        painted.clear()
        start = time.perf_counter()
        window.target.set_target(Wish(T, "Drag", "drag"))  # type: ignore[attr-defined]
        _until(app, lambda: bool(painted))
        times.append((painted[-1] - start) * 1e3)
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
    if len(sys.argv) > 2 and sys.argv[1] in ("frame", "drag", "startup", "memory"):
        child(sys.argv[1:])
    else:
        sys.exit(main())
