"""Filters of pictures: scipy's, which has no types of its own."""

# pyright: basic

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, special

Floats = NDArray[np.float32]


def steps(values: Floats) -> tuple[Floats, Floats]:
    """The least and the greatest value within 3 x 3 pixels, shapes (h, w)."""
    least, most = ndimage.minimum_filter(values, 3), ndimage.maximum_filter(values, 3)
    return np.asarray(least, np.float32), np.asarray(most, np.float32)


def patches(shape: tuple[int, ...], *, size_px: float, rng: np.random.Generator) -> Floats:
    """Numbers that are evenly spread over 0 to 1, alike among neighbours, shape (h, w)."""
    noise = rng.standard_normal(shape, dtype=np.float32)
    smooth = ndimage.gaussian_filter(noise, size_px / 2, truncate=2.0, mode="wrap")
    return special.ndtr(smooth / max(float(smooth.std()), 1e-9)).astype(np.float32)


def moved(picture: Floats, down_px: float, right_px: float) -> Floats:
    """A picture moved by parts of pixels, its border repeated; shape (h, w, 3)."""
    found = ndimage.shift(picture, (down_px, right_px, 0.0), order=1, mode="nearest")
    return np.asarray(found, np.float32)
