"""What a person said is not to be done, kept to by whoever reads the rest of what was said.

The grammar hears "don't touch the red cup" in any sentence, also in one that it cannot read as a
whole; a plan that goes against it is no plan, however it was made. What nobody named ("don't make
a mess") is not known by its words.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple, cast

from msgspec.structs import replace

from intents import goals as g
from intents.english.order import RULES
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import Scope, to_object
from intents.english.reading import Sentence
from intents.english.readings.asides import forbidden
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.text import Text
from intents.goals import Goal, ObjectQuery
from intents.vocabulary import Vocabulary

_TELLS = lexicon.words("i we they he she it is are was were why that who which if do does did")
"""After one of these a negation tells of something: "I do not know", "it is not on the table"."""
_PUTS = lexicon.PUTTING | lexicon.words("bring carry take move")
"""Where a thing stands after one of these is where it is not to go."""
_SPARES = lexicon.phrases("hands off,except,except for,apart from,other than,excluding,save for")
_ALONE = lexicon.words("alone be where there as untouched")
_MODALS = lexicon.words("must may should shall can")
_ANYTHING = lexicon.words("anything nothing")
_HANDLES = (g.Pick, g.Place, g.Bring, g.Give, g.ForEach)
MAX_CHARACTERS = 1000


class Prohibition(NamedTuple):
    """What is not to be done.

    Attributes:
        said: In the person's words.
        things: What is not to be handled; with ``spots``, not to be put there.
        spots: Where the robot is not to go, or to put anything.
        away: Not even what is there is to be fetched.
    """

    said: str
    things: tuple[ObjectQuery, ...]
    spots: frozenset[str]
    away: bool


def broken(goals: Iterable[Goal], texts: Iterable[str], vocabulary: Vocabulary) -> str:
    """Which of the prohibitions in some texts goals go against, in words; empty if none."""
    listed = list(g.each(goals))
    for text in texts:
        for one in prohibitions(text, vocabulary):
            if any(_breaks(goal, one, vocabulary) for goal in listed):
                return f"the person said “{one.said}”"
    return ""


def prohibitions(text: str, vocabulary: Vocabulary) -> list[Prohibition]:
    """What a text says is not to be done, as far as it names a thing or a place."""
    words = Text(text[:MAX_CHARACTERS], vocabulary)
    found: list[Prohibition] = []
    at = 0
    while at < len(words):
        aside = _aside(words, at)
        if aside is not None:
            one = _of(words, aside)
            found += [one] if one.things or one.spots else []
        at = max(aside.end if aside else 0, at + 1)
    return found


class _Aside(NamedTuple):
    """From which word to which it says so, and whether it is something to keep away from."""

    start: int
    end: int
    away: bool = False


def _aside(text: Text, at: int) -> _Aside | None:
    """Don't touch *the cup*; leave *it* alone; *the cup* must not be moved; all except *it*."""
    if text.word(at - 1) not in _TELLS and text.word(at + 1) != "only":
        sentence = Sentence(text, Scope(text.index), RULES)
        found = forbidden(sentence, at)
        noted = sentence.notes.forbidden
        if found is not None:
            from_there = not noted and not _ANYTHING.isdisjoint(text.words[at : found[1]])
            away = from_there or (bool(noted) and noted[0].away)
            return _Aside(at, found[1], away) if noted or from_there else None
    start = text.phrase_end(_SPARES, at) or (at + 1 if text.word(at) == "leave" else None)
    phrase = noun_phrase(text, start or at)
    if phrase is None:
        return None
    after = text.words[phrase.end : phrase.end + 2]
    alone = text.word(at) == "leave" and after[:1] and after[0] in _ALONE
    spared = start is not None and (alone or text.word(at) != "leave")
    barred = start is None and after[:1] and after[0] in _MODALS and after[1:] == ["not"]
    told = 1 if alone else 3 if barred else 0  # "... alone", "... must not be moved"
    return _Aside(at, min(phrase.end + told, len(text))) if spared or barred else None


def _of(text: Text, aside: _Aside) -> Prohibition:
    start, end, away = aside
    things: list[ObjectQuery] = []
    spots: set[str] = set()
    puts = bool(_PUTS.intersection(text.words[start : start + 4]))
    for query, name in _named(text, start, end):
        where = name if query is None else query.at if puts else None
        spots |= {where} if where else set[str]()
        thing = replace(query, at=None) if query is not None and puts else query
        if thing is not None and replace(thing, count=None) != ObjectQuery():
            things.append(thing)
    return Prohibition(text.raw(start, end), tuple(things), frozenset(spots), away)


def _named(text: Text, start: int, end: int) -> Iterator[tuple[ObjectQuery | None, str]]:
    """The things and the spots that stand between two words."""
    scope, at = Scope(text.index), start
    while at < end:
        match, phrase = text.name_at(at), noun_phrase(text, at)
        spot = match.of("place", "room") if match else None
        query = None
        try:
            query = to_object(phrase, scope) if phrase is not None and phrase.end <= end else None
        except ReadingError:
            query = None
        if query is not None and query != ObjectQuery() and not query.held:
            yield query, ""
            at = phrase.end if phrase else at + 1
        elif spot is not None and match is not None:
            yield None, spot
            at = match.end
        else:
            at += 1


def _breaks(goal: Goal, one: Prohibition, vocabulary: Vocabulary) -> bool:
    query = cast("ObjectQuery | None", getattr(goal, "object", None))
    slots = [getattr(goal, slot, None) for slot in ("on", "in_", "to", "place")]
    reached = {slot for slot in slots if isinstance(slot, str)} & one.spots
    if one.away and query is not None and query.at in one.spots:
        return True
    if not one.things:
        return bool(reached)
    if query is None or not isinstance(goal, _HANDLES) or (one.spots and not reached):
        return False
    return any(_may_be(query, thing, vocabulary) for thing in one.things)


def _may_be(query: ObjectQuery, thing: ObjectQuery, vocabulary: Vocabulary) -> bool:
    """Whether a description may mean a thing, or one of several such."""
    if query.held and query.name is None and query.category is None:
        return False  # it was described before
    if query.except_ is not None and _covers(query.except_, thing):
        return False
    both = ((query.color, thing.color), (query.size, thing.size), (query.at, thing.at))
    if any(one is not None and other is not None and one != other for one, other in both):
        return False
    return not _kinds(query, vocabulary).isdisjoint(_kinds(thing, vocabulary))


def _covers(excluded: ObjectQuery, thing: ObjectQuery) -> bool:
    same = excluded.name in (None, thing.name) and excluded.color in (None, thing.color)
    return same and excluded.category in (None, thing.category)


def _kinds(query: ObjectQuery, vocabulary: Vocabulary) -> set[tuple[str, str]]:
    """The things of the vocabulary that a description may mean, each by its name and colour."""
    return {
        (thing.name, thing.color)
        for thing in vocabulary.objects
        if query.name in (None, thing.name)
        and query.category in (None, thing.category)
        and (query.color is None or not thing.color or query.color == thing.color)
    }
