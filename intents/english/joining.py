"""What two clauses in a row mean together."""

from collections.abc import Collection

from msgspec.structs import replace

from intents.english.words import lexicon
from intents.goals import (
    DIRECTIONS,
    OPERATOR,
    Ask,
    Balance,
    Bring,
    Close,
    Count,
    Find,
    Follow,
    ForEach,
    Gesture,
    Give,
    Goal,
    GoTo,
    Greet,
    Guide,
    If,
    LookAt,
    Meet,
    ObjectQuery,
    Open,
    Person,
    Pick,
    Place,
    Present,
    Report,
    Say,
    Switch,
    Tell,
    Wait,
)

_HANDS = 2
_MOVES = (Bring, Give, Place)


_LASTING = (Find, Count, Guide, Follow, Greet, LookAt, Open, Close, Switch, Report, Tell, Balance)
"""What is so, or known, once it is done: asked for again it is the same."""
_SHORT = (Gesture,)
"""What can be done several times, and said several times for nothing: "wave, wave!"."""
_AGAIN = lexicon.words("again twice thrice once more times time another repeat")
_LINKED = lexicon.words("and then after")


def said_once(goals: list[Goal], words: Collection[str]) -> list[Goal]:
    """Goals without those that only say the one before again: "sit down, sit down!"."""
    if not _AGAIN.isdisjoint(words):
        return goals
    kept: list[Goal] = []
    for goal in goals:
        same = bool(kept) and kept[-1] == goal
        short = isinstance(goal, _SHORT) and _LINKED.isdisjoint(words)
        if not (same and (short or isinstance(goal, _LASTING))):
            kept.append(goal)
    return kept


def joined(before: list[Goal], goal: Goal, *, first: str) -> Goal:
    """The goal in the light of the one before, which is taken off the list if it is part of it.

    ``first`` is the first word of its clause.
    """
    if before:
        if _answer_is_brought(before, goal):
            before.pop()  # telling me comes back to me
        goal = _told_there(before[-1], goal)
        if _already_sought(before[-1], goal):
            before.pop()
    last = before[-1] if before else goal
    if isinstance(last, Tell) and goal == Tell(object=ObjectQuery(), property=last.property):
        before.pop()
        return last  # what is on the rack? Just the name of the thing
    if _is_answer(last, goal):
        before.pop()
        return goal
    if isinstance(last, Balance) and isinstance(goal, Wait) and first in _HOLDS:
        before.pop()
        return replace(last, duration_s=goal.duration_s)
    if isinstance(last, Guide) and isinstance(goal, GoTo) and goal.place:
        further = first in lexicon.DETERMINERS | {"to"} or first in goal.place.lower().split()
        return replace(last, to=goal.place) if further else goal  # ..., and then *the bar*
    for join in (_each_in_turn, _handed_over_there, _given_there, _found_there):
        made = join(last, goal)
        if made is not None:
            if join is not _found_there:
                before.pop()
            return made
    return goal


def carried(goals: list[Goal]) -> list[Goal]:
    """Take the pen, the cup and the box, and put them on the desk: each is fetched in its turn.

    More than two cannot be held at once, and need not be.
    """
    picks = [goal for goal in goals if isinstance(goal, Pick)]
    several = any(goal.object.count == "all" for goal in picks)
    if not several and (
        sum(goal.object.count if isinstance(goal.object.count, int) else 1 for goal in picks)
        <= _HANDS
    ):
        return goals
    kept = list(goals)
    for pick in picks:
        each_one = next((g for g in kept if _is_of(g, pick)), None)
        if isinstance(each_one, ForEach):
            thing = replace(pick.object, count=None)
            kept[kept.index(each_one)] = replace(each_one, object=thing)
            kept.remove(pick)
            continue
        later = [g for g in kept[kept.index(pick) :] if isinstance(g, Place | Bring | Give)]
        fate = next((g for g in later if _bare(g.object) == _bare(pick.object)), None)
        if fate is not None:
            thing = replace(fate.object, at=fate.object.at or pick.object.at)
            kept[kept.index(fate)] = replace(fate, object=thing)
            kept.remove(pick)
    return kept


def _is_of(goal: Goal, pick: Pick) -> bool:
    """Whether what is picked up all together is put away one by one."""
    if not isinstance(goal, ForEach) or pick.object.count != "all":
        return False
    return _bare(goal.object) == _bare(replace(pick.object, count=None))


def same_object(wanted: Goal, found: list[Goal]) -> bool:
    """I want the chips, can you bring them; Ada wants out, guide her: one wish, said twice."""
    goal = found[0] if found else None
    if isinstance(wanted, ForEach) and isinstance(goal, ForEach):
        return wanted.object.name == goal.object.name and same_object(
            wanted.goals[0], list(goal.goals)
        )
    if isinstance(wanted, Guide):
        return isinstance(goal, Guide) and wanted.person.name == goal.person.name
    if not isinstance(goal, Bring | Pick | Find | Give) or not isinstance(wanted, Bring | Find):
        return False
    one, other = wanted.object, goal.object
    if one is None or other is None:
        return wanted == goal
    return one.name == other.name


