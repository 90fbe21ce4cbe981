"""Noun phrases become objects, people and places; pronouns become what they stand for."""

import dataclasses
from dataclasses import dataclass
from typing import cast

from msgspec.structs import replace

from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.pronouns import HELD
from intents.english.phrases.told_by_color import of_color
from intents.english.trouble import Doubtful, Misfit, NotUnderstood, Unclear, listing
from intents.english.words.lexer import singular
from intents.english.words.names import NameIndex
from intents.goals import (
    OPERATOR,
    Ask,
    Bring,
    Close,
    Count,
    Find,
    ForEach,
    Give,
    Goal,
    GoTo,
    LookAt,
    ObjectQuery,
    Open,
    Person,
    Pick,
    Place,
    Relation,
    Switch,
    Tell,
)

ME = Person(who="operator")
_OBJECTS = ("object", "category")
_SPOTS = ("place", "room")
_ANY_OF_A_KIND = (
    "a", "an", "any", "another", "some", "each", "every", "no", "which", "what", "whichever",
)  # fmt: skip
_INDEFINITE = ("a", "an", "any", "another", "either")


@dataclass(slots=True)
class Scope:
    """What pronouns stand for: the last object, person and place spoken of.

    Attributes:
        device: The door, drawer or device spoken of last.
        group: The objects picked up and not yet put down, for "them".
        last: The goal before, for "and tell me".
        parted: What "one" was and which it is, once "the other" is spoken of.
        unknown: What was spoken of last, if nothing of that name is known.
    """

    index: NameIndex
    object: ObjectQuery | None = None
    person: Person | None = None
    place: str | None = None
    person_is_last: bool = False
    device: str | None = None
    group: tuple[ObjectQuery, ...] = ()
    last: Goal | None = None
    parted: tuple[ObjectQuery, ObjectQuery] | None = None
    unknown: str = ""

    def mention(self, what: ObjectQuery | Person | str | None) -> None:
        """Remember what has just been spoken of."""
        if isinstance(what, ObjectQuery):
            if what != ObjectQuery(held=True):
                self.object, self.person_is_last, self.unknown = what, False, ""
        elif isinstance(what, Person):
            if what.who != "operator":
                self.person, self.person_is_last = what, True
        elif what is not None and what != OPERATOR:
            self.place = what

    def mention_goal(self, goal: Goal) -> None:
        """Remember what a goal speaks of; what it moves is no longer where it was."""
        stays = isinstance(goal, Find | Count | Tell | LookAt)
        if isinstance(goal, Pick):
            self.group = (*self.group, replace(goal.object, at=None))
        elif isinstance(goal, Place | Bring | Give):
            self.group = ()
        for slot in ("object", "person", "place", "on", "in_", "to"):
            value = cast("ObjectQuery | Person | str | bool | None", getattr(goal, slot, None))
            if value is None or isinstance(value, bool):
                continue
            if isinstance(value, ObjectQuery | Person):
                self.mention(value.at)
                value = value if stays else replace(value, at=None)
                if isinstance(goal, ForEach) and isinstance(value, ObjectQuery):
                    value = replace(value, count="all")
            self.mention(value)
        if isinstance(goal, Open | Close | Switch):
            self.device = goal.what
        if isinstance(goal, Find | LookAt) and goal.object and goal.object.name:
            kinds = {n.kind for n in self.index.exact(goal.object.name)}
            self.mention(goal.object.name if kinds and kinds <= {"place", "room"} else None)
        returns = isinstance(goal, GoTo) and goal.place == OPERATOR
        if not (returns and isinstance(self.last, Ask | Count | Tell)):
            self.last = goal  # count them, come back and tell me the number
        for nested in ("goals", "then", "else_"):
            for inner in cast("tuple[Goal, ...]", getattr(goal, nested, ())):
                self.mention_goal(inner)


def is_person(phrase: NounPhrase, scope: Scope) -> bool:
    """Whether a phrase speaks of a person rather than of a thing."""
    if phrase.noun == "pronoun":
        if phrase.said in ("him", "her", "he", "she"):
            return True
        if phrase.said in ("them", "they") and scope.person_is_last:
            return not _is_many(scope.object)
        return scope.person is not None and scope.object is None
    return phrase.is_person


def _is_many(thing: ObjectQuery | None) -> bool:
    """Whether things are meant rather than one: two cups; her glasses."""
    if thing is None:
        return False
    last = (thing.name or thing.category or "").split()[-1:]
    return thing.count not in (None, 1) or any(singular(word) != word for word in last)


