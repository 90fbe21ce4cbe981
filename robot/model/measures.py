"""What can be seen at a robot's model, and so need not be said of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import msgspec
import mujoco
import numpy as np

from robot.se3 import Array, quat_to_matrix

SMALL_M = 1e-6


class Arm(msgspec.Struct, frozen=True):
    """An arm's joints from the shoulder outwards, and the site at its end.

    Without a site it ends where its last link does (`far_end`).
    """

    joints: tuple[str, ...]
    tip: str


class Measures(msgspec.Struct, frozen=True):
    """Sizes of a standing robot, see `RobotDescription`."""

    shoulder_height_m: float
    shoulder_aside_m: float
    arm_reach_m: float
    body_radius_m: float
    neck_rad: float


def measure(
    model: mujoco.MjModel,
    joints_rad: Mapping[str, float],
    *,
    arms: Sequence[Arm],
    soles: Sequence[str],
    neck: str = "",
) -> Measures:
    """Sizes of a robot that stands with its joints so; lengths of arms are 0 where it has none.

    `neck` is the joint that turns its head to a side.

    Raises:
        KeyError: if a joint or a site is not in the model.
    """
    data = mujoco.MjData(model)
    for name, value in joints_rad.items():
        data.qpos[model.joint(name).qposadr[0]] = value
    mujoco.mj_kinematics(model, data)
    feet = np.array([data.site(sole).xpos for sole in soles])
    anchors = [data.joint(arm.joints[:2][-1]).xanchor for arm in arms] or [np.zeros(3)]
    shoulders = np.abs(np.array(anchors) - feet.min(axis=0) * (0.0, 0.0, 1.0)).mean(axis=0)
    return Measures(
        shoulder_height_m=float(shoulders[2]),
        shoulder_aside_m=float(shoulders[1]),
        arm_reach_m=min((_length_m(model, data, arm) for arm in arms), default=0.0),
        body_radius_m=_radius_m(model, data, feet.mean(axis=0)[:2]),
        neck_rad=float(np.abs(model.joint(neck).range).min()) if neck else 0.0,
    )


def far_end(model: mujoco.MjModel, link: int) -> Array:
    """Where a link ends that nothing hangs on, in its own frame [m], shape (3,).

    On the line from its origin through its centre of mass, as far out as its geoms go.
    """
    at = model.body_ipos[link]
    length = float(np.linalg.norm(at))
    if length < SMALL_M:
        return np.zeros(3)
    along = at / length
    first, count = int(model.body_geomadr[link]), int(model.body_geomnum[link])
    ends = [float((_own_corners(model, k) @ along).max()) for k in range(first, first + count)]
    return along * max([length, *ends])


def _length_m(model: mujoco.MjModel, data: mujoco.MjData, arm: Arm) -> float:
    """From the second joint, about which it is lifted, to its end: the links laid end to end."""
    points = [data.joint(name).xanchor for name in arm.joints[1:]]
    if arm.tip:
        points += [data.site(arm.tip).xpos]
    elif points:
        link = int(model.jnt_bodyid[model.joint(arm.joints[-1]).id])
        rotation = data.xmat[link].reshape(3, 3)
        points += [rotation @ far_end(model, link) + data.xpos[link]]
    return sum(math.dist(a, b) for a, b in pairwise(points))


def _radius_m(model: mujoco.MjModel, data: mujoco.MjData, middle: Array) -> float:
    """Of the circle about a point of the floor that holds all that can touch something."""
    return max(
        float(np.linalg.norm(_corners(model, data, geom)[:, :2] - middle, axis=1).max())
        for geom in range(model.ngeom)
        if model.geom_contype[geom] or model.geom_conaffinity[geom]
    )


def _corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Points around a geom in the world, shape (n, 3)."""
    rotation, p = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    return _points(model, geom) @ rotation.T + p


def _own_corners(model: mujoco.MjModel, geom: int) -> Array:
    """The same in the frame of its link."""
    w, x, y, z = model.geom_quat[geom].tolist()
    rotation = quat_to_matrix((w, x, y, z))
    return _points(model, geom) @ rotation.T + model.geom_pos[geom]


def _points(model: mujoco.MjModel, geom: int) -> Array:
    """The same in its own frame: the vertices of a mesh, the corners of its box else."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        return np.asarray(model.mesh_vert[first : first + count], dtype=np.float64)
    centre, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return centre + signs * half
