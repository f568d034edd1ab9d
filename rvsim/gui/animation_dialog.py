"""Export › Animation: size, rate, speed, format and file; painted in slices, written aside, given up at any time."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QCloseEvent, QPixmap
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QProgressBar,
    QVBoxLayout,
    QWidget,
)

from rvsim.errors import FileWriteError
from rvsim.gui.animation import (
    RATES,
    SIZES,
    Animation,
    AnimationSettings,
    Picturing,
    framed_for,
    save_animation,
)
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, combo, form, select
from rvsim.gui.workers import LatestWorker
from rvsim.kinematics import forward_kinematics
from rvsim.language import left_to_right, tr, tr_later
from rvsim.motion import Trajectory
from rvsim.playback.player import Playable
from rvsim.scene.build import SceneOptions
from rvsim.scene.paths import path_items

_FORMATS = {
    ".gif": tr_later("GIF: plays everywhere"),
    ".png": tr_later("APNG: every colour, larger"),
    ".webp": tr_later("WebP: smallest"),
}
_SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0)
_PREVIEW = 320  # [pixels] wide
_TRAIL = 600  # places


class AnimationDialog(QDialog):
    """Does not stop the work in the window; the motion that was loaded when it opened is the one that is written."""

    def __init__(
        self, parent: QWidget, session: Session, motion: MotionControl, stage: Stage, preferences: Preferences
    ) -> None:
        super().__init__(parent)
        self.setObjectName("animation_dialog")
        self.setWindowTitle(tr("Export animation"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._session, self._preferences, self._stage = session, preferences, stage
        self._trajectory: Playable | None = motion.player.trajectory
        # The arm and the path of that motion: the window may show others by the time it is painted.
        self._experiment, self._tracking = session.experiment, session.tracking
        self._opening_at = motion.opening_at
        self._animation: Animation | None = None
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_encoded)
        self._slice = QTimer(self, interval=0)  # the window's own events come in between
        self._slice.timeout.connect(self._paint_next)
        self._make_choices()
        self._lay_out()
        self._show_summary()
        self._show_still()

    # --- assembly --------------------------------------------------------------------------------------------------

    def _make_choices(self) -> None:
        self.size_box = combo("animation_size", tr("Size of the picture"))
        for width, height in SIZES:
            self.size_box.addItem(left_to_right(f"{width} × {height}"), (width, height))
        self.rate_box = combo("animation_rate", tr("Frames a second"))
        for rate in RATES:
            self.rate_box.addItem(tr("{rate} frames a second", rate=rate), rate)
        self.speed_box = combo("animation_speed", tr("How fast the motion runs"))
        for speed in _SPEEDS:
            self.speed_box.addItem(left_to_right(f"{speed:g}×"), speed)
        self.format_box = combo("animation_format", tr("Format of the file"), _FORMATS)
        self.loop = QCheckBox(tr("Again and again"))
        self.loop.setObjectName("animation_loop")
        self.loop.setChecked(True)
        self.size_box.setCurrentIndex(1)
        select(self.rate_box, 15)
        select(self.speed_box, 1.0)
        self.file = QLineEdit(str(Path.home() / f"{self._session.robot.name}.gif"))
        self.file.setObjectName("animation_file")
        self.file.setAccessibleName(tr("File"))
        self.file.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        for box in (self.size_box, self.rate_box, self.speed_box):
            box.currentIndexChanged.connect(lambda _: self._show_summary())
        self.size_box.currentIndexChanged.connect(lambda _: self._show_still())
        self.format_box.currentIndexChanged.connect(lambda _: self._on_format())

    def _lay_out(self) -> None:
        self.preview = QLabel()
        self.preview.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.preview.setFixedHeight(_PREVIEW * 9 // 16)
        self.summary = wrapped_label("muted")
        self.summary.setObjectName("animation_summary")
        self.progress = QProgressBar()
        self.progress.setObjectName("animation_progress")
        self.progress.setRange(0, 1000)
        self.progress.setVisible(False)
        rows = form()
        rows.addRow(tr("Size"), self.size_box)
        rows.addRow(tr("Rate"), self.rate_box)
        rows.addRow(tr("Speed"), self.speed_box)
        rows.addRow(tr("Format"), self.format_box)
        rows.addRow("", self.loop)
        rows.addRow(tr("File"), self._file_row())
        self.start_button = button(
            "animation_start", tr("Export animation"), tr("Paint and write it"), self.start, primary=True
        )
        self.cancel_button = button("animation_cancel", tr("Close"), tr("Give up, or close"), self.give_up)
        buttons = QHBoxLayout()
        buttons.addWidget(self.progress, 1)
        buttons.addStretch(0)
        buttons.addWidget(self.start_button)
        buttons.addWidget(self.cancel_button)
        column = QVBoxLayout(self)
        column.setSpacing(8)
        column.addWidget(self.preview)
        column.addLayout(rows)
        column.addWidget(self.summary)
        column.addLayout(buttons)
        self.setMinimumWidth(420)

    def _file_row(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.addWidget(self.file, 1)
        row.addWidget(button("animation_browse", "…", tr("Choose the file"), self._browse))
        return row

    def _browse(self) -> None:
        chosen, _ = QFileDialog.getSaveFileName(self, tr("Export animation"), self.file.text(), f"*{self.ending}")
        if chosen:
            path = Path(chosen)
            self.file.setText(str(path if path.suffix else path.with_suffix(self.ending)))

    # --- what is chosen --------------------------------------------------------------------------------------------

    @property
    def ending(self) -> str:
        """ ".gif", ".png" or ".webp"."""
        return str(self.format_box.currentData())

    @property
    def settings(self) -> AnimationSettings:
        """What the boxes say."""
        width, height = self.size_box.currentData()
        rate, speed = self.rate_box.currentData(), self.speed_box.currentData()
        return AnimationSettings(width, height, rate, speed, self.loop.isChecked())

    def _on_format(self) -> None:
        self.file.setText(str(Path(self.file.text()).with_suffix(self.ending)))
        self._show_summary()

    def _show_summary(self) -> None:
        """What will come of it, or why nothing can."""
        problem = self._problem()
        self.start_button.setEnabled(not problem)
        set_role(self.summary, role="" if problem else "muted", level="warning" if problem else "")
        if problem or self._trajectory is None:
            self.summary.setText(problem)
            return
        settings, duration = self.settings, self._trajectory.duration
        size = settings.estimated_bytes(duration, self.ending) / 1e6
        frames, seconds = settings.frames(duration), settings.seconds(duration)
        self.summary.setText(
            tr("{frames} frames, {seconds:.1f} s, about {size:.1f} MB.", frames=frames, seconds=seconds, size=size)
        )

    def _problem(self) -> str:
        if self._trajectory is None:
            return tr("No motion yet: track a line or run a program first.")
        if self.settings.too_many(self._trajectory.duration):
            return tr("Too many frames of that size: choose a smaller one, fewer frames a second, or a higher speed.")
        return ""

    # --- at work ---------------------------------------------------------------------------------------------------

    @property
    def busy(self) -> bool:
        """Whether frames are being painted, or the file is being made."""
        return self._animation is not None

    def start(self) -> None:
        """Paint all frames, then write them."""
        if self._trajectory is None or self.busy:
            return
        self._animation = Animation(self._trajectory, self._picturing(), self.settings)
        self._show_busy(True)
        self._slice.start()

    def give_up(self) -> None:
        """Stop what is being done; with nothing to stop, close."""
        if not self.busy:
            self._worker.close()
            super().reject()
            return
        self._end()
        self.summary.setText(tr("Given up. Nothing was written."))

    def _paint_next(self) -> None:
        animation = self._animation
        if animation is None:
            return
        more = animation.step()
        self.progress.setValue(round(900 * animation.share))
        if len(animation.frames) % 5 == 1:
            self._show_frame(animation)
        if not more:
            self._slice.stop()
            self.progress.setFormat(tr("writing …"))
            self._worker.ask(partial(animation.encode, self.ending))

    def _on_encoded(self, data: bytes) -> None:
        path = Path(self.file.text())
        try:
            save_animation(data, path)
        except FileWriteError as problem:
            sentence, level = str(problem), "error"
        else:
            sentence, level = tr("Saved {path}: {size:.2f} MB.", path=path, size=len(data) / 1e6), "info"
        self._end()
        self.summary.setText(sentence)
        set_role(self.summary, role="", level="" if level == "info" else level)
        self._session.say(sentence, level)

    def _end(self) -> None:
        self._slice.stop()
        if self._animation is not None:
            self._animation.give_up()
        self._worker.cancel()
        self._animation = None
        self._show_busy(False)

    def _show_busy(self, busy: bool) -> None:
        for box in (self.size_box, self.rate_box, self.speed_box, self.format_box, self.loop, self.file):
            box.setEnabled(not busy)
        self.start_button.setEnabled(not busy)
        self.cancel_button.setText(tr("Cancel") if busy else tr("Close"))
        self.progress.setFormat("%p %")
        self.progress.setVisible(busy)
        self.progress.setValue(0)

    def _show_frame(self, animation: Animation) -> None:
        if animation.last is not None:
            self._show_picture(QPixmap.fromImage(animation.last))

    def _show_still(self) -> None:
        """The picture as it will look, at the present pose."""
        image = self._picturing().frame(0.0, self._experiment.q, self.settings)
        self._show_picture(QPixmap.fromImage(image))

    def _show_picture(self, picture: QPixmap) -> None:
        smooth = Qt.TransformationMode.SmoothTransformation
        self.preview.setPixmap(
            picture.scaled(_PREVIEW, self.preview.height(), Qt.AspectRatioMode.KeepAspectRatio, smooth)
        )

    def _picturing(self) -> Picturing:
        """The scene as it is seen in the window now: eye, look, path and trail."""
        view, wanted, palette = self._stage.view, self._preferences, self._stage.palette
        options = SceneOptions(
            look=wanted["look"],
            frames=wanted["show_frames"],
            labels=wanted["show_labels"],
            floor=wanted["show_floor"],
            length_unit=wanted["length_unit"],
        )
        camera = framed_for(view.camera, self.settings, view.width(), view.height())
        tracking, robot = self._tracking, self._experiment.robot
        path = () if tracking is None else path_items(
            tracking.path.points, tracking.reached, np.empty((0, 3)), palette, marks=False
        )  # fmt: skip
        times, points = np.empty(0), np.empty((0, 3))
        if isinstance(self._trajectory, Trajectory) and wanted["show_trail"]:
            times = np.linspace(self._trajectory.path_start, self._trajectory.duration, _TRAIL)
            points = forward_kinematics(robot, self._trajectory.q(times))[:, :3, 3]
        return Picturing(robot, camera, palette, options, path, times, points, self._opening_at)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Whatever is at work ends; Qt goes on with `reject`."""
        self._end()
        super().closeEvent(event)

    def reject(self) -> None:
        """Escape cancels what is being done, or closes."""
        self.give_up()
