"""People who are to get somewhere: "help Ada find the door", "have her follow you"."""

from msgspec.structs import replace

from intents.english.phrases.complements import first_with, read_complements
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.referents import is_person, to_person, to_place
from intents.english.reading import Found, Sentence
from intents.english.words import lexicon
from intents.goals import OPERATOR, Guide

_HELPS = lexicon.words("help assist let")
_FINDS_WAY = lexicon.phrases(
    "get,go,find,reach,navigate,find his way,find her way,find their way,find the way,walk,move,"
    "make his way,make her way,make their way,come,travel,find way,get back,return"
)
_CAUSES = lexicon.words("have let make ask get tell")


def helped_there(sentence: Sentence, at: int) -> Found | None:
    """Help Ada find her way from the gate to the lab; how does Ada get to the lab?"""
    text, scope = sentence.text, sentence.scope
    if text.word(at) not in _HELPS | {"how"}:
        return None
    start = at + 1
    if text.word(at) == "how":
        start += text.word(start) in ("does", "can", "do", "could", "should")
    phrase = noun_phrase(text, start)
    if phrase is None or not is_person(phrase, scope) or phrase.noun == "operator":
        return None
    person = to_person(phrase, scope)
    way = text.phrase_end(_FINDS_WAY, phrase.end + (text.word(phrase.end) == "to"))
    if way is None:
        return None
    complements, stop = read_complements(text, way)
    source = first_with(complements, "from")
    goal = first_with(complements, "to", "into", "")
    if goal is None:
        return None
    if source:
        person = replace(person, at=to_place(source.phrase, scope, objects=True))
    to = OPERATOR if goal.phrase.noun in ("operator", "here") else to_place(goal.phrase, scope)
    return [Guide(person=person, to=to)], stop


def shown_where(sentence: Sentence, at: int) -> Found | None:
    """Show Ada where the lab is."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at + 1) if text.word(at) == "show" else None
    if phrase is None or not is_person(phrase, scope):
        return None
    person = to_person(phrase, scope)
    if text.word(phrase.end) != "where":
        return None
    start = phrase.end + 1 + (text.word(phrase.end + 1) in ("is", "are"))
    place = noun_phrase(text, start)
    if place is None or (phrase.noun == "operator" and not place.is_spot):
        return None  # show me where the cup is: find it
    end = place.end + (text.word(place.end) in ("is", "are"))
    return [Guide(person=person, to=to_place(place, scope, objects=True))], end


def made_to_follow(sentence: Sentence, at: int) -> Found | None:
    """Have her follow you to the office: to guide her."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at + 1) if text.word(at) in _CAUSES else None
    if phrase is None or not is_person(phrase, scope):
        return None
    end = phrase.end + (text.word(phrase.end) == "to")
    if text.words[end : end + 2] not in (["follow", "you"], ["come", "with"]):
        return None
    complements, stop = read_complements(text, end + 2)
    goal = first_with(complements, "to", "into")
    to = to_place(goal.phrase, scope) if goal else None
    return [Guide(person=to_person(phrase, scope), to=to)], stop
