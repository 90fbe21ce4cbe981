"""Worlds: shipped or written by people, read from YAML, and what follows from them."""

from __future__ import annotations

import math

from robot.se3 import SE3
from sim.schema import Room, World


def empty() -> World:
    """A bare floor of 20 by 20 m, the robot in its middle."""
    return World(name="empty", rooms=(Room(id="hall", at_m=(0.0, 0.0), size_m=(20.0, 20.0)),))


def start_pose(world: World) -> SE3:
    """X_WS where the robot's stance begins."""
    return SE3.from_xy_yaw(*world.start.at_m, math.radians(world.start.yaw_deg))
