"""One planar scan, as points in the plane of the laser and of the place where it stands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

NEAREST_M = 0.05
"""Whatever is nearer is no return: lasers say so with zero or a small code."""
FARTHEST_M = 1000.0
"""Whatever is farther is none either: no laser scanner in a plane sees that far."""


@dataclass(frozen=True, kw_only=True)
class PlanarScan:
    """Ranges counter-clockwise from a first bearing, in the laser's frame (x ahead, y left).

    `ranges_m` has shape (n,); what is not finite, nearer than `NEAREST_M` or farther than
    `FARTHEST_M` is no return.
    `pose` is the laser's x, y [m] and yaw [rad] in the place; a laser that stands still needs none.
    """

    t_s: float
    ranges_m: Array
    angle_min_rad: float
    angle_step_rad: float
    pose: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @cached_property
    def bearings_rad(self) -> Array:
        """Of each beam, shape (n,)."""
        return self.angle_min_rad + self.angle_step_rad * np.arange(
            len(self.ranges_m), dtype=np.float64
        )

    @cached_property
    def returned(self) -> NDArray[np.intp]:
        """The numbers of the beams that came back."""
        ranges_m = self.ranges_m
        return np.flatnonzero((ranges_m >= NEAREST_M) & (ranges_m <= FARTHEST_M))

    @cached_property
    def points_m(self) -> Array:
        """Where the beams that came back ended, in the laser's frame, shape (returned, 2)."""
        bearings_rad, ranges_m = self.bearings_rad[self.returned], self.ranges_m[self.returned]
        directions = np.column_stack((np.cos(bearings_rad), np.sin(bearings_rad)))
        return ranges_m[:, None] * directions

    def in_place(self, points_m: Array) -> Array:
        """Points of the laser's frame in the frame of the place, shape (n, 2)."""
        x_m, y_m, yaw_rad = self.pose
        cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
        return points_m @ np.array([[cos, sin], [-sin, cos]]) + np.array([x_m, y_m])

    def in_laser(self, points_m: Array) -> Array:
        """Points of the place in the laser's frame, shape (n, 2): the inverse of `in_place`."""
        x_m, y_m, yaw_rad = self.pose
        cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
        return (points_m - np.array([x_m, y_m])) @ np.array([[cos, -sin], [sin, cos]])
