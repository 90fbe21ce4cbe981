"""Where goals do the contrary of what was said, or do it to more or fewer than was said.

A guess at other words seldom loses a name, and easily a small word: it opens what is to be brought
down, counts the sugar as cups, waits ten seconds for ten minutes, puts the bowl where everything in
it was to go, and stops after the first of two orders.
"""

import re
from collections.abc import Iterator, Sequence

from intents.english.faithfulness import numbers
from intents.english.frames.devices import is_device
from intents.english.words import lexicon
from intents.english.words.lexer import singular, words_in
from intents.english.words.measures import Measure, measure, number
from intents.english.words.names import NameIndex
from intents.english.words.verbs import base_form, verbs_at
from intents.goals import Count, ForEach, Goal, ObjectQuery, Open, Report, Switch, Wait, each

_SHUTS = lexicon.words("close closed shut down off out kill stop cut end lower douse draw drawn")
_OPENS = lexicon.words("open opened up on start run wake raise lift unlock boot fire going part")
_SWITCHES = lexicon.words("switch switched turn turned power powered flick put get kill leave cut")
_EVERY = lexicon.words("every each")
_WHERE = lexicon.words("on in at from under off inside behind")
_TAKES = lexicon.words("take pick get collect grab fetch go come see look have let keep leave")
"""What an order begins with that another one may well finish: "take the cup, put it there"."""
_COUNTED_BY = lexicon.words("of the them these those my your our more other")
_WAITS = lexicon.words("wait pause rest hold")
_ADDRESSED = lexicon.words("you your yours yourself u ur ya ye robot")
_OF_A_THING = re.compile(
    r"\bwhy (?:is|are|was|were|does|do|did|has|have|had|must|can|will) "
    r"(?:the|this|that|these|those|a|an|my|our|his|her|its|their|some|all|every) [a-z]+ [a-z]+"
)
"""Why is *that flower so* pointy: of a thing, not "why did that fail"."""
_CLAUSES = re.compile(r"[,.;:!?…—–]+|\b(?:and|then)\b")
_NEAR = 1e-3
_SEVERAL = 2
_REACH = 3
_HOLES = lexicon.words("hole socket slot outlet gap crack")


def turns_round(words: list[str], goals: Sequence[Goal]) -> bool:
    """Bring *down* the curtain: whether it opens or switches on what was to be shut or off.

    The other way round nothing can be told: "it stands wide open" asks for it to be closed.
    """
    begun = [g for g in each(goals) if isinstance(g, Open) or (isinstance(g, Switch) and g.on)]
    return bool(begun) and not _SHUTS.isdisjoint(words) and _OPENS.isdisjoint(words)


def switches_furniture(words: list[str], goals: Sequence[Goal]) -> bool:
    """Boots *off the table*: whether what is no device is switched, and nobody said that."""
    switched = [goal for goal in each(goals) if isinstance(goal, Switch)]
    return _SWITCHES.isdisjoint(words) and any(not is_device(goal) for goal in switched)


def counts_another(words: list[str], goals: Sequence[Goal], names: NameIndex) -> bool:
    """Espresso, *two sugars*: whether the only number said counts what nobody knows."""
    counted = {
        count
        for goal in each(goals)
        if not isinstance(goal, Count)
        for count in [getattr(getattr(goal, "object", None), "count", None)]
        if isinstance(count, int) and count >= _SEVERAL
    }
    for wanted in counted:
        ends = [n.end for at in range(len(words)) if (n := number(words, at)) and n.value == wanted]
        if ends and not any(_counts_known(words, end, names) for end in ends):
            return True
    return False


def _counts_known(words: list[str], at: int, names: NameIndex) -> bool:
    """Whether a number before a word counts what is known, or what goes without saying."""
    if at >= len(words) or words[at] in _COUNTED_BY or words[at] in lexicon.FUNCTION_WORDS:
        return True
    behind = range(at, min(at + _REACH, len(words)))
    if any(words[n] in lexicon.OBJECT_NOUNS | lexicon.PERSON_NOUNS for n in behind):
        return True
    known = (names.match(words, n) for n in behind)
    return any(match is not None and match.of("object", "category") for match in known)


def mistimes(words: list[str], goals: Sequence[Goal]) -> bool:
    """Whether a wait is of another length than any that was said."""
    told = [one.value for one in _durations(words)]
    waits = [goal.duration_s for goal in each(goals) if isinstance(goal, Wait) and goal.duration_s]
    return any(all(abs(wait - one) > _NEAR for one in told) for wait in waits)


