"""The noun of a phrase: a name of the vocabulary, a word like "thing", or a word not known."""

from intents.english.phrases.phrase import SOMETHING, Locative, NounPhrase, is_at_it, is_content
from intents.english.words import lexicon
from intents.english.words.lexer import QUOTE
from intents.english.words.lexicon import ALL, DETERMINERS, GENDERS, LEVELS
from intents.english.words.names import Match
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_PARTS = lexicon.words("door doors lid flap")
"""Parts of furniture that stand for the whole: the cabinet door."""

_HOLDERS = (lexicon.OBJECT_NOUNS - SOMETHING) | lexicon.CONTAINERS


def read_noun(text: Text, phrase: NounPhrase, at: int) -> int | None:
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
    color = text.index.colors.get(text.word(at + 1))
    if text.word(at) in SOMETHING and color:
        phrase.color = color
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
    if text.word(end) in LEVELS and not phrase.level and text.word(end) not in ("left", "right"):
        phrase.level = text.word(end)  # shelf upper
        _prefix_level(text, phrase)
        if not phrase.level:
            return end + 1 + (text.word(end + 1) in lexicon.BOARDS)
        phrase.level = ""
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
    if text.lookup(lexicon.SUPERLATIVES, at) or text.words[at : at + 2] == ["end", "up"]:
        return False
    if (text.word(at) == "before" and not text.name_at(at)) or is_at_it(text, at):
        return False
    last = not is_content(text, at + 1) or bool(verbs_at(text.words, at + 1))
    if text.word(at) in text.index.colors and last:
        return False  # cup red
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
        begun = text.index.partial(phrase.said) if end > at + 1 else ()
        phrase.names, phrase.exact = begun or text.index.partial(text.words[end - 1]), False
    if phrase.names and (end == at + 1 or text.index.partial(phrase.said)):
        phrase.noun = "name"
    else:
        phrase.names = ()
    return end
