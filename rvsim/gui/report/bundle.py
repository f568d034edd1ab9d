"""The bundle: a folder with the report, the tables, the script, the session and an animation; whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np

from rvsim.errors import FileWriteError
from rvsim.gui.animation import Animation, AnimationSettings, Picturing, save_animation
from rvsim.gui.formula import pieces
from rvsim.gui.report.artist import PageArtist, painted_png
from rvsim.gui.report.pdf import Sheets, write_pdf
from rvsim.kinematics import forward_kinematics
from rvsim.lab.motion_table import motion_csv
from rvsim.lab.recording_table import recording_csv
from rvsim.lab.report import Cover, Study, build
from rvsim.lab.report.html import html_parts
from rvsim.lab.report.values import Block, Document, Figure, Formula, Formulas, ScenePicture
from rvsim.lab.script import motion_script, tracking_script
from rvsim.lab.tables import tracking_csv
from rvsim.language import tr
from rvsim.scene import Camera
from rvsim.scene.build import SceneOptions, scene_bounds
from rvsim.scene.palette import LIGHT
from rvsim.scene.paths import path_items

Found = TypeVar("Found")

_TRAIL = 600  # places
_SETTINGS = AnimationSettings(640, 400, 12)
_MOMENT = 0.02  # [s] that is waited for another thread
_LONGEST = 60.0  # [s] of an animation: a longer motion is shown faster


class Order(NamedTuple):
    """What is wanted: where, what stands on the cover, which parts, and what besides."""

    folder: Path
    cover: Cover
    parts: frozenset[str] | None = None
    animation: bool = False
    zipped: bool = False
    session: bytes | None = None  # the session file


class Progress(NamedTuple):
    """How far it is, 0…1, and what comes next."""

    share: float
    next: str


@dataclass(frozen=True)
class _File:
    """A file of the bundle: what it is, and how its bytes are made."""

    what: str
    make: Callable[[], bytes]


def write_bundle(study: Study, order: Order) -> Iterator[Progress]:
    """Make the bundle in small pieces of work; giving the iterator up leaves nothing behind.

    Raises:
        FileWriteError: it cannot be written there; nothing is.
    """
    draft = _draft_beside(order.folder)
    try:
        yield from _filled(study, order, draft)
        yield from _beside(lambda: _put_in_place(draft, order), Progress(0.99, tr("Putting the folder in its place")))
    except OSError as problem:
        if isinstance(problem, FileWriteError):
            raise
        raise FileWriteError(order.folder, (problem.strerror or str(problem)).lower()) from None
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def _draft_beside(folder: Path) -> Path:
    """A hidden folder next to where the bundle is to be: a rename must not cross file systems."""
    if folder.exists() or folder.is_symlink():
        raise FileWriteError(folder, tr("there is something of that name already; choose another name"))
    if not folder.parent.is_dir():
        raise FileWriteError(folder, tr("there is no folder “{parent}”", parent=folder.parent))
    try:
        return Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    except OSError as problem:
        raise FileWriteError(folder, (problem.strerror or str(problem)).lower()) from None


def _put_in_place(draft: Path, order: Order) -> None:
    draft.chmod(0o755 & ~_umask())
    archive = Path(shutil.make_archive(f"{draft}-zip", "zip", draft)) if order.zipped else None
    try:
        os.rename(draft, order.folder)
        if archive is not None:
            os.replace(archive, zip_of(order.folder))
    finally:
        if archive is not None:
            archive.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def zip_of(folder: Path) -> Path:
    """Where the archive of a bundle is."""
    return folder.with_name(f"{folder.name}.zip")


def free_folder(parent: Path, name: str) -> Path:
    """A folder of that name that is not there yet, with a number where it has to be."""
    candidates = (parent / (name if number == 1 else f"{name}-{number}") for number in range(1, 10_000))
    return next(folder for folder in candidates if not (folder.exists() or zip_of(folder).exists()))


# --- what is in it -------------------------------------------------------------------------------------------------


def _filled(study: Study, order: Order, draft: Path) -> Iterator[Progress]:
    files = yield from _beside(lambda: _files(study, order), Progress(0.0, tr("Working the report out")))
    words = {name: file.what for name, file in files.items()}
    animated = order.animation and study.motion is not None
    if animated:
        words["animation.gif"] = tr("the motion as a moving picture")
    begin = 0.0
    for name, file in files.items():
        data = yield from _beside(file.make, Progress(begin, tr("Writing {name}", name=name)))
        (draft / name).write_bytes(data)
    if animated:
        yield from _scaled(_animation(study, draft / "animation.gif"), 0.02, 0.45)
        begin = 0.45
    document = yield from _beside(
        lambda: build(study, order.cover, order.parts, words), Progress(begin, tr("Working the report out"))
    )
    yield from _scaled(_page(document, draft / "report.html"), begin, begin + 0.35 * (1.0 - begin))
    yield from _scaled(_paper(document, draft / "report.pdf"), begin + 0.35 * (1.0 - begin), 0.98)


def _scaled(parts: Iterator[Progress], begin: float, end: float) -> Iterator[Progress]:
    for share, what in parts:
        yield Progress(begin + share * (end - begin), what)


def _files(study: Study, order: Order) -> dict[str, _File]:
    """The small ones."""
    found = {
        "script.py": _File(tr("works the numbers out once more, with Python and NumPy alone"), lambda: _script(study))
    }
    tracking, curves, recording = study.tracking, study.curves, study.recording
    if tracking is not None:
        found["path.csv"] = _File(
            tr("the points of the path with their joints"), lambda: tracking_csv(tracking).encode()
        )
    if curves is not None:
        found["motion.csv"] = _File(
            tr("joints, their rates and the tool over time"), lambda: motion_csv(curves).encode()
        )
    if recording is not None and not recording.empty:
        table = recording_csv(study.robot, recording)
        measured = tr("what was desired, commanded and measured")
        reported = tr("what was desired, commanded and reported")
        found["measured.csv"] = _File(measured if recording.is_measured else reported, table.encode)
    session = order.session
    if session is not None:
        found["experiment.rvsim"] = _File(tr("the experiment itself, for rvsim to open"), lambda: session)
    return found


def _script(study: Study) -> bytes:
    """Of the tracked path, else of the motion, else of the pose alone."""
    text = None if study.tracking is None else tracking_script(study.tracking, study.trajectory)
    if text is None and study.trajectory is not None and study.curves is not None:
        text = motion_script(study.robot, study.curves.times, study.curves.q)
    return (text or motion_script(study.robot, [0.0], study.q[None])).encode()


def _page(document: Document, file: Path) -> Iterator[Progress]:
    blocks = tuple(document.blocks())
    for number, block in enumerate(blocks):
        yield from _ready(block, Progress(0.8 * number / len(blocks), tr("Drawing the page")))
    parts, total = [], len(blocks) + 2 * len(document.sections) + 3
    for number, part in enumerate(html_parts(document, PageArtist())):
        parts.append(part)
        yield Progress(0.8 + 0.2 * number / total, tr("Drawing the page"))
    file.write_text("".join(parts), encoding="utf-8")


def _ready(block: Block, progress: Progress) -> Iterator[Progress]:
    """Formulas are set and pictures painted in a thread; both are remembered until they are drawn."""
    if isinstance(block, Formula | Formulas):
        yield from _beside(lambda: [pieces(latex) for latex in block.parts], progress)
    elif isinstance(block, Figure):
        for picture in block.pictures:
            if isinstance(picture, ScenePicture):
                yield from _beside(partial(painted_png, picture), progress)
    else:
        yield progress


def _paper(document: Document, file: Path) -> Iterator[Progress]:
    sheets = Sheets(document)
    blocks = sum(1 for _ in document.blocks())
    for number, _ in enumerate(sheets.lay_out()):
        yield Progress(0.5 * min(number / (3 * blocks), 1.0), tr("Setting the pages"))
    for number, _ in enumerate(write_pdf(sheets, file), 1):
        yield Progress(
            0.5 + 0.5 * number / len(sheets.pages),
            tr("Printing page {number} of {count}", number=number, count=len(sheets.pages)),
        )


def _animation(study: Study, file: Path) -> Iterator[Progress]:
    motion = study.motion
    assert motion is not None, "asked for only where something moves"
    settings = AnimationSettings(
        _SETTINGS.width, _SETTINGS.height, _SETTINGS.rate, max(1.0, motion.duration / _LONGEST), loop=True
    )
    animation = Animation(motion, _picturing(study), settings)
    while animation.step():
        yield Progress(0.95 * animation.share, tr("Painting the animation"))
    data = yield from _encoded(animation)
    save_animation(data, file)


def _encoded(animation: Animation) -> Generator[Progress, None, bytes]:
    """A thread writes it, for that takes seconds at once."""
    progress = Progress(0.95, tr("Writing the animation"))
    return (yield from _beside(lambda: animation.encode(".gif"), progress, animation.give_up))


def _beside(
    work: Callable[[], Found], progress: Progress, at_the_end: Callable[[], None] = lambda: None
) -> Generator[Progress, None, Found]:
    """Work that a thread does while the window goes on."""
    with ThreadPoolExecutor(1, "rvsim-report") as pool:
        job: Future[Found] = pool.submit(work)
        try:
            while wait([job], _MOMENT).not_done:
                yield progress
        finally:
            at_the_end()
        return job.result()


def _picturing(study: Study) -> Picturing:
    robot, tracking, motion = study.robot, study.tracking, study.motion
    assert motion is not None, "asked for only where something moves"
    times = np.linspace(0.0, motion.duration, _TRAIL)
    trail = forward_kinematics(robot, np.stack([motion.q(time) for time in times]))[:, :3, 3]
    extras = () if tracking is None else path_items(tracking.path.points, tracking.reached, np.empty((0, 3)), LIGHT)
    camera = Camera(np.zeros(3), 1.0).fitted(scene_bounds(robot), _SETTINGS.width, _SETTINGS.height)
    return Picturing(robot, camera, LIGHT, SceneOptions("solid"), extras, times, trail)
