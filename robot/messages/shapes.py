"""Forms of things: a primitive, and the pieces of it that are known more exactly."""

from __future__ import annotations

import math
from typing import Literal

import msgspec

from robot.se3 import SE3, Vector3


class Piece(msgspec.Struct, frozen=True, kw_only=True):
    """A part of a shape, sized as one; `is_held`: a hand may close on it."""

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    X_ShapePiece: SE3 = SE3()
    is_held: bool = True

    @property
    def radius_m(self) -> float:
        """From the shape's axis to what of the piece is furthest away, as it is not turned."""
        x, y, _ = self.X_ShapePiece.p
        if self.kind == "cylinder":
            return math.hypot(x, y) + 0.5 * self.size_m[0]
        return math.hypot(abs(x) + 0.5 * self.size_m[0], abs(y) + 0.5 * self.size_m[1])


INSIDE_M = 0.002
"""What reaches no further out of a shape does not stick out of it."""


class Shape(msgspec.Struct, frozen=True, kw_only=True):
    """A primitive: `size_m` is (x, y, z) of a box, (diameter, diameter, height) of a cylinder.

    `pieces` are its form where that is known more exactly: neck and belly of a bottle, a cup's
    handle, which sticks out of the primitive. Its foot and its top are the primitive's.
    """

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    X_BodyShape: SE3 = SE3()
    pieces: tuple[Piece, ...] = ()

    @property
    def held_pieces(self) -> tuple[Piece, ...]:
        """What a hand may close on: all of it, where its form is not known."""
        whole = Piece(kind=self.kind, size_m=self.size_m)
        return tuple(piece for piece in self.pieces or (whole,) if piece.is_held)

    @property
    def sticking_out(self) -> tuple[Piece, ...]:
        """Pieces that are not inside the primitive."""
        x, y, _ = self.size_m
        return tuple(
            piece
            for piece in self.pieces
            if abs(piece.X_ShapePiece.p[0]) + 0.5 * piece.size_m[0] > 0.5 * x + INSIDE_M
            or abs(piece.X_ShapePiece.p[1]) + 0.5 * piece.size_m[1] > 0.5 * y + INSIDE_M
        )

    @property
    def is_round(self) -> bool:
        """Whether it is the same from all sides."""
        upright = (
            piece.kind == "cylinder" and piece.X_ShapePiece.p[:2] == (0.0, 0.0)
            for piece in self.pieces
        )
        return self.kind == "cylinder" and all(upright)

    @property
    def radius_m(self) -> float:
        """Of the upright cylinder about its axis that holds all of it."""
        x, y, _ = self.size_m
        own = 0.5 * x if self.kind == "cylinder" else 0.5 * math.hypot(x, y)
        reaches = [piece.radius_m for piece in self.pieces]
        return max([own, *reaches])
