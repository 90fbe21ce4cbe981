"""What can be seen at a robot's model, and so need not be said of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import msgspec
import mujoco
import numpy as np

from robot.se3 import Array


class Arm(msgspec.Struct, frozen=True):
    """An arm's joints from the shoulder outwards, and the site at its end (none: the last link)."""

    joints: tuple[str, ...]
    tip: str


class Measures(msgspec.Struct, frozen=True):
    """Sizes of a standing robot [m], see `RobotDescription`."""

    shoulder_height_m: float
    shoulder_aside_m: float
    arm_reach_m: float
    body_radius_m: float


def measure(
    model: mujoco.MjModel,
    joints_rad: Mapping[str, float],
    *,
    arms: Sequence[Arm],
    soles: Sequence[str],
) -> Measures:
    """Sizes of a robot that stands with its joints so; lengths of arms are 0 where it has none.

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
        arm_reach_m=min((_length_m(data, arm) for arm in arms), default=0.0),
        body_radius_m=_radius_m(model, data, feet.mean(axis=0)[:2]),
    )


def _length_m(data: mujoco.MjData, arm: Arm) -> float:
    """From the second joint, about which it is lifted, to its end: the links laid end to end."""
    points = [data.joint(name).xanchor for name in arm.joints[1:]]
    points += [data.site(arm.tip).xpos] if arm.tip else []
    return sum(math.dist(a, b) for a, b in pairwise(points))


def _radius_m(model: mujoco.MjModel, data: mujoco.MjData, middle: Array) -> float:
    """Of the circle about a point of the floor that holds all that can touch something."""
    return max(
        float(np.linalg.norm(_corners(model, data, geom)[:, :2] - middle, axis=1).max())
        for geom in range(model.ngeom)
        if model.geom_contype[geom] or model.geom_conaffinity[geom]
    )


def _corners(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> Array:
    """Points around a geom, shape (n, 3): the vertices of a mesh, the corners of its box else."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        points = model.mesh_vert[first : first + count]
    else:
        centre, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
        signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        points = centre + signs * half
    return points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
