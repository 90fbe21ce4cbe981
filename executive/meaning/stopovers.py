"""Things that are taken to a room and then to something in it: they are put down once.

"Take the stapler to the copy room and put it on the paper rack": the room says where the rack is.
"""

from __future__ import annotations

from collections.abc import Iterable

from msgspec.structs import replace

from executive.meaning.knowledge import Knowledge
from intents import goals

_Carry = goals.Place | goals.Bring | goals.Give


def without_stopovers(asked: Iterable[goals.Goal], knowledge: Knowledge) -> tuple[goals.Goal, ...]:
    """The goals, less those that put a thing down in a room where the next one takes it further.

    It is taken then from where the first of the two says that it is.
    """
    kept: list[goals.Goal] = []
    for goal in asked:
        whole = _as_one(kept[-1], goal, knowledge) if kept else None
        if whole is None:
            kept.append(goal)
        else:
            kept[-1] = whole
    return tuple(kept)


def _as_one(first: goals.Goal, then: goals.Goal, knowledge: Knowledge) -> goals.Goal | None:
    """Both in one; None where the first is something of its own."""
    if not isinstance(first, goals.Place | goals.Bring) or not isinstance(then, _Carry):
        return None
    if isinstance(first, goals.Place) and (first.part or first.relation):
        return None
    rooms = knowledge.places(_target(first) or "")
    if not rooms or any(place.id != place.room for place in rooms):
        return None
    if not _is_same(first.object, then.object):
        return None
    inside = _rooms_of(then, knowledge)
    if not inside or not inside <= {place.room for place in rooms}:
        return None
    return replace(then, object=first.object)


def _target(goal: _Carry) -> str | None:
    """The name of the place that a thing is taken to, if it is one."""
    if isinstance(goal, goals.Place):
        return goal.on or goal.in_
    return goal.to if isinstance(goal.to, str) else None


def _rooms_of(goal: _Carry, knowledge: Knowledge) -> set[str]:
    """Ids of the rooms in which it may end: none if that is a room itself, or not known."""
    target = _target(goal)
    if target is not None:
        places = knowledge.places(target)
        return set() if any(place.floor for place in places) else {place.room for place in places}
    if isinstance(goal, goals.Place) or isinstance(goal.to, str) or goal.to.name is None:
        return set()
    person = knowledge.person(goal.to.name)
    if person is None:
        return set()
    name = knowledge.room_at(person.X_WO.p)
    return {place.room for place in knowledge.places(name) if place.id == place.room}


def _is_same(first: goals.ObjectQuery, then: goals.ObjectQuery) -> bool:
    """Whether "it", "the mug" or "them" is what was spoken of just before."""
    if then.count is not None and then.count != first.count:
        return False
    if then.count not in (None, "all"):
        return False  # "a mug to the kitchen and a mug on the table" are two
    if then.held and then.name is None and then.category is None:
        return True
    return _looks(first) == _looks(then)


def _looks(query: goals.ObjectQuery) -> goals.ObjectQuery:
    """What a description says of a thing, without where it is and how many."""
    return replace(query, at=None, relation=None, superlative=None, held=False, count=None)
