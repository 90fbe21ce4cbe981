"""A thing as it was made: how it looks, what touches, what it weighs, where a hand can close."""

from __future__ import annotations

from typing import Literal, NamedTuple

from robot.messages import Piece
from robot.se3 import SE3, Vector3
from sim.forms.mesh import Matter, Mesh
from sim.things.prints import Picture

IDENTITY = (1.0, 0.0, 0.0, 0.0)


class Look(NamedTuple):
    """A part that is seen: its form, its colour, and the picture that is wrapped around it."""

    mesh: Mesh
    color: str
    picture: Picture | None = None


class Contact(NamedTuple):
    """A convex part that touches, as MuJoCo has its sizes (half extents), in the thing's frame."""

    kind: Literal["box", "cylinder", "capsule", "ellipsoid"]
    half_m: Vector3
    p: Vector3
    quat_wxyz: tuple[float, float, float, float] = IDENTITY


class Made(NamedTuple):
    """What a form comes to; its frame stands in the middle of its foot, z up.

    Attributes:
        looks, contacts: its parts.
        size_m: of the upright cylinder or box around all but what sticks out.
        matter: of its walls; `hollow`: of what would fill it, at 1 kg/m³.
        pieces: its form as planners have it: what a hand closes on and what it keeps off; empty:
            the shape alone.
    """

    looks: tuple[Look, ...]
    contacts: tuple[Contact, ...]
    shape: Literal["box", "cylinder"]
    size_m: Vector3
    matter: Matter
    hollow: Matter
    pieces: tuple[Piece, ...] = ()


class Thing(NamedTuple):
    """One thing of a kind; its frame O is in the middle of its shape.

    Attributes:
        name: unlike that of every other thing that is made, for meshes to be shared.
        rolls: whether it is round anywhere that it may lie on.
        radius_m: of the circle around all of it, seen from above.
    """

    name: str
    category: str
    color: str
    material: str
    shape: Literal["box", "cylinder"]
    size_m: Vector3
    looks: tuple[Look, ...]
    contacts: tuple[Contact, ...]
    pieces: tuple[Piece, ...]
    matter: Matter
    radius_m: float

    @property
    def mass_kg(self) -> float:
        """Of all of it, with what is in it."""
        return self.matter.mass_kg


def piece(
    kind: Literal["box", "cylinder"], size_m: Vector3, p: Vector3, *, is_held: bool = True
) -> Piece:
    """A piece for planners."""
    return Piece(kind=kind, size_m=size_m, X_ShapePiece=SE3(p), is_held=is_held)
