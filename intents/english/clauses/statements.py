"""Statements: "there is a cup on the table", "she is in the kitchen"."""

from dataclasses import replace as replace_words

from msgspec.structs import replace

from intents.english.phrases.complements import read_list
from intents.english.phrases.noun_phrases import noun_phrase, read_postmodifiers
from intents.english.phrases.phrase import NounPhrase, is_all
from intents.english.phrases.referents import Scope, is_person, to_object, to_person, to_place
from intents.english.words import lexicon
from intents.english.words.text import Text
from intents.goals import ObjectQuery, Person

IS = lexicon.phrases(
    "is,are,was,were,should be,might be,must be,may be,could be,ought to be,has to be,will be,"
    "would be,used to be,should still be,is supposed to be"
)
"""What states rather than asks."""


def stated(
    text: Text, at: int, scope: Scope, where: str | None = None
) -> tuple[NounPhrase, int] | None:
    """What is stated to be somewhere, and where that ends: pronouns refer to it from now on.

    ``where`` is the place, if it was named before: on the table *is a cup*.
    """
    there = text.phrase_end(IS, at + 1) if text.word(at) == "there" else None
    phrase = noun_phrase(text, there or at)
    if phrase is None:
        return None
    if not there and not (where and text.word(at - 1) in ("is", "are")):
        predicate = text.phrase_end(IS, phrase.end)
        if predicate is None:
            return None
        phrase.end = predicate
        read_postmodifiers(text, phrase)
        if phrase.end == predicate:
            return None
    if there and text.word(phrase.end) == "and":
        return phrase, _mention_several(text, phrase, scope, where)
    mention_phrase(phrase, scope, where)
    many = there and text.word(at + 1) == "are" and is_all(replace_words(phrase, determiner="the"))
    if many and scope.object and scope.object.count is None:
        scope.mention(replace(scope.object, count="all"))  # there are cups here, take *them*
    return phrase, phrase.end


def _mention_several(text: Text, first: NounPhrase, scope: Scope, where: str | None) -> int:
    """There is *a plate and a bowl on the bar*, put them away: where what there is ends."""
    things, end = read_list(text, first.start)
    if len(things) < 2 or not all(one.name("object", "category") for one in things):
        mention_phrase(first, scope, where)
        return first.end
    group: list[ObjectQuery] = []
    for one in things:
        one.places = one.places or things[-1].places
        mention_phrase(one, scope, where)
        group += [scope.object] if scope.object else []
    scope.group = tuple(group)
    return end


def mention_phrase(phrase: NounPhrase, scope: Scope, where: str | None = None) -> None:
    """Remember a thing, a person or a place that has been spoken of."""
    if phrase.is_spot:
        scope.mention(to_place(phrase, scope))
        return
    if phrase.owner and scope.person is None:
        scope.person = Person(name=phrase.owner)
    what = (to_person if is_person(phrase, scope) else to_object)(phrase, scope)
    what = replace(what, at=what.at or where)
    if isinstance(what, ObjectQuery) and what.count is None and is_all(phrase):
        what = replace(what, count="all")  # the cups are in the sink, put *them* away
    scope.mention(what.at)
    scope.mention(what)
