"""A home from a seed: the same kind and seed are the same home, wherever it is made."""

from __future__ import annotations

import math
import zlib
from functools import lru_cache

import msgspec
import numpy as np

from robot.errors import ConfigError, Problem
from robot.person_distances import PERSON_RADIUS_M, ZONE_M
from sim.footprint import Point
from sim.homes import choosing, formed, layout, lived_in
from sim.homes.catalogue import HomeKind, Someone, home_kind, stock
from sim.homes.draws import shuffled
from sim.homes.furnishing import furnished
from sim.homes.ground import Ground
from sim.homes.stocking import stocked
from sim.homes.surfaces import Surface, surfaces
from sim.world_checks import check
from sim.world_schema import Person, Spot, Start, World

TRIES = 60
LEAST_SURFACES, LEAST_OBJECTS, MOST_THINGS = 5, 9, 400
"""Things: all goods in all colours are some 420, each of its own colour in its category."""
PEOPLE = (1, 3)
PERSON_ROOM_M = 0.55
"""Of free floor around somebody."""
PASSING_M = PERSON_RADIUS_M + ZONE_M + 0.2
"""From somebody's middle to ways that go by them: 20 cm to spare of where the robot would stop. Its
planner keeps less by itself: for Juno 0.68 m (body, `walking.room.beside_m`, person)."""
STANDING_ROOM_M = 0.45
"""Of free floor around a spot, and around the robot's start."""
APART_M = 1.5
"""Between people, spots and the start."""


class Home(msgspec.Struct, frozen=True):
    """A generated world, and what is known of its floor."""

    kind: HomeKind
    world: World
    ground: Ground
    surfaces: list[Surface]


class Size(msgspec.Struct, frozen=True):
    """How large a home is to be; None: as usual for its kind."""

    rooms: int | None = None
    things: int | None = None


@lru_cache(maxsize=16)  # making one takes up to 3 s, and a campaign asks for each many times
def home(
    kind_name: str,
    seed: int,
    size: Size = Size(),  # noqa: B008, it is frozen
    *,
    is_lived_in: bool = False,
    has_forms: bool = False,
) -> Home:
    """Make a home; nobody changes it afterwards.

    Args:
        kind_name: one of `sim.homes.catalogue.names()`.
        seed: of all that is drawn.
        size: of how many rooms and things.
        is_lived_in: as untidy as where people live (`sim.homes.lived_in`).
        has_forms: with things of real forms (`sim.homes.formed`).

    Raises:
        ConfigError: there is no such kind, none of that size, or no home of it was found for this
            seed.
    """
    kind = home_kind(kind_name)
    _check(kind, kind_name, size)
    for attempt in range(TRIES):
        entropy = [seed, zlib.crc32(kind_name.encode()), attempt, *[1] * is_lived_in]
        rng = np.random.default_rng(entropy)
        made = _attempt(
            kind, f"{kind_name}_{seed}", rng, size, is_lived_in=is_lived_in, has_forms=has_forms
        )
        if made is not None:
            return made
    cure = "take another seed" if size == Size() else "take another seed, more rooms, fewer things"
    raise ConfigError(f"no {kind_name} was found for seed {seed}; {cure}")


def _check(kind: HomeKind, name: str, size: Size) -> None:
    if size.rooms is not None:
        choosing.check(kind, name, size.rooms)
    if size.things is not None and not LEAST_OBJECTS <= size.things <= MOST_THINGS:
        cure = f"from {LEAST_OBJECTS} to {MOST_THINGS}"
        raise ConfigError([Problem(f"{size.things} things cannot be had", suggestion=cure)])


