"""What hides what: lines of sight from eyes to points, cut by the solids of a map."""

from __future__ import annotations

import numpy as np

from robot.planning.numerics import Indices, Mask
from robot.planning.solids import Solid
from robot.se3 import Array

SHRUNK_M = 0.005
"""Solids are taken to be so much smaller: a line along a board's edge is not cut by it."""
ROUND = 0.85
"""Side of the upright box that a cylinder counts as, by its diameter: between in and around it."""


class Screens:
    """Solids that stand in the way of eyes, as boxes with axes of their own."""

    def __init__(self, solids: tuple[Solid, ...], *, on_m: float | None = None) -> None:
        """Take them as they stand.

        Args:
            solids: what hides.
            on_m: what a point is in, or so near to, does not hide it: that is seen standing there.
        """
        self._on_m = on_m
        count = len(solids)
        self._centres = np.array([s.X_WG.p for s in solids]).reshape(count, 3)
        self._axes = np.array([s.X_WG.rotation() for s in solids]).reshape(count, 3, 3)
        half = np.array([0.5 * np.array(s.size_m) for s in solids]).reshape(count, 3)
        rounded = np.array([s.kind == "cylinder" for s in solids], dtype=bool)
        half[rounded, :2] *= ROUND
        self._half = np.maximum(half - SHRUNK_M, 1e-4)
        self._reach = np.linalg.norm(half, axis=1)

    def in_sight(self, p_W: Array, eyes_W: Array) -> Mask:
        """From which eyes, shape (n, 3), a point is seen with nothing between, shape (n,)."""
        if not len(eyes_W):
            return np.zeros(0, dtype=bool)
        lines = eyes_W - p_W
        far = float(np.linalg.norm(lines, axis=1).max())
        near = self._near(p_W, far)
        if not len(near):
            return np.ones(len(eyes_W), dtype=bool)
        axes, half = self._axes[near], self._half[near][:, None, :]
        begin = np.einsum("kji,kj->ki", axes, p_W - self._centres[near])[:, None, :]
        along = np.einsum("kji,nj->kni", axes, lines)
        along = np.where(np.abs(along) < 1e-9, 1e-9, along)
        low, high = (-half - begin) / along, (half - begin) / along
        enters = np.minimum(low, high).max(axis=2)
        leaves = np.maximum(low, high).min(axis=2)
        cut = (enters < leaves) & (leaves > 0.0) & (enters < 1.0)
        if self._on_m is not None:
            cut &= (np.abs(begin) > half + self._on_m).any(axis=2)
        return ~cut.any(axis=0)

    def _near(self, p_W: Array, far_m: float) -> Indices:
        """Rows of the solids that any part of is so near to a point.

        A wall's middle says little of that: in a home of 12 rooms this leaves a fifth of what its
        middle and its size leave.
        """
        rows = np.flatnonzero(np.linalg.norm(self._centres - p_W, axis=1) < far_m + self._reach)
        at = np.einsum("kji,kj->ki", self._axes[rows], p_W - self._centres[rows])
        beyond = np.maximum(np.abs(at) - self._half[rows], 0.0)
        return rows[np.linalg.norm(beyond, axis=1) <= far_m]
