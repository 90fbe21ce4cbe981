"""The colours and floors that a world file can name."""

from __future__ import annotations

import msgspec

Rgb = tuple[float, float, float]

COLORS: dict[str, Rgb] = {
    "red": (0.80, 0.13, 0.11),
    "orange": (0.93, 0.48, 0.12),
    "yellow": (0.95, 0.78, 0.20),
    "green": (0.22, 0.58, 0.30),
    "teal": (0.20, 0.47, 0.50),
    "blue": (0.13, 0.34, 0.75),
    "purple": (0.45, 0.26, 0.62),
    "pink": (0.92, 0.52, 0.62),
    "brown": (0.42, 0.27, 0.17),
    "white": (0.93, 0.93, 0.92),
    "gray": (0.55, 0.56, 0.58),
    "black": (0.10, 0.10, 0.11),
    "cream": (0.90, 0.87, 0.80),
    "charcoal": (0.20, 0.21, 0.23),
    "worktop": (0.36, 0.37, 0.39),
    "steel": (0.70, 0.72, 0.75),
    "oak": (0.74, 0.58, 0.40),
    "walnut": (0.40, 0.27, 0.19),
    "skin": (0.85, 0.66, 0.53),
    "wall": (0.88, 0.87, 0.84),
}


class Floor(msgspec.Struct, frozen=True):
    """A floor covering: two colours in a checker of `tile_m` (along x, along y)."""

    light: Rgb
    dark: Rgb
    tile_m: tuple[float, float]


FLOORS: dict[str, Floor] = {
    "tiles": Floor((0.80, 0.81, 0.82), (0.74, 0.75, 0.77), (0.5, 0.5)),
    "wood": Floor((0.70, 0.55, 0.39), (0.66, 0.51, 0.36), (1.2, 0.14)),
    "carpet": Floor((0.55, 0.57, 0.60), (0.53, 0.55, 0.58), (0.1, 0.1)),
    "concrete": Floor((0.60, 0.60, 0.59), (0.58, 0.58, 0.57), (1.0, 1.0)),
}
