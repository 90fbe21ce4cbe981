"""Following, guiding, meeting and greeting."""

from msgspec.structs import replace

from intents.english.frames.slots import Slots, need
from intents.english.phrases.complements import Clause
from intents.english.phrases.referents import ME, Scope, to_place
from intents.english.trouble import Misfit
from intents.goals import OPERATOR, Find, Follow, Goal, GoTo, Greet, Guide, Meet, Person


def _someone(slots: Slots, question: str, *roles: str) -> list[Person]:
    """Whom it is about, with where they are; the last one spoken of if nobody is named."""
    people = slots.persons()
    if not people:
        person = slots.take_person(*roles)
        people = [person] if person else [slots.scope.person] if slots.scope.person else []
    need(people, question)
    at = slots.source() or slots.loose_place()
    return [replace(p, at=p.at or at) for p in people]


_NEED_PLACE = ("see", "show", "help", "move", "steer", "get")
"""Verbs that guide only where a place is named: see Ada to the door."""
_GUIDES = ("guide", "escort", "lead", "accompany", "conduct", "usher")


def _destination(slots: Slots) -> str | None:
    """Where to; "back" and "here" are to the operator."""
    goal = slots.take("to", "into", "through")
    if goal:
        return to_place(goal.phrase, slots.scope)
    if slots.take_here():
        return OPERATOR
    if slots.scope.place and (there := slots.take_there()):
        return to_place(there.phrase, slots.scope)
    return OPERATOR if slots.direction("backward") else None


def _where_spoken_of(slots: Slots) -> str | None:
    """Lead Ada *there*: to the place spoken of, and not Ada who is there."""
    bare = slots.peek("")
    places = bare.phrase.places if bare and bare.phrases else []
    if not places or places[-1].of.noun != "there" or not slots.scope.place:
        return None
    return to_place(places.pop().of, slots.scope)


def follow(clause: Clause, scope: Scope) -> list[Goal]:
    """Follow Ada out of the lab."""
    slots = Slots(clause, scope)
    to = _destination(slots)
    people = _someone(slots, "Whom shall I follow?", "at", "with")
    slots.direction("forward", "around")
    slots.done()
    return [Follow(person=p, to=to) for p in people]


def guide(clause: Clause, scope: Scope) -> list[Goal]:
    """Guide Ada out to the garden."""
    slots = Slots(clause, scope)
    slots.rest = [c for c in slots.rest if not (c.phrases and c.phrase.said == "way")]
    if clause.verb.split()[0] not in _GUIDES and not slots.clause.with_role("", "with"):
        raise Misfit("that is not to guide anybody")
    to = _destination(slots)
    if any(c.phrases and c.role == "" and not c.phrase.is_person for c in slots.rest):
        bare = slots.take("")
        if bare and bare.phrase.noun != "pronoun":
            raise Misfit(f"“{bare.phrase.said}” is not a person I could guide")
        if bare:
            slots.rest.insert(0, bare)
    to = to or _where_spoken_of(slots)
    people = _someone(slots, "Whom shall I guide?", "with")
    slots.direction("forward", "around", "up", "down")
    slots.done()
    if to is None and people == [ME] and isinstance(scope.last, Guide) and scope.last.person == ME:
        to = scope.last.to  # which way is the lab, just take me
    verb = clause.verb.split()[0]
    if to is None and verb not in _GUIDES and (people == [ME] or verb in _NEED_PLACE):
        raise Misfit("that is not to guide anybody")
    return [Guide(person=p, to=to) for p in people]


def meet(clause: Clause, scope: Scope) -> list[Goal]:
    """Meet Ada by the gate."""
    slots = Slots(clause, scope)
    here = next((c.phrase for c in slots.rest if c.phrases and c.phrase.noun == "operator"), None)
    people = _someone(slots, "Whom shall I meet?", "with", "to")
    slots.done()
    if here is not None:
        within = to_place(here.places[0].of, scope) if here.places else people[0].at
        return [GoTo(place=within or OPERATOR)]
    return [Meet(person=p) for p in people]


def collect(clause: Clause, scope: Scope) -> list[Goal]:
    """Get Jamie from the bathtub: to find them there."""
    slots = Slots(clause, scope)
    people = _someone(slots, "Whom shall I fetch?")
    slots.take_person("for")
    slots.done()
    return [Find(person=p) for p in people]


def greet(clause: Clause, scope: Scope) -> list[Goal]:
    """Greet Ada; introduce yourself."""
    slots = Slots(clause, scope)
    people = slots.persons()
    other = slots.take_person("to", "for", "with")
    if people and other:
        raise Misfit("I can introduce myself, not people to one another")
    if not people:
        people = [other or scope.person or Person()]
    slots.take_person("from")  # from me
    at = slots.source() or slots.loose_place()
    slots.done()
    return [Greet(person=p if p == ME else replace(p, at=p.at or at)) for p in people]
