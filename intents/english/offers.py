"""Offers: a statement that asks for something without saying so is answered with a question.

"I am thirsty" by itself asks for nothing, and who says it wants a drink: the robot asks, with the
goal named, and does nothing before the answer. Beside a command it is background.
"""

from intents.english.clauses.openings import skip_openings
from intents.english.phrases.noun_phrases import noun_phrase
from intents.english.phrases.phrase import NounPhrase
from intents.english.phrases.referents import ME, is_person, to_object, to_person, to_place
from intents.english.reading import Sentence
from intents.english.trouble import ReadingError
from intents.english.words import lexicon
from intents.english.words.text import Text
from intents.goals import Bring, Goal, ObjectQuery, Switch

_FEELS = lexicon.phrases(
    "is,am,are,'s,feels,feel,is feeling,am feeling,looks,is getting,am getting"
)
_HELPS = {
    "thirsty": ("drink", "water", "juice", "lemonade", "water bottle", "bottle"),
    "parched": ("drink", "water", "juice", "lemonade", "water bottle", "bottle"),
    "hungry": ("food", "fruit", "snack", "apple", "banana", "biscuit", "cookie"),
    "starving": ("food", "fruit", "snack", "apple", "banana", "biscuit", "cookie"),
    "peckish": ("snack", "food", "fruit", "biscuit", "cookie", "apple"),
    "cold": ("blanket", "jacket", "sweater", "coat"),
    "freezing": ("blanket", "jacket", "sweater", "coat"),
    "chilly": ("blanket", "jacket", "sweater", "coat"),
    "wet": ("towel", "umbrella"),
}
"""What helps who is so: the first of these that there is."""
_OUT_OF = lexicon.phrases(
    "am out of,is out of,are out of,have run out of,has run out of,ran out of,am running out of,"
    "is running out of,'s out of,"
    "are running out of,am short of,has no more,have no more"
)
_DARK = lexicon.phrases(
    "it is dark,it is too dark,it is so dark,it is very dark,i can not see anything"
)
_COULD_DO = lexicon.phrases(
    "could do with,could use,needs,need,are begging for,is begging for,would like,want some,"
    "wants some,lacks,is missing,are missing"
)
_FALLEN = lexicon.phrases(
    "i have fallen,i fell,i have had a fall,i had a fall,i have tripped,i can not get up,"
    "i can not stand up,i am hurt,i am bleeding,i have hurt myself,i feel faint,i can not breathe,"
    "i am stuck,i am trapped"
)
_QUALIFIERS = lexicon.words("so very really a bit rather quite too still again some more getting")


def would_help(sentence: Sentence) -> Goal | None:
    """What would help who says something that asks for nothing; None if nothing is known to."""
    at = skip_openings(sentence.text, 0)
    try:
        return _lit(sentence, at) or _felt(sentence, at) or _short_of(sentence, at)
    except ReadingError:
        return None


def in_distress(text: Text) -> bool:
    """Help! *I have fallen*: whether somebody says that they are not well off."""
    return any(text.phrase_end(_FALLEN, at) is not None for at in range(len(text)))


def _lit(sentence: Sentence, at: int) -> Goal | None:
    """It is dark in here."""
    if sentence.text.phrase_end(_DARK, at) is None:
        return None
    lamps = (n for word in ("lamp", "light", "lights") for n in sentence.text.index.exact(word))
    return Switch(what=next((lamp.name for lamp in lamps), "light"), on=True)


def _felt(sentence: Sentence, at: int) -> Goal | None:
    """Grandma is cold."""
    text, scope = sentence.text, sentence.scope
    phrase = noun_phrase(text, at)
    if phrase is None or not is_person(phrase, scope):
        return None
    n = text.phrase_end(_FEELS, phrase.end) or phrase.end
    while text.word(n) in _QUALIFIERS:
        n += 1
    known = (name for word in _HELPS.get(text.word(n), ()) for name in text.index.exact(word))
    help_ = next((name for name in known if name.kind in ("object", "category")), None)
    if help_ is None or n == phrase.end:
        return None
    what = ObjectQuery(name=help_.name) if help_.kind == "object" else None
    what = what or ObjectQuery(category=help_.name, count=1)
    return Bring(object=what, to=to_person(phrase, scope))


def _short_of(sentence: Sentence, at: int) -> Goal | None:
    """We are out of milk; the printer has run out of paper."""
    text, scope = sentence.text, sentence.scope
    we = NounPhrase(at, at + 1, noun="operator", said="we") if text.word(at) == "we" else None
    phrase = we or noun_phrase(text, at)
    start = text.phrase_end(_OUT_OF | _COULD_DO, phrase.end) if phrase else None
    while start is not None and text.word(start) in _QUALIFIERS:
        start += 1
    lacking = noun_phrase(text, start) if start is not None else None
    if phrase is None or lacking is None or lacking.is_person:
        return None
    thing = to_object(lacking, scope)
    if phrase.noun in ("operator", "pronoun") or is_person(phrase, scope):
        mine = phrase.noun == "operator" or phrase.said in ("we", "they", "it")
        return Bring(object=thing, to=ME if mine else to_person(phrase, scope))
    place = to_place(phrase, scope) if phrase.is_spot else None
    return Bring(object=thing, to=place or ME)
