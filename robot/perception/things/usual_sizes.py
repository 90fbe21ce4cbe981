"""How large things of a kind are: what is of another size is of no kind, however much it looks so.

A tin of coffee looks as a tin of beans does, and is a quarter larger. The namer tells of the size
of a thing apart from what that is, and errs in it by some percent.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.se3 import Array, Vector3

SPREAD = 0.1
"""1 sigma of the namer's errors of the three sizes together, in logarithms."""


class UsualSizes(NamedTuple):
    """Sizes of kinds, in the order of the namer's classes.

    Attributes:
        middle: logarithms of the longer side, the shorter one and the height [m], shape (n, 3);
            nan of what has no size.
        reach: how far those of one kind are off that at most, likewise.
    """

    middle: Array
    reach: Array

    def weighed(self, chances: Array, size_m: Vector3, unknown: int) -> Array:
        """Probabilities of classes, with how well a size fits; what does not, is of no kind.

        Args:
            chances: by looks, shape (n,).
            size_m: longer side, shorter side, height.
            unknown: the class of what is of no kind.
        """
        off = np.abs(np.log(np.array(size_m)) - self.middle) - self.reach
        squares = (np.maximum(off, 0.0) ** 2).sum(axis=1)
        fits = np.where(np.isnan(squares), 1.0, np.exp(-0.5 * squares / SPREAD**2))
        weighed = chances * fits
        weighed[unknown] += float(chances.sum() - weighed.sum())
        return weighed


def written(sizes: dict[str, tuple[Vector3, Vector3]]) -> str:
    """A line for a network's notes: of each kind its sizes [m], and by which share they vary."""
    return ";".join(
        f"{kind}:" + ",".join(f"{one:.4f}" for one in (*size_m, *vary))
        for kind, (size_m, vary) in sizes.items()
    )


def read(line: str, names: tuple[str, ...]) -> UsualSizes:
    """What `written` wrote, for classes of such names; of others no size is known."""
    told = dict(part.split(":") for part in line.split(";") if part)
    middle, reach = (np.full((len(names), 3), math.nan) for _ in range(2))
    for row, name in enumerate(names):
        if name in told:
            numbers = np.array([float(one) for one in told[name].split(",")])
            middle[row], reach[row] = np.log(numbers[:3]), np.log1p(numbers[3:])
    return UsualSizes(middle, reach)
