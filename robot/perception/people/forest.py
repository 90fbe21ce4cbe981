"""A random forest as plain arrays: which shapes are legs. Trained by `benchmarks.people.train`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from robot.perception.people.scan import Array


@dataclass(frozen=True)
class Forest:
    """Decision trees laid end to end; a node without a feature (-1) is a leaf.

    Of node i: `value[i]` is the probability of a leaf; otherwise one goes to node `left[i]` where
    the feature is at most `threshold[i]`, and to `right[i]` where it is above.
    """

    roots: NDArray[np.int32]
    feature: NDArray[np.int16]
    threshold: NDArray[np.float32]
    left: NDArray[np.int32]
    right: NDArray[np.int32]
    value: NDArray[np.float32]

    def probability(self, shapes: Array) -> Array:
        """Of each row of features, shape (n, features), to be a leg: shape (n,)."""
        rows = np.arange(len(shapes))[:, None]
        values = shapes.astype(np.float32)  # as they were when it was trained
        nodes = np.repeat(self.roots[None, :], len(shapes), axis=0)
        while np.any(inner := self.feature[nodes] >= 0):
            below = values[rows, self.feature[nodes]] <= self.threshold[nodes]
            nodes = np.where(inner, np.where(below, self.left[nodes], self.right[nodes]), nodes)
        return self.value[nodes].mean(axis=1, dtype=np.float64)


@cache
def leg_forest() -> Forest:
    """The forest that comes along, trained on synthetic scans alone."""
    file = resources.files("robot.perception.people").joinpath("leg_forest.npz")
    with resources.as_file(file) as path, np.load(path, allow_pickle=False) as arrays:
        return Forest(**{name: arrays[name] for name in Forest.__dataclass_fields__})
