"""The orientation a 5R arm can have that is nearest to the wanted one, at the same place of the tool.

The tool axis a must lie in the vertical plane through the base axis and the tool. The smallest rotation that brings
it there turns a into its projection a_p onto the plane, by asin|n·a| about a × a_p; n is the plane's normal.
"""

from __future__ import annotations

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.inverse.chain import TOLERANCE, Chain
from rvsim.language import tr
from rvsim.spatial import rot_z
from rvsim.spatial.arrays import FloatArray


def nearest_orientation(chain: Chain, T: FloatArray) -> FloatArray:
    """T_base_tool (m, 4, 4) with each orientation turned as little as the arm needs, each place kept.

    Raises:
        NoClosedFormError: the tool tip lies beside the roll axis.
    """
    require_tip_on_roll_axis(chain)
    T_0_tool = chain.T_0_base @ T
    axis = T_0_tool[:, :3, :3] @ chain.T_tool_n[:3, 2]
    turned = rotation_onto(axis, _projected(axis, _plane_normals(T_0_tool[:, :3, 3], axis)))
    result = T_0_tool.copy()
    result[:, :3, :3] = turned @ T_0_tool[:, :3, :3]
    return np.asarray(chain.T_base_0 @ result)


def turned_about_vertical(chain: Chain, T: FloatArray) -> FloatArray:
    """T_base_tool (m, 4, 4) turned about the base axis, in place, until feasible: place, pitch and roll are kept.

    Raises:
        NoClosedFormError: the tool tip lies beside the roll axis.
    """
    require_tip_on_roll_axis(chain)
    T_0_tool = chain.T_0_base @ T
    (x, y, _), (ax, ay, _) = T_0_tool[:, :3, 3].T, (T_0_tool[:, :3, :3] @ chain.T_tool_n[:3, 2]).T
    turn = np.arctan2(ax * y - ay * x, ax * x + ay * y)
    turn -= np.pi * np.rint(turn / np.pi)  # outwards or back to the base, whichever is nearer
    turn[(np.hypot(x, y) <= TOLERANCE) | (np.hypot(ax, ay) <= TOLERANCE)] = 0.0
    result = T_0_tool.copy()
    result[:, :3, :3] = rot_z(turn) @ T_0_tool[:, :3, :3]
    return np.asarray(chain.T_base_0 @ result)


def rotation_onto(start: FloatArray, end: FloatArray) -> FloatArray:
    """The smallest rotation (m, 3, 3) of unit vectors (m, 3) at most 90° apart: 1 + [v] + [v]²/(1 + c), v = s × e."""
    v = np.cross(start, end)
    cosine = np.einsum("mi,mi->m", start, end)
    cross = np.zeros((len(v), 3, 3))
    cross[:, 0, 1], cross[:, 0, 2], cross[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    cross -= cross.transpose(0, 2, 1).copy()
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + cosine)[:, None, None])


def has_tip_on_roll_axis(chain: Chain) -> bool:
    """Whether turning the roll joint leaves the tool tip in its place."""
    return bool(np.abs(chain.T_n_tool[:2, 3]).max() <= TOLERANCE)


def require_tip_on_roll_axis(chain: Chain) -> None:
    """Raises NoClosedFormError for a tool tip beside the roll axis."""
    if not has_tip_on_roll_axis(chain):
        raise NoClosedFormError(chain.robot.name, tr("the tool tip must lie on the roll axis to keep its place."))


def _plane_normals(p: FloatArray, axis: FloatArray) -> FloatArray:
    """Unit normals (m, 3) of the vertical planes through p; on the base axis any plane will do: the tool's own."""
    on_axis = np.hypot(p[:, 0], p[:, 1]) <= TOLERANCE
    towards = np.where(on_axis[:, None], axis, p) * (1.0, 1.0, 0.0)
    towards[np.linalg.norm(towards, axis=-1) <= TOLERANCE] = (1.0, 0.0, 0.0)
    normal = np.stack([towards[:, 1], -towards[:, 0], np.zeros(len(p))], axis=-1)
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True))


def _rejected(vector: FloatArray, normal: FloatArray) -> FloatArray:
    return np.asarray(vector - np.einsum("mi,mi->m", vector, normal)[:, None] * normal)


def _projected(axis: FloatArray, normal: FloatArray) -> FloatArray:
    """The axis within the plane, as a unit vector; one square to the plane is as near to every direction: downwards."""
    inside = _rejected(axis, normal)
    norm = np.linalg.norm(inside, axis=-1, keepdims=True)
    down = np.array([0.0, 0.0, -1.0])
    return np.where(norm <= TOLERANCE, down, inside / np.where(norm == 0.0, 1.0, norm))
