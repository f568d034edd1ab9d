"""What is seen of a motion while the arm runs it: where a virtual arm really is, and which faults were on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rvsim.gui.device_words import LANGUAGE_WORDS
from rvsim.language import tr
from rvsim.playback.recording import MOST_ROWS, Recording
from rvsim.robot.arrays import FloatArray

if TYPE_CHECKING:
    from rvsim.device.driver.io_thread import ArmDriver
    from rvsim.device.driver.state import DriverState


class Witness:
    """Looks at an arm at each poll, from the start of a motion on."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """A motion begins."""
        self._times: list[float] = []
        self._poses: list[FloatArray] = []
        self._faults: set[str] = set()

    def look(self, driver: ArmDriver, state: DriverState) -> None:
        """Note where the virtual arm is; nothing of a real one, which nobody can look into."""
        arm = driver.virtual
        if arm is None or state.phase != "running":
            return
        self._faults |= {fault.value for fault in arm.faults.on}
        last = self._times[-1] if self._times else 0.0
        if state.time > last and len(self._times) < MOST_ROWS:
            self._times.append(state.time)
            self._poses.append(arm.true_q)

    def recording(self, driver: ArmDriver) -> Recording:
        """What the driver recorded, with the true poses of a virtual arm."""
        recording = driver.recording
        if len(self._times) < 2 or len(self._poses[0]) != recording.desired.shape[1]:
            return recording
        return recording.with_true(np.array(self._times), np.array(self._poses))

    def words(self, driver: ArmDriver, is_virtual: bool) -> str:
        """How the motion was run, in sentences."""
        controller = tr(LANGUAGE_WORDS[driver.language])
        if not is_virtual:
            return tr(
                "It ran on the arm at {port} (controller: {controller}; {baud} baud).",
                port=driver.url,
                controller=controller,
                baud=driver.baud,
            )
        how = tr(
            "It ran on rvsim’s virtual arm (controller: {controller}; {baud} baud).",
            controller=controller,
            baud=driver.baud,
        )
        return f"{how} {self._fault_words()}"

    def _fault_words(self) -> str:
        if not self._faults:
            return tr("Faults that were switched on: none.")
        return tr(
            "Faults that were switched on: {faults}.", faults=tr(", ").join(tr(fault) for fault in sorted(self._faults))
        )
