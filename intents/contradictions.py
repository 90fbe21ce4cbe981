"""What a sentence says that its goals contradict, whatever reading they came from.

The law of faithfulness looks at words that come back in no goal. These all come back, or were
passed over with good reason, and still the goals are not what was said: what was taken back is done
as well as what was said instead ("to Ada no to Leo"), one of two is done where either was asked
for, what was to be done otherwise is lost, and so is an exception. It is asked about. What is done
at once that was to be done at an hour is looked for in :mod:`intents.occasions`.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import chain, combinations
from typing import NamedTuple

from msgspec.structs import replace

from intents.english.faithfulness import numbers, strings
from intents.english.words import lexicon
from intents.english.words.lexer import words_in
from intents.english.words.measures import number
from intents.english.words.names import NameIndex
from intents.goals import (
    Answer,
    Ask,
    Bring,
    Condition,
    ForEach,
    Give,
    Goal,
    GoTo,
    Guide,
    If,
    LookAt,
    ObjectQuery,
    Person,
    Place,
    Say,
    each,
    simple_conditions,
    to_builtins,
)

_QUOTED = re.compile(r"[\"“«][^\"”»]*[\"”»]")
_TAKES_BACK = re.compile(
    r"\b(?:(?:wait|actually|sorry|oh|ah|but|hang on)\W+)?(?:no|nah|naw|nope)\b(?!\s+(?:rush|hurry|"
    r"problem|need|worries|matter|longer|more|one|idea|doubt|trouble|other|further))|"
    r"\bor\W+(?:wait|rather|hang on|hold on|hmm?)\b|"
    r"\b(?:scratch|scrap|strike|forget) that\b|\bcorrection\b|\bwhat am i saying\b|"
    r"\bon second thoughts?\b|\bi mean(?:t)?\b|\bsorry\b|\binstead\b"
)
"""What takes back what was said before it."""
_THEN = re.compile(r"\b(?:then|afterwards|after that|next|first|both)\b")
_OTHERWISE = re.compile(
    r"(?:[,.;:…—–]|\bor|\band)\s*(?:otherwise|elsewise|else|(?P<if_not>(?:if )?(?:not|no|none)"
    r"(?: (?:have|there|got|found))?(?=,| then\b)|if not)|"
    r"failing (?:that|which))\b\W*"
    r"(?P<then>.*)"
)
_NOTHING = re.compile(
    r"(?:(?:just|then|please|you can|simply)\W+)*(?:never ?mind|nvm|don'?t|do not|leave|"
    r"forget|no\b|stay|it'?s|that'?s|fine|do nothing|skip|not to|so be|worry)"
)
"""What is to be done otherwise, if that is nothing."""
_EITHER = re.compile(r"\beither\b[^.!?]*\bor\b")
_WITHOUT = re.compile(
    r"\b(?:without|except|excepting|save|bar|but not|minus)\s+(?:for\s+)?"
    r"(?:(?:the|that|my|your|his|her|our|this)\s+)?"
)
_SEEN_TO = re.compile(r"\bsee to (?:it|that|this|them|the|my|your)\b(?! that)")
_SHARE = re.compile(r"\bone (?:is )?for \w+")
_NAMED = re.compile(
    r"^(?:\w+, )?(?:my|our|the|his|her|that|this) (?!one\b|thing\b)\w+"
    r"(?:'s| is| are| was| fell| went) "
    r"(?=.*\b(?:it|them)\b)"
)
"""Something that is told of, whatever it is."""
_SPEAKS = (Say, Ask, Answer)
_Moving = Bring | Give | Place | Guide
_MOVES = _SEVERAL = 2
_DENIES = lexicon.words("not don't never than of without except no for like")
_TELL_OF = lexicon.words("is are 's was were have has had 've got see sees with or")
_STILL = (["left"], ["there"], ["here"], ["remaining"], ["yet"])
_SORTS = {"room": "place", "category": "object"}
"""Names of these take one another's place."""


class Contradiction(NamedTuple):
    """What was said that goals contradict, in its own words, and the goals that may be meant."""

    said: str
    goals: tuple[Goal, ...]


