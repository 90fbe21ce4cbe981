"""Everything a plan keeps clear of, as a flat list of boxes and cylinders in the world."""

from __future__ import annotations

from typing import Literal

import msgspec
import numpy as np

from robot.messages import Piece, Shape
from robot.planning.requests import Surroundings
from robot.se3 import SE3, Array

PIECE = "/"
"""Between the id of a thing and the number of its piece."""
PERSON_HEIGHT_M = 1.8
"""Of a person who stands, as an obstacle."""


class Solid(msgspec.Struct, frozen=True, kw_only=True):
    """A primitive at X_WG (its own frame, in its middle); `size_m` as in `messages.Shape`."""

    id: str
    kind: Literal["box", "cylinder"]
    size_m: tuple[float, float, float]
    X_WG: SE3

    def half_extents_m(self) -> Array:
        """Half of its extent along the world's axes, shape (3,) [m]."""
        return np.abs(self.X_WG.rotation()) @ (0.5 * np.array(self.size_m))

    def z_range_m(self) -> tuple[float, float]:
        """Lowest and highest height [m]."""
        half = float(self.half_extents_m()[2])
        return self.X_WG.p[2] - half, self.X_WG.p[2] + half


def solids_of(around: Surroundings) -> tuple[Solid, ...]:
    """All solids but the ignored, in a fixed order."""
    found: list[Solid] = []
    for obstacle in (*around.map.obstacles, *around.unmapped):
        if obstacle.id not in around.ignored:
            found += [solid(obstacle.id, obstacle.X_WO, shape) for shape in obstacle.shapes]
    for person in around.map.people:
        if person.id not in around.ignored:
            x, y, _ = person.X_WO.p
            at = SE3((x, y, 0.5 * PERSON_HEIGHT_M))
            size = (2 * person.radius_m, 2 * person.radius_m, PERSON_HEIGHT_M)
            found.append(Solid(id=person.id, kind="cylinder", size_m=size, X_WG=at))
    for thing in around.objects:
        if thing.id not in around.ignored:
            found.append(solid(thing.id, thing.X_WO, thing.shape))
            X_WS = thing.X_WO @ thing.shape.X_BodyShape
            found += [solid_piece(thing.id, X_WS, one) for one in thing.shape.sticking_out]
    return tuple(found)


def people_of(around: Surroundings) -> Array:
    """Circles (x, y, radius) that people stand in [m], but for the ignored, shape (n, 3)."""
    people = [person for person in around.map.people if person.id not in around.ignored]
    circles = [(*person.X_WO.p[:2], person.radius_m) for person in people]
    return np.array(circles, dtype=np.float64).reshape(-1, 3)


def solid_piece(id: str, X_WS: SE3, piece: Piece) -> Solid:
    """A piece of a shape at X_WS."""
    return Solid(id=id, kind=piece.kind, size_m=piece.size_m, X_WG=X_WS @ piece.X_ShapePiece)


def grasped(id: str, shape: Shape) -> tuple[Solid, ...]:
    """What a hand closes on, in the shape's frame; each piece has an id of its own (`piece_id`)."""
    if not shape.pieces:
        return (Solid(id=id, kind=shape.kind, size_m=shape.size_m, X_WG=SE3()),)
    return tuple(
        solid_piece(piece_id(id, number), SE3(), piece) for number, piece in enumerate(shape.pieces)
    )


def piece_id(id: str, number: int | None) -> str:
    """The id of a piece of a thing (None: of the thing)."""
    return id if number is None else f"{id}{PIECE}{number}"


def solid(id: str, X_WO: SE3, shape: Shape) -> Solid:
    """A shape of a body standing at X_WO."""
    return Solid(id=id, kind=shape.kind, size_m=shape.size_m, X_WG=X_WO @ shape.X_BodyShape)
