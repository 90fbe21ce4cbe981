"""Tasks for a home: what somebody would ask for there, and what is true once it is done.

The form is that of task files (docs/evaluation.md): a sentence, checks of the simulator's truth,
and a calm person's time. Each begins with the home as it is.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable
from typing import Any

import msgspec
import numpy as np

from sim.homes import wording as words
from sim.homes.home import Home
from sim.homes.surfaces import Surface
from sim.homes.visitor import HANDLE_S, LOOK_S, SAY_S, Visitor
from sim.placing import radius_m
from sim.world_schema import Object, Person, Room, Spot

Truth = dict[str, Any]

CARRY_S = 2 * HANDLE_S
GREETING = r"\b(hello|hi|hey|good (morning|day|afternoon|evening))\b"
SPOT_M, PASSED_M = 0.9, 0.7
"""Within which the robot is at a spot at the end, and was there on its way."""
GREETED_M, HANDED_M, BESIDE_M = 2.5, 1.5, 0.30
"""From somebody who is spoken to; to whom something is brought; between neighbours."""
AWAY_M = 3.0
"""From somebody to what they are brought, at least; half of it from the start to where one goes."""
WELL_APART_M = 0.13
"""Between the middles of two things of which one is behind or left of the other: evaluations move
each of them by up to 3 cm."""
ALONG_M = 0.05
"""How far such things are off the line that they are on, at most."""
NEIGHBOURS_M = 0.22
"""Of free surface between neighbours, at most."""
COUNT = 10
MOST_AT_ONCE = 4
"""Things to be moved by one wish."""


class Task(msgspec.Struct, frozen=True, kw_only=True):
    """A wish: `truth` are the checks that all hold once it is fulfilled."""

    kind: str
    say: str
    truth: list[Truth]
    person_s: int
    or_code: str = ""


def tasks(home: Home, seed: int) -> list[Task]:
    """Ten tasks of ten kinds; a kind that this home has no occasion for gives way to another."""
    name = home.world.name
    rng = np.random.default_rng([seed, zlib.crc32(name.encode()), 0x7A5C])
    visitor = Visitor(home, rng)
    last = visitor.shuffled(("nextto", "patrol"))
    order = [kind for kind in KINDS if kind not in last] + last
    made = {kind: KINDS[kind](visitor) for kind in order}
    found = [task for task in made.values() if task is not None][:COUNT]
    while len(found) < COUNT:
        more = _fetch(visitor)
        if more is None:
            break
        found.append(more)
    return found


def _fetch(visitor: Visitor) -> Task | None:
    for item in visitor.shuffled(visitor.objects):
        for target in visitor.targets([item])[:1]:
            is_wish = visitor.chance(0.2)
            say = visitor.pick(words.WISHES if is_wish else words.FETCH).format(
                o=visitor.called(item),
                p=visitor.place(visitor.surface_of(item)),
                q=visitor.place_in_room(target),
            )
            return Task(
                kind="fetch",
                say=words.asked(say, visitor.rng),
                truth=[_on(item, target)],
                person_s=_carrying_s(visitor, [(item, target)]),
            )
    return None


def _two(visitor: Visitor) -> Task | None:
    items = visitor.shuffled(visitor.objects)
    for a, b in zip(items[::2], items[1::2], strict=False):
        together = visitor.chance(0.5)
        if together:
            targets = visitor.targets([a, b])[:1] * 2
        else:
            targets = [*visitor.targets([a])[:1], *visitor.targets([b])[:1]]
        if len(targets) < 2:
            continue
        q, r = targets
        is_same = q.place.id == r.place.id
        if is_same and q.free_spots([a, b], visitor.on(q)) < 2:
            continue
        names = {
            "q": visitor.place(q),
            "r": visitor.place(r),
            "p": visitor.place(visitor.surface_of(a)),
        }
        form = visitor.pick(words.TWO_TOGETHER if is_same else words.TWO_APART)
        say = form.format(a=visitor.called(a), b=visitor.called(b), **names)
        return Task(
            kind="two",
            say=words.asked(say, visitor.rng),
            truth=[_on(a, q), _on(b, r)],
            person_s=_carrying_s(visitor, [(a, q), (b, r)]),
        )
    return None


def _relative(visitor: Visitor) -> Task | None:
    for item in visitor.shuffled(visitor.objects):
        same = visitor.of(item.category)
        piece = visitor.surface_of(item).item
        alone = sum(visitor.surface_of(one).item is piece for one in same) == 1
        if not alone or len(same) < 2:
            continue
        for anchor in visitor.shuffled(visitor.on(visitor.surface_of(item))):
            relations = _relations(visitor.surface_of(item), item, anchor)
            targets = visitor.targets([item])[:1] if relations else []
            if targets:
                relation = visitor.pick(relations)
                say = visitor.pick(words.RELATIVE).format(
                    c=item.category,
                    rel=visitor.pick(words.RELATIONS[relation]),
                    b=visitor.called(anchor),
                    q=visitor.place(targets[0]),
                )
                return Task(
                    kind="relative",
                    say=words.asked(say, visitor.rng),
                    truth=[_on(item, targets[0])],
                    person_s=_carrying_s(visitor, [(item, targets[0])]),
                )
    return None


def _relations(surface: Surface, item: Object, anchor: Object) -> list[str]:
    """How a thing lies to another of another category: beside it, and as seen from the front.

    Left and behind are only said where everybody stands before the surface.
    """
    if item.category == anchor.category or item.at_m is None or anchor.at_m is None:
        return []
    found: list[str] = []
    if math.dist(item.at_m, anchor.at_m) - radius_m(item) - radius_m(anchor) <= NEIGHBOURS_M:
        found.append("near")
    nearer, leftward = item.at_m[0] - anchor.at_m[0], anchor.at_m[1] - item.at_m[1]
    if surface.has_one_side:
        if abs(nearer) >= WELL_APART_M and abs(leftward) <= ALONG_M:
            found.append("in_front" if nearer > 0 else "behind")
        if WELL_APART_M <= abs(leftward) <= 2 * NEIGHBOURS_M and abs(nearer) <= ALONG_M:
            found.append("left" if leftward > 0 else "right")
    return found


def _conditional(visitor: Visitor) -> Task | None:
    forms = visitor.shuffled((_if_any, _if_there, _if_not_there, _if_none))
    return next((task for form in forms if (task := form(visitor))), None)


def _if_any(visitor: Visitor) -> Task | None:
    """There is exactly one, and it is brought."""
    for item in visitor.shuffled(visitor.objects):
        surface = visitor.surface_of(item)
        same = [one for one in visitor.on(surface) if one.category == item.category]
        for target in visitor.targets([item])[:1] if len(same) == 1 else []:
            say = visitor.pick(words.IF_ANY).format(
                a_c=words.an(item.category),
                p=visitor.place(surface),
                q=visitor.place(target),
                s=visitor.called(visitor.pick(visitor.world.spots)),
            )
            return _conditioned(visitor, say, [_on(item, target)], [(item, target)])
    return None


def _if_there(visitor: Visitor) -> Task | None:
    """It is there, and brought."""
    for item in visitor.shuffled(visitor.objects):
        for target in visitor.targets([item])[:1]:
            say = visitor.pick(words.IF_THERE).format(
                o=visitor.called(item),
                p=visitor.place(visitor.surface_of(item)),
                q=visitor.place(target),
                s=visitor.called(visitor.pick(visitor.world.spots)),
            )
            return _conditioned(visitor, say, [_on(item, target)], [(item, target)])
    return None


def _if_not_there(visitor: Visitor) -> Task | None:
    """It is elsewhere: it stays there, and the robot goes where it was told."""
    for item in visitor.shuffled(visitor.objects):
        places = visitor.targets([item])
        spot = visitor.pick(visitor.world.spots)
        if len(places) >= 2 and math.dist(spot.at_m, visitor.start) > AWAY_M / 2:
            say = visitor.pick(words.IF_NOT_THERE).format(
                o=visitor.called(item),
                p=visitor.place(places[0]),
                q=visitor.place(places[1]),
                s=visitor.called(spot),
            )
            stops = [visitor.at(places[0]), visitor.beside(spot)]
            return Task(
                kind="conditional",
                say=words.asked(say, visitor.rng),
                truth=[{"not_moved": item.id}, {"at": list(spot.at_m), "within_m": SPOT_M}],
                person_s=visitor.person_s(stops, doing_s=LOOK_S),
            )
    return None


def _if_none(visitor: Visitor) -> Task | None:
    """None of its kind is there yet, so it is brought."""
    for item in visitor.shuffled(visitor.objects):
        for target in visitor.targets([item])[:3]:
            if any(one.category == item.category for one in visitor.on(target)):
                continue
            say = visitor.pick(words.IF_NONE).format(
                c=item.category, o=visitor.called(item), p=visitor.place(target)
            )
            looked = visitor.at(target)
            task = _conditioned(visitor, say, [_on(item, target)], [(item, target)])
            stops = [looked, visitor.by(item), looked]
            more_s = visitor.person_s(stops, doing_s=CARRY_S + LOOK_S)
            return msgspec.structs.replace(task, person_s=more_s)
    return None


def _conditioned(
    visitor: Visitor, say: str, truth: list[Truth], errands: list[tuple[Object, Surface]]
) -> Task:
    return Task(
        kind="conditional",
        say=words.asked(say, visitor.rng),
        truth=truth,
        person_s=_carrying_s(visitor, errands) + round(LOOK_S),
    )


def _route(visitor: Visitor) -> Task | None:
    rooms = [
        room for room in visitor.shuffled(visitor.world.rooms) if room.id != visitor.start_room
    ]
    here = next(room for room in visitor.world.rooms if room.id == visitor.start_room)
    a: Room | Spot = rooms[0]
    b: Room | Spot = rooms[1] if len(rooms) > 1 else here
    if visitor.chance(0.35):
        spots = visitor.shuffled(visitor.world.spots)
        a, b = (spots[0], spots[1]) if len(spots) > 1 and visitor.chance(0.5) else (a, spots[0])
    truth: list[Truth] = []
    if isinstance(a, Room) and isinstance(b, Room):
        truth = [{"visited": [a.id, b.id]}, {"robot_in": b.id}]
    elif isinstance(a, Room):
        truth = [{"visited": [a.id]}, {"at": list(b.at_m), "within_m": SPOT_M}]
    else:
        truth = [{"passed_at": list(a.at_m), "within_m": PASSED_M},
                 {"at": list(b.at_m), "within_m": SPOT_M}]  # fmt: skip
    say = visitor.pick(words.ROUTE).format(a=visitor.called(a), b=visitor.called(b))
    waiting_s = 3.0 if "wait" in say else LOOK_S if "look" in say else 0.0
    stops = [visitor.beside(a), visitor.beside(b)]
    return Task(
        kind="route",
        say=words.asked(say, visitor.rng),
        truth=truth,
        person_s=visitor.person_s(stops, doing_s=waiting_s),
    )


def _search(visitor: Visitor) -> Task | None:
    away = [item for item in visitor.objects if visitor.room_of(item) != visitor.start_room]
    for item in visitor.shuffled(away or visitor.objects):
        spot = visitor.pick(visitor.world.spots)
        targets = visitor.targets([item])[:1]
        looking_s = LOOK_S * len(visitor.surfaces) / 2
        if visitor.chance(0.3):
            say = visitor.pick(words.SEARCH_SPOT).format(
                o=visitor.called(item), s=visitor.called(spot)
            )
            truth: list[Truth] = [{"object": item.id, "held": True},
                                  {"at": list(spot.at_m), "within_m": SPOT_M}]  # fmt: skip
            stops = [visitor.by(item), visitor.beside(spot)]
            person_s = visitor.person_s(stops, doing_s=HANDLE_S + looking_s)
        elif targets:
            say = visitor.pick(words.SEARCH).format(
                o=visitor.called(item), q=visitor.place(targets[0])
            )
            truth = [_on(item, targets[0])]
            person_s = _carrying_s(visitor, [(item, targets[0])]) + round(looking_s)
        else:
            continue
        return Task(
            kind="search", say=words.asked(say, visitor.rng), truth=truth, person_s=person_s
        )
    return None


def _person(visitor: Visitor) -> Task | None:
    who = visitor.pick(visitor.world.people)
    far = [item for item in visitor.objects if math.dist(visitor.by(item), who.at_m) > AWAY_M]
    if far and visitor.chance(0.5):
        return _handed(visitor, who, visitor.pick(far))
    return _spoken_to(visitor, who)


def _handed(visitor: Visitor, who: Person, item: Object) -> Task:
    """Something is brought: they have it, or it is held out to them."""
    needs = visitor.chance(0.2)
    say = visitor.pick(words.NEEDS if needs else words.HAND_OVER).format(
        P=who.title.capitalize(),
        o=visitor.called(item),
        p=visitor.place(visitor.surface_of(item)),
        them=visitor.people[who.id].pronoun,
    )
    theirs: Truth = {"object": item.id, "with_person": who.id, "within_m": HANDED_M}
    return Task(
        kind="person",
        say=words.asked(say, visitor.rng),
        truth=[{"robot_near": who.id, "within_m": HANDED_M}, theirs],
        person_s=visitor.person_s([visitor.by(item), visitor.beside(who)], doing_s=CARRY_S),
        or_code="not_taken",
    )


def _spoken_to(visitor: Visitor, who: Person) -> Task:
    news = visitor.pick(words.NEWS)
    tells = visitor.chance(0.5)
    say = visitor.pick(words.TELL if tells else words.HELLO).format(
        P=who.title.capitalize(), them=visitor.people[who.id].pronoun, m=news
    )
    return Task(
        kind="person",
        say=words.asked(say, visitor.rng),
        truth=[
            {"robot_near": who.id, "within_m": GREETED_M},
            {"said": f"(?i){news if tells else GREETING}"},
        ],
        person_s=visitor.person_s([visitor.beside(who)], doing_s=SAY_S),
    )


def _count(visitor: Visitor) -> Task | None:
    item = visitor.pick(visitor.objects)
    surface = visitor.surface_of(item)
    room = next(room for room in visitor.world.rooms if room.id == surface.room)
    in_room = visitor.chance(0.35)
    there = [
        one
        for one in visitor.of(item.category)
        if (visitor.room_of(one) == room.id if in_room else one.on == item.on)
    ]
    say = visitor.pick(words.COUNT_IN if in_room else words.COUNT).format(
        cs=visitor.plural(item.category),
        p=visitor.called(room) if in_room else visitor.place(surface),
    )
    number = len(there)
    stops = [visitor.by(one) for one in there]
    return Task(
        kind="count",
        say=words.asked(say, visitor.rng),
        truth=[{"said": rf"(?i)\b({number}|{words.NUMBERS[number]})\b"}],
        person_s=visitor.person_s(stops, doing_s=LOOK_S * number + SAY_S),
    )


def _all(visitor: Visitor) -> Task | None:
    for category in visitor.shuffled(visitor.categories()):
        members = visitor.of(category)
        surfaces = visitor.shuffled(visitor.surfaces.values())
        crowded = [
            surface
            for surface in surfaces
            if 2 <= sum(one.category == category for one in visitor.on(surface)) < len(members)
        ]
        if crowded and visitor.chance(0.5):
            made = _all_of(visitor, category, crowded[0], surfaces)
        elif len(members) >= 2:
            made = _all_of(visitor, category, None, surfaces)
        else:
            made = None
        if made is not None:
            return made
    return None


def _all_of(
    visitor: Visitor, category: str, source: Surface | None, surfaces: list[Surface]
) -> Task | None:
    """All of a category, or all of it from one place; what is there already stays there."""
    members = [one for one in visitor.of(category) if source is None or one.on == source.place.id]
    has_some = {one.on for one in members}
    surfaces = sorted(surfaces, key=lambda surface: surface.place.id not in has_some)
    if visitor.chance(0.5):
        surfaces = surfaces[::-1]
    for target in surfaces:
        moved = [one for one in members if one.on != target.place.id]
        if target is source or target.item.kind == "box" or not 1 <= len(moved) <= MOST_AT_ONCE:
            continue
        if target.free_spots(moved, visitor.on(target)) < len(moved):
            continue
        is_pair = source is None and len(members) == 2
        forms = words.ALL_FROM if source else words.BOTH if is_pair else words.ALL
        say = visitor.pick(forms).format(
            c=category,
            cs=visitor.plural(category),
            q=visitor.place(target),
            p=visitor.place(source) if source else "",
        )
        return Task(
            kind="all",
            say=words.asked(say, visitor.rng),
            truth=[_on(one, target) for one in members],
            person_s=_carrying_s(visitor, [(one, target) for one in moved]),
        )
    return None


def _nextto(visitor: Visitor) -> Task | None:
    for anchor in visitor.shuffled(visitor.objects):
        surface = visitor.surface_of(anchor)
        for item in visitor.shuffled(visitor.objects)[:6]:
            if item.on == anchor.on or not _has_room_beside(visitor, surface, anchor, item):
                continue
            say = visitor.pick(words.NEXT_TO).format(
                o=visitor.called(item), b=visitor.called(anchor)
            )
            beside: Truth = {"object": item.id, "near": anchor.id, "within_m": BESIDE_M}
            return Task(
                kind="nextto",
                say=words.asked(say, visitor.rng),
                truth=[_on(item, surface), beside],
                person_s=_carrying_s(visitor, [(item, surface)]),
            )
    return None


def _has_room_beside(visitor: Visitor, surface: Surface, anchor: Object, item: Object) -> bool:
    """Whether a thing can be put to the left or to the right of another, with room for a hand."""
    x, y = anchor.at_m or (0.0, 0.0)
    near_m = radius_m(anchor) + max(radius_m(item), 0.07) + 0.05
    spots = ((x, y + near_m), (x, y - near_m))
    others = visitor.on(surface)
    return near_m <= BESIDE_M - 0.06 and any(
        surface.takes(item, spot, others, gap_m=0.05) for spot in spots
    )


def _patrol(visitor: Visitor) -> Task | None:
    rooms = visitor.shuffled(visitor.world.rooms)
    rooms.sort(key=lambda room: room.id == visitor.start_room)
    stops = rooms[: 3 if len(rooms) > 3 and visitor.chance(0.6) else 2]
    times = 1 + visitor.chance(0.4)
    say = visitor.pick(words.PATROL[times]).format(
        all=words.listed([visitor.called(room) for room in stops])
    )
    return Task(
        kind="patrol",
        say=words.asked(say, visitor.rng),
        truth=[{"visited": [room.id for room in stops] * times}],
        person_s=visitor.person_s([visitor.beside(room) for room in stops] * times, doing_s=0.0),
    )


def _on(item: Object, surface: Surface) -> Truth:
    return {"object": item.id, "on": surface.place.id}


def _carrying_s(visitor: Visitor, errands: list[tuple[Object, Surface]]) -> int:
    """Of a person who brings one thing after the other."""
    stops = [stop for item, target in errands for stop in (visitor.by(item), visitor.at(target))]
    return visitor.person_s(stops, doing_s=CARRY_S * len(errands))


KINDS: dict[str, Callable[[Visitor], Task | None]] = {
    "fetch": _fetch, "two": _two, "relative": _relative, "conditional": _conditional,
    "route": _route, "search": _search, "person": _person, "count": _count, "all": _all,
    "nextto": _nextto, "patrol": _patrol,
}  # fmt: skip
