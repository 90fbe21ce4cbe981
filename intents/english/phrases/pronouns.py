"""Phrases without a noun of their own: "it", "here", "me", "what is on the table"."""

from intents.english.phrases.phrase import SOMETHING, Noun, NounPhrase, is_content
from intents.english.words import lexicon
from intents.english.words.lexicon import DETERMINERS
from intents.english.words.measures import number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at

_PARTS = lexicon.words("top center centre middle front side end edge surface bottom inside corner "
                       "left right rest")  # fmt: skip


_OF_THEM = lexicon.DETERMINERS | {"of"}


def part_of(text: Text, start: int) -> int | None:
    """The top of the counter is the counter: where the whole begins."""
    at = start + (text.word(start) in ("the", "its"))
    at += text.word(at) in ("left", "right", "far", "very") and text.word(at + 1) in _PARTS
    if text.word(at) in _PARTS and text.word(at + 1) == "of" and at > start:
        return at + 2
    return None


def free_relative(text: Text, start: int) -> NounPhrase | None:
    """Bring me *what is on the table*; *whatever weighs* the least."""
    word, after = text.word(start), text.word(start + 1)
    if start == 0 or word not in ("what", "whatever", "whoever"):
        return None
    noun: Noun = "person" if word == "whoever" else "object"
    if after in ("is", "are"):
        return NounPhrase(start, start + 2, noun=noun, said=word)
    if word != "what" or after == "weighs":
        return NounPhrase(start, start + 1, noun=noun, said=word)
    return None


def pronoun(text: Text, start: int) -> NounPhrase | None:
    """Me, it, them, here: a phrase of one word."""
    word = text.word(start)
    if word in lexicon.OPERATOR_WORDS:
        return NounPhrase(start, start + 1, noun="operator", said=word)
    if word in ("the", "your") and text.word(start + 1) in ("operator", "user"):
        return NounPhrase(start, start + 2, noun="operator", said="operator")
    if word in ("here", "there", "back"):
        noun: Noun = "there" if word == "there" else "here"
        return NounPhrase(start, start + 1, noun=noun, said=word)
    if word in ("over", "right") and text.word(start + 1) in ("here", "there"):
        noun = "here" if text.word(start + 1) == "here" else "there"
        return NounPhrase(start, start + 2, noun=noun, said=noun)
    if word == "both" and not is_content(text, start + 1) and text.word(start + 1) not in _OF_THEM:
        return NounPhrase(start, start + 1, noun="pronoun", said=word)
    if word not in lexicon.PRONOUNS:
        return None
    determines = word in DETERMINERS and is_content(text, start + 1)
    if text.word(start + 1) in SOMETHING:
        determines = False
    if determines and (not verbs_at(text.words, start + 1) or text.name_at(start + 1)):
        return None
    if word == "this" and number(text.words, start + 1):
        return None
    end = start + 2 if text.word(start + 1) in ("both", "all") else start + 1
    return NounPhrase(start, end, noun="pronoun", said=word)