def _attempt(
    kind: HomeKind,
    name: str,
    rng: np.random.Generator,
    size: Size,
    *,
    is_lived_in: bool,
    has_forms: bool,
) -> Home | None:
    """One draw; None if not everything in it can be reached, or not all that is wanted is there."""
    kind = lived_in.of_kind(kind, rng) if is_lived_in else kind
    kind = formed.of_kind(kind) if has_forms else kind
    chosen = choosing.chosen(kind, rng, count=size.rooms)
    rooms = layout.rooms(chosen, rng)
    kinds = {room.id: room for room in chosen.rooms}
    furniture = furnished(rooms, [kinds[room.id] for room in rooms], rng)
    world = World(name=name, rooms=rooms, furniture=furniture)
    world = lived_in.with_chairs(world, rng) if is_lived_in else world
    ground = Ground(world)
    people = _people(world, ground, rng)
    if not people:
        return None
    people = lived_in.in_a_doorway(world, people, rng) if is_lived_in else people
    world = msgspec.structs.replace(world, people=people)
    reached = surfaces(world, ground)
    spots = _spots(kind, world, ground, rng)
    room_m, most_m = lived_in.CLOSE_M if is_lived_in else (STANDING_ROOM_M, math.inf)
    start = _start(world, spots, ground, rng, room_m=room_m, most_m=most_m)
    if len(reached) < LEAST_SURFACES or not spots or start is None:
        return None
    objects = stocked(
        kind, reached, rng, count=size.things, is_lived_in=is_lived_in, has_forms=has_forms
    )
    goods = {good.category: good for good in formed.goods()}
    plurals = {item.category: goods[item.category].plural for item in objects}
    world = msgspec.structs.replace(
        world, spots=spots, start=start, objects=objects, categories=plurals
    )
    if len(objects) < (size.things or LEAST_OBJECTS) or check(world):
        return None
    return Home(kind, world, ground, reached)


def _people(world: World, ground: Ground, rng: np.random.Generator) -> tuple[Person, ...]:
    """Somebody here and there, in nobody's way; nobody where some room cannot be reached.

    What the home's ground loses around them is taken off it.
    """
    whole = ground.home.copy()
    count = int(rng.integers(PEOPLE[0], PEOPLE[1] + 1))
    found: list[Person] = []
    for who in shuffled(stock().people, rng)[:count]:
        for _ in range(20):
            at = _free(ground, rng, room_m=PERSON_ROOM_M, apart=[p.at_m for p in found])
            if at is None:
                break
            before = ground.home.copy()
            ground.keep_from([at], PASSING_M)
            if _all_rooms(world, ground) and ground.home.sum() > 0.6 * whole.sum():
                found.append(_person(who, at, rng))
                break
            ground.home = before
    return tuple(found) if _all_rooms(world, ground) else ()


def _person(who: Someone, at: Point, rng: np.random.Generator) -> Person:
    return Person(
        id=who.id, at_m=at, yaw_deg=float(5 * rng.integers(-35, 37)), height_m=who.height_m,
        color=who.color,
    )  # fmt: skip


def _all_rooms(world: World, ground: Ground) -> bool:
    """Whether the home is in every room, by a fair part of its floor."""
    cells = [int((ground.home & (ground.room == index)).sum()) for index in range(len(world.rooms))]
    return all(count >= 80 for count in cells)


def _spots(
    kind: HomeKind, world: World, ground: Ground, rng: np.random.Generator
) -> tuple[Spot, ...]:
    found: list[Spot] = []
    for spot in kind.spots:
        apart = [p.at_m for p in world.people] + [other.at_m for other in found]
        at = _free(ground, rng, room_m=STANDING_ROOM_M, apart=apart, most_m=0.75)
        if at is None:
            return ()
        yaw = float(90 * rng.integers(-1, 3))
        found.append(Spot(id=spot.id, synonyms=spot.synonyms, at_m=at, yaw_deg=yaw))
    return tuple(found)


def _start(
    world: World,
    spots: tuple[Spot, ...],
    ground: Ground,
    rng: np.random.Generator,
    *,
    room_m: float,
    most_m: float,
) -> Start | None:
    apart = [p.at_m for p in world.people] + [spot.at_m for spot in spots]
    at = _free(ground, rng, room_m=room_m, apart=apart, most_m=most_m)
    return None if at is None else Start(at_m=at, yaw_deg=float(5 * rng.integers(-35, 37)))


def _free(
    ground: Ground,
    rng: np.random.Generator,
    *,
    room_m: float,
    apart: list[Point],
    most_m: float = math.inf,
) -> Point | None:
    """A point of the home with that much free floor around it, far from others; None if none is."""
    mask = ground.home & (ground.room >= 0)
    mask &= (ground.clearance_m >= room_m) & (ground.clearance_m <= most_m)
    cells = np.argwhere(mask)
    for index in shuffled(range(len(cells)), rng)[:40]:
        x, y = ground.points(cells[index]).tolist()
        at = (round(x, 2) + 0.0, round(y, 2) + 0.0)
        if all(math.dist(at, other) >= APART_M for other in apart):
            return at
    return None
