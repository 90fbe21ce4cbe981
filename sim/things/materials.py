"""What things are made of: density, gloss, and how they slide."""

from __future__ import annotations

from typing import NamedTuple


class Material(NamedTuple):
    """A material.

    Attributes:
        density_kg_m3: of the solid, mean of the ranges in handbooks (CRC Handbook, MatWeb).
        gloss: how much of a mirror it is, 0 to 1.
        friction: on wood.
    """

    density_kg_m3: float
    gloss: float
    friction: float


MATERIALS: dict[str, Material] = {
    "porcelain": Material(2400.0, 0.6, 0.45),
    "stoneware": Material(2200.0, 0.5, 0.5),
    "glass": Material(2500.0, 0.9, 0.4),
    "steel": Material(7850.0, 0.8, 0.4),
    "aluminium": Material(2700.0, 0.7, 0.4),
    "plastic": Material(950.0, 0.35, 0.4),
    "paper": Material(750.0, 0.1, 0.5),
    "wood": Material(650.0, 0.15, 0.5),
    "fruit": Material(900.0, 0.25, 0.6),
}
