"""Noun phrases up to their noun: "the three largest red cups", "Julia's cup", "whatever", "it"."""

from intents.english.phrases.nouns import read_noun
from intents.english.phrases.phrase import Locative, NounPhrase, is_content
from intents.english.phrases.premodifiers import read_adjectives, read_quantity
from intents.english.phrases.pronouns import free_relative, pronoun
from intents.english.words import lexicon
from intents.english.words.lexer import COMMA, FULL_STOP
from intents.english.words.properties import property_of
from intents.english.words.text import Text

_STANDS = lexicon.words("is are am was were stands stood sits sat lies lay belongs goes")


_KIN = lexicon.words(
    "daughter son wife husband mother father mum mom dad brother sister friend colleague boss aunt "
    "uncle cousin grandma grandpa grandmother grandfather partner girlfriend boyfriend roommate "
    "flatmate kid child neighbour neighbor niece nephew buddy student teacher"
)
_OF_PEOPLE = (
    _KIN
    | lexicon.PERSON_NOUNS
    | frozenset(lexicon.GENDERS)
    | lexicon.words(
        "young old little wee small big poor dear good nice sweet lovely darling bairn lass lassie "
        "laddie fella fellow chap bloke gent ma'am maam missus mister sir madam nurse doctor "
        "nipper youngster baby toddler granny gran nan nanny grandad"
    )
)
"""What may stand before somebody's name and tells nothing else."""
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
    at = _named_behind(text, at) or read_adjectives(text, phrase, at)
    end = read_noun(text, phrase, at)
    if end is None and at > start:
        end = _elliptic(text, phrase, at)
    if end is None:
        return None
    phrase.end = end
    return _owned(text, phrase)


def _named_behind(text: Text, at: int) -> int | None:
    """My daughter *Mia*; young *Leo*; the wee lad *Leo*: where the name begins."""
    end = at
    while text.word(end) in _OF_PEOPLE and text.name_at(end) is None:
        end += 1
    named = text.name_at(end) if end > at else None
    return end if named and named.of("person") else None


def _elliptic(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """A phrase without a noun: "the blue", "the largest", "all of them", "two"."""
    if text.word(at) == "of" and not phrase.superlative:
        return at if phrase.count else None
    if phrase.determiner in ("some", "any") and at == phrase.start + 1 and _ends(text, at):
        phrase.noun, phrase.said = "pronoun", "it"  # if there is milk, bring me some
        return at
    told_apart = phrase.color or phrase.size or phrase.superlative or phrase.level or phrase.other
    if phrase.determiner and told_apart:
        phrase.noun, phrase.said = "one", "one"
        return at
    return None


def _ends(text: Text, at: int) -> bool:
    return at >= len(text) or text.word(at) in (COMMA, FULL_STOP, "and", "from", "then")


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
    owned.start, owned.owner = phrase.start, phrase.name("person")
    if phrase.name("room", "place") and owned.noun == "name":
        owned.places.append(Locative("in", phrase))
    return owned
