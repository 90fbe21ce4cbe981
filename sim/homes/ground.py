"""The floor of a home as a grid: how far everything is, where somebody gets to, and how long."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from robot.planning import numerics
from robot.planning.numerics import Indices, Mask
from robot.se3 import Array
from sim import atlas
from sim.footprint import Footprint, Point
from sim.homes import ways
from sim.world_schema import World

CELL_M = 0.05
FAR_M = 1.0
"""Distances are known up to here."""
WAY_M = 0.80
"""The narrowest way that a home has to have to everything: its narrowest door."""
HALF_WAY_M = WAY_M / 2 - CELL_M
"""The middle of the narrowest door lies up to a cell beside the grid's nearest points."""


class Ground:
    """Distance of the floor's points to furniture and walls, and the largest part of it in one.

    Attributes:
        clearance_m: distance to what stands nearest, `FAR_M` at most, shape (nx, ny).
        home: cells of that part, where ways are `WAY_M` wide at least, (nx, ny).
        room: index of the room that a cell lies in, -1 for none, (nx, ny).
    """

    def __init__(self, world: World) -> None:
        """Measure everything once."""
        x_min, y_min, x_max, y_max = world.bounds_m
        self._low = np.array((x_min, y_min))
        self._shape = (
            math.ceil((x_max - x_min) / CELL_M) + 1,
            math.ceil((y_max - y_min) / CELL_M) + 1,
        )
        self.room = np.full(self._shape, -1)
        for index, room in enumerate(world.rooms):
            self._mark(atlas.room_footprint(room), index)
        self.clearance_m = np.full(self._shape, FAR_M)
        for footprint in outlines(world):
            self._keep_off(footprint)
        self.home = _largest(self.clearance_m >= HALF_WAY_M)
        self._lengths: dict[tuple[int, int], Array] = {}

    def keep_from(self, points: Sequence[Point], distance_m: float) -> None:
        """Take the floor around points out of the home, and what is cut off by that."""
        x, y = self._coordinates()
        for point in points:
            self.home &= np.hypot(x - point[0], y - point[1]) >= distance_m
        self.home = _largest(self.home)
        self._lengths.clear()

    def cell(self, point: Point) -> tuple[int, int]:
        """The grid's point nearest to one of the floor."""
        i, j = np.rint((np.array(point) - self._low) / CELL_M).astype(int).tolist()
        return min(max(i, 0), self._shape[0] - 1), min(max(j, 0), self._shape[1] - 1)

    def points(self, cells: Indices) -> Array:
        """Points of the floor, shape (n, 2), of cells, shape (n, 2)."""
        return self._low + CELL_M * cells.astype(np.float64)

    def within(self, footprint: Footprint, distance_m: float) -> Array:
        """Points of the home that near to the middle of a footprint, in its room, (n, 2)."""
        x, y = self._coordinates()
        near = np.hypot(x - footprint.middle[0], y - footprint.middle[1]) <= distance_m
        own = self.room == self.room[self.cell(footprint.middle)]
        return self.points(np.argwhere(self.home & near & own))

    def walk_m(self, start: Point, goal: Point) -> float:
        """Length of the shortest way between two cells of the home, infinite if there is none."""
        cell = self.cell(start)
        if cell not in self._lengths:
            self._lengths[cell] = CELL_M * ways.lengths(self.home, cell)
        return float(self._lengths[cell][self.cell(goal)])

    def _coordinates(self) -> tuple[Array, Array]:
        i, j = np.mgrid[0 : self._shape[0], 0 : self._shape[1]]
        return self._low[0] + CELL_M * i, self._low[1] + CELL_M * j

    def _mark(self, footprint: Footprint, index: int) -> None:
        x_min, y_min, x_max, y_max = footprint.box_m
        (i, j), (k, m) = self.cell((x_min, y_min)), self.cell((x_max, y_max))
        self.room[i : k + 1, j : m + 1] = index

    def _keep_off(self, footprint: Footprint) -> None:
        x_min, y_min, x_max, y_max = footprint.box_m
        i, j = self.cell((x_min - FAR_M, y_min - FAR_M))
        k, m = self.cell((x_max + FAR_M, y_max + FAR_M))
        rows, columns = np.mgrid[i : k + 1, j : m + 1]
        x = self._low[0] + CELL_M * rows - footprint.middle[0]
        y = self._low[1] + CELL_M * columns - footprint.middle[1]
        c, s = math.cos(footprint.yaw_rad), math.sin(footprint.yaw_rad)
        u = np.abs(c * x + s * y) - footprint.half_m[0]
        v = np.abs(c * y - s * x) - footprint.half_m[1]
        outside: Array = np.hypot(np.maximum(u, 0.0), np.maximum(v, 0.0))
        inside: Array = np.minimum(np.maximum(u, v), 0.0)
        here = self.clearance_m[i : k + 1, j : m + 1]
        np.minimum(here, outside + inside, out=here)


def outlines(world: World) -> list[Footprint]:
    """What stands on the floor: furniture, and every piece of wall."""
    found = [atlas.footprint(item) for item in world.furniture]
    for room in world.rooms:
        for wall in atlas.walls(room):
            for shape in wall.shapes:
                x, y, _ = wall.X_WO.apply(shape.X_BodyShape.p)
                found.append(
                    Footprint((float(x), float(y)), (shape.size_m[0] / 2, shape.size_m[1] / 2))
                )
    return found


def _largest(mask: Mask) -> Mask:
    """The largest connected part of a mask."""
    labels = numerics.regions(mask)
    counts = np.bincount(labels.ravel())
    counts[0] = 0
    best = int(np.argmax(counts))
    return (labels == best) & mask
