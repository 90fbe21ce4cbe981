"""What a world file may say: the YAML's types, one struct an entry (docs/worlds.md).

Metres and kilograms; angles in degrees, because people write these files. Everything that has a
front looks along its +x: `size_m` is depth (front to back), width, height.
"""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from robot.files import quantities as q

Side = Literal["north", "east", "south", "west"]


MOST_ROOMS, MOST_SPOTS, MOST_FURNITURE, MOST_OBJECTS, MOST_PEOPLE = 300, 500, 1000, 500, 100
"""A world of 300 rooms, 1000 tables, 500 cups is read in 0.3 s, compiled in 0.5 s; a step: 1 ms."""


class Entry(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Anything with an `id`; people call it `name` (the id with spaces) or one of `synonyms`."""

    id: str
    name: str = ""
    synonyms: q.Several[q.Line] = ()

    @property
    def title(self) -> str:
        """What people call it."""
        return self.name or self.id.replace("_", " ")


class Door(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A gap in a wall; `at_m` is its middle along the wall, from the room's centre."""

    wall: Side
    at_m: q.Place = 0.0
    width_m: q.Size = 1.0


class Room(Entry, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rectangle of floor around `at_m`, x by y; north is +y, east is +x."""

    at_m: tuple[q.Place, q.Place]
    size_m: tuple[q.Size, q.Size]
    walls: tuple[Side, ...] = ()
    doors: Annotated[tuple[Door, ...], Meta(max_length=32)] = ()
    wall_height_m: q.Size = 2.2
    floor: str = "tiles"


class Spot(Entry, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A named point of the floor to walk to."""

    at_m: tuple[q.Place, q.Place]
    yaw_deg: q.Heading = 0.0


class Furniture(Entry, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A piece of furniture; `kind` chooses its form (sim/furniture.py) and its places.

    `boards_m` are the heights of a shelf's boards. A `movable` piece is a free body of `mass_kg`;
    left out, the kind decides.
    """

    kind: str
    at_m: tuple[q.Place, q.Place]
    yaw_deg: q.Heading = 0.0
    size_m: tuple[q.Size, q.Size, q.Size] | None = None
    boards_m: q.Several[q.Size] = ()
    color: q.Line = ""
    movable: bool | None = None
    mass_kg: q.Load = 5.0


class Object(Entry, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Something to handle, on a place.

    `at_m` is measured in the place, from its middle; left out, a free spot is drawn from the seed.
    What `lies` is a cylinder on its side, its axis along its heading; `size_m` is as it stands.
    A `kind` of the catalogue (sim/things) has a form of its own; with the `variant` it says what
    the file leaves out: category, color, shape, size and mass.
    """

    category: str
    color: q.Line
    shape: str
    size_m: tuple[q.Size, q.Size, q.Size]
    mass_kg: q.Load
    on: str
    at_m: tuple[q.Place, q.Place] | None = None
    yaw_deg: q.Heading = 0.0
    lies: bool = False
    kind: str = ""
    variant: Annotated[int, Meta(ge=0, le=999_999)] = 0

    @property
    def height_m(self) -> float:
        """Above what it stands or lies on."""
        return self.size_m[0] if self.lies else self.size_m[2]


class Behaviour(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a simulated person does by themselves when the robot speaks to them.

    Attributes:
        takes: they take what is held out to them, and keep it.
        steps_aside: they make room when they are asked to.
        answers: what they answer to a question; empty: they say nothing at all.
    """

    takes: bool = True
    steps_aside: bool = True
    answers: str = "Yes."


Posture = Literal["stands", "sits", "lies"]


class Person(Entry, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Somebody who is there, and does what their behaviour says.

    Attributes:
        posture: who sits does so on a seat of 0.45 m, which is not there by that; who lies is on
            the back, the head where they face.
    """

    at_m: tuple[q.Place, q.Place]
    yaw_deg: q.Heading = 0.0
    height_m: q.Height = 1.70
    color: q.Line = "blue"
    posture: Posture = "stands"
    behaviour: Behaviour = Behaviour()


class Start(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the robot stands when the world begins."""

    at_m: tuple[q.Place, q.Place] = (0.0, 0.0)
    yaw_deg: q.Heading = 0.0


class World(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A world file. `categories` maps the singular of a kind of object to its plural."""

    name: str
    rooms: Annotated[tuple[Room, ...], Meta(max_length=MOST_ROOMS)]
    spots: Annotated[tuple[Spot, ...], Meta(max_length=MOST_SPOTS)] = ()
    furniture: Annotated[tuple[Furniture, ...], Meta(max_length=MOST_FURNITURE)] = ()
    objects: Annotated[tuple[Object, ...], Meta(max_length=MOST_OBJECTS)] = ()
    people: Annotated[tuple[Person, ...], Meta(max_length=MOST_PEOPLE)] = ()
    categories: Annotated[dict[str, str], Meta(max_length=MOST_OBJECTS)] = {}
    start: Start = Start()

    @property
    def bounds_m(self) -> tuple[float, float, float, float]:
        """Smallest rectangle around all rooms: x_min, y_min, x_max, y_max."""
        lows = [
            [at - size / 2 for at, size in zip(r.at_m, r.size_m, strict=True)] for r in self.rooms
        ]
        highs = [
            [at + size / 2 for at, size in zip(r.at_m, r.size_m, strict=True)] for r in self.rooms
        ]
        return (
            min(low[0] for low in lows),
            min(low[1] for low in lows),
            max(high[0] for high in highs),
            max(high[1] for high in highs),
        )