def to_object(phrase: NounPhrase, scope: Scope, *, spots: bool = False) -> ObjectQuery:
    """The object that a phrase describes; with ``spots`` furniture counts as well.

    Raises:
        Misfit: It is no object.
        NotUnderstood: It is not in the vocabulary.
        Unclear: Several names of the vocabulary fit.
    """
    at, relation = _where(phrase, scope)
    if phrase.noun == "one" and scope.object and not phrase.places:  # of those on the table
        at, relation = scope.object.at, scope.object.relation
    if phrase.said == HELD:
        return ObjectQuery(held=True)
    if phrase.noun == "pronoun" and scope.unknown:
        raise NotUnderstood(f"I know no object called “{scope.unknown}”")
    if phrase.noun == "pronoun":
        known = scope.object or ObjectQuery(held=True)
        if phrase.said in ("them", "they") and known.count == 1:
            known = replace(known, count="all")  # if there are any cups, take them to the sink
        return replace(known, at=at or known.at, relation=relation or known.relation)
    if phrase.noun in ("operator", "person", "body", "here", "there", "place") or phrase.is_person:
        raise Misfit(f"“{phrase.said}” is not an object")
    name, category = _object_name(phrase, scope, spots)
    superlative = phrase.superlative
    sides = [one.how for one in phrase.places if one.part and one.of.is_spot] + [phrase.side]
    side = next(filter(None, sides), None)
    if side and superlative is None:
        superlative = "leftmost" if side == "left" else "rightmost"
    color, size = phrase.color, phrase.size
    if phrase.noun == "one" and name:
        other = scope.index.sibling(name, color=color, size=size)
        if not other:
            raise NotUnderstood(f"I know no {color or size} one besides the {name}")
        if other != name:
            name, color, size = other, None, None
    query = ObjectQuery(
        name=name or None,
        category=category or None,
        color=color,
        size=size,
        superlative=superlative,
        count=phrase.count or (1 if _is_any(phrase) or _is_one_more(phrase, scope) else None),
        at=at,
        relation=relation,
        except_=_without(phrase.without, scope) if phrase.without else None,
    )
    if relation and name and relation.how in ("in", "on") and relation.of.name == name:
        raise NotUnderstood(f"I do not know what is in the {name}")
    return _other(query, phrase.said, scope) if phrase.other else query


def _without(phrase: NounPhrase, scope: Scope) -> ObjectQuery:
    """What is not meant; "the red ones" are told by their colour alone."""
    query = replace(to_object(phrase, scope), count=None)
    return replace(query, name=None, category=None) if phrase.noun == "one" else query


def _other(query: ObjectQuery, said: str, scope: Scope) -> ObjectQuery:
    """The one of two things that was not spoken of; of "one" it is settled which that is.

    Raises:
        Unclear: There are more than two, or none was spoken of.
    """
    last = scope.object
    marks = scope.index.variants(query.name or "")
    if last is None or last.name != query.name or len(marks) != 2 or query.color or query.size:
        choices = tuple(f"{mark} {query.name}" for mark in marks)
        which = f", {_the(list(choices))}" if choices else " do you mean"
        raise Unclear(f"Which {query.name or 'one'}{which}?", choices, f"other {said}")
    colored = marks[0] in scope.index.colors
    known = last.color if colored else last.size
    first = known if known in marks else marks[0]
    second = marks[1] if first == marks[0] else marks[0]
    if known is None:
        one = replace(last, count=None)
        scope.parted = last, replace(one, color=first) if colored else replace(one, size=first)
    return replace(query, color=second) if colored else replace(query, size=second)


def _is_any(phrase: NounPhrase) -> bool:
    """A cup, any cup, one of the cups, something: whichever it is."""
    if phrase.superlative or phrase.noun not in ("name", "object"):
        return False
    return phrase.determiner in _INDEFINITE or phrase.said in ("something", "anything")


def _is_one_more(phrase: NounPhrase, scope: Scope) -> bool:
    """A mug on the table and *one* on the bar: another, of those that any will do of."""
    last = scope.object
    told = phrase.determiner or phrase.color or phrase.size or phrase.superlative or phrase.other
    return phrase.noun == "one" and not told and last is not None and last.count is not None


