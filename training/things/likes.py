"""Whether a form could be taken for another one, by its outline and its size alone."""

from __future__ import annotations

import math

import numpy as np

from robot.se3 import Array
from sim.things.catalogue import Bent, Closed, Flat, Fruit, Kind, Packet, Vessel

SIZE_LOG = 0.10
"""Sizes that differ by less, in logarithms: things of one kind do by up to 0.06."""
PROFILE = 0.10
"""Mean difference of two outlines of turned things, of the greater of their radii."""
LEVELS = np.linspace(0.02, 0.98, 25)


def are_alike(one: Kind, other: Kind) -> bool:
    """Whether things of one kind may look as things of another do, whatever is printed on them.

    A handle makes no difference: it may be behind. Neither does whether it is open: one sees that
    from above only.
    """
    a, b = one.of, other.of
    if isinstance(a, Vessel | Closed) and isinstance(b, Vessel | Closed):
        return _turned(a.profile_m, b.profile_m)
    if isinstance(a, Fruit) and isinstance(b, Fruit):
        same_colour = bool(set(one.colors) & set(other.colors))
        return same_colour and a.lies == b.lies and _turned(a.profile_m, b.profile_m)
    if isinstance(a, Packet) and isinstance(b, Packet):
        return _near((*sorted(a.size_m[:2]), a.size_m[2]), (*sorted(b.size_m[:2]), b.size_m[2]))
    if isinstance(a, Flat) and isinstance(b, Flat):
        return bool(a.tines) == bool(b.tines) and _near(_box(a), _box(b))
    if isinstance(a, Bent) and isinstance(b, Bent):
        return _near((a.length_m, a.radius_m), (b.length_m, b.radius_m))
    return False


def _turned(a: tuple[tuple[float, float], ...], b: tuple[tuple[float, float], ...]) -> bool:
    first, high = _outline(a)
    second, other = _outline(b)
    if not _near((high,), (other,)):
        return False
    return float(np.abs(first - second).mean()) < PROFILE * max(first.max(), second.max())


def _outline(profile_m: tuple[tuple[float, float], ...]) -> tuple[Array, float]:
    """Radii at levels from the foot to the top [m], and the height."""
    points = np.asarray(profile_m)
    low, high = float(points[:, 1].min()), float(points[:, 1].max())
    rising = np.maximum.accumulate(points[:, 1])
    return np.interp(low + LEVELS * (high - low), rising, points[:, 0]), high - low


def _box(form: Flat) -> tuple[float, float]:
    """Its length, and its greatest width."""
    first, last = form.sections[0].x_m, form.sections[-1].x_m + form.tines_m
    return last - first, max(one.width_m for one in form.sections)


def _near(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return all(abs(math.log(x / y)) < SIZE_LOG for x, y in zip(a, b, strict=True))
