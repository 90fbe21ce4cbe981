"""Where something is to be put: on or in a place, on a part of it, beside another thing."""

from typing import NamedTuple

from msgspec.structs import replace

from intents.english.frames.slots import Slots, detach_place
from intents.english.phrases.complements import Clause, Complement
from intents.english.phrases.phrase import SAID_HOW, Locative, NounPhrase
from intents.english.phrases.referents import (
    Scope,
    is_person,
    scope_of_ones,
    to_object,
    to_place,
)
from intents.english.trouble import Misfit, NotUnderstood, Unclear
from intents.english.words import lexicon
from intents.goals import OPERATOR, How, ObjectQuery, Part, Place, Relation

MOVES = ("move", "transport", "transfer", "shift")
"""Verbs of what is carried; with "next to", that is where to."""


_NARROW = lexicon.words("bottle cup mug glass vase jug ball")
_HOLD_NOTHING = lexicon.words(
    "spoon fork knife pen pencil marker ball phone control remote apple banana orange glasses keys "
    "key screwdriver hammer scissors pipette"
)
"""Where nothing can be put: impossible stacks are refused before anything moves."""


class Target(NamedTuple):
    """Where something is to be put, as slots of :class:`Place`."""

    on: str | None = None
    in_: str | None = None
    part: Part | None = None
    relation: Relation | None = None


def put_at(query: ObjectQuery, spot: Target | None) -> Place:
    """To put something there, or down where it can be."""
    where = spot or Target()
    return Place(object=query, on=where.on, in_=where.in_, part=where.part, relation=where.relation)


def destination(slots: Slots) -> Target | None:
    """Whether on or in, and which place; or beside which thing."""
    goal = slots.take("to", "into") or slots.take_where()
    if goal:
        how = "in" if goal.role == "into" else "on"
        return _spot(Locative("in" if how == "in" else "on", goal.phrase), slots.scope)
    at = slots.take("at")
    if at:
        other = at.phrases[1] if at.how == "between" and len(at.phrases) > 1 else None
        return _spot(Locative(at.how, at.phrase, other), slots.scope, slots.peek(""))
    bares = [c for c in slots.rest if c.phrases and c.role == ""]
    there = next((c for c in bares[1:] if c.phrase.noun == "there"), None)
    last = slots.scope.last
    if there and isinstance(last, Place) and last.relation:
        slots.rest.remove(there)
        return Target(relation=last.relation)
    if there and slots.scope.place:
        slots.rest.remove(there)
        return Target(on=slots.scope.place)
    spot = bares[-1] if len(bares) > 1 and bares[-1].phrase.name("place", "room") else None
    if spot and spot.phrase.is_spot and not slots.peek("from"):
        slots.rest.remove(spot)
        return _spot(Locative(None, spot.phrase), slots.scope)  # put it kitchen table
    bare = bares[0] if bares else None
    place = detach_place(bare.phrases[-1]) if bare else None
    source = slots.peek("from")
    if place is None and source:
        place = detach_place(source.phrase)
    inside = slots.scope.device or slots.scope.place
    if place is None and inside and slots.clause.particles() & {"inside", "in"}:
        return Target(in_=inside)
    if place is not None and bare is not None:
        place = _after_description(bare.phrases[-1], place, slots.scope)
    return _spot(place, slots.scope, bare) if place else None


def _after_description(phrase: NounPhrase, place: Locative, scope: Scope) -> Locative:
    """Put the cup behind the vase on the shelf: "behind the vase" tells which of several cups.

    Of a thing that is told apart already, as "the red cup", it is where to put it.
    """
    last = place.other or place.of
    surface = last.places[-1] if last.places else None
    if phrase.noun == "pronoun":
        return place  # put it next to the vase on the shelf: which one is known
    if surface is None or not surface.of.is_spot or place.how not in _BESIDE:
        return place
    name = phrase.name("object")
    several = not name or bool(scope.index.variants(name))
    if phrase.color or phrase.size or phrase.superlative or not several:
        return place
    last.places.pop()
    phrase.places.append(place)
    return surface


def _spot(place: Locative, scope: Scope, put: Complement | None = None) -> Target:
    """Where that is, of things that are `put`: "next to the green one" is of their kind."""
    if is_person(place.of, scope):
        raise Misfit("I can put things on or in places; to people I give them")
    if place.how in _BESIDE and (_is_thing(place.of) or _is_by_furniture(place)):
        alike = scope_of_ones(put.phrases[-1], scope) if put and place.of.noun == "one" else scope
        of = replace(to_object(place.of, alike, spots=True), count=None)
        other = replace(to_object(place.other, scope), count=None) if place.other else None
        return Target(relation=Relation(how=place.how, of=of, other=other))
    if place.how not in ("on", "in", None):
        where = SAID_HOW.get(place.how, place.how)
        raise NotUnderstood(f"I can put things on or in a place, not {where} something")
    where = to_place(place.of, scope, objects=True)
    if place.how != "in" and place.of.name("object") == where and (place.of.color or place.of.size):
        which = " ".join(filter(None, (place.of.size, place.of.color, where)))
        raise NotUnderstood(f"I put things on furniture, not on the {which}")
    noun = where.split()[-1]
    narrow = noun in _NARROW and place.how == "on" and not place.of.is_spot
    if narrow or (noun in _HOLD_NOTHING and place.of.name("object") == where):
        raise NotUnderstood(f"Nothing would stay on or in the {where}")
    if where == OPERATOR:
        raise Unclear("Where shall I put it?")
    part = place.of.part
    if place.how == "in" and part is None:
        return Target(in_=where)
    return Target(on=where, part=part)


def moved_beside(clause: Clause, slots: Slots) -> Target | None:
    """Move the cup *next to the plate*: of what is moved, that is where to."""
    bare = slots.peek("")
    last = bare.phrases[-1].places[-1:] if bare else []
    if not clause.verb.startswith(MOVES) or slots.peek("to", "into") or not last:
        return None
    if last[0].how not in _BESIDE or not (_is_thing(last[0].of) or _is_by_furniture(last[0])):
        return None
    assert bare is not None
    bare.phrases[-1].places.pop()
    return _spot(last[0], slots.scope, bare)


def to_part(slots: Slots) -> Target | None:
    """Move the cup *to the other end of the table*."""
    goal = slots.peek("to", "into", "at")
    if goal is None or goal.phrase.part is None or goal.phrase.name("room"):
        return None
    slots.take("to", "into", "at")
    return Target(on=to_place(goal.phrase, slots.scope), part=goal.phrase.part)


_BESIDE: tuple[How, ...] = ("near", "left", "right", "behind", "in_front", "between")


def _is_thing(phrase: NounPhrase) -> bool:
    """Whether a phrase is of something that stands on a surface, to put things beside it."""
    return bool(phrase.name("object", "category")) or phrase.noun in ("one", "object")


def _is_by_furniture(place: Locative) -> bool:
    """Next to the lamp, beside the bed: on what stands next to it, not on it."""
    named = place.of.name("place") and not place.of.name("room")
    return place.how == "near" and bool(named) and place.other is None