def _object_name(phrase: NounPhrase, scope: Scope, spots: bool) -> tuple[str, str]:
    """Name and category, of which at most one is not empty."""
    if phrase.noun == "one" and scope.object:
        return scope.object.name or "", scope.object.category or ""
    if phrase.noun in ("object", "one"):
        return "", ""
    kinds = (*_OBJECTS, *_SPOTS) if spots else _OBJECTS
    names = phrase.all_names(*kinds)
    if phrase.noun == "unknown" or not names:
        raise _unknown("object", phrase, scope, _OBJECTS)
    if len(names) > 1 and not phrase.exact:
        told = of_color(names, phrase.color, scope.index)
        if len(told) == 1:
            return (told[0], "") if told[0] in phrase.all_names("object") else ("", told[0])
        kind = _kind(names)
        if kind and _where(phrase, scope)[1] is not None:
            return kind, ""  # which jam it is that is next to the milk is seen there
        if kind and _is_of_a_kind(phrase, kind):
            return "", kind  # count the jams: all of them, however they differ
        raise Unclear(f"Which {phrase.said}, {_the(names)}?", tuple(names), phrase.said)
    name = phrase.name("object", *(_SPOTS if spots else ()))
    return (name, "") if name else ("", phrase.name("category"))


def _kind(names: list[str]) -> str:
    """What names that differ have in common: "jam", of the strawberry jam and the plum jam."""
    last = {name.rpartition(" ")[2] for name in names}
    return last.pop() if len(last) == 1 else ""


def _is_of_a_kind(phrase: NounPhrase, kind: str) -> bool:
    """Whether it is no certain one: "the mugs", "two mugs", "any mug", but not "the mug"."""
    head = phrase.said.split()[-1]
    plural = head != singular(head)
    loose = phrase.determiner in _ANY_OF_A_KIND
    told = plural or loose or phrase.count is not None or phrase.superlative is not None
    return told and kind in (head, singular(head))


def to_person(phrase: NounPhrase, scope: Scope) -> Person:
    """The person that a phrase describes.

    Raises:
        Misfit: It is no person.
        NotUnderstood: Nobody of that name is known.
        Unclear: A pronoun stands for nobody.
    """
    if phrase.noun == "operator":
        return ME
    at, beside = _where(phrase, scope)
    if at is None and beside and beside.how in ("left", "right") and not beside.of.category:
        at = beside.of.name  # who stands right of the door is at the door
    if phrase.noun in ("pronoun", "one"):
        if scope.person is None:
            raise Unclear("Who is meant?")
        known = scope.person
        return replace(
            known,
            at=at or known.at,
            posture=phrase.posture or known.posture,
            gesture=phrase.gesture or known.gesture,
            wearing=phrase.wearing or known.wearing,
        )
    if phrase.noun == "unknown" and not phrase.determiner:
        if not scope.index.knows_people:
            return Person(name=phrase.said, at=at)
        raise _unknown("person", phrase, scope, ("person",))
    if not phrase.is_person:
        raise Misfit(f"“{phrase.said}” is not a person")
    return Person(
        name=phrase.name("person") or None,
        gender=phrase.gender,
        posture=phrase.posture,
        gesture=phrase.gesture,
        wearing=phrase.wearing,
        superlative=phrase.superlative,
        count=phrase.count,
        at=at,
    )


def sought(phrase: NounPhrase, scope: Scope, *, spots: bool = False) -> Find:
    """To look for the object or the person that a phrase describes."""
    if is_person(phrase, scope):
        return Find(person=to_person(phrase, scope))
    return Find(object=to_object(phrase, scope, spots=spots))


def to_place(
    phrase: NounPhrase, scope: Scope, *, objects: bool = False, within: bool = False
) -> str:
    """The place that a phrase names.

    Args:
        phrase: The phrase.
        scope: What pronouns stand for.
        objects: A box or a bowl will do.
        within: It is to be inside of it: a room rather than a piece of furniture.

    Raises:
        Misfit: It is no place.
        NotUnderstood: It is not in the vocabulary.
        Unclear: Several places fit.
    """
    if phrase.noun in ("here", "operator"):
        return OPERATOR
    if phrase.other:
        raise Unclear("Which place do you mean? Tell me its name.")
    if phrase.where:
        raise Unclear(
            "I know that place only by what is there. What is it called?", (), phrase.where
        )
    if phrase.noun in ("there", "pronoun"):
        opened = _opened(scope) if phrase.noun == "pronoun" else ""
        found = opened or scope.place or (scope.device if phrase.noun == "pronoun" else None)
        if found is None:
            raise Unclear("Where is that?")
        return found
    if phrase.noun == "place" and phrase.places:
        return to_place(phrase.places[0].of, scope, objects=objects)
    if phrase.noun == "place" and scope.place:
        return scope.place
    names = phrase.all_names(*_SPOTS) or (phrase.all_names("object") if objects else [])
    if within and len(names) > 1 and not phrase.exact:
        names = phrase.all_names("room") or names
    if not names or phrase.level:
        if phrase.is_person:
            raise Misfit(f"“{phrase.said}” is not a place")
        raise _unknown("place", phrase, scope, _SPOTS)
    if len(names) > 1 and not phrase.exact:
        rooms = {w for p in phrase.places for w in p.of.name("room").split()} - {"room"}
        inside = [n for n in names if rooms & set(n.split())]
        if len(inside) == 1:
            return inside[0]
        raise Unclear(f"Which {phrase.said}, {_the(names)}?", tuple(names), phrase.said)
    return names[0]


