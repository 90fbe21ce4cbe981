"""Ways over the floor that keep away from things where there is room, and go through where not.

The way of least cost on a grid (Dijkstra): a metre costs the more, the nearer things are than what
is wanted, so a doorway is passed in its middle, a gap between chairs is taken only if the way round
is long, and everywhere else the way keeps what is wanted. Then the grid's corners are pulled out of
it wherever a straight line costs no more.
"""

from __future__ import annotations

import math

import numpy as np

from robot.planning import numerics
from robot.planning.floor import Floor
from robot.planning.floor_field import CELL_M
from robot.se3 import Array

STRIDE = 2
"""Cells between nodes of the grid: a doorway of 0.8 m leaves 4 nodes beside each other."""
TIGHT_COST = 12.0
"""What a metre costs more where things are as near as can be. To squeeze between chairs is worth
a detour of 2 to 4 m; through a doorway of 0.8 m, in its middle, one of 0.1 m."""
AROUND_NODES = 250
"""So far around the start is searched first, 20 m: a home as a whole, and not all of a factory."""
CHEAP_ENOUGH = 1.02
"""A straight line may cost 2 % more than what it stands for: the grid is off by up to 4 %."""


class FloorWays:
    """Ways from one point, over a floor."""

    def __init__(self, floor: Floor, start: Array, *, least_m: float, wanted_m: float) -> None:
        """Search from `start`, shape (2,) [m], over all that is at least `least_m` clear.

        Args:
            floor: to walk on.
            start: where the ways begin.
            least_m: what has to be clear.
            wanted_m: what should be.
        """
        self._floor, self._least_m, self._wanted_m = floor, least_m, wanted_m
        self._start = start
        height, width = floor.field.shape
        self._shape = (-(-height // STRIDE), -(-width // STRIDE))
        self._from = self._node(start)
        self._search(AROUND_NODES)

    def cost(self, goal: Array) -> float:
        """What the way to a point costs [m of free floor]; infinite where there is none."""
        return self._cost_to(self._node(goal)) * STRIDE * CELL_M

    def _cost_to(self, node: tuple[int, int]) -> float:
        """What the way to a node costs [lengths of a grid's edge]; searches farther off if it must.

        No length costs less than one, so no way that leaves what was searched costs less than it
        is to its edge.
        """
        while True:
            (top, left), (rows, columns) = self._corner, self._costs.shape
            row, column = node[0] - top, node[1] - left
            inside = 0 <= row < rows and 0 <= column < columns
            found = float(self._costs[row, column]) if inside else math.inf
            if found <= self._around or not self._leads_on:
                return found
            self._search(2 * self._around)

    def _search(self, around: int) -> None:
        """Find the ways to all nodes that are no more rows and columns from the start than that."""
        spans = [
            (max(0, at - around), min(size, at + around + 1))
            for at, size in zip(self._from, self._shape, strict=True)
        ]
        (top, bottom), (left, right) = spans
        field = self._floor.field[
            STRIDE * top : STRIDE * (bottom - 1) + 1, STRIDE * left : STRIDE * (right - 1) + 1
        ]
        cost = np.where(field >= self._least_m, self._cost(field), np.inf)
        start = (self._from[0] - top, self._from[1] - left)
        self._costs, self._before = numerics.cheapest_ways(cost, STRIDE, start)
        self._around, self._corner = around, (top, left)
        beyond = [
            costs
            for costs, is_edge in (
                (self._costs[0], top == 0),
                (self._costs[-1], bottom == self._shape[0]),
                (self._costs[:, 0], left == 0),
                (self._costs[:, -1], right == self._shape[1]),
            )
            if not is_edge
        ]
        self._leads_on = any(bool(np.isfinite(costs).any()) for costs in beyond)

    def corners(self, goal: Array) -> Array | None:
        """Corners of the way to a point, both ends included, shape (k, 2); None: there is none."""
        if self._clear((self._start, goal), self._wanted_m):
            return np.array([self._start, goal])
        if not math.isfinite(self.cost(goal)):
            return None
        (top, left), columns = self._corner, self._costs.shape[1]
        row, column = self._node(goal)
        nodes = [(row - top, column - left)]
        while nodes[-1] != (self._from[0] - top, self._from[1] - left):
            index = int(self._before[nodes[-1]])
            nodes.append((index // columns, index % columns))
        way = [(row + top, column + left) for row, column in reversed(nodes)]
        points = self._floor.points(np.array(way) * STRIDE)
        return self._pulled_tight(np.concatenate([[self._start], points[1:-1], [goal]]))

    def _pulled_tight(self, points: Array) -> Array:
        """Leave points out as long as the straight line instead of them costs no more."""
        legs = self._line_costs(points[:-1], points[1:])
        along = np.concatenate([[0.0], np.cumsum(legs)])
        kept, at = [0], 0
        while at < len(points) - 1:
            ahead = np.arange(at + 1, len(points))
            straight = self._line_costs(
                np.repeat(points[at : at + 1], len(ahead), 0), points[ahead]
            )
            fine = straight <= CHEAP_ENOUGH * (along[ahead] - along[at]) + 1e-9
            at = int(ahead[fine][-1]) if fine.any() else at + 1
            kept.append(at)
        return points[kept]

    def _line_costs(self, a: Array, b: Array) -> Array:
        """What straight lines cost, shapes (n, 2) to (n,); infinite where one is not free."""
        lengths = np.linalg.norm(b - a, axis=1)
        count = max(2, math.ceil(float(lengths.max()) / (0.5 * CELL_M)) + 1)
        share = numerics.even(0.0, 1.0, count)[:, None, None]
        clearances = self._floor.clearances_m(((1 - share) * a + share * b).reshape(-1, 2))
        clearances = clearances.reshape(count, -1)
        # Ends of the way may stand a little nearer than the cells around them.
        free = clearances.min(axis=0) >= self._least_m - 0.5 * CELL_M
        return np.where(free, lengths * self._cost(clearances).mean(axis=0), np.inf)

    def _clear(self, line: tuple[Array, Array], clearance_m: float) -> bool:
        a, b = line
        return self._floor.segment_clearance_m(tuple(a), tuple(b)) >= clearance_m

    def _cost(self, clearances_m: Array) -> Array:
        """What a metre costs where so much is clear."""
        short = (self._wanted_m - clearances_m) / max(self._wanted_m - self._least_m, 1e-9)
        return 1.0 + TIGHT_COST * np.clip(short, 0.0, 1.0) ** 2

    def _node(self, point: Array) -> tuple[int, int]:
        """Row and column of the nearest node that can be walked on, or of the nearest at all."""
        row, column = (round(float(at)) for at in self._floor.row_column(point) / STRIDE)
        rows, columns = (np.clip(np.arange(at - 1, at + 2), 0, size - 1)
                         for at, size in zip((row, column), self._shape, strict=True))  # fmt: skip
        around = [(int(r), int(c)) for r in rows for c in columns]
        at = self._floor.points(np.array(around) * STRIDE)
        far = np.linalg.norm(at - point, axis=1)
        free = self._floor.clearances_m(at) >= self._least_m
        return around[int(np.argmin(far + np.where(free, 0.0, 1e3)))]
