"""Noun phrases up to their noun: "the three largest red cups", "Julia's cup", "whatever", "it"."""

from intents.english.phrases.nouns import read_noun
from intents.english.phrases.phrase import Locative, NounPhrase, is_content
from intents.english.phrases.premodifiers import read_adjectives, read_quantity
from intents.english.phrases.pronouns import free_relative, pronoun
from intents.english.words import lexicon
from intents.english.words.properties import property_of
from intents.english.words.text import Text

_STANDS = lexicon.words("is are am was were stands stood sits sat lies lay belongs goes")


_KIN = lexicon.words(
    "daughter son wife husband mother father mum mom dad brother sister friend colleague boss aunt "
    "uncle cousin grandma grandpa grandmother grandfather partner girlfriend boyfriend roommate "
    "flatmate kid child neighbour neighbor niece nephew buddy student teacher"
)
_SOURCES = lexicon.phrases(
    "you found it,you got it,you got it from,you took it from,you picked it up,it came from,"
    "you have it from,you had it from"
)


def bare_phrase(text: Text, start: int) -> NounPhrase | None:
    """The noun phrase that begins at a word, without what follows its noun."""
    return (
        _whichever(text, start)
        or free_relative(text, start)
        or _whereabouts(text, start)
        or pronoun(text, start)
        or _full(text, start)
    )


def _whichever(text: Text, start: int) -> NounPhrase | None:
    """*Whatever fruit is* on the table: any one."""
    if text.word(start) not in ("whatever", "whichever") or not is_content(text, start + 1):
        return None
    phrase = _full(text, start + 1)
    if phrase is None:
        return None
    phrase.start, phrase.determiner = start, "any"
    phrase.end += text.word(phrase.end) in ("is", "are")
    return phrase


def _whereabouts(text: Text, start: int) -> NounPhrase | None:
    """*Where Ada is*: at Ada's; *where the cup was*: a place without a name."""
    if text.word(start) != "where":
        return None
    source = text.phrase_end(_SOURCES, start + 1)
    if source:
        it = NounPhrase(start, source, noun="pronoun", said="it")
    else:
        found = pronoun(text, start + 1) or _full(text, start + 1)
        if found is None or text.word(found.end) not in _STANDS:
            return None
        it = found
        it.start, it.end = start, it.end + 1
    person = it.is_person or it.said in ("he", "she")
    named = it.name("place", "room") and not it.name("object", "category")
    it.where = "" if person or named else text.raw(start, it.end)
    return it


def _full(text: Text, start: int) -> NounPhrase | None:
    phrase = NounPhrase(start, start)
    at = read_quantity(text, phrase, start)
    at = read_adjectives(text, phrase, at)
    named = text.name_at(at + 1)
    if text.word(at) in _KIN and named and named.of("person") and phrase.determiner:
        at += 1  # my daughter Mia
    end = read_noun(text, phrase, at)
    if end is None and at > start:
        end = _elliptic(text, phrase, at)
    if end is None:
        return None
    phrase.end = end
    return _owned(text, phrase)


def _elliptic(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """A phrase without a noun: "the blue", "the largest", "all of them", "two"."""
    if text.word(at) == "of" and not phrase.superlative:
        return at if phrase.count else None
    told_apart = phrase.color or phrase.size or phrase.superlative or phrase.level or phrase.other
    if phrase.determiner and told_apart:
        phrase.noun, phrase.said = "one", "one"
        return at
    return None


def _owned(text: Text, phrase: NounPhrase) -> NounPhrase | None:
    """Julia's cup, the kitchen's table: the owner is passed over, a room says where."""
    after = text.word(phrase.end + 1)
    if text.word(phrase.end) != "'s" or not is_content(text, phrase.end + 1):
        return phrase
    if property_of(after) or after in ("question", "questions", "quiz"):
        return phrase
    owned = _full(text, phrase.end + 1)
    if owned is None:
        return phrase
    owned.start = phrase.start
    owned.owner = phrase.name("person")
    if phrase.name("room", "place") and owned.noun == "name":
        owned.places.append(Locative("in", phrase))
    return owned
