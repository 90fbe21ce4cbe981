"""Noun phrases: "the three largest red cups on the table in the kitchen".

A noun phrase is read in three parts: what stands before the noun (how many, which, what colour),
the noun (a name of the vocabulary, a word like "thing" or "person", or a word not known), and what
follows it (see :mod:`intents.english.postmodifiers`). Nothing is decided here about what the
phrase is for; :mod:`intents.english.referents` turns it into an object, a person or a place.
"""

from intents.english import lexicon
from intents.english.lexer import QUOTE
from intents.english.lexicon import ALL, COLORS, DETERMINERS, GENDERS, LEVELS, SIZES
from intents.english.measures import UNIT_WORDS, number
from intents.english.names import Match
from intents.english.phrase import SOMETHING, Locative, NounPhrase, is_content
from intents.english.pronouns import free_relative, part_of, pronoun
from intents.english.properties import property_of
from intents.english.text import Text
from intents.english.verbs import verbs_at

_PARTS = lexicon.words("door doors lid flap")
"""Parts of furniture that stand for the whole: the cabinet door."""
_APART = ("different", "separate")
_STANDS = lexicon.words("is are am was were stands stood sits sat lies lay belongs goes")
_SOURCES = lexicon.phrases(
    "you found it,you got it,you got it from,you took it from,you picked it up,it came from,"
    "you have it from,you had it from"
)
_HOLDERS = (lexicon.OBJECT_NOUNS - SOMETHING) | lexicon.CONTAINERS


def noun_phrase(text: Text, start: int) -> NounPhrase | None:
    """The noun phrase that begins at a word, as long as it goes."""
    from intents.english.postmodifiers import read_postmodifiers

    part = part_of(text, start)
    if part:
        return noun_phrase(text, part)
    phrase = (
        _whichever(text, start)
        or free_relative(text, start)
        or _whereabouts(text, start)
        or pronoun(text, start)
        or _full(text, start)
    )
    if phrase is None:
        return None
    read_postmodifiers(text, phrase)
    return phrase


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
    at = _read_quantity(text, phrase, start)
    at = _read_adjectives(text, phrase, at)
    end = _read_noun(text, phrase, at)
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
    if phrase.name("room", "place") and owned.noun == "name":
        owned.places.append(Locative("in", phrase))
    return owned


def _read_quantity(text: Text, phrase: NounPhrase, at: int) -> int:
    """All, both, every, the, my, three: up to where adjectives begin."""
    while True:
        word = text.word(at)
        if word in ALL:
            phrase.count = 2 if word == "both" else "all"
            at += 1
        elif word in DETERMINERS:
            phrase.determiner = word
            at += 1
        elif word == "of" and phrase.count and text.word(at + 1) in DETERMINERS | {"them"}:
            at += 1
        else:
            amount = None if text.name_at(at) else number(text.words, at)
            ordinary = amount and amount.value == int(amount.value) and amount.value < 1000
            units = UNIT_WORDS - lexicon.BODY_NOUNS
            if not ordinary or amount is None or text.word(amount.end) in units:
                return at
            if word == "one" and not is_content(text, amount.end):
                return at
            phrase.count = int(amount.value) if amount.value > 1 else None
            phrase.determiner = phrase.determiner or "a"
            at = amount.end


def _read_adjectives(text: Text, phrase: NounPhrase, at: int) -> int:
    """Colours, sizes, superlatives and the like, up to the noun."""
    while True:
        end = _read_adjective(text, phrase, at)
        if end is None:
            return at
        at = end


def _read_adjective(text: Text, phrase: NounPhrase, at: int) -> int | None:
    word, match = text.word(at), text.name_at(at)
    most = text.lookup(lexicon.SUPERLATIVES, at)
    if most and (match is None or match.end <= most[1]):
        phrase.superlative = most[0]
        return most[1]
    better = lexicon.COMPARATIVES.get(word) if phrase.determiner == "the" else None
    if better and match is None and not (word in LEVELS and _prefixed(text, word, at)):
        phrase.superlative = better
        return at + 1
    if match and (match.end > at + 1 or not is_content(text, at + 1)):
        return None
    if word in COLORS and not (match and verbs_at(text.words, at + 1)):
        phrase.color = COLORS[word]
        return at + 1
    if match:
        return None
    return _read_common_adjective(text, phrase, at)


