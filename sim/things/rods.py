"""Capsules along a way."""

from __future__ import annotations

import itertools
import math

import numpy as np

from robot.se3 import Array
from sim.things.outlines import turned
from sim.things.thing import Contact


def along(way: Array, radius_m: float) -> list[Contact]:
    """One from each point to the next, shape (n, 3)."""
    return [rod(a, b, radius_m) for a, b in itertools.pairwise(way)]


def rod(start: Array, end: Array, radius_m: float) -> Contact:
    """A capsule between two points."""
    axis = end - start
    length = float(np.linalg.norm(axis))
    yaw, pitch = math.atan2(axis[1], axis[0]), math.acos(float(axis[2]) / length)
    x, y, z = (float(v) for v in 0.5 * (start + end))
    return Contact("capsule", (radius_m, radius_m, 0.5 * length), (x, y, z), turned(yaw, pitch))
