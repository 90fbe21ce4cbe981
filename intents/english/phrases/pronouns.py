"""Phrases without a noun of their own: "it", "here", "me", "what is on the table"."""

from intents.english.phrases.phrase import SOMETHING, Noun, NounPhrase, is_content
from intents.english.words import lexicon
from intents.english.words.lexicon import DETERMINERS
from intents.english.words.measures import number
from intents.english.words.text import Text
from intents.english.words.verbs import verbs_at
from intents.goals import Part

_PARTS = lexicon.words("top center centre middle front side end edge surface bottom inside corner "
                       "left right rest")  # fmt: skip


_OF_THEM = lexicon.DETERMINERS | {"of"}


def part_of(text: Text, start: int) -> tuple[Part | None, int] | None:
    """The top of the counter is the counter: which part of it, and where the whole begins."""
    at = start + (text.word(start) in ("the", "its"))
    which = text.word(at) if text.word(at) in _WHICH and text.word(at + 1) in _PARTS else ""
    at += which != ""
    noun = text.word(at)
    if noun in _PARTS and text.word(at + 1) in ("of", "part") and at > start:
        end = at + 2 + (text.word(at + 1) == "part" and text.word(at + 2) == "of")
        return (_ENDS.get(which) if noun in _END_NOUNS else _PLAIN_PARTS.get(noun)), end
    return None


_ENDS: dict[str, Part] = {
    "left": "left_end", "right": "right_end", "far": "other_end", "farther": "other_end",
    "further": "other_end", "other": "other_end", "opposite": "other_end", "near": "near_end",
    "nearer": "near_end",
}  # fmt: skip
_WHICH = frozenset({*_ENDS, "very"})
_END_NOUNS = ("end", "side")
_PLAIN_PARTS: dict[str, Part] = {
    "center": "middle", "centre": "middle", "middle": "middle", "edge": "edge",
}  # fmt: skip


_MORE = lexicon.words("of more one the other others")
"""Some *of* the tea: no pronoun by itself."""
HELD = "what is held"
_IN_HAND = lexicon.phrases(
    "you are holding,you hold,you are carrying,you carry,you have in your hand,"
    "you have in your hands,you have got in your hand,you have got,you are holding there,"
    "is in your hand,is in your hands,you have got in your hands,you are gripping"
)


def free_relative(text: Text, start: int) -> NounPhrase | None:
    """Bring me *what is on the table*; *whatever weighs* the least."""
    word, after = text.word(start), text.word(start + 1)
    if start == 0 or word not in ("what", "whatever", "whoever"):
        return None
    held = text.phrase_end(_IN_HAND, start + 1) if word != "whoever" else None
    if held:
        return NounPhrase(start, held, noun="pronoun", said=HELD)
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
    if word in ("here", "there", "back") and text.name_at(start) is None:  # the back door
        noun: Noun = "there" if word == "there" else "here"
        return NounPhrase(start, start + 1, noun=noun, said=word)
    if word in ("over", "right") and text.word(start + 1) in ("here", "there"):
        noun = "here" if text.word(start + 1) == "here" else "there"
        return NounPhrase(start, start + 2, noun=noun, said=noun)
    if word == "both" and not is_content(text, start + 1) and text.word(start + 1) not in _OF_THEM:
        return NounPhrase(start, start + 1, noun="pronoun", said=word)
    if word == "some" and not is_content(text, start + 1) and text.word(start + 1) not in _MORE:
        return NounPhrase(start, start + 1, noun="pronoun", said=word)
    if word not in lexicon.PRONOUNS:
        return None
    determines = word in DETERMINERS and is_content(text, start + 1)
    if text.word(start + 1) in SOMETHING:
        determines = False
    described = text.word(start + 1) in lexicon.EMPTY_ADJECTIVES and is_content(text, start + 2)
    if determines and (described or not verbs_at(text.words, start + 1) or text.name_at(start + 1)):
        return None
    if word == "this" and number(text.words, start + 1):
        return None
    end = start + 2 if text.word(start + 1) in ("both", "all") else start + 1
    return NounPhrase(start, end, noun="pronoun", said=word)