def _prefixed(text: Text, level: str, at: int) -> bool:
    """Whether the world has a "lower shelf" where "lower" stands before "shelf"."""
    names = (f"{other} {text.word(at + 1)}" for other in LEVELS.get(level, ()))
    return any(text.index.exact(name) for name in names)


def _read_common_adjective(text: Text, phrase: NounPhrase, at: int) -> int | None:
    word, followed = text.word(at), is_content(text, at + 1)
    if word in SIZES and (followed or phrase.determiner) and word != "light":
        phrase.size = SIZES[word]
        return at + 1
    if word in LEVELS and (followed or text.word(at + 1) in lexicon.ONES):
        phrase.level = word
        phrase.side = word if word in ("left", "right") else ""
        return at + 1
    amount = number(text.words, at)
    if amount and followed and amount.value > 1 and amount.value == int(amount.value):
        phrase.count = int(amount.value)
        return amount.end
    end = _read_person_adjective(text, phrase, at)
    if end:
        return end
    if (word == "other" and phrase.determiner == "the") or (word in _APART and followed):
        phrase.other = True
        return at + 1
    if word in lexicon.EMPTY_ADJECTIVES and followed:
        return at + 1
    return None


def _read_person_adjective(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Sitting, waving, male - before a person."""
    word = text.word(at)
    posture = text.lookup(lexicon.POSTURES, at)
    end = posture[1] if posture else at + 1
    if text.word(end) not in lexicon.PERSON_NOUNS | set(GENDERS):
        return None
    if posture:
        phrase.posture = posture[0]
    elif word == "waving":
        phrase.gesture = "waving"
    elif word in GENDERS:
        phrase.gender = GENDERS[word]
    elif word in ("young", "old", "tall", "short", "nice", "kind", "other"):
        pass
    else:
        return None
    return end


def _read_noun(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """The noun itself; None if there is none."""
    word, match = text.word(at), text.name_at(at)
    if match and match.end > at + 1:
        return _read_name(text, phrase, match, at)
    phrase.said = word
    if word in GENDERS or word in lexicon.PERSON_NOUNS:
        phrase.noun, phrase.gender = "person", GENDERS.get(word) or phrase.gender
        if word in lexicon.EVERYONE:
            phrase.count = "all"
        return at + 1
    if word in lexicon.OBJECT_NOUNS:
        phrase.noun = "object"
        return _something(text, phrase, at)
    if match:
        return _read_name(text, phrase, match, at)
    if word in lexicon.ONES:
        phrase.noun = "one"
        return at + 1
    owned = phrase.determiner + phrase.side != "" or text.word(at - 1) in DETERMINERS | ALL
    if word in lexicon.BODY_NOUNS and owned:
        phrase.noun = "body"
        return at + 1
    if word in lexicon.PLACE_NOUNS and phrase.determiner:
        phrase.noun = "place"
        return at + 1
    return _read_unknown(text, phrase, at)


def _something(text: Text, phrase: NounPhrase, at: int) -> int:
    """Something to drink is a drink, where there are drinks."""
    purpose = {"drink": "drink", "eat": "food"}.get(text.word(at + 2), "")
    if text.word(at + 1) == "to" and purpose:
        named = text.index.exact(f"something to {text.word(at + 2)}") or text.index.exact(purpose)
        phrase.noun, phrase.names = ("name", named) if named else ("unknown", ())
        phrase.said = f"something to {text.word(at + 2)}"
        return at + 3
    if text.word(at) == "everything":
        phrase.count = "all"
    if text.word(at) in SOMETHING and text.word(at + 1) in COLORS:
        phrase.color = COLORS[text.word(at + 1)]
        return at + 2
    return at + 1


def _read_name(text: Text, phrase: NounPhrase, match: Match, at: int) -> int:
    """A name, or a compound of names: the last one counts, a room before it says where."""
    phrase.noun, phrase.names, phrase.said = (
        "name",
        match.names,
        " ".join(text.words[at : match.end]),
    )
    end = match.end
    _prefix_level(text, phrase)
    if (
        match.of("room")
        and text.word(end) in ("floor", "area", "room")
        and text.name_at(end) is None
    ):
        return end + 1
    if match.of("person") or text.word(end) == QUOTE:
        return end
    if match.of("place") and text.word(end) in _PARTS and text.word(end + 1) != "of":
        return end + 1
    follower = text.name_at(end)
    if follower and not follower.of("person"):
        outer = NounPhrase(at, end, noun="name", said=phrase.said, names=match.names)
        last = _read_name(text, phrase, follower, end)
        if outer.name("room", "place") and not phrase.name("room"):
            phrase.places.insert(0, Locative("in", outer))
        return last
    if text.word(end) in _HOLDERS and not _goes_on_unknown(text, end + 1):
        return end + (text.word(end + 1) != "you")
    if _goes_on_unknown(text, end):
        return _read_unknown_compound(text, phrase, at, end)
    return end


def _read_unknown_compound(text: Text, phrase: NounPhrase, at: int, end: int) -> int:
    """A name before a word not known: "kitchen table" where there are only other tables."""
    modifier = NounPhrase(at, end, noun="name", said=phrase.said, names=phrase.names)
    phrase.names = ()
    last = _read_unknown(text, phrase, end) or end
    if phrase.names and (phrase.exact or modifier.name("room")):
        if modifier.name("room"):
            phrase.places.insert(0, Locative("in", modifier))
    else:
        phrase.noun, phrase.names = "unknown", ()
    phrase.said = " ".join(text.words[at:last])
    return last


def _goes_on_unknown(text: Text, at: int) -> bool:
    """Whether words that are no names, verbs or people go on with a compound."""
    if text.word(at) in SOMETHING or verbs_at(text.words, at) or _names_person(text, at):
        return False
    if text.lookup(lexicon.SUPERLATIVES, at):
        return False
    return is_content(text, at)


def _names_person(text: Text, at: int) -> bool:
    match = text.name_at(at)
    person_word = text.word(at) in lexicon.PERSON_NOUNS or text.word(at) in GENDERS
    return person_word or bool(match and match.of("person"))


def _prefix_level(text: Text, phrase: NounPhrase) -> None:
    """The upper shelf, where the world has an "upper shelf" or a "top shelf"."""
    for level in LEVELS.get(phrase.level, ()):
        for spelling in (f"{level} {phrase.said}", f"{phrase.said} {level}"):
            named = text.index.exact(spelling)
            if named:
                phrase.names, phrase.level, phrase.side = named, "", ""
                phrase.said = spelling
                return


def _read_unknown(text: Text, phrase: NounPhrase, at: int) -> int | None:
    """Words not known, up to a name that they describe ("mobile phone") or to their end."""
    if text.word(at) == "can" and phrase.determiner:
        phrase.noun = "unknown"
        return at + 1
    end = at
    while end < at + 4 and is_content(text, end) and not _names_person(text, end):
        fresh = end > at or not (phrase.determiner or phrase.color or phrase.size or phrase.level)
        if fresh and verbs_at(text.words, end):
            break
        match = text.name_at(end)
        if match and end > at and match.of("object", "place", "room") and not match.of("category"):
            phrase.said = " ".join(text.words[at : match.end])
            return _read_name(text, phrase, match, end)
        end += 1
    if end == at:
        return None
    phrase.noun, phrase.said = "unknown", " ".join(text.words[at:end])
    _prefix_level(text, phrase)
    if not phrase.names:
        phrase.names, phrase.exact = text.index.partial(text.words[end - 1]), False
    if phrase.names and end == at + 1:
        phrase.noun = "name"
    else:
        phrase.names = ()
    return end