def contradiction(text: str, goals: tuple[Goal, ...], index: NameIndex) -> Contradiction | None:
    """What was said that goals contradict; None if they do not."""
    plain = " ".join(_QUOTED.sub(" ", text.lower().replace("’", "'")).split())
    every = list(each(goals))
    speaks = any(isinstance(goal, _SPEAKS) for goal in every)
    if not speaks and not any(isinstance(goal, If) for goal in every):
        for sense in (_taken_back, _counted_twice, _of_nothing_known, _only_looked_at):
            told = sense(plain, goals)
            if told is not None:
                return told
        instead = _lost_instead(plain, goals, index) or _denied(plain, goals, index)
        if instead:
            return Contradiction(instead, goals)
        either = _EITHER.search(plain) if len(goals) == 1 else None
        if either:
            return Contradiction(either.group().strip(" ,.;:!?"), goals)
    lost = next(chain(_lost_otherwise(plain, every), _lost_exception(plain, every, index)), "")
    return Contradiction(lost, goals) if lost else None


def _taken_back(plain: str, goals: tuple[Goal, ...]) -> Contradiction | None:
    """What takes back an order that is done all the same; what was said last may be meant."""
    if len(goals) < _MOVES or _THEN.search(plain):
        return None
    for found in _TAKES_BACK.finditer(plain):
        parts = plain[: found.start()], plain[found.end() :]
        for one, two in combinations(goals, 2):
            if _are_rivals(one, two, *parts):
                kept = tuple(goal for goal in goals if goal is not one)
                return Contradiction(found.group().strip(" ,.;"), kept)
    return None


def _lost_instead(plain: str, goals: tuple[Goal, ...], index: NameIndex) -> str:
    """The desk, no, *the shelf* is better; take four, no, *three*: said instead, and in no goal."""
    for found in _TAKES_BACK.finditer(plain):
        before, after = words_in(plain[: found.start()]), words_in(plain[found.end() :])
        if found.group().startswith("but"):
            continue  # the box, but no the lid
        told = set(strings(goals))
        first, last = _names(before, index), [*_names(after, index)]
        kept = {kind for name, kind in last if name.lower() in told}
        gone = {kind for name, kind in first if name.lower() in told} - kept
        lost = next((name for name, kind in last if kind in gone and name.lower() not in told), "")
        counts = [n for words in (before, after) for n in (_numbers(words),)]
        said = {*map(float, numbers(goals))}
        number_lost = counts[0] & said - counts[1] and counts[1] - said - counts[0]
        if lost or number_lost:
            return plain[found.start() :].strip(" ,.;:!?")
    return ""


def _denied(plain: str, goals: tuple[Goal, ...], index: NameIndex) -> str:
    """Two cups and *no plate*: a thing that is denied by its name, and something is done with it.

    "There is no milk, fetch some" tells of it.
    """
    words, told = words_in(plain), set(strings(goals))
    for at in range(1, len(words) - 1):
        denies = words[at] == "no" and words[at - 1] not in _TELL_OF
        match = index.match(words, at + 1) if denies else None
        if match is None or not any(name.name.lower() in told for name in match.names):
            continue
        name = " ".join(words[at + 1 : match.end])
        straight = re.search(rf"\w no {re.escape(name)}\b", plain)  # to Ravi, no, Olga takes back
        once = straight and " ".join(words).count(name) == 1
        if once and words[match.end : match.end + 1] not in _STILL:
            return f"no {name}"
    return ""


def _names(words: list[str], index: NameIndex) -> Iterator[tuple[str, str]]:
    """The names of things and places in some words, and people, that are not denied there."""
    at = 0
    while at < len(words):
        match = index.match(words, at)
        if match is None or _DENIES.intersection(words[max(0, at - 4) : at]):
            at += 1
            continue
        yield from ((name.name, _SORTS.get(name.kind, name.kind)) for name in match.names[:1])
        at = match.end


def _numbers(words: list[str]) -> set[float]:
    """The counts in some words, but for one: that may be no count."""
    found = (number(words, at) for at in range(len(words)))
    return {n.value for n in found if n is not None and n.value >= _SEVERAL}


