"""What stands before the noun: how many, which, what colour, what size."""

from intents.english.phrases.phrase import NounPhrase, is_content
from intents.english.words import lexicon
from intents.english.words.lexicon import ALL, DETERMINERS, GENDERS, LEVELS, SIZES
from intents.english.words.measures import UNIT_WORDS, number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_STRESSED = lexicon.words("very really absolutely absolute single actual ever most so far")
"""What only stresses a superlative: the *very* smallest cup."""
_APART = ("different", "separate")


def read_quantity(text: Text, phrase: NounPhrase, at: int) -> int:
    """All, both, every, the, my, three: up to where adjectives begin."""
    while True:
        word = text.word(at)
        if word in ALL:
            phrase.count = 2 if word == "both" else "all"
            at += 1
        elif word in DETERMINERS:
            phrase.determiner = word
            at += 1
        elif word == "of" and _partitive(phrase) and text.word(at + 1) in DETERMINERS | {"them"}:
            at += 1
        elif word == "and" and text.word(at - 1) in ALL and text.word(at + 1) in ALL:
            at += 1  # each and every cup
        elif _two_of_a_kind(text, at):
            phrase.count = 2
            at += 2
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


def _partitive(phrase: NounPhrase) -> bool:
    """All *of the* cups; some *of the* tea."""
    return bool(phrase.count) or phrase.determiner in ("some", "any")


def _two_of_a_kind(text: Text, at: int) -> bool:
    """The pair of *cups* is two of them; a pair of *scissors* is one thing."""
    thing = text.name_at(at + 2) if text.words[at : at + 2] == ["pair", "of"] else None
    name = thing.of("object", "category") if thing else None
    return name is not None and not name.endswith("s")


def read_adjectives(text: Text, phrase: NounPhrase, at: int) -> int:
    """Colours, sizes, superlatives and the like, up to the noun."""
    while True:
        end = _read_adjective(text, phrase, at)
        if end is None:
            return at
        at = end


def _read_adjective(text: Text, phrase: NounPhrase, at: int) -> int | None:
    word, match = text.word(at), text.name_at(at)
    if word in _STRESSED and text.lookup(lexicon.SUPERLATIVES, at + 1):
        return at + 1
    most = text.lookup(lexicon.SUPERLATIVES, at)
    if most and word in LEVELS and _prefixed(text, word, at):
        phrase.level = word
        return at + 1
    if most and (match is None or match.end <= most[1]):
        phrase.superlative = most[0]
        return most[1]
    better = lexicon.COMPARATIVES.get(word) if phrase.determiner == "the" else None
    if better and match is None and not (word in LEVELS and _prefixed(text, word, at)):
        phrase.superlative = better
        return at + 1
    if match and (match.end > at + 1 or not is_content(text, at + 1)):
        return None
    colors = text.index.colors
    if word in colors and not (match and verbs_at(text.words, at + 1)):
        phrase.color = colors[word]
        return at + 1
    if match:
        return None
    if word in ("non", "not") and text.word(at + 1) in colors and is_content(text, at + 2):
        named = colors[text.word(at + 1)]
        phrase.without = NounPhrase(at, at + 2, noun="one", said="one", color=named)
        return at + 2
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