def waits_for_nothing(words: list[str], goals: Sequence[Goal]) -> bool:
    """Nod, *wait one second*: whether a wait with its length was said, and none is done."""
    if any(isinstance(goal, Wait) for goal in each(goals)):
        return False
    starts = (at + 1 + (words[at + 1 : at + 2] == ["for"]) for at in _waits(words))
    found = (measure(words, at) for at in starts if at < len(words))
    return any(one is not None and one.kind == "time" for one in found)


def _waits(words: list[str]) -> Iterator[int]:
    return (at for at, word in enumerate(words) if word in _WAITS)


def whose_is_lost(words: list[str], goals: Sequence[Goal]) -> bool:
    """*Whose* coat is that? Whether it is asked, or told, whose something is: no goal says that."""
    return "whose" in words and bool(goals)


def explains_another(text: str, goals: Sequence[Goal]) -> bool:
    """Why is *that flower* so pointy? Whether the robot tells why it did something itself."""
    tells = any(isinstance(goal, Report) and goal.topic == "why" for goal in each(goals))
    words = words_in(text)
    return tells and _ADDRESSED.isdisjoint(words) and bool(_OF_A_THING.search(" ".join(words)))


def measures_lost(words: list[str], goals: Sequence[Goal]) -> bool:
    """Whether how long or how far was said comes back in no goal."""
    told = numbers(goals)
    return any(all(abs(one.value - n) > _NEAR for n in told) for one in _measured(words))


def _durations(words: list[str]) -> Iterator[Measure]:
    return (one for one in _measured(words) if one.kind == "time")


def _measured(words: list[str]) -> Iterator[Measure]:
    at = 0
    while at < len(words):
        found = measure(words, at)
        if found is not None:
            yield found
        at = found.end if found is not None else at + 1


def loses_all(words: list[str], goals: Sequence[Goal], names: NameIndex) -> bool:
    """Everything *on the bar*, every *cup*: whether it is done to one of them."""
    counts = [getattr(getattr(goal, "object", None), "count", None) for goal in each(goals)]
    if "all" in counts or any(isinstance(goal, ForEach | Count) for goal in each(goals)):
        return False
    for at, word in enumerate(words[:-1]):
        match = names.match(words, at + 1) if word in _EVERY else None
        if match is not None and match.of("object", "category"):
            return True
        if word == "everything" and words[at + 1] in _WHERE:
            return True
    return False


def orders_fewer(text: str, goals: Sequence[Goal]) -> bool:
    """Whether more clauses begin with an order than there are goals."""
    begun = 0
    for clause in _CLAUSES.split(text.lower()):
        words = words_in(clause)
        follows = words[1:2] != [] and words[1] in lexicon.DETERMINERS | lexicon.PRONOUNS
        orders = follows and base_form(words[0]) == words[0] and bool(verbs_at(words, 0))
        begun += orders and words[0] not in _TAKES
    return begun > max(len(list(each(goals))), 1)


def puts_by_part(words: list[str], goals: Sequence[Goal], names: NameIndex) -> bool:
    """In the *plug hole*, before somebody *pits* his foot: whether a part is taken for a place."""
    spots = {
        spot.lower()
        for goal in each(goals)
        for spot in (getattr(goal, "on", None), getattr(goal, "in_", None))
        if isinstance(spot, str)
    }
    whole = {
        known.name.lower()
        for at in range(len(words))
        for match in [names.match(words, at)]
        if match
        for known in match.names
        if words[match.end - 1] == known.name.lower().split()[-1]
    }
    for spot in spots - whole:
        ends = spot.split()[-1]
        for at, word in enumerate(words[:-1]):
            verb = word == f"{ends}s" and words[at + 1] in lexicon.DETERMINERS
            part = word in spot.split() and words[at + 1] in _HOLES
            if verb or part:
                return True
    return False


def is_beside_itself(words: list[str], goals: Sequence[Goal]) -> bool:
    """The game *behind the till*: whether a thing is where it is itself, and was said but once."""
    said = [singular(word) for word in words]
    for goal in each(goals):
        query = getattr(goal, "object", None)
        if not isinstance(query, ObjectQuery) or query.relation is None:
            continue
        other = query.relation.of
        if other.name is None:
            continue
        last = singular(words_in(other.name)[-1])
        if other.name == query.name and not other.color and said.count(last) < _SEVERAL:
            return True
    return False
