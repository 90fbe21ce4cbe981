"""Wishes that lead somewhere: ways, searches, people, counting, patrols."""

from __future__ import annotations

import math

from sim.homes import wording as words
from sim.homes.task import AWAY_M, CARRY_S, SPOT_M, Task, Truth, carrying_s, stands_on
from sim.homes.visitor import HANDLE_S, LOOK_S, SAY_S, Visitor
from sim.world_schema import Object, Person, Room, Spot

GREETING = r"\b(hello|hi|hey|good (morning|day|afternoon|evening))\b"
PASSED_M = 0.7
"""Within which the robot was at a spot on its way."""
GREETED_M, HANDED_M = 2.5, 1.5
"""From somebody who is spoken to; to whom something is brought."""


def route(visitor: Visitor) -> Task | None:
    """Go to two places, one after the other."""
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


def search(visitor: Visitor) -> Task | None:
    """Find a thing wherever it is: bring it, or hold it at a spot."""
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
            truth = [stands_on(item, targets[0])]
            person_s = carrying_s(visitor, [(item, targets[0])]) + round(looking_s)
        else:
            continue
        return Task(
            kind="search", say=words.asked(say, visitor.rng), truth=truth, person_s=person_s
        )
    return None


def person(visitor: Visitor) -> Task | None:
    """Bring somebody something, or greet or tell them something."""
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


def count(visitor: Visitor) -> Task | None:
    """Say how many of a kind there are, in a room or at a place."""
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


def patrol(visitor: Visitor) -> Task | None:
    """Go through two or three rooms, once or twice."""
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
