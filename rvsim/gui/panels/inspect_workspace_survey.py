"""A workspace worked out in parts, for a worker: how far it is, and in the end the whole."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import NamedTuple

from rvsim.kinematics.workspace import Workspace, WorkspaceTask, workspace_parts

_TELL_EVERY = 0.03  # [s]


class Survey(NamedTuple):
    """A workspace, and how long it took [s]."""

    workspace: Workspace
    seconds: float


def survey_parts(task: WorkspaceTask) -> Iterator[float | Survey | None]:
    """The share that is done, 0…1 (None where it was told just before), and last the survey."""
    begun = told = time.monotonic()
    for part in workspace_parts(task):
        now = time.monotonic()
        if isinstance(part, Workspace):
            yield Survey(part, now - begun)
        elif now - told >= _TELL_EVERY:
            told = now
            yield part
        else:
            yield None  # not worth telling, but a place to be stopped at