def _opened(scope: Scope) -> str:
    """Open the cupboard and count the cups in *it*: what was opened last."""
    return (
        scope.last.what if isinstance(scope.last, Open) and scope.last.what == scope.device else ""
    )


def _where(phrase: NounPhrase, scope: Scope) -> tuple[str | None, Relation | None]:
    """The most precise place, and where it is relative to an object."""
    rooms: list[str] = []
    spots: list[str] = []
    relation = None
    alike = scope_of_ones(phrase, scope)
    for place in phrase.places:
        named = _relation(place, alike if place.of.noun == "one" else scope)
        if named:
            relation = named
            rooms += _rooms(place.of)
            if place.of.places:
                inner, _ = _where(place.of, scope)
                spots += [inner] if inner else []
        else:
            if place.of.noun == "place" and not (place.of.places or scope.place):
                continue
            name = to_place(place.of, scope, within=place.how == "in")
            (rooms if place.of.name("room") == name else spots).append(name)
    return next(iter(spots + rooms), None), relation


def scope_of_ones(phrase: NounPhrase, scope: Scope) -> Scope:
    """The blue jar next to *the green one*: beside a thing that was named "one" is of its kind."""
    name, category = phrase.name("object"), phrase.name("category")
    if phrase.is_person or not (name or category):
        known = scope.object and replace(scope.object, at=None, relation=None, count=None)
        return dataclasses.replace(scope, object=known)
    kind = ObjectQuery(name=name or None, category=None if name else category)
    return dataclasses.replace(scope, object=kind)


def _rooms(phrase: NounPhrase) -> list[str]:
    return [p.of.name("room") for p in phrase.places if p.of.name("room")]


def _relation(place: Locative, scope: Scope) -> Relation | None:
    """Where it is relative to something that is not simply a place to be at."""
    spot = place.of.noun in ("here", "there", "operator", "place") or bool(place.of.name(*_SPOTS))
    if place.of.noun == "pronoun":
        spot = scope.place is not None or bool(_opened(scope))
    unknown = place.of.noun == "unknown"
    if unknown or place.of.is_person or (spot and place.how in (None, "on", "in", "near")):
        return None
    if spot and place.part and not place.of.name("object"):
        return None
    of = replace(to_object(place.of, scope, spots=True), at=None)
    other = to_object(place.other, scope, spots=True) if place.other else None
    return Relation(how=place.how or "near", of=of, other=other and replace(other, at=None))


def _unknown(
    kind: str, phrase: NounPhrase, scope: Scope, kinds: tuple[str, ...]
) -> NotUnderstood | Doubtful:
    """Say what is not known, and ask whether one of the names that are like it is meant."""
    said = f"{phrase.level} {phrase.said}".strip()
    like = scope.index.like(phrase.said, kinds)
    if len(like) == 1 and not phrase.color:
        like = [f"{mark} {like[0]}" for mark in scope.index.variants(like[0])] or like
    if like and not phrase.name("object", "place", "room"):
        meant = listing(like) if kind == "person" else _the(like)
        told = f"I know no {kind} called “{said}”. Do you mean {meant}?"
        return Doubtful(told, tuple(like), phrase.said)
    return NotUnderstood(_reason(kind, said, phrase, scope, kinds))


def _reason(kind: str, said: str, phrase: NounPhrase, scope: Scope, kinds: tuple[str, ...]) -> str:
    near = scope.index.nearest(phrase.said, kinds)
    hint = f"; nearest: {listing(near)}" if near else ""
    other = {"object": ("place", "room"), "place": ("object",), "person": ()}[kind]
    if phrase.name(*other):
        return f"“{said}” is not {'an' if kind == 'object' else 'a'} {kind} I can use here{hint}"
    return f"I know no {kind} called “{said}”{hint}"


def _the(names: list[str]) -> str:
    return listing([f"the {name}" for name in names])
