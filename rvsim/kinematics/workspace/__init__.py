"""Where a tool can go: sections of the workspace, their outlines, and a cloud of places, sampled or asked."""

from rvsim.kinematics.workspace.branches import has_branches, holds_orientation
from rvsim.kinematics.workspace.grid import Grid
from rvsim.kinematics.workspace.survey import workspace, workspace_parts
from rvsim.kinematics.workspace.values import SectionMap, Workspace, WorkspaceTask

__all__ = [
    "Grid",
    "SectionMap",
    "Workspace",
    "WorkspaceTask",
    "has_branches",
    "holds_orientation",
    "workspace",
    "workspace_parts",
]
