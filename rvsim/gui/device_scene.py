"""The arm at the other end of the wire, as a ghost beside the one that is shown, and its gripper."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, QTimer

from rvsim.gui.device_control import DeviceControl
from rvsim.gui.served_arm import ServedArm
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.ghosts import Ghost, ghost_items

LAYER = "arm on the wire"
_FRAME_MS = 33
_SAME = 1e-5  # [rad]: closer than that nobody sees a change


class DeviceScene(QObject):
    """Draws where the arm on the wire is: what it measures, and for a virtual one where it really is."""

    def __init__(
        self, session: Session, stage: Stage, device: DeviceControl, served: ServedArm, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._stage, self._device, self._served = session, stage, device, served
        self._shown: FloatArray | None = None
        self._timer = QTimer(self, interval=_FRAME_MS)
        self._timer.timeout.connect(self.show)
        device.state_changed.connect(lambda _: self._wake())
        served.changed.connect(self._wake)

    def _wake(self) -> None:
        if not self._timer.isActive():
            self._timer.start()
            self.show()

    def show(self) -> None:
        """Draw the ghost where it is now; without a device nothing, and the timer rests."""
        found = self._place()
        state = self._device.state
        opening = state.gripper if state is not None and np.isfinite(state.gripper) else None
        self._stage.show_gripper(opening)
        if found is None:
            self._shown = None
            self._stage.set_layer(LAYER, ())
            if state is None and self._served.arm is None:
                self._timer.stop()
            return
        robot, q = found
        if self._shown is not None and len(self._shown) == len(q) and np.abs(self._shown - q).max() < _SAME:
            return
        self._shown = q
        ghost = Ghost("device", "", q, True, lit=True)
        self._stage.set_layer(LAYER, ghost_items(robot, [ghost], self._stage.palette))

    def _place(self) -> tuple[Robot, FloatArray] | None:
        """The arm on the wire and its joints; None when nobody knows."""
        arm = self._device.virtual or self._served.arm
        if arm is not None:
            return arm.robot, arm.true_q
        state = self._device.state
        robot = self._session.robot
        if state is None or len(state.measured_q) != robot.dof or not np.isfinite(state.measured_q).all():
            return None  # with another number of joints, another arm is just being taken
        return robot, state.measured_q
