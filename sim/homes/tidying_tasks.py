"""Wishes after which things stand elsewhere: brought, put together, put beside one another."""

from __future__ import annotations

import math

import msgspec

from sim.homes import wording as words
from sim.homes.surfaces import Surface
from sim.homes.task import AWAY_M, CARRY_S, SPOT_M, Task, Truth, carrying_s, stands_on
from sim.homes.visitor import LOOK_S, Visitor
from sim.placing import radius_m
from sim.world_schema import Object

BESIDE_M = 0.30
"""Between neighbours."""
WELL_APART_M = 0.13
"""Between the middles of two things of which one is behind or left of the other: evaluations move
each of them by up to 3 cm."""
ALONG_M = 0.05
"""How far such things are off the line that they are on, at most."""
NEIGHBOURS_M = 0.22
"""Of free surface between neighbours, at most."""
MOST_AT_ONCE = 4
"""Things to be moved by one wish."""


def fetch(visitor: Visitor) -> Task | None:
    """Bring one thing to one place."""
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
                truth=[stands_on(item, target)],
                person_s=carrying_s(visitor, [(item, target)]),
            )
    return None


def two(visitor: Visitor) -> Task | None:
    """Bring two things, together or each to its place."""
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
            truth=[stands_on(a, q), stands_on(b, r)],
            person_s=carrying_s(visitor, [(a, q), (b, r)]),
        )
    return None


def relative(visitor: Visitor) -> Task | None:
    """Bring the one of its kind that is beside another thing, or behind it."""
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
                    truth=[stands_on(item, targets[0])],
                    person_s=carrying_s(visitor, [(item, targets[0])]),
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


def conditional(visitor: Visitor) -> Task | None:
    """Bring something, or go somewhere, if something is so."""
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
            return _conditioned(visitor, say, [stands_on(item, target)], [(item, target)])
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
            return _conditioned(visitor, say, [stands_on(item, target)], [(item, target)])
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
            task = _conditioned(visitor, say, [stands_on(item, target)], [(item, target)])
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
        person_s=carrying_s(visitor, errands) + round(LOOK_S),
    )


def all_of_a_kind(visitor: Visitor) -> Task | None:
    """Bring all of a kind, or all of it from one place."""
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
            truth=[stands_on(one, target) for one in members],
            person_s=carrying_s(visitor, [(one, target) for one in moved]),
        )
    return None


def nextto(visitor: Visitor) -> Task | None:
    """Put one thing next to another."""
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
                truth=[stands_on(item, surface), beside],
                person_s=carrying_s(visitor, [(item, surface)]),
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
