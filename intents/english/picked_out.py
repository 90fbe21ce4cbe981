"""One of several that are to be handled, told apart: "the cups, *the blue one first*".

What is said of one of them is said of the others as well: they come after it, before it, or go
where all were to go.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

from msgspec.structs import replace

from intents.english.clauses.markers import marker_end
from intents.english.exclusions import narrowed
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import Locative, NounPhrase
from intents.english.phrases.referents import is_person, to_object, to_person, to_place
from intents.english.reading import Found, Sentence
from intents.english.substitution import redirected
from intents.english.trouble import Partly
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.lexicon import GOALWARDS, phrases, words
from intents.english.words.measures import NUMBER_WORDS
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Bring, ForEach, Give, Goal, ObjectQuery, Person, Pick, Place

_LINKS = words("but and with please only just")
_BEGIN = phrases("first,starting with,beginning with,start with,begin with,first of all,take first")
_FIRST = phrases("first,at first,first of all,first please,to begin with,to start with,before the "
                 "other,before the others,before the other one,first and then the other,first then "
                 "the other,first and then the others")  # fmt: skip
_LAST = phrases("last,last of all,at last,at the end,in the end,afterwards,last please,after the "
                "other,after the others,after the other one")  # fmt: skip
_SIDES = words("left right middle center centre front back side end corner edge")
_AT = words("on in at to into onto")
_COUNTS = NUMBER_WORDS | {"both"}


class _Picked(NamedTuple):
    """What is said of one of them.

    Attributes:
        phrase: Which one.
        end: Where the words end.
        turn: "first" or "last"; empty where it is told where it goes.
        to: Where it goes.
    """

    phrase: NounPhrase
    end: int
    turn: str
    to: Person | str | None = None


def picked_out(sentence: Sentence, at: int, last: list[Goal]) -> Found | None:
    """Put the cups on the counter, *the red one first*; ..., *the blue one on the shelf*.

    Raises:
        Partly: It is to be somewhere on what they are put on.
    """
    if not last:
        return None
    text, start = sentence.text, _past_openings(sentence.text, at)
    turned = _turned(text, start, said_first=_said_first(text, at, start))
    about = _about(last[-1])
    if turned is not None and (about is None or not _is_one_of(turned.phrase, about)):
        moved = _moved(turned, last)
        return moved and _noted(sentence, at, turned, None, moved)
    if about is None or not isinstance(about.name or about.category, str):
        return None
    if turned is not None:
        goals = _in_turn(sentence, turned, about, last)
        return _noted(sentence, at, turned, about, (goals, turned.end))
    placed = _placed(sentence, start, last) if at else []
    if not placed or not all(_is_one_of(one.phrase, about) for one in placed):
        return None
    goals = _apart(sentence, placed, about, last)
    return _noted(sentence, at, placed[0], about, (goals, placed[-1].end))


def _noted(
    sentence: Sentence, at: int, picked: _Picked, about: ObjectQuery | None, found: Found
) -> Found:
    """The same; what only tells in which order, and how many there were in all, is said by it."""
    text, passed = sentence.text, sentence.notes.passed
    passed.append((at, picked.phrase.start))
    if picked.turn:
        passed.append((picked.phrase.end, picked.end))
    if about is not None and isinstance(about.count, int):
        passed += [(n, n + 1) for n in range(at) if text.word(n) in _COUNTS]
    return found


def _past_openings(text: Text, at: int) -> int:
    while text.word(at) in (COMMA, FULL_STOP) and at < len(text):
        at += 1
    at = marker_end(text, at) or at
    while text.word(at) in _LINKS or text.word(at) == COMMA:
        at += 1
    begin = text.phrase_end(_BEGIN, at)
    return begin + (text.word(begin) == COMMA) if begin else at


def _said_first(text: Text, at: int, start: int) -> bool:
    return any(text.phrase_end(_BEGIN, n) == start for n in range(at, start))


def _closed(text: Text, end: int) -> bool:
    return end >= len(text) or text.word(end) in (COMMA, FULL_STOP, "and", "then")


def _turned(text: Text, at: int, *, said_first: bool) -> _Picked | None:
    """*The red one first*; *first the red one*."""
    if verbs_at(text.words, at) and not text.name_at(at):
        return None
    phrase = noun_phrase(text, at)
    phrase = phrase and _without_turn(text, phrase)
    if phrase is None or phrase.noun not in ("one", "name") or phrase.is_person or phrase.places:
        return None
    first, later = text.phrase_end(_FIRST, phrase.end), text.phrase_end(_LAST, phrase.end)
    end = first or later or phrase.end
    if not _closed(text, end) or not (first or later or said_first):
        return None
    end = _past_other(text, end)
    if end < len(text) and text.word(end) != FULL_STOP:
        return None
    return _Picked(phrase, end, "last" if later else "first")


def _without_turn(text: Text, phrase: NounPhrase) -> NounPhrase:
    """The bottle, of "the bottle first", which may be read as one noun."""
    for at in range(phrase.start, phrase.end):
        named = text.name_at(at)
        if named and (text.phrase_end(_FIRST, named.end) or text.phrase_end(_LAST, named.end)):
            return dataclasses.replace(
                phrase, end=named.end, noun="name", names=named.names, said=text.raw(at, named.end)
            )
    return phrase


def _past_other(text: Text, at: int) -> int:
    """The red one first, *and then the blue one*."""
    start = at
    while text.word(start) in (COMMA, "and", "then"):
        start += 1
    other = noun_phrase(text, start) if start > at else None
    alone = other is not None and (other.noun == "one" or other.other)
    return other.end if other and alone and other.end >= len(text) and not other.places else at


def _about(goal: Goal) -> ObjectQuery | None:
    """The several things that a goal is about."""
    query = getattr(goal, "object", None)
    if not isinstance(query, ObjectQuery) or query.held:
        return None
    several = query.count == "all" or (isinstance(query.count, int) and query.count > 1)
    return query if isinstance(goal, ForEach) or several else None


def _is_one_of(phrase: NounPhrase, about: ObjectQuery) -> bool:
    """Whether a phrase tells one apart of the several: "the red one", "the red cup"."""
    marked = bool(phrase.color or phrase.size or phrase.superlative or phrase.side)
    same = not phrase.names or about.name in phrase.all_names("object", "category")
    return marked and not about.color and same and phrase.count is None


def _one(goal: Goal, query: ObjectQuery) -> Goal:
    """What is done with one of them, as with all."""
    if isinstance(goal, ForEach) and len(goal.goals) == 1:
        inner = goal.goals[0]
        held = getattr(inner, "object", None)
        if isinstance(inner, Place | Bring | Give | Pick) and held == ObjectQuery(held=True):
            return replace(inner, object=query)
    if isinstance(goal, ForEach):
        return replace(goal, object=query)
    assert isinstance(goal, Place | Bring | Give | Pick)
    return replace(goal, object=query)


def _split(
    sentence: Sentence, phrase: NounPhrase, about: ObjectQuery, goal: Goal
) -> tuple[ObjectQuery, Goal]:
    """The one that is told apart, and what is done with the others."""
    one = to_object(phrase, sentence.scope)
    one = replace(one, name=about.name, category=about.category, count=None, at=about.at)
    fewer = about.count - 1 if isinstance(about.count, int) else about.count
    others = narrowed(replace(about, count=fewer), one, phrase, sentence.scope)
    return one, replace(goal, object=others)  # type: ignore[call-arg]


def _in_turn(
    sentence: Sentence, picked: _Picked, about: ObjectQuery, last: list[Goal]
) -> list[Goal]:
    one, others = _split(sentence, picked.phrase, about, last[-1])
    alone = _one(last[-1], one)
    pair = [alone, others] if picked.turn == "first" else [others, alone]
    return [*last[:-1], *pair]


def _moved(picked: _Picked, last: list[Goal]) -> Found | None:
    """The bottle first: of several things that were asked for, in another order."""
    name = picked.phrase.name("object", "category")
    with_it = [goal for goal in last if name and _speaks_of(goal, name, picked.phrase.color)]
    others = [goal for goal in last if goal not in with_it]
    if len(with_it) != 1 or not others:
        return None
    order = [*with_it, *others] if picked.turn == "first" else [*others, *with_it]
    return (order, picked.end) if order != last else (last, picked.end)


def _speaks_of(goal: Goal, name: str, color: str | None) -> bool:
    query = getattr(goal, "object", None)
    if not isinstance(query, ObjectQuery) or name not in (query.name, query.category):
        return False
    return color in (None, query.color)


def _placed(sentence: Sentence, at: int, last: list[Goal]) -> list[_Picked]:
    """*The red one on the upper shelf* and *the blue one on the lower shelf*.

    Raises:
        Partly: "On the left" is no place of its own.
    """
    text, found = sentence.text, list[_Picked]()
    if not _puts(last[-1]):
        return []
    while True:
        phrase = noun_phrase(text, at)
        if phrase is None or phrase.noun not in ("one", "name") or phrase.is_person:
            return found
        side_end = _side_end(text, phrase)
        if side_end is not None:
            said = text.raw(at, side_end)
            raise Partly(f"I cannot take account of “{said}”", tuple(sentence.before))
        picked = _where(sentence, phrase, last[-1])
        if picked is None or not _closed(text, picked.end):
            return found
        found.append(picked)
        at = picked.end
        while text.word(at) in (COMMA, "and"):
            at += 1
        if at == picked.end or at >= len(text):
            return found


def _puts(goal: Goal) -> bool:
    inner = goal.goals if isinstance(goal, ForEach) else (goal,)
    one = inner[0] if len(inner) == 1 else None
    return isinstance(one, Bring) or (isinstance(one, Place) and one.relation is None)


def _side_end(text: Text, phrase: NounPhrase) -> int | None:
    """Where "on the left", "in the middle" ends that tells where one is to be among the others."""
    before = text.words[max(phrase.start, phrase.end - 3) : phrase.end]
    if len(before) == 3 and before[0] in _AT and before[2] in _SIDES:
        return phrase.end if _closed(text, phrase.end) else None
    begun = phrase.places[0].of.start if phrase.places else phrase.end + 1
    if text.word(begun - 1) not in _AT and text.word(begun) not in _AT:
        return None
    at = begun + (text.word(begun) in _AT)
    at += text.word(at) in ("the", "your", "my")
    return at + 1 if text.word(at) in _SIDES and _closed(text, at + 1) else None


def _where(sentence: Sentence, phrase: NounPhrase, goal: Goal) -> _Picked | None:
    """Where one goes; what is only at a place, among things that are brought, is there before."""
    text, scope = sentence.text, sentence.scope
    inner = goal.goals[0] if isinstance(goal, ForEach) else goal
    is_place = isinstance(inner, Place)
    if phrase.places:
        there: Locative = phrase.places[-1]
        plain = there.how in (None, "on") and there.of.is_spot and len(phrase.places) == 1
        if not plain or not is_place:
            return None
        return _Picked(phrase, phrase.end, "", to_place(there.of, scope))
    start = text.phrase_end(GOALWARDS, phrase.end)
    to = noun_phrase(text, start) if start else None
    if to is None:
        return None
    if is_person(to, scope) or to.noun == "operator":
        return _Picked(phrase, to.end, "", to_person(to, scope))
    return _Picked(phrase, to.end, "", to_place(to, scope)) if to.is_spot else None


def _apart(
    sentence: Sentence, placed: list[_Picked], about: ObjectQuery, last: list[Goal]
) -> list[Goal]:
    """The others where all were to go, and each that is told apart to its own place."""
    goal = last[-1]
    marks = sentence.scope.index.variants(about.name or "")
    rest: list[Goal] = []
    if len(placed) == 1:
        phrase = _without_places(placed[0].phrase)
        rest = [_split(sentence, phrase, about, goal)[1]]
    elif set(marks) != {one.phrase.color for one in placed}:
        raise Partly("I cannot tell where the others are to go", tuple(sentence.before))
    each = [
        redirected(
            _one(goal, _split(sentence, _without_places(one.phrase), about, goal)[0]), one.to
        )
        for one in placed
        if one.to is not None
    ]
    return [*last[:-1], *rest, *each]


def _without_places(phrase: NounPhrase) -> NounPhrase:
    """A phrase without where it is: that is where it is to go."""
    return dataclasses.replace(phrase, places=[])
