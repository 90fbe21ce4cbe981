"""The world as it is mapped and believed: furniture, places, things, people."""

from __future__ import annotations

import math

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.messages.basics import Message, Side, Source
from robot.messages.shapes import Shape
from robot.person_distances import PERSON_RADIUS_M
from robot.se3 import SE3
from robot.usual_things import usual

SAMPLE_M = 0.25
"""How far apart the points of a surface are by which it is said what of it was seen [m]."""


class Obstacle(msgspec.Struct, frozen=True, kw_only=True):
    """A rigid body that does not move by itself: furniture, walls, people's outlines."""

    id: str
    name: str
    X_WO: SE3
    shapes: tuple[Shape, ...]
    movable: bool = False


class Place(msgspec.Struct, frozen=True, kw_only=True):
    """A surface that things are put on: a rectangle with its centre and axes X_WP, z up.

    `size_m` its extent along x and y; `clearance_m` the free height above it; `of` the furniture.
    `floor` places (rooms, spots) are walked to and have no surface. `kind` is the sort of furniture
    ("table", "chair"), empty where nobody said.
    """

    id: str
    name: str
    X_WP: SE3
    size_m: tuple[float, float]
    clearance_m: float = 2.0
    of: str = ""
    room: str = ""
    floor: bool = False
    synonyms: tuple[str, ...] = ()
    kind: str = ""

    def samples(self) -> NDArray[np.float64]:
        """Points spread over the surface [m], shape (n, 3) in W; `Looked` is about each of them."""
        grid = [
            (np.arange(count) + 0.5) / count - 0.5
            for count in (max(1, math.ceil(size / SAMPLE_M)) for size in self.size_m)
        ]
        x, y = np.meshgrid(grid[0] * self.size_m[0], grid[1] * self.size_m[1], indexing="ij")
        points_P = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
        return points_P @ self.X_WP.rotation().T + np.array(self.X_WP.p)


class Looked(msgspec.Struct, frozen=True, kw_only=True):
    """When each of a surface's `samples` was last seen well [s], -inf: never, in their order."""

    place_id: str
    seen_s: tuple[float, ...]


class ObjectInfo(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of an object before it is seen (from the world file: an oracle's knowledge)."""

    id: str
    name: str
    category: str
    color: str
    shape: Shape
    mass_kg: float
    synonyms: tuple[str, ...] = ()

    @property
    def plain_name(self) -> str:
        """The name without the colour in front of it: "cup" of a "red cup"."""
        plain = self.name.removeprefix(f"{self.color} ") if self.color else self.name
        return plain or self.name

    def told(self) -> ObjectInfo:
        """As it is known by its name alone: as large and heavy as such things usually are."""
        known = usual(self.category)
        shape = Shape(kind=known.kind, size_m=known.size_m)
        return msgspec.structs.replace(self, shape=shape, mass_kg=known.mass_kg)

    @property
    def full_name(self) -> str:
        """What it is called on screen: "the red cup"."""
        return f"the {self.color} {self.plain_name}" if self.color else f"the {self.plain_name}"


class PersonInfo(msgspec.Struct, frozen=True, kw_only=True):
    """A person as the world file gives them; `synonyms` are what else they are called."""

    id: str
    name: str
    X_WO: SE3
    radius_m: float = PERSON_RADIUS_M
    synonyms: tuple[str, ...] = ()


class WorldMap(Message, frozen=True, kw_only=True):
    """The prior map: what does not change by itself. Until there is SLAM it is the world file's."""

    name: str
    obstacles: tuple[Obstacle, ...]
    places: tuple[Place, ...]
    objects: tuple[ObjectInfo, ...]
    people: tuple[PersonInfo, ...]
    categories: dict[str, str]
    bounds_m: tuple[float, float, float, float]
    start_X_WS: SE3 = SE3()
    source: Source = "oracle"

    def told(self) -> WorldMap:
        """The same without what only eyes and hands can know of objects: their forms and masses."""
        return msgspec.structs.replace(self, objects=tuple(one.told() for one in self.objects))

    def object(self, object_id: str) -> ObjectInfo | None:
        """The object with an id."""
        return next((item for item in self.objects if item.id == object_id), None)

    def place(self, place_id: str) -> Place | None:
        """The place with an id."""
        return next((item for item in self.places if item.id == place_id), None)

    def person(self, person_id: str) -> PersonInfo | None:
        """The person with an id."""
        return next((item for item in self.people if item.id == person_id), None)


class Track(msgspec.Struct, frozen=True, kw_only=True):
    """Where an object is believed to be.

    `seen_s` is when it was last seen (-inf: never, then X_WO is None); `missing` is set when its
    place was in clear view and it was not there; `held_by` while a hand has it. `unlike` says what
    something is that was taken for it ("white", "the rice box"), until it is seen elsewhere.
    Of people whom the robot's own senses tell of: `covariance` row by row of x, y [m²], () where it
    is unknown, and `posture`: "stands", "sits", "lies", with ", a hand up" where one is.
    """

    id: str
    X_WO: SE3 | None
    seen_s: float
    missing: bool = False
    held_by: Side | None = None
    unlike: str = ""
    covariance: tuple[float, ...] = ()
    posture: str = ""


class Unnamed(msgspec.Struct, frozen=True, kw_only=True):
    """A thing that own eyes see standing somewhere and that they know no name for.

    `words` say what it looks like ("green thing of 9 cm"); `X_WO` is upright, of its middle.
    `may_be` are the ids of told things that it may well be, the likeliest first. `near` is unset as
    long as it was not seen from near by: then its form and its place are a guess.
    """

    id: str
    words: str
    X_WO: SE3
    shape: Shape
    seen_s: float
    may_be: tuple[str, ...] = ()
    near: bool = True


class WorldState(Message, frozen=True, kw_only=True):
    """The world model: localisation and everything tracked.

    `X_WN` takes the controller's odometry frame to the world: `X_WB = X_WN @ X_NB`.
    `fix_age_s` is the age of the last fix that was believed; `jumps` counts how often the estimate
    of X_WN had to be thrown over. `unmapped` is what the sensors see and the map does not explain.
    `people` are tracked like objects; one not seen yet (`seen_s` -inf) is where the map says.
    `looked` is what of the surfaces has been in view, near enough and with nothing before it.
    `covariance`, row by row, is of the errors of the base's x, y [m] and heading [rad], () where it
    is unknown; `lost` says why the robot does not know where it is, "" while it does. `unsure` is
    where somebody may be whom no camera has looked at: x and y [m] in W. `unnamed` stands
    somewhere, and is none of the tracks.
    """

    X_WN: SE3
    X_WB: SE3
    fix_age_s: float
    tracks: tuple[Track, ...]
    people: tuple[Track, ...] = ()
    unmapped: tuple[Obstacle, ...] = ()
    looked: tuple[Looked, ...] = ()
    jumps: int = 0
    source: Source = "oracle"
    covariance: tuple[float, ...] = ()
    lost: str = ""
    unsure: tuple[tuple[float, float], ...] = ()
    unnamed: tuple[Unnamed, ...] = ()
