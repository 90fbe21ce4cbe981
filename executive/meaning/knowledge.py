"""What the map says, as words for the parser and as answers for the planner of tasks."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from executive.skills.motions.support import surface_under
from intents.grounding import Entity
from intents.numbers import Noun, plural
from intents.vocabulary import Someone, Spot, Thing, Vocabulary
from robot.messages import ObjectInfo, PersonInfo, Place, WorldMap
from robot.se3 import SE3, Vector3

T = TypeVar("T")
SMALL, BIG = 0.75, 1.33
"""Volume relative to the mean of its name: less is small, more is big."""
WALL_M, DOOR_M = 0.4, 0.6
"""Walls between rooms are thinner, and doors between them wider."""


class Knowledge:
    """A map, looked up by the names people use (any case)."""

    def __init__(self, world_map: WorldMap) -> None:
        """Look things up in `world_map`."""
        self.map = world_map

    def vocabulary(self) -> Vocabulary:
        """All names of this world, for the parser."""
        rooms = [place for place in self.map.places if _is_room(place)]
        others = [place for place in self.map.places if place not in rooms]
        return Vocabulary.of(
            objects=[self._thing(info) for info in self.map.objects],
            places=[
                Spot(name=place.name, synonyms=place.synonyms, furniture=not place.floor)
                for place in others
            ],
            rooms=[Spot(name=place.name, synonyms=place.synonyms) for place in rooms],
            people=[
                Someone(name=person.name, synonyms=person.synonyms) for person in self.map.people
            ],
            categories=self.map.categories,
        )

    def _thing(self, info: ObjectInfo) -> Thing:
        return Thing(
            name=info.plain_name,
            synonyms=info.synonyms,
            category=info.category,
            color=info.color,
            size=self._size_word(info),
        )

    def entity(self, info: ObjectInfo) -> Entity:
        """An object for grounding; where it is has to be seen, so it is left open."""
        return Entity(
            id=info.id,
            name=info.plain_name,
            category=info.category,
            color=info.color,
            size_m=info.shape.size_m,
            mass_kg=info.mass_kg,
        )

    def entities(self) -> tuple[Entity, ...]:
        """Every object for grounding."""
        return tuple(self.entity(info) for info in self.map.objects)

    def _size_word(self, info: ObjectInfo) -> str:
        """A size word where it tells this object from others of its name."""
        name = info.plain_name
        alike = [volume(other) for other in self.map.objects if other.plain_name == name]
        ratio = volume(info) * len(alike) / sum(alike)
        return "small" if ratio < SMALL else "big" if ratio > BIG else ""

    def object(self, object_id: str) -> ObjectInfo | None:
        """The object with an id."""
        return self.map.object(object_id)

    def place(self, place_id: str) -> Place | None:
        """The place with an id."""
        return self.map.place(place_id)

    def places(self, name: str) -> tuple[Place, ...]:
        """Every place that a name can mean: none, one, or several of the same name."""
        wanted = name.casefold()
        exact = [p for p in self.map.places if wanted in (p.name.casefold(), p.id.casefold())]
        others = [p for p in self.map.places if wanted in map(str.casefold, p.synonyms)]
        return tuple(exact or others)

    def surface_under(self, X_WO: SE3) -> Place | None:
        """The surface that something stands on, if any."""
        return surface_under(X_WO, self.map.places)

    def room_at(self, p_W: Vector3) -> str:
        """The name of the room that a point is in, empty if in none."""
        inside = (room.name for room in self.map.places if _is_room(room) and _over(p_W, room))
        return next(inside, "")

    def rooms(self, name: str) -> tuple[Place, ...]:
        """The rooms that a name can mean."""
        return tuple(place for place in self.places(name) if _is_room(place)) if name else ()

    def rooms_beside(self, name: str) -> tuple[Place, ...]:
        """The rooms that have a wall, or an open side, in common with those of a name."""
        rooms = self.rooms(name)
        others = [place for place in self.map.places if _is_room(place) and place not in rooms]
        return tuple(one for one in others if any(_share_a_side(one, room) for room in rooms))

    def noun(self, name: str) -> Noun:
        """What is counted, with the plural that the world gives for it, or else English forms."""
        return Noun(name, self.map.categories.get(name) or plural(name))

    def person(self, name: str | None) -> PersonInfo | None:
        """A person by name; None stands for the operator: who is called so, or the only one."""
        people = self.map.people
        wanted = (name or "operator").casefold()
        named = _first(p for p in people if wanted in (p.name.casefold(), p.id.casefold()))
        named = named or _first(p for p in people if wanted in map(str.casefold, p.synonyms))
        if named is None and name is None and len(people) == 1:
            return people[0]
        return named


def _is_room(place: Place) -> bool:
    return place.floor and place.id == place.room


def _over(p_W: Vector3, place: Place) -> bool:
    x, y, _ = (place.X_WP.inverse() @ SE3(p_W)).p
    return abs(x) <= 0.5 * place.size_m[0] and abs(y) <= 0.5 * place.size_m[1]


def _share_a_side(a: Place, b: Place) -> bool:
    """Whether two rooms lie side by side, for as long as a door is wide at least."""
    (a_low, a_high), (b_low, b_high) = _corners(a), _corners(b)
    together = np.minimum(a_high, b_high) - np.maximum(a_low, b_low)
    return bool(together.min() > -WALL_M and together.max() >= DOOR_M)


def _corners(room: Place) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The lowest and the highest x and y of a room [m], each of shape (2,)."""
    half = 0.5 * np.abs(room.X_WP.rotation()[:2, :2]) @ np.array(room.size_m)
    at = np.array(room.X_WP.p[:2])
    return at - half, at + half


def volume(info: ObjectInfo) -> float:
    """Volume of the box around an object [m³]."""
    x, y, z = info.shape.size_m
    return x * y * z


def _first(items: Iterable[T]) -> T | None:
    return next(iter(items), None)
