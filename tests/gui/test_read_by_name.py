"""What a program reads from the window by name is true although the page is behind another one."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtWidgets import QDoubleSpinBox, QTableView, QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.preferences import Preferences
from rvsim.kinematics import forward_kinematics, jacobian


def test_tool_jacobian_and_torques_are_true_behind_other_pages(qtbot: QtBot) -> None:
    window = build_window(Preferences(), robot="rv-m1")
    qtbot.addWidget(window)
    with qtbot.waitExposed(window):
        window.show()
    for joint, value in enumerate((30.0, 40.0, -50.0, 20.0, 60.0), 1):
        window.findChild(QWidget, f"joint_value_{joint}").setValue(value)
    T = forward_kinematics(window.session.robot, window.session.q)
    shown = [window.findChild(QDoubleSpinBox, f"tool_{axis}").value() for axis in "xyz"]
    np.testing.assert_allclose(shown, 1e3 * T[:3, 3], atol=0.06)

    J = jacobian(window.session.robot, window.session.q)
    table = window.findChild(QTableView, "jacobian_table").model()
    entry = float(table.index(0, 0).data().replace("\u2212", "-"))
    np.testing.assert_allclose(entry, 1e3 * J[0, 0], atol=0.06)

    window.findChild(QWidget, "wrench_fz").setValue(-10.0)
    torques = window.findChild(QTableView, "torque_table").model()
    texts = [torques.index(1, column).data() for column in range(torques.columnCount())]
    wanted = f"{-10.0 * J[2, 1]:.2f}".replace("-", "\u2212")
    assert any(text is not None and wanted in str(text) for text in texts), (texts, wanted)


def test_tables_behind_other_pages_are_true_within_a_drag_too(qtbot: QtBot) -> None:
    window = build_window(Preferences(), robot="rv-m1")
    qtbot.addWidget(window)
    window.findChild(QWidget, "wrench_fz").setValue(-10.0)
    tables = [window.findChild(QTableView, name).model() for name in ("jacobian_table", "torque_table")]
    start = np.array(window.session.q)
    for shoulder in np.radians([[0.0, angle, 0.0, 0.0, 0.0] for angle in (10.0, 20.0, 30.0)]):
        assert window.session.move_to(start + shoulder, "Drag", merge="hand")
        J = jacobian(window.session.robot, window.session.q)
        entry, torque = (table.index(*place).data() for table, place in zip(tables, ((0, 1), (1, 3)), strict=True))
        assert float(entry.replace("\u2212", "-")) == pytest.approx(1e3 * J[0, 1], abs=0.06)
        assert float(torque.replace("\u2212", "-")) == pytest.approx(-10.0 * J[2, 1], abs=0.006)