def sought_there(wanted: Goal, found: list[Goal]) -> Find | None:
    """I cannot find Ada, *have a look in the hall*: she is to be looked for there.

    *Have a look around*: that is what looking for her is.
    """
    goal = found[0] if len(found) == 1 else None
    if not isinstance(wanted, Find) or not isinstance(goal, GoTo | LookAt) or not goal.place:
        return None
    if isinstance(goal, LookAt) and goal.place in DIRECTIONS:
        return wanted if goal == LookAt(place="around") else None
    if replace(goal, place=None) != type(goal)():
        return None
    if wanted.person is not None and not wanted.person.at:
        return replace(wanted, person=replace(wanted.person, at=goal.place))
    if wanted.object is not None and not (wanted.object.at or wanted.object.relation):
        return replace(wanted, object=replace(wanted.object, at=goal.place))
    return None


def as_wished(goal: Goal, wish: Goal) -> Goal:
    """The goal with where the wish said that the thing is; to fetch it is to bring it."""
    if isinstance(goal, Guide) and isinstance(wish, Guide):
        return replace(goal, to=goal.to or wish.to, person=wish.person)
    if isinstance(goal, Pick) and isinstance(wish, Bring):
        return wish
    if isinstance(goal, ForEach) and isinstance(wish, ForEach):
        return replace(goal, object=wish.object)
    if isinstance(goal, Bring) and isinstance(wish, Bring) and goal.object.at is None:
        return replace(goal, object=replace(goal.object, at=wish.object.at))
    return goal


def instead(before: list[Goal], goal: Goal, *, said: bool, but: bool) -> Goal:
    """The cup to Ada, but *if she is out, put it on the desk*: one or the other, and not both.

    Args:
        before: The goals before; what the other stands in place of is taken off.
        goal: What is to be done on a condition.
        said: It is said to be done instead.
        but: It is set against what stands before it.
    """
    last = before[-1] if before else None
    if not (isinstance(goal, If) and goal.then and not goal.else_ and isinstance(last, _MOVES)):
        return goal
    other, holds = goal.then[0], goal.condition
    same = isinstance(other, _MOVES) and _bare(other.object) == _bare(last.object)
    receiver = last.to if isinstance(last, Bring | Give) else None
    someone = holds.person if isinstance(holds, Present) and holds.negated else None
    absent = someone and isinstance(receiver, Person) and someone.name == receiver.name
    if not (said or (same and (absent or but))):
        return goal
    before.pop()
    if isinstance(holds, Present) and holds.negated:
        there = replace(holds, negated=False)
        return If(condition=there, then=(last,), else_=goal.then)
    return replace(goal, else_=(last,))


def or_else(before: list[Goal], goal: Goal) -> Goal:
    """Bring a pear (or), *if there is none*, a plum: one or the other, and not both."""
    last = before[-1] if before else None
    if not isinstance(goal, If) or not isinstance(last, Bring | Find | Give | Pick | Place):
        return goal
    holds = goal.condition
    if not isinstance(holds, Present) or not holds.negated or holds.object is None:
        return goal
    if last.object is None or holds.object not in (last.object, _bare(last.object)):
        return goal
    before.pop()
    sought = replace(last.object, count=None)
    there = replace(holds, object=sought, negated=False)
    return If(condition=there, then=(replace(last, object=sought),), else_=goal.then)


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


def _is_answer(last: Goal, goal: Goal) -> bool:
    """Check whether a cup is on the table. If so, ...: the condition looks there by itself.

    To find it would fail where there is none.
    """
    if not isinstance(last, Find) or not isinstance(goal, If) or not last.object:
        return False
    asked = goal.condition
    return isinstance(asked, Present) and asked.object == last.object and bool(last.object.at)


def _told_there(before: Goal, goal: Goal) -> Goal:
    """Look at the table and count the cups: those on the table."""
    if not isinstance(before, GoTo | LookAt) or not isinstance(goal, Tell | Count):
        return goal
    if before.place is None or (isinstance(before, LookAt) and before.place in DIRECTIONS):
        return goal
    if goal.object and not (goal.object.at or goal.object.relation or goal.object.held):
        return replace(goal, object=replace(goal.object, at=before.place))
    if goal.person and goal.person.at is None and goal.person.who is None:
        return replace(goal, person=replace(goal.person, at=before.place))
    return goal


def _answer_is_brought(before: list[Goal], goal: Goal) -> bool:
    """Ask Ines if she is well, then come back and tell me what she says."""
    to_me = isinstance(goal, Ask) and goal.to == Person(who=OPERATOR)
    asked = before[-2:-1] and isinstance(before[-2], Ask)
    return bool(to_me and asked and before[-1] == GoTo(place=OPERATOR))


def _already_sought(before: Goal, goal: Goal) -> bool:
    """Look for the tallest cup, then name it: telling finds it."""
    if isinstance(before, LookAt) and isinstance(goal, Tell | Count) and before.place:
        told_of = goal.object or goal.person
        return told_of is not None and told_of.at == before.place
    if isinstance(goal, Ask | Tell | Count) and isinstance(before, Ask | Tell | Count) and goal.to:
        return replace(goal, to=None) == replace(before, to=None)
    if not (isinstance(before, Find | Tell) and isinstance(goal, Tell)):
        return False
    if goal.person is not None:
        return isinstance(before, Find) and goal.person == before.person
    return goal.property == "name" and goal.object is not None and goal.object == before.object