def _counted_twice(plain: str, goals: tuple[Goal, ...]) -> Contradiction | None:
    """Two cups, *one for me and one for Ada*: two in all."""
    shares = list(_SHARE.finditer(plain))
    whole = [
        goal
        for goal in goals
        if isinstance(goal, Bring | Give) and goal.object.count == len(shares) > 1
    ]
    if not whole:
        return None
    one = tuple(
        replace(goal, object=replace(goal.object, count=1)) if goal in whole else goal
        for goal in goals
    )
    return Contradiction(plain[shares[0].start() : shares[-1].end()], one)


def _of_nothing_known(plain: str, goals: tuple[Goal, ...]) -> Contradiction | None:
    """*My pipe's* on the sill, fetch it: what is in hand is fetched for what nobody knows."""
    first = goals[0] if goals else None
    held = isinstance(first, Bring | Give | Place) and first.object == ObjectQuery(held=True)
    found = _NAMED.search(plain) if held else None
    return Contradiction(found.group().strip(), goals) if found else None


def _only_looked_at(plain: str, goals: tuple[Goal, ...]) -> Contradiction | None:
    """The lamp is broken, *see to it*: more than a look is asked for, and nobody says what."""
    found = _SEEN_TO.search(plain) if any(isinstance(goal, LookAt) for goal in goals) else None
    return Contradiction(found.group(), goals) if found else None


def _are_rivals(one: Goal, two: Goal, before: str, after: str) -> bool:
    """Whether the same is to be done in two ways, one said ahead of a word and one behind it."""
    if isinstance(one, GoTo) and isinstance(two, GoTo) and one.by and two.by:
        ways = one.by.forward_m or 0.0, two.by.forward_m or 0.0
        return ways[0] * ways[1] < 0
    if not isinstance(one, _Moving) or not isinstance(two, _Moving):
        return False
    here, there = _whither(one), _whither(two)
    thing, other = _about(one), _about(two)
    return (
        bool(thing)
        and thing == other
        and here != there
        and _said(here, before)
        and _said(there, after)
    )


def _about(goal: _Moving) -> str:
    """The name of what is moved, or of who is led."""
    if isinstance(goal, Guide):
        return goal.person.name or ""
    return goal.object.name or goal.object.category or ""


def _whither(goal: _Moving) -> str:
    """Where it is moved to, or to whom."""
    to = (goal.on or goal.in_) if isinstance(goal, Place) else goal.to
    return (to.name or to.who or "") if isinstance(to, Person) else to or ""


def _said(where: str, part: str) -> bool:
    """Whether a place or somebody is named in a part of a sentence; who speaks needs no name."""
    words = set(words_in(part))
    return where == "operator" or not words.isdisjoint(where.lower().split())


def _lost_otherwise(plain: str, every: Sequence[Goal]) -> Iterator[str]:
    """Otherwise *the iron*: where no goal says what is to be done otherwise."""
    conditions = [goal for goal in every if isinstance(goal, If)]
    if not conditions or any(goal.else_ for goal in conditions):
        return
    for found in _OTHERWISE.finditer(plain):
        rest = found["then"]
        if found["if_not"] and all(_is_denied(goal.condition) for goal in conditions):
            continue  # see if it is there, and if not bring it: that is the case that was told
        if len(rest.split()) > 1 and not _NOTHING.match(rest):
            yield found.group().strip(" ,.;:")


def _is_denied(holds: Condition) -> bool:
    """Whether it is the case that something is not so."""
    return all(one.negated for one in simple_conditions(holds))


def _lost_exception(plain: str, every: Sequence[Goal], index: NameIndex) -> Iterator[str]:
    """All drinks *without the beer*: where something is done with all of them."""
    named = [one.object.name for one in every if isinstance(one, ForEach)]
    if all(named):
        return  # all toy cars, but not the ball: it is none of them
    words = set(plain.split())
    if words.isdisjoint(lexicon.ALL | {"everything"}) or "'except':" in str(to_builtins(every)):
        return
    for found in _WITHOUT.finditer(plain):
        rest = words_in(plain[found.end() :])
        match = index.match(rest, 0) if rest else None
        if match is not None and match.of("object", "category"):
            yield f"{found.group()}{' '.join(rest[: match.end])}"
