"""What is done with the outline of a turned thing: rounding it, going inside, finding its parts."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.messages import Piece
from robot.se3 import Array, Vector3
from sim.things.thing import Contact, piece

STEEP = 0.22
"""A side whose radius changes by less than this with the height is upright enough for a hand: the
pads' friction is 0.8 and more, its angle is 39 degrees, and both sides lean."""
LEAST_SIDE_M = 0.018
"""Less of a side is not enough for fingers that are 2 cm high."""
ALIKE_M = 0.004
"""Sides whose radii differ by less belong together."""
SHORT_M = 0.006
"""Stretches of a wall that are shorter touch nothing by themselves."""
THIN_M = 0.003
"""Walls that touch are no thinner: what is pressed would go through."""


def rounded(profile: Array, times: int) -> Array:
    """An outline with its corners cut off so often; its ends stay (Chaikin, 1974)."""
    for _ in range(times):
        near, far = profile[:-1], profile[1:]
        cut = np.stack([0.75 * near + 0.25 * far, 0.25 * near + 0.75 * far], axis=1)
        profile = np.concatenate([profile[:1], cut.reshape(-1, 2)[1:-1], profile[-1:]])
    return profile


def inset(profile: Array, wall_m: float) -> Array:
    """An outline so far inside of another that begins on the axis, both shape (n, 2)."""
    ways = np.diff(profile, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    inwards = np.column_stack([-ways[:, 1], ways[:, 0]])
    before, after = np.concatenate([inwards[:1], inwards]), np.concatenate([inwards, inwards[-1:]])
    both = before + after
    length = np.einsum("ij,ij->i", both, both)
    inner = profile + wall_m * 2.0 * both / np.maximum(length, 1.0)[:, None]
    inner[0, 0] = 0.0
    inner[-1, 1] = profile[-1, 1]
    inner[:, 0] = np.maximum(inner[:, 0], 0.0)
    return inner


def above(profile: Array, floor_m: float) -> Array:
    """What of an outline is above a height, from the axis on: the inside of a vessel."""
    high = profile[profile[:, 1] > floor_m + 1e-5]
    high[:, 1] = np.maximum.accumulate(high[:, 1])
    below = profile[profile[:, 1] <= floor_m + 1e-5]
    edge = max(float(below[-1, 0]), 0.2 * float(high[0, 0])) if len(below) else 0.0
    start = [[0.0, floor_m]] + ([[edge, floor_m]] if edge > 1e-4 else [])
    return np.concatenate([start, high])


class Side(NamedTuple):
    """A piece of an outline: its greatest radius, and from where to where it goes."""

    radius_m: float
    low_m: float
    high_m: float
    is_held: bool


def sides(profile: Array) -> list[Side]:
    """The parts of an outline: upright ones of about one radius, which can be held, and others."""
    found: list[Side] = []
    for (r0, z0), (r1, z1) in zip(profile[:-1].tolist(), profile[1:].tolist(), strict=True):
        high = z1 - z0
        if high < 1e-4:
            continue
        is_held = abs(r1 - r0) < STEEP * high
        one = Side(max(r0, r1), z0, z1, is_held)
        last = found[-1] if found else None
        alike = last and abs(last.radius_m - one.radius_m) < ALIKE_M
        if last and last.is_held == is_held and (alike or not is_held):
            found[-1] = Side(max(last.radius_m, one.radius_m), last.low_m, z1, is_held)
        else:
            found.append(one)
    return [
        one._replace(is_held=one.is_held and one.high_m - one.low_m >= LEAST_SIDE_M)
        for one in found
    ]


def pieces(profile: Array) -> tuple[Piece, ...]:
    """The parts as planners have them, in a frame in the middle of the height."""
    middle = 0.5 * float(profile[:, 1].max())
    return tuple(
        piece(
            "cylinder",
            (2 * side.radius_m, 2 * side.radius_m, side.high_m - side.low_m),
            (0.0, 0.0, 0.5 * (side.low_m + side.high_m) - middle),
            is_held=side.is_held,
        )
        for side in sides(profile)
    )


def discs(profile: Array) -> list[Contact]:
    """A stack of upright cylinders, one a stretch of an outline; sloping ones have their mean."""
    found: list[Contact] = []
    for (r0, z0), (r1, z1) in zip(profile[:-1].tolist(), profile[1:].tolist(), strict=True):
        if z1 - z0 > 1e-4:
            radius = max(0.5 * (r0 + r1), 0.001)
            half = 0.5 * (z1 - z0)
            found.append(Contact("cylinder", (radius, radius, half), (0.0, 0.0, z0 + half)))
    return found


def staves(profile: Array, *, wall_m: float, count: int) -> list[Contact]:
    """Boxes side by side around a hollow, like the staves of a barrel, a ring of them a stretch.

    The prism that they make is as wide as the circle, in the mean of its flats and its edges.
    """
    found: list[Contact] = []
    half_turn = math.pi / count
    flat = 2.0 / (1.0 + 1.0 / math.cos(half_turn))
    thick = 0.5 * max(wall_m, THIN_M)
    for (r0, z0), (r1, z1) in zip(profile[:-1].tolist(), profile[1:].tolist(), strict=True):
        length = math.hypot(r1 - r0, z1 - z0)
        if length < SHORT_M:
            continue
        lean = math.atan2(r1 - r0, z1 - z0)
        out, up = math.cos(lean), -math.sin(lean)
        radius = 0.5 * (r0 + r1) * flat - thick * out
        height = 0.5 * (z0 + z1) - thick * up
        wide = max(r0, r1) * flat * math.tan(half_turn)
        for k in range(count):
            turn = (2 * k + 1) * half_turn
            p: Vector3 = (radius * math.cos(turn), radius * math.sin(turn), height)
            found.append(Contact("box", (thick, wide, 0.5 * length), p, turned(turn, lean)))
    return found


def turned(yaw_rad: float, pitch_rad: float) -> tuple[float, float, float, float]:
    """The quaternion of a turn about z after one about y."""
    cy, sy = math.cos(0.5 * yaw_rad), math.sin(0.5 * yaw_rad)
    cp, sp = math.cos(0.5 * pitch_rad), math.sin(0.5 * pitch_rad)
    return (cy * cp, -sy * sp, cy * sp, sy * cp)
