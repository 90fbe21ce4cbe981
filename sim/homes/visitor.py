"""Somebody at a home who asks for things there: their names, and how long a person takes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import TypeVar

import numpy as np

from sim import atlas
from sim.footprint import Point
from sim.homes.catalogue import Someone, stock
from sim.homes.draws import one_of, shuffled
from sim.homes.home import Home
from sim.homes.surfaces import Surface
from sim.world_schema import Entry, Object, Person, Room, Spot

T = TypeVar("T")

WALK_M_S = 1.0
"""Of a calm person: adults walk 1.2 to 1.4 m/s on a free way (docs/worlds.md); at home there are
doors and corners, and a cup in the hand is not to be spilt."""
BEGIN_S, HANDLE_S, TURN_S, SAY_S, LOOK_S = 2.0, 5.0, 2.0, 3.0, 2.0
"""To understand and set out; to grasp or to put down; to turn to something at the end of a way; to
say a sentence; to look over a surface. By eye: with the walking they come within a fifth of what
people who wrote such tasks by hand gave for a fetch (25 s) and for two (50 s)."""
SYNONYM, PLAIN = 0.3, 0.6
"""How often something is called by a synonym; what is alone of its kind, by no more than that."""


class Visitor:
    """Knows a home, and draws one after the other what to ask for in it."""

    def __init__(self, home: Home, rng: np.random.Generator) -> None:
        """Sort out what lies where."""
        self.home, self.world, self.rng = home, home.world, rng
        self.objects: tuple[Object, ...] = home.world.objects
        self.surfaces = {surface.place.id: surface for surface in home.surfaces}
        self.start: Point = home.world.start.at_m
        self.start_room = atlas.room_at(home.world, self.start)
        self.people: dict[str, Someone] = {who.id: who for who in stock().people}

    def pick(self, items: Sequence[T]) -> T:
        """One of several."""
        return one_of(items, self.rng)

    def shuffled(self, items: Iterable[T]) -> list[T]:
        """All of them, in any order."""
        return shuffled(items, self.rng)

    def chance(self, share: float) -> bool:
        """Whether something happens this time."""
        return bool(self.rng.random() < share)

    # --- what is there ---

    def surface_of(self, item: Object) -> Surface:
        """What a thing lies on."""
        return self.surfaces[item.on]

    def room_of(self, item: Object) -> str:
        """Id of the room that a thing is in."""
        return self.surface_of(item).room

    def on(self, surface: Surface) -> list[Object]:
        """What lies on a surface."""
        return [item for item in self.objects if item.on == surface.place.id]

    def of(self, category: str) -> list[Object]:
        """All things of a category."""
        return [item for item in self.objects if item.category == category]

    def categories(self) -> list[str]:
        """All categories there are things of."""
        return list(dict.fromkeys(item.category for item in self.objects))

    def targets(self, items: Sequence[Object]) -> list[Surface]:
        """Surfaces with room for all these things that none of them is on, in any order."""
        taken = {item.on for item in items}
        free = [
            surface
            for surface in self.shuffled(self.surfaces.values())
            if surface.place.id not in taken and (surface.item.kind != "box" or self.chance(0.3))
        ]
        return [
            surface for surface in free if surface.free_spots(items, self.on(surface)) == len(items)
        ]

    # --- what it is called ---

    def called(self, entry: Entry) -> str:
        """A room, a spot, a thing: its name, or now and then a synonym."""
        if entry.synonyms and self.chance(SYNONYM):
            return f"the {self.pick(entry.synonyms)}"
        if isinstance(entry, Object) and len(self.of(entry.category)) == 1 and self.chance(PLAIN):
            return f"the {entry.category}"
        return f"the {entry.title}"

    def place(self, surface: Surface) -> str:
        """A surface; a board of a shelf by its level."""
        level = surface.place.id.removeprefix(surface.item.id).strip("_")
        if not level:
            return self.called(surface.item)
        form = self.pick(("the {level} {shelf}",) * 3 + ("the {level} board of the {shelf}",))
        return form.format(level=level, shelf=surface.item.title)

    def place_in_room(self, surface: Surface) -> str:
        """The same, now and then with its room."""
        if self.chance(0.15):
            room = next(room for room in self.world.rooms if room.id == surface.room)
            return f"{self.place(surface)} in {self.called(room)}"
        return self.place(surface)

    def plural(self, category: str) -> str:
        """Several of a category."""
        return self.world.categories[category]

    # --- how long a person takes ---

    def by(self, item: Object) -> Point:
        """Where one stands to take a thing."""
        return self.surface_of(item).standing(item.at_m or (0.0, 0.0)) or self.start

    def at(self, surface: Surface) -> Point:
        """Where one stands to put something on a surface."""
        depth, width = surface.place.size_m
        spots = [(x * depth, y * width) for y in (0.0, 0.25, -0.25) for x in (0.25, 0.0, -0.25)]
        stands = (surface.standing(spot) for spot in spots)
        return next((stand for stand in stands if stand), self.start)

    def beside(self, entry: Person | Spot | Room) -> Point:
        """Where one stands to be with somebody, at a spot, in a room."""
        ground = self.home.ground
        points = ground.points(np.argwhere(ground.home))
        if isinstance(entry, Room):
            index = self.world.rooms.index(entry)
            points = ground.points(np.argwhere(ground.home & (ground.room == index)))
        best = int(np.argmin(np.hypot(*(points - np.array(entry.at_m)).T)))
        x, y = points[best].tolist()
        return x, y

    def person_s(self, stops: Sequence[Point], *, doing_s: float) -> int:
        """Seconds that a calm person needs for a way by all stops, and what is done there."""
        way = [self.start, *stops]
        walked_m = sum(self._walk_m(one, other) for one, other in pairwise(way))
        return round(BEGIN_S + walked_m / WALK_M_S + TURN_S * len(stops) + doing_s)

    def _walk_m(self, one: Point, other: Point) -> float:
        length_m = self.home.ground.walk_m(one, other)
        return length_m if math.isfinite(length_m) else math.dist(one, other)
