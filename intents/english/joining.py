"""What two clauses in a row mean together."""

from msgspec.structs import replace

from intents.goals import (
    Balance,
    Bring,
    Find,
    ForEach,
    Give,
    Goal,
    GoTo,
    Meet,
    ObjectQuery,
    Person,
    Pick,
    Place,
    Say,
    Wait,
)


def joined(before: list[Goal], goal: Goal, *, first: str) -> Goal:
    """The goal in the light of the one before, which is taken off the list if it is part of it.

    ``first`` is the first word of its clause.
    """
    last = before[-1] if before else goal
    if isinstance(last, Balance) and isinstance(goal, Wait) and first in _HOLDS:
        before.pop()
        return replace(last, duration_s=goal.duration_s)
    for join in (_each_in_turn, _handed_over_there, _given_there, _found_there):
        made = join(last, goal)
        if made is not None:
            if join is not _found_there:
                before.pop()
            return made
    return goal


_HOLDS = ("hold", "stay", "keep", "remain")


def _each_in_turn(last: Goal, goal: Goal) -> Goal | None:
    """Pick up all the cups and load them into the rack: one after the other."""
    if not (isinstance(last, Pick) and isinstance(goal, ForEach) and last.object.count == "all"):
        return None
    if replace(last.object, count=None, at=None) != replace(goal.object, count=None, at=None):
        return None
    query = replace(last.object, count=None)
    return ForEach(object=query, goals=(Pick(object=ObjectQuery(held=True)), *goal.goals))


def _handed_over_there(last: Goal, goal: Goal) -> Goal | None:
    """Take the cup to the kitchen and give it to Ada: to Ada, who is there."""
    if not (isinstance(last, Place) and last.on and isinstance(goal, Give)):
        return None
    person = goal.to
    if person.who or person.at or _bare(last.object) != _bare(goal.object):
        return None
    return Bring(object=last.object, to=replace(person, at=last.on))


def _given_there(last: Goal, goal: Goal) -> Goal | None:
    """Go to the lab and give Ada the cup: to Ada, who is there."""
    if not (isinstance(last, GoTo) and last.place and isinstance(goal, Give)):
        return None
    return None if goal.to.who or goal.to.at else replace(goal, to=replace(goal.to, at=last.place))


def _found_there(last: Goal, goal: Goal) -> Goal | None:
    """Find a guest in the lab and say hello: to whoever was found."""
    if not (isinstance(last, Find | Meet) and isinstance(goal, Say) and goal.to):
        return None
    here = last.person
    only_there = here is not None and here.at and here == Person(at=here.at)
    return replace(goal, to=Person()) if only_there and goal.to == here else None


def _bare(query: ObjectQuery) -> ObjectQuery:
    return replace(query, at=None)
